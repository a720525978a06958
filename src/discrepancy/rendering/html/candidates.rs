//! The candidates by their evidence.

use super::part;
use crate::discrepancy::report::{CandidatePicture, Pictures};
use crate::number_format::plain;
use crate::picture::axis::{Axis, extent};
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
    let range = [low.min(-LINEAR / 2.0) * 1.1, high * 1.05];
    let axis = Axis::symlog("ΔBIC", "", range, LINEAR).along([0.0, 100.0]);
    let rows = shown.iter().flat_map(|c| row(c, &axis));
    let chart = Element::new("div").with("class", "weighed").children(rows);
    let more = all.len() - shown.len();
    let rest = if more > 0 { format!(" Not drawn: {}.", counted(more, "weaker candidate")) } else { String::new() };
    let how = format!(
        "ΔBIC is the BIC without an effect minus the BIC with it, beside nothing else: above 10 the evidence is very strong, \
         below 0 it speaks against the effect. Bars are linear up to ±10 and logarithmic beyond, from the line at 0.{rest}"
    );
    Some(part::figure(vec![chart], None, "The candidates by their evidence, the best first.", &how))
}

/// The name, the value with what became of the candidate, and the bar from zero.
fn row(candidate: &CandidatePicture, axis: &Axis) -> [Element; 3] {
    let (look, remark) = match (candidate.chosen, candidate.rival) {
        (true, _) => ("solid", ", chosen"),
        (_, true) => ("hatched", ", not told apart"),
        _ => ("hollow", ""),
    };
    let value = candidate.delta_bic;
    let zero = axis.at(0.0);
    let to = if value.is_finite() { axis.at(value).clamp(0.0, 100.0) } else { zero };
    part::bar(look, &candidate.id, format!("{}{remark}", plain(value)), zero, to, zero)
}
