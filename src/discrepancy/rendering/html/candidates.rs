//! The candidates by their evidence.

use super::part;
use crate::discrepancy::report::{CandidatePicture, Pictures};
use crate::number_format::plain;
use crate::picture::axis::{Axis, extent};
use crate::picture::bars::{Bar, Look, chart};
use crate::picture::svg::Element;
use crate::wording::counted;

/// Candidates that get a bar, besides those chosen and their rivals.
const MOST_BARS: usize = 14;
/// ΔBIC up to which the axis is linear: evidence below it is weak.
const LINEAR: f64 = 10.0;

/// One bar a candidate, best first.
pub fn figure(pictures: &Pictures) -> Option<Element> {
    let all = &pictures.candidates;
    let shown: Vec<&CandidatePicture> = all
        .iter()
        .enumerate()
        .filter(|(i, c)| *i < MOST_BARS || c.chosen || c.rival)
        .map(|(_, c)| c)
        .take(40)
        .collect();
    if shown.is_empty() {
        return None;
    }
    let [low, high] = extent(shown.iter().map(|c| c.delta_bic).chain([0.0, LINEAR])).unwrap_or([0.0, LINEAR]);
    let axis = Axis::symlog("ΔBIC", "", [low.min(-LINEAR / 2.0) * 1.1, high * 1.1], LINEAR);
    let bars: Vec<Bar> = shown.iter().map(|c| bar(c)).collect();
    let description =
        "Horizontal bars, best first. Filled: chosen. Hatched: not told from a chosen one. Hollow: the rest.";
    let drawing = chart(&bars, axis, "candidates", "Candidates by ΔBIC", description);
    let more = all.len() - shown.len();
    let rest = if more > 0 { format!(" Not drawn: {}.", counted(more, "weaker candidate")) } else { String::new() };
    let how = format!(
        "ΔBIC is the BIC without an effect minus the BIC with it: above 10 the evidence is very strong, below 0 it speaks \
         against the effect. The axis is linear up to ±10 and logarithmic beyond.{rest}"
    );
    Some(part::figure(vec![drawing], None, "The candidates by their evidence.", &how))
}

fn bar(candidate: &CandidatePicture) -> Bar {
    let (look, remark) = match (candidate.chosen, candidate.rival) {
        (true, _) => (Look::Solid, ", chosen"),
        (_, true) => (Look::Hatched, ", not told apart"),
        _ => (Look::Hollow, ""),
    };
    let value = candidate.delta_bic;
    Bar { name: candidate.id.clone(), value, remark: format!("{}{remark}", plain(value)), look }
}
