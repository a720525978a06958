//! Runs seen from above: measured, predicted before, predicted after.

use super::part;
use crate::discrepancy::report::{PathPicture, Pictures};
use crate::number_format::{prefixed, significant};
use crate::picture::axis::{Axis, equal_aspect, extent, widened};
use crate::picture::plot::{Key, Marker, Panel, Size};
use crate::picture::svg::{Element, cut};
use crate::wording::counted;

/// Runs that get a panel.
const MOST_PANELS: usize = 6;
/// Points of one line of one panel.
const MOST_POINTS: usize = 2200;
/// Restarts that get a ring; with more the rings would hide the path.
const MOST_RINGS: usize = 40;

/// What the lines of some runs are called, but for those that none of them has.
pub fn keys(runs: &[&PathPicture]) -> Vec<Key<'static>> {
    let key = |class, marker, label| Key { class, marker, label };
    let given = runs.iter().any(|r| !r.before.is_empty());
    let patched = runs.iter().any(|r| !r.after.is_empty());
    [
        (true, key("measured", None, "measured")),
        (given, key("before", None, "model as given")),
        (patched, key("after", None, "patched model")),
        (given, key("start", Some(Marker::Ring), "restart")),
    ]
    .into_iter()
    .filter_map(|(drawn, key)| drawn.then_some(key))
    .collect()
}

/// A panel for every run, the held-out ones first; none with fewer than two runs, which the story shows already.
pub fn figure(pictures: &Pictures) -> Option<Element> {
    let mut runs: Vec<&PathPicture> = pictures.paths.iter().filter(|p| frame(p).is_some()).collect();
    runs.sort_by_key(|p| !p.held_out);
    if runs.len() < 2 {
        return None;
    }
    let more = runs.len().saturating_sub(MOST_PANELS);
    let draw = |(i, p): (usize, &&PathPicture)| panel(p, Size::PANEL, false, &format!("path-{i}"));
    let panels: Vec<Element> = runs.iter().take(MOST_PANELS).enumerate().filter_map(draw).collect();
    let rest = if more > 0 { format!(" Not drawn: {}.", counted(more, "further run")) } else { String::new() };
    let how =
        format!("{}{rest}", "Both axes have the same scale. At every ring the model restarts on the measured path.");
    Some(part::figure(
        panels,
        Some(key(&runs)),
        "Every run from above: where the dashed line leaves the grey one, the model is wrong.",
        &how,
    ))
}

/// The legend, as text that does not shrink with the drawings.
pub fn key(runs: &[&PathPicture]) -> Element {
    let entry = |key: &Key| {
        let swatch = Element::new("i").with("class", format!("swatch {}", key.class));
        Element::new("span").child(swatch).text(key.label)
    };
    Element::new("p").with("class", "legend").children(keys(runs).iter().map(entry))
}

/// One run; a close-up shows the piece in which the two models part most, where the whole run would not show it.
pub fn panel(run: &PathPicture, size: Size, close_up: bool, id: &str) -> Option<Element> {
    let whole = frame(run)?;
    let near = if close_up { parting(run, whole) } else { None };
    let [horizontal, vertical] = near.unwrap_or(whole);
    let x = Axis::linear("x", "m", horizontal).along(size.columns());
    let y = Axis::linear("y", "m", vertical).along(size.rows());
    let (x, y) = equal_aspect(x, y);
    let mut panel = Panel::new(size, x, y);
    panel.pieces("measured", std::slice::from_ref(&run.measured), MOST_POINTS);
    panel.pieces("before", &run.before, MOST_POINTS);
    panel.pieces("after", &run.after, MOST_POINTS);
    panel.markers("start", Marker::Ring, &restarts(run));
    let part = match (run.held_out, run.after.is_empty()) {
        (true, _) => "held out",
        (_, true) => "not fitted",
        _ => "fitted",
    };
    let remark = [part, if near.is_some() { ", close-up" } else { "" }];
    panel.heading(&run.run, &remark.concat());
    let title = format!("Path of {}", cut(&run.run, 60));
    Some(panel.finish(id, &title, &described(run, whole)))
}

