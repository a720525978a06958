//! How much each constraint is violated over time: two strips on one scale, before above after.

use super::part;
use crate::discrepancy::report::{Pictures, ResidualPicture};
use crate::number_format::significant;
use crate::picture::axis::{Axis, extent, widened};
use crate::picture::decimate;
use crate::picture::plot::{Panel, Size, frame_svg};
use crate::picture::svg::{Element, cut, label};
use crate::wording::counted;
use std::collections::BTreeSet;

/// Residuals that get a pair of strips; further ones get one strip for both models.
const MOST_PANELS: usize = 12;
/// Residuals that are drawn.
const MOST_DRAWN: usize = 72;
/// Points along a strip for both models: extremes of so many stretches of time.
const STRETCHES: f64 = 60.0;
/// Width of a panel, pixels.
const WIDTH: f64 = 520.0;
/// Height of a strip, pixels.
const STRIP: f64 = 158.0;
/// Height of the heading, pixels.
const TOP: f64 = 24.0;

/// A strip and its margins.
const SIZE: Size = Size { width: WIDTH, height: STRIP, margins: [58.0, 20.0, 26.0, 42.0] };

/// A pair of strips for every constraint and run, every constraint at least once.
pub fn figure(pictures: &Pictures) -> Option<Element> {
    let all: Vec<&ResidualPicture> = pictures.residuals.iter().filter(|r| drawable(r)).collect();
    let ordered = ordered(&all);
    if ordered.is_empty() {
        return None;
    }
    let draw = |(i, r): (usize, &&ResidualPicture)| {
        let id = format!("residual-{i}");
        if i < MOST_PANELS { panel(r, &id) } else { both(r, &id) }
    };
    let panels = ordered.iter().take(MOST_DRAWN).enumerate().map(draw).collect();
    let more = all.len().saturating_sub(MOST_DRAWN);
    let rest = if more > 0 {
        format!(" Not drawn: {} of constraint and run.", counted(more, "further pair"))
    } else {
        String::new()
    };
    let dashed =
        if ordered.len() > MOST_PANELS { " Where both stand in one strip, the model as given is dashed." } else { "" };
    let how = format!(
        "What each constraint should keep at zero, computed from the measurement. The grey band is ±2σ of measurement \
         noise: a true model stays inside it 95 % of the time.{dashed}{rest}"
    );
    Some(part::figure(panels, None, "The violated constraints over time: the patch should leave only noise.", &how))
}

fn drawable(r: &ResidualPicture) -> bool {
    r.time.iter().zip(&r.before).any(|(t, v)| t.is_finite() && v.is_finite())
}

/// The first residual of every constraint, then the others in their order.
fn ordered<'a>(all: &[&'a ResidualPicture]) -> Vec<&'a ResidualPicture> {
    let mut seen = BTreeSet::new();
    let (first, further): (Vec<_>, Vec<_>) = all.iter().partition(|r| seen.insert(r.constraint.as_str()));
    first.into_iter().chain(further).collect()
}

fn panel(r: &ResidualPicture, id: &str) -> Element {
    let size = Size { width: WIDTH, height: TOP + 2.0 * STRIP + 6.0, margins: [0.0; 4] };
    let strips = [("before", "model as given", &r.before), ("after", "patched model", &r.after)];
    let strip = |(i, (class, name, values)): (usize, (&str, &str, &Vec<f64>))| {
        strip(r, class, name, values, &format!("{id}-{class}")).number("y", TOP + STRIP * i as f64)
    };
    let strips: Vec<Element> = strips.into_iter().enumerate().map(strip).collect();
    frame_svg(size, id, &title(r), &said(r, [", above,", ", below,"])).child(heading(r)).children(strips)
}

