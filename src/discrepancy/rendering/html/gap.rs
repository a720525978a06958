//! The gap over the horizon, before and after, against what noise alone makes.

use super::head::shrinkage;
use super::part;
use crate::discrepancy::report;
use crate::discrepancy::report::{BeforeAfter, GapCurve, Pictures, Report};
use crate::discrepancy::report::{judged, judged_alike, middle};
use crate::number_format::{plain, prefixed, significant};
use crate::picture::axis::{Axis, extent};
use crate::picture::plot::{Marker, Panel, Size};
use crate::picture::svg::{Element, label, line, path};

/// A panel with room for names at the ends of the lines.
pub const SIZE: Size = Size { margins: [58.0, 138.0, 50.0, 46.0], ..Size::PANEL };
/// Pixels between ticks along the horizon: its labels are short.
const TICKS: f64 = 44.0;
/// Horizons up to which every one gets a marker.
const MOST_MARKERS: usize = 14;

/// Whether the axes are linear, to show how much smaller, or logarithmic, to show how near the floor.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Axes {
    /// Linear from zero.
    LinearisedWindow,
    /// Both logarithmic.
    Log,
}

/// The gap on logarithmic axes.
pub fn figure(report: &Report, pictures: &Pictures) -> Option<Element> {
    let curve = curve(report, pictures)?;
    let mut drawings = vec![panel(report, &curve, Axes::Log, SIZE, "gap-log")?];
    drawings.extend(heading_curve(report).and_then(|c| heading_panel(report, &c)));
    let see = "The gap over the horizon on logarithmic axes: how near the patched model comes to the noise.";
    let how = format!(
        "RMS error of prediction on the {} data after the model was restarted on the measured path. Inside the grey band \
         measurement noise alone explains the error.",
        data_name(report)
    );
    Some(part::figure(drawings, None, see, &how))
}

/// What the gap was measured on.
pub fn data_name(report: &Report) -> &'static str {
    middle(&report.gap).and_then(judged).map_or("measured", |(name, _)| name)
}

/// The curve of the pictures, or the horizons of the table where there is none; none with nothing to draw.
pub fn curve(report: &Report, pictures: &Pictures) -> Option<GapCurve> {
    let drawable = |c: &GapCurve| c.before.iter().any(|v| v.is_finite()) && !c.horizon.is_empty();
    let given = Some(pictures.gap.clone()).filter(|c| drawable(c));
    let position = |v: &BeforeAfter| [Some(v.position_rms_before), Some(v.position_rms_after)];
    given.or_else(|| Some(tabled(report, position, |f| Some(f.position_rms))).filter(drawable))
}

fn heading_curve(report: &Report) -> Option<GapCurve> {
    let heading = |v: &BeforeAfter| [v.heading_rms_before, v.heading_rms_after];
    Some(tabled(report, heading, |f| f.heading_rms)).filter(|c| c.before.iter().any(|v| v.is_finite()))
}

fn tabled(
    report: &Report,
    values: impl Fn(&BeforeAfter) -> [Option<f64>; 2],
    floor: impl Fn(&report::Floor) -> Option<f64>,
) -> GapCurve {
    let mut curve = GapCurve::default();
    for (gap, (_, v)) in judged_alike(&report.gap).into_iter().filter_map(|g| Some((g, judged(g)?))) {
        let [before, after] = values(v).map(|v| v.unwrap_or(f64::NAN));
        curve.horizon.push(gap.horizon_s);
        curve.before.push(before);
        curve.after.push(after);
        curve.floor.push(floor(&gap.noise_floor).unwrap_or(f64::NAN));
    }
    curve
}

/// Position gap over horizon.
pub fn panel(report: &Report, curve: &GapCurve, axes: Axes, size: Size, id: &str) -> Option<Element> {
    let mut panel = drawn(curve, ("position error", "m"), axes, size)?;
    if axes == Axes::LinearisedWindow {
        shrink_arrow(&mut panel, report, curve);
    }
    panel.heading("Position error over horizon", &format!("{} data", data_name(report)));
    let description = described(curve, "m");
    Some(panel.finish(id, "Position error over the horizon", &description))
}

fn heading_panel(report: &Report, curve: &GapCurve) -> Option<Element> {
    let mut panel = drawn(curve, ("heading error", "rad"), Axes::Log, SIZE)?;
    panel.heading("Heading error over horizon", &format!("{} data", data_name(report)));
    Some(panel.finish("gap-heading", "Heading error over the horizon", &described(curve, "rad")))
}

/// What a curve shows, with its numbers at both ends.
fn described(curve: &GapCurve, base: &str) -> String {
    let at = |i: usize| {
        let values = [curve.before[i], curve.after[i], curve.floor[i]];
        let (factor, unit) = prefixed(values.into_iter().filter(|v| v.is_finite()).fold(0.0, f64::max), base);
        let [before, after, floor] = values.map(|v| significant(v * factor, 2));
        let horizon = plain(curve.horizon[i]);
        format!(
            "{horizon} s ahead the model as given errs by {before} {unit}, the patched one by {after}, noise makes {floor}"
        )
    };
    match curve.horizon.len() {
        0 => String::new(),
        1 => format!("{}.", at(0)),
        n => format!("{}; {}.", at(0), at(n - 1)),
    }
}

