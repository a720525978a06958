//! The words of the page, explained: those of the method, and every effect that is named on it.

use super::part::holding;
use crate::discrepancy::report::Report;
use crate::effects;
use crate::picture::svg::Element;
use std::collections::BTreeSet;

/// Words of the method in the order in which they come up.
const METHOD: [(&str, &str); 8] = [
    (
        "held out",
        "rows or whole runs that are opened after the last choice: nothing is fitted to them, so an error on them is one the model would make on a new drive",
    ),
    (
        "error ahead",
        "the model is put on the measured path and driven by the logged inputs for some seconds; how far it then is from what was measured",
    ),
    (
        "noise alone",
        "the error ahead that the noise of the measured pose would make if the model were true: no model does better",
    ),
    (
        "ΔBIC",
        "the Bayesian information criterion without an effect minus that with it (Schwarz 1978): above 10 the evidence for it is very strong (Kass and Raftery 1995)",
    ),
    ("rotation constraint", "the wheel rolls as far as the vehicle goes; what violates it is creep along the wheel"),
    ("traverse constraint", "the wheel does not move sideways; what violates it is creep across the wheel"),
    (
        "not told from",
        "another effect explains these runs as well, or any runs: the same equation under another name, the same to first order, or no difference in what was driven",
    ),
    ("patched model", "the model as given with what was found added to it"),
];

/// The explained words as a list.
pub(super) fn list(report: &Report) -> Element {
    let named = report
        .effects
        .iter()
        .flat_map(|e| std::iter::once(e.id.as_str()).chain(e.indistinguishable_from.iter().map(|r| r.id.as_str())));
    let ids: BTreeSet<&str> = named.chain(report.refuted.iter().map(|r| r.id.as_str())).collect();
    let known = ids.into_iter().filter_map(effects::named);
    let of_effects = known.map(|e| (e.id.clone(), format!("{}; {}", e.says, e.source)));
    // Where nothing was judged, no word of judging comes up.
    let judged = !report.gap.is_empty();
    entries(method().filter(|(word, _)| judged || word.ends_with("constraint")).chain(of_effects))
}

/// The words of the method alone.
pub(super) fn of_method() -> Element {
    entries(method())
}

fn method() -> impl Iterator<Item = (String, String)> {
    METHOD.iter().map(|(word, says)| ((*word).to_string(), (*says).to_string()))
}

fn entries(all: impl Iterator<Item = (String, String)>) -> Element {
    let entry = |(word, says): (String, String)| [holding("dt", word), holding("dd", says)];
    Element::new("dl").with("class", "words").children(all.flat_map(entry))
}
