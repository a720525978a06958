//! The one picture that tells the story: a path and a gap shrinking.

use super::paths;
use super::{gap, part};
use crate::discrepancy::rendering::summary::verdict_sentence;
use crate::discrepancy::report::{PathPicture, Pictures, Report};
use crate::discrepancy::report::{judged, middle};
use crate::number_format::{plain, prefixed, significant};
use crate::picture::plot::{Size, frame_svg, legend};
use crate::picture::svg::{Element, cut, label, rect};
use crate::picture::theme;

/// Pixels above the panels of the stand-alone drawing.
const TOP: f64 = 92.0;
/// Pixels around them.
const MARGIN: f64 = 20.0;

/// The story for the page; none with nothing to draw.
pub fn figure(report: &Report, pictures: &Pictures) -> Option<Element> {
    let panels = panels(report, pictures, "story");
    let key = shown(pictures).map(|run| paths::key(&[run]));
    let see = match middle(&report.gap) {
        Some(_) => headline(report),
        None => "The measured path from above.".into(),
    };
    let how = match shown(pictures) {
        Some(run) if run.before.is_empty() => "Grey is what was measured.",
        Some(run) if run.after.is_empty() => {
            "Grey is what was measured. The dashed line is the model as given, restarted at every ring."
        }
        _ => {
            "Grey is what was measured. The dashed line is the model as given, restarted at every ring; the solid line \
             is the patched model."
        }
    };
    (!panels.is_empty()).then(|| part::figure(panels, key, &format!("{}.", see.trim_end_matches('.')), how))
}

/// The path of a held-out run, or else of any, and the gap.
fn panels(report: &Report, pictures: &Pictures, id: &str) -> Vec<Element> {
    let path = shown(pictures).and_then(|run| paths::panel(run, Size::PANEL, true, &format!("{id}-path")));
    let curve = gap::curve(report, pictures);
    let gap = curve.and_then(|c| gap::panel(report, &c, gap::Axes::LinearisedWindow, gap::SIZE, &format!("{id}-gap")));
    path.into_iter().chain(gap).collect()
}

fn shown(pictures: &Pictures) -> Option<&PathPicture> {
    let drawable = |p: &&PathPicture| p.measured.iter().flatten().any(|v| v.is_finite());
    pictures.paths.iter().filter(drawable).min_by_key(|p| !p.held_out)
}

/// The story as a stand-alone drawing for a README; light and dark, on a ground of its own.
pub fn gap_svg(report: &Report, pictures: &Pictures) -> String {
    let panels = panels(report, pictures, "gap");
    let columns = panels.len().max(1) as f64;
    let width = (2.0 * MARGIN + columns * Size::PANEL.width).max(720.0);
    let body = if panels.is_empty() { 0.0 } else { Size::PANEL.height };
    let size = Size { width, height: TOP + body + MARGIN, margins: [0.0; 4] };
    let sentence = verdict_sentence(report);
    let placed = panels.into_iter().enumerate().map(|(i, panel)| {
        panel
            .number("x", MARGIN + i as f64 * Size::PANEL.width)
            .number("y", TOP)
            .number("width", Size::PANEL.width)
            .number("height", Size::PANEL.height)
    });
    let drawing = frame_svg(size, "gap", &headline(report), &sentence)
        .with("xmlns", "http://www.w3.org/2000/svg")
        .number("width", size.width)
        .number("height", size.height)
        .child(Element::new("style").text(theme::stand_alone()))
        .child(rect("paper", [0.0, 0.0], size.width, size.height))
        .child(label("title", [MARGIN, 40.0], "start", cut(&headline(report), (width / 10.5) as usize)))
        .children(shown(pictures).map(|run| legend(&paths::keys(&[run]), [MARGIN + 4.0, 68.0]).0))
        .children(placed);
    format!("{}\n", drawing.haloed())
}

/// The gap over the horizon alone, on logarithmic axes; none with nothing to draw.
pub fn gap_panel(report: &Report, pictures: &Pictures, size: Size, id: &str) -> Option<Element> {
    gap::panel(report, &gap::curve(report, pictures)?, gap::Axes::Log, size, id)
}

/// What shrank, with its numbers; the verdict where there is no gap.
fn headline(report: &Report) -> String {
    let Some((gap, (name, v))) = middle(&report.gap).and_then(|g| Some((g, judged(g)?))) else {
        return verdict_sentence(report);
    };
    let (factor, unit) = prefixed(v.position_rms_before.max(v.position_rms_after), "m");
    let show = |v: f64| significant(v * factor, 2);
    let name = if name == "held-out" { "Held-out" } else { "Fitted" };
    format!(
        "{name} position error after {} s: {} → {} {unit} (noise floor {} {unit})",
        plain(gap.horizon_s),
        show(v.position_rms_before),
        show(v.position_rms_after),
        show(gap.noise_floor.position_rms)
    )
}