/// Both models in one strip.
fn both(r: &ResidualPicture, id: &str) -> Element {
    let size = Size { width: WIDTH, height: TOP + STRIP, margins: [0.0; 4] };
    let mut panel = banded(r, ["time", "s"]);
    let time = extent(r.time.iter().copied()).unwrap_or([0.0, 1.0]);
    let stretches = STRETCHES / (time[1] - time[0]).max(f64::MIN_POSITIVE);
    for (class, values) in [("before slim", &r.before), ("after slim", &r.after)] {
        let points: Vec<_> = r.time.iter().zip(values).map(|(t, v)| [(t - time[0]) * stretches, *v]).collect();
        let extremes = decimate::columns(&points);
        panel.series(class, &extremes.iter().map(|p| [time[0] + p[0] / stretches, p[1]]).collect::<Vec<_>>());
    }
    let said = said(r, [", dashed,", ""]);
    let strip = panel.finish(&format!("{id}-both"), "both models", "").number("width", WIDTH).number("height", STRIP);
    frame_svg(size, id, &title(r), &said).child(heading(r)).child(strip.number("y", TOP))
}

fn title(r: &ResidualPicture) -> String {
    format!("Violation of the {} in {}", cut(&r.constraint, 40), cut(&r.run, 40))
}

/// What a panel shows, with its numbers and where each of the models is.
fn said(r: &ResidualPicture, [of_given, of_patched]: [&str; 2]) -> String {
    let most = |values: &[f64]| values.iter().map(|v| v.abs()).filter(|v| v.is_finite()).fold(0.0, f64::max);
    let [before, after] = [&r.before, &r.after].map(|v| significant(most(v), 2));
    format!(
        "At most {before} {unit} before{of_given} and {after} {unit} after{of_patched} on one scale; the band is twice the noise, \
         {} {unit}.",
        significant(2.0 * r.noise, 2),
        unit = r.unit
    )
}

fn heading(r: &ResidualPicture) -> Element {
    let remark = Element::new("tspan").with("dx", "6").with("style", "font-weight:400;fill:var(--soft)");
    label("heading", [2.0, 18.0], "start", cut(&r.constraint, 30)).child(remark.text(cut(&r.run, 30)))
}

fn strip(r: &ResidualPicture, class: &str, name: &str, values: &[f64], id: &str) -> Element {
    let mut panel = banded(r, if class == "after" { ["time", "s"] } else { [""; 2] });
    let points: Vec<_> = r.time.iter().zip(values).map(|(t, v)| [*t, *v]).collect();
    panel.series(&format!("{class} thin"), &points);
    panel.note(label("strong", [SIZE.columns()[1], 14.0], "end", name));
    panel.finish(id, name, "").number("width", WIDTH).number("height", STRIP)
}

/// An empty strip: its axes, zero, and the band of noise.
fn banded(r: &ResidualPicture, [name_x, unit_x]: [&str; 2]) -> Panel {
    let time = extent(r.time.iter().copied()).unwrap_or([0.0, 1.0]);
    let x = Axis::linear(name_x, unit_x, if time[0] < time[1] { time } else { widened(time, 0.0) });
    let y = Axis::linear("violation", &r.unit, widened(value_range(r), 0.06));
    let mut panel = Panel::new(SIZE, x.along(SIZE.columns()), y.along(SIZE.rows()));
    if r.noise.is_finite() {
        let two = 2.0 * r.noise;
        panel.band(&time.map(|t| (t, [-two, two])));
    }
    panel.series("zero", &time.map(|t| [t, 0.0]));
    if r.noise.is_finite() {
        panel.series("floor", &time.map(|t| [t, 2.0 * r.noise]));
        panel.series("floor", &time.map(|t| [t, -2.0 * r.noise]));
    }
    panel
}

/// One range for both strips, with the noise band inside.
fn value_range(r: &ResidualPicture) -> [f64; 2] {
    let noise = if r.noise.is_finite() { 2.4 * r.noise } else { 0.0 };
    extent(r.before.iter().chain(&r.after).copied().chain([noise, -noise])).unwrap_or([-1.0, 1.0])
}
