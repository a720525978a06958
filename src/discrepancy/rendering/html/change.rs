//! What to change, to copy from; without a script every text stands under its name.

use super::part::holding;
use crate::discrepancy::rendering::plain_text::capitalised;
use crate::discrepancy::report::{Change, NextExperiment};
use crate::picture::svg::Element;

/// The texts to put somewhere, and the next drive beside them; none where there is neither.
pub(super) fn section(changes: &[Change], next: Option<&NextExperiment>) -> Option<Element> {
    let texts: Vec<Element> = changes.iter().enumerate().map(text).collect();
    let next = next.map(next_experiment);
    if texts.is_empty() && next.is_none() {
        return None;
    }
    let heading = (!texts.is_empty()).then(|| holding("h2", "What to change"));
    let texts = (!texts.is_empty()).then(|| Element::new("div").with("class", "texts").children(texts));
    let columns = Element::new("div").with("class", "columns").children(texts).children(next);
    Some(Element::new("section").with("id", "change").children(heading).child(columns))
}

/// What to drive next, where the data cannot tell.
fn next_experiment(next: &NextExperiment) -> Element {
    let body = Element::new("aside").with("class", "next").child(holding("strong", "What to drive next"));
    let [drive, why] = [&next.manoeuvre, &next.why].map(|text| format!("{}.", capitalised(text.trim_end_matches('.'))));
    body.child(holding("p", drive)).child(holding("p", why))
}

fn text((i, of): (usize, &Change)) -> Element {
    Element::new("div")
        .with("class", "text")
        .with("id", format!("change-{i}"))
        .child(holding("h3", &of.of))
        .child(holding("pre", of.text.trim_end()))
}
