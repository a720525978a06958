//! The numbers behind the map, as the script reads them.

use super::script::packed;
use crate::discrepancy::report::{Forecast, Report};
use crate::picture::svg::Element;
use serde_json::{Value, json};

/// The block of data: every run, and where and when effects hold in part.
pub(super) fn block(report: &Report, forecasts: &[Forecast]) -> Element {
    let data = json!({ "runs": forecasts.iter().map(run).collect::<Vec<_>>(), "patched": is_patched(report), "disks": disks(report) });
    // A bracket of a name never ends the element.
    let text = data.to_string().replace('<', "\\u003c");
    Element::new("script").with("type", "application/json").with("id", "forecasts").verbatim(text)
}

fn run(of: &Forecast) -> Value {
    let pose = |i: usize| packed(of.pose.iter().map(|p| p[i]));
    let points = of.paths.iter().map(|[before, _]| before.len()).max().unwrap_or(0);
    // Without a forecast the robot stays, and the error is less than none.
    let top = top(of);
    let ghosts = |i: usize| {
        let of_place = of.paths.iter().zip(&of.pose).flat_map(move |(both, pose)| {
            both.iter().flat_map(move |path| (0..points).map(move |k| path.get(k).map_or(pose[i], |p| p[i])))
        });
        packed(of_place)
    };
    let error = |k: usize| packed(of.error.iter().map(|e| if e[k].is_finite() { e[k] } else { -0.1 * top }));
    json!({
        "ahead": of.ahead,
        "held": Some(of.held_out_from.max(of.time[0])).filter(|t| t.is_finite()),
        "floor": Some(of.floor).filter(|f| f.is_finite()),
        "top": top,
        "scoped": of.scoped,
        "m": points,
        "t": packed(of.time.iter().copied()),
        "x": pose(0), "y": pose(1), "h": pose(2),
        "before": error(0), "after": error(1),
        "gx": ghosts(0), "gy": ghosts(1),
    })
}

/// Whether the patched model is another than the one given.
pub(super) fn is_patched(report: &Report) -> bool {
    !(report.effects.is_empty() && report.unnamed.is_empty())
}

/// The error at which the scale of a run ends: the largest, and never so little that noise looks like a fault.
pub(super) fn top(of: &Forecast) -> f64 {
    let most = of.error.iter().flatten().copied().filter(|e| e.is_finite()).fold(1e-12, f64::max);
    if of.floor.is_finite() { most.max(4.0 * of.floor) } else { most }
}

/// Where effects hold that hold within a disk: x, y and radius, m.
pub(super) fn disks(report: &Report) -> Vec<[f64; 3]> {
    report.effects.iter().filter_map(|e| e.scope.as_ref()?.disk).collect()
}