fn drawn(curve: &GapCurve, (name, base): (&str, &str), axes: Axes, size: Size) -> Option<Panel> {
    let all = || curve.before.iter().chain(&curve.after).chain(&curve.floor).copied();
    let [_, largest] = extent(all())?;
    let (factor, unit) = prefixed(largest, base);
    let positive = |values: &mut dyn Iterator<Item = f64>| extent(values.filter(|v| *v > 0.0));
    let [nearest, farthest] = positive(&mut curve.horizon.iter().copied())?;
    let [x, y] = match axes {
        Axes::LinearisedWindow => [
            Axis::linear("horizon", "s", [0.0, farthest]),
            Axis::linear(name, &unit, [0.0, (largest * factor * 1.06).max(1e-9)]),
        ],
        Axes::Log => {
            let [low, high] = a_decade(positive(&mut all())?);
            [Axis::log("horizon", "s", [nearest, farthest]), Axis::log(name, &unit, [low * factor, high * factor])]
        }
    };
    let bottom = y.range[0];
    let mut panel = Panel::new(size, x.along(size.columns()), y.along(size.rows())).with_ticks(TICKS);
    let points = |values: &[f64]| curve.horizon.iter().zip(values).map(|(h, v)| [*h, v * factor]).collect::<Vec<_>>();
    let [before, after, floor] = [&curve.before, &curve.after, &curve.floor].map(|v| points(v));
    panel.band(&floor.iter().map(|p| (p[0], [bottom, p[1]])).collect::<Vec<_>>());
    panel.series("floor", &floor);
    draw_line(&mut panel, "before", Marker::Square, &before);
    draw_line(&mut panel, "after", Marker::Circle, &after);
    let ends = [(&before, "model as given"), (&after, "patched model"), (&floor, "noise floor")];
    let last = |(points, name): &(&Vec<[f64; 2]>, &'static str)| points.last().map(|p| (*p, *name));
    panel.end_labels(&ends.iter().filter_map(last).collect::<Vec<_>>());
    Some(panel)
}

/// A range widened to a factor of ten at least, so that a small difference does not look large.
fn a_decade([low, high]: [f64; 2]) -> [f64; 2] {
    let pad = (10.0 * low / high).max(1.0).sqrt();
    [low / pad, high * pad]
}

fn draw_line(panel: &mut Panel, class: &str, marker: Marker, points: &[[f64; 2]]) {
    panel.series(class, points);
    let stride = points.len().div_ceil(MOST_MARKERS).max(1);
    let marked: Vec<_> = points.iter().rev().step_by(stride).copied().collect();
    panel.markers(class, marker, &marked);
}

/// An arrow from the gap before to the gap after at the middle horizon, with how much smaller it is.
fn shrink_arrow(panel: &mut Panel, report: &Report, curve: &GapCurve) {
    let Some(gap) = middle(&report.gap) else { return };
    let Some((_, v)) = judged(gap) else { return };
    let Some(times) = shrinkage(v.position_rms_before, v.position_rms_after) else { return };
    let largest = extent(curve.before.iter().chain(&curve.after).chain(&curve.floor).copied()).map_or(0.0, |r| r[1]);
    let (factor, _) = prefixed(largest, "m");
    let at = |value: f64| panel.place([gap.horizon_s, value * factor]);
    let (from, to) = (at(v.position_rms_before), at(v.position_rms_after));
    let room = to[1] - from[1];
    if room.is_nan() || room < 44.0 {
        return;
    }
    let (top, tip) = (from[1] + 9.0, to[1] - 9.0);
    let x = from[0];
    panel.note(line("line arrow", [x, top], [x, tip - 7.0]));
    panel.note(path("mark arrow", &[[x, tip], [x - 4.5, tip - 9.0], [x + 4.5, tip - 9.0]]));
    let text = format!("{times} at {} s", plain(gap.horizon_s));
    panel.note(label("strong", [x + 9.0, (top + tip) / 2.0 + 4.0], "start", text));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithmic_axes_span_the_values_in_their_unit() {
        let curve = GapCurve {
            horizon: vec![1.0, 10.0],
            before: vec![0.05, 0.2],
            after: vec![0.012, 0.03],
            floor: vec![0.011, 0.011],
        };
        let panel = drawn(&curve, ("position RMS", "m"), Axes::Log, SIZE).unwrap().finish("gap", "Gap", "").to_string();
        assert!(panel.contains(">100<") && panel.contains("mm"), "{panel}");
        for far in [">0.01<", ">0.1<", ">1<", ">1000<"] {
            // The horizon has a tick at 1 s.
            assert!(panel.matches(far).count() <= usize::from(far == ">1<"), "{far} in {panel}");
        }
    }
}
