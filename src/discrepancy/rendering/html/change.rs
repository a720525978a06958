//! What to change, to copy from; without a script every text stands under its name.

use super::head::next_experiment;
use super::part::holding;
use crate::discrepancy::report::{Change, Pictures, Report};
use crate::picture::svg::Element;

/// The texts to put somewhere, and the next drive beside them; none where there is neither.
pub(super) fn section(report: &Report, pictures: &Pictures) -> Option<Element> {
    let texts: Vec<Element> = pictures.changes.iter().enumerate().map(text).collect();
    let next = next_experiment(report);
    if texts.is_empty() && next.is_none() {
        return None;
    }
    let heading = (!texts.is_empty()).then(|| holding("h2", "What to change"));
    let texts = (!texts.is_empty()).then(|| Element::new("div").with("class", "texts").children(texts));
    let columns = Element::new("div").with("class", "columns").children(texts).children(next);
    Some(Element::new("section").with("id", "change").children(heading).child(columns))
}

fn text((i, of): (usize, &Change)) -> Element {
    Element::new("div")
        .with("class", "text")
        .with("id", format!("change-{i}"))
        .child(holding("h3", &of.of))
        .child(holding("pre", of.text.trim_end()))
}
