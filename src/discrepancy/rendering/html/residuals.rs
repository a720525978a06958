//! How much each constraint is violated over time: two strips on one scale, before above after.

use super::part;
use crate::discrepancy::report::{Pictures, ResidualPicture};
use crate::number_format::significant;
use crate::picture::axis::{Axis, extent, widened};
use crate::picture::plot::{Panel, Size, frame_svg};
use crate::picture::svg::{Element, cut, label};
use crate::wording::counted;
use std::collections::BTreeSet;

/// Residuals that get a panel.
const MOST_PANELS: usize = 24;
/// Width of a panel, pixels.
const WIDTH: f64 = 520.0;
/// Height of a strip, pixels.
const STRIP: f64 = 158.0;
/// Height of the heading, pixels.
const TOP: f64 = 24.0;

/// A pair of strips for every constraint and run, every constraint at least once.
pub fn figure(pictures: &Pictures) -> Option<Element> {
    let all: Vec<&ResidualPicture> = pictures.residuals.iter().filter(|r| drawable(r)).collect();
    let chosen = chosen(&all);
    if chosen.is_empty() {
        return None;
    }
    let panels = chosen.iter().enumerate().map(|(i, r)| panel(r, &format!("residual-{i}"))).collect();
    let more = all.len() - chosen.len();
    let rest = if more > 0 {
        format!(" Not drawn: {} of constraint and run.", counted(more, "further pair"))
    } else {
        String::new()
    };
    let how = format!(
        "What each constraint should keep at zero, computed from the measurement. The grey band is ±2σ of measurement \
         noise: a true model stays inside it 95 % of the time.{rest}"
    );
    Some(part::figure(panels, None, "The violated constraints over time: the patch should leave only noise.", &how))
}

fn drawable(r: &ResidualPicture) -> bool {
    r.time.iter().zip(&r.before).any(|(t, v)| t.is_finite() && v.is_finite())
}

/// The first residual of every constraint, then more in their order.
fn chosen<'a>(all: &[&'a ResidualPicture]) -> Vec<&'a ResidualPicture> {
    let mut seen = BTreeSet::new();
    let (first, further): (Vec<_>, Vec<_>) = all.iter().partition(|r| seen.insert(r.constraint.as_str()));
    first.into_iter().chain(further).take(MOST_PANELS).collect()
}

fn panel(r: &ResidualPicture, id: &str) -> Element {
    let size = Size { width: WIDTH, height: TOP + 2.0 * STRIP + 6.0, margins: [0.0; 4] };
    let title = format!("Violation of the {} in {}", cut(&r.constraint, 40), cut(&r.run, 40));
    let most = |values: &[f64]| values.iter().map(|v| v.abs()).filter(|v| v.is_finite()).fold(0.0, f64::max);
    let [before, after] = [&r.before, &r.after].map(|v| significant(most(v), 2));
    let description = format!(
        "At most {before} {unit} before, above, and {after} {unit} after, below, on one scale; the band is twice the noise, \
         {} {unit}.",
        significant(2.0 * r.noise, 2),
        unit = r.unit
    );
    let strips = [("before", "model as given", &r.before), ("after", "patched model", &r.after)];
    let strip = |(i, (class, name, values)): (usize, (&str, &str, &Vec<f64>))| {
        strip(r, class, name, values, &format!("{id}-{class}")).number("y", TOP + STRIP * i as f64)
    };
    frame_svg(size, id, &title, &description).child(heading(r)).children(strips.into_iter().enumerate().map(strip))
}

fn heading(r: &ResidualPicture) -> Element {
    let remark = Element::new("tspan").with("dx", "6").with("style", "font-weight:400;fill:var(--soft)");
    label("heading", [2.0, 18.0], "start", cut(&r.constraint, 30)).child(remark.text(cut(&r.run, 30)))
}

fn strip(r: &ResidualPicture, class: &str, name: &str, values: &[f64], id: &str) -> Element {
    let bottom = 42.0;
    let size = Size { width: WIDTH, height: STRIP, margins: [58.0, 20.0, 26.0, bottom] };
    let time = extent(r.time.iter().copied()).unwrap_or([0.0, 1.0]);
    let [name_x, unit_x] = if class == "after" { ["time", "s"] } else { [""; 2] };
    let x = Axis::linear(name_x, unit_x, if time[0] < time[1] { time } else { widened(time, 0.0) });
    let y = Axis::linear("violation", &r.unit, widened(value_range(r), 0.06));
    let mut panel = Panel::new(size, x.along(size.columns()), y.along(size.rows()));
    if r.noise.is_finite() {
        let two = 2.0 * r.noise;
        panel.band(&time.map(|t| (t, [-two, two])));
    }
    panel.series("zero", &time.map(|t| [t, 0.0]));
    let points: Vec<_> = r.time.iter().zip(values).map(|(t, v)| [*t, *v]).collect();
    panel.series(&format!("{class} thin"), &points);
    if r.noise.is_finite() {
        panel.series("floor", &time.map(|t| [t, 2.0 * r.noise]));
        panel.series("floor", &time.map(|t| [t, -2.0 * r.noise]));
    }
    panel.note(label("strong", [size.columns()[1], 14.0], "end", name));
    panel.finish(id, name, "").number("width", WIDTH).number("height", STRIP)
}

/// One range for both strips, with the noise band inside.
fn value_range(r: &ResidualPicture) -> [f64; 2] {
    let noise = if r.noise.is_finite() { 2.4 * r.noise } else { 0.0 };
    extent(r.before.iter().chain(&r.after).copied().chain([noise, -noise])).unwrap_or([-1.0, 1.0])
}
