//! The columns of runs that are not fitted, over time: where a line of it is wrong, it is seen here.

use super::part;
use crate::discrepancy::report::ColumnPicture;
use crate::number_format::significant;
use crate::picture::axis::{Axis, extent, widened};
use crate::picture::plot::{Panel, Size};
use crate::picture::svg::{Element, cut};
use crate::wording::counted;

/// Columns that get a panel.
const MOST_PANELS: usize = 24;
/// A panel.
const SIZE: Size = Size { width: 520.0, height: 208.0, margins: [62.0, 20.0, 48.0, 44.0] };

/// A panel for every column, the inputs of each run before its pose.
pub fn figure(columns: &[ColumnPicture]) -> Option<Element> {
    let drawable = |c: &&ColumnPicture| c.values.iter().any(|v| v.is_finite());
    let all: Vec<&ColumnPicture> = columns.iter().filter(drawable).collect();
    let draw = |(i, c): (usize, &&ColumnPicture)| panel(c, &format!("column-{i}"));
    let panels: Vec<Element> = all.iter().take(MOST_PANELS).enumerate().map(draw).collect();
    let more = all.len().saturating_sub(MOST_PANELS);
    let rest = if more > 0 { format!(" Not drawn: {}.", counted(more, "further column")) } else { String::new() };
    let how = format!("In SI units, with what the model file says of signs and units.{rest}");
    (!panels.is_empty()).then(|| part::figure(panels, None, "Inputs and pose as they were read.", &how))
}

fn panel(of: &ColumnPicture, id: &str) -> Element {
    let range = |values: &[f64]| extent(values.iter().copied()).unwrap_or([0.0, 1.0]);
    let [from, until] = range(&of.time);
    let values = range(&of.values);
    let x = Axis::linear("time", "s", if from < until { [from, until] } else { widened([from, until], 0.0) });
    let y = Axis::linear(&of.name, &of.unit, widened(values, 0.06));
    let mut panel = Panel::new(SIZE, x.along(SIZE.columns()), y.along(SIZE.rows()));
    let points: Vec<[f64; 2]> = of.time.iter().zip(&of.values).map(|(t, v)| [*t, *v]).collect();
    panel.series("after thin", &points);
    panel.heading(&cut(&of.run, 40), "");
    let [least, most] = values.map(|v| significant(v, 3));
    let said = format!(
        "Between {least} and {most} {}, from {} s to {} s.",
        of.unit,
        significant(from, 3),
        significant(until, 3)
    );
    panel.finish(id, &format!("{} of {}", of.name, of.run), &said)
}