/// What a run seen from above shows, with its numbers.
fn described(run: &PathPicture, [x, y]: [[f64; 2]; 2]) -> String {
    let [wide, high] = [x, y].map(|[from, to]| significant(to - from, 2));
    let size = format!("Seen from above, {wide} m by {high} m");
    let apart = run.before.iter().zip(&run.after).filter_map(|(a, b)| Some((a.last()?, b.last()?)));
    let apart = apart.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).filter(|d| d.is_finite()).fold(0.0, f64::max);
    match (run.before.is_empty(), run.after.is_empty()) {
        (true, _) => format!("{size}: the measured path."),
        (_, true) => format!("{size}: the measured path and the model as given."),
        _ => {
            let (factor, unit) = prefixed(apart, "m");
            format!(
                "{size}: the model as given and the patched one part by {} {unit} at most.",
                significant(apart * factor, 2)
            )
        }
    }
}

fn restarts(run: &PathPicture) -> Vec<[f64; 2]> {
    let starts: Vec<_> = run.before.iter().filter_map(|piece| piece.first().copied()).collect();
    if starts.len() > MOST_RINGS { Vec::new() } else { starts }
}

/// The ranges of x and y that hold all three lines.
fn frame(run: &PathPicture) -> Option<[[f64; 2]; 2]> {
    let pieces = run.before.iter().chain(&run.after).flatten();
    ranges(run.measured.iter().chain(pieces))
}

fn ranges<'a>(points: impl Iterator<Item = &'a [f64; 2]>) -> Option<[[f64; 2]; 2]> {
    let points: Vec<_> = points.filter(|p| p.iter().all(|v| v.is_finite())).collect();
    let along = |i: usize| extent(points.iter().map(|p| p[i])).map(|r| widened(r, 0.04));
    Some([along(0)?, along(1)?])
}

/// The ranges around the piece whose two models end farthest apart, where that would be too small to see on the whole.
fn parting(run: &PathPicture, [x, y]: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let length = (x[1] - x[0]).max(y[1] - y[0]);
    let apart = |(before, after): &(&Vec<[f64; 2]>, &Vec<[f64; 2]>)| match (before.last(), after.last()) {
        (Some(p), Some(q)) => Some((p[0] - q[0]).hypot(p[1] - q[1])).filter(|d| d.is_finite()).unwrap_or(0.0),
        _ => 0.0,
    };
    let pairs = run.before.iter().zip(&run.after);
    let widest = pairs.max_by(|a, b| apart(a).total_cmp(&apart(b)))?;
    let [x, y] = ranges(widest.0.iter().chain(widest.1))?;
    let near = (x[1] - x[0]).max(y[1] - y[0]);
    (apart(&widest) < 0.025 * length && apart(&widest) > 0.0 && near < 0.6 * length)
        .then(|| [widened(x, 0.15), widened(y, 0.15)])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two pieces, in the second of which both models end so far apart.
    fn parted(by: f64) -> PathPicture {
        let line = |from: [f64; 2], to: [f64; 2]| vec![from, to];
        PathPicture {
            run: "a.csv".into(),
            held_out: false,
            measured: vec![],
            before: vec![line([0.0, 0.0], [50.0, 0.0]), line([50.0, 0.0], [90.0, 10.0])],
            after: vec![line([0.0, 0.0], [50.0, 0.001]), line([50.0, 0.0], [90.0, 10.0 + by])],
        }
    }

    #[test]
    fn a_close_up_shows_what_is_too_small_on_the_whole() {
        let whole = [[0.0, 100.0], [0.0, 20.0]];
        let [x, y] = parting(&parted(1.0), whole).unwrap();
        // The piece from 50 to 90 and from 0 to 11, widened twice.
        assert!(x[0] < 45.0 && x[0] > 40.0 && x[1] > 95.0 && x[1] < 100.0, "{x:?}");
        assert!(y[0] < -1.0 && y[0] > -3.0 && y[1] > 12.0 && y[1] < 14.0, "{y:?}");
        assert_eq!(parting(&parted(3.0), whole), None);
        assert_eq!(parting(&parted(1.0), [[0.0, 60.0], [0.0, 20.0]]), None);
        let same = PathPicture { after: parted(0.0).before, ..parted(0.0) };
        assert_eq!(parting(&same, whole), None);
    }
}
