//! `report.html`: the finding in one sentence, what it amounts to, what to change, a map to explore, then the evidence.
//!
//! The page holds everything it shows and asks for nothing. All of it but the map's controls reads without its script, on a
//! phone, on a dark screen, on paper and aloud.

mod candidates;
pub(crate) mod cards;
mod change;
pub mod check_page;
mod forecast_data;
mod gap;
mod head;
mod map;
pub(crate) mod part;
mod paths;
mod residuals;
mod runs;
mod script;
mod story;
mod style;
mod tables;
mod words;

use crate::discrepancy::report::{Pictures, Report};
use crate::picture::svg::Element;
use part::{fold, holding};

pub use story::{gap_panel, gap_svg};

/// The report as a self-contained page.
pub fn html(report: &Report, pictures: &Pictures) -> String {
    let title = format!("{} — creepage", head::sentence(report).trim_end_matches('.'));
    let is_explored = !pictures.forecasts.is_empty() || !pictures.changes.is_empty();
    let body = page_body(report, pictures);
    let script = is_explored.then(script::element);
    document(policy_head(&title, &report.provenance.version, is_explored), body, script)
}

/// A document of a head and the main part of its body.
pub(crate) fn page(head: Element, main: Element) -> String {
    document(head, main, None)
}

fn document(head: Element, main: Element, script: Option<Element>) -> String {
    let body = Element::new("body").child(main).children(script);
    let page = Element::new("html").with("lang", "en").child(head).child(body);
    format!("<!DOCTYPE html>\n{page}\n")
}

/// The head of a page that asks for nothing but itself.
pub(crate) fn policy_head(title: &str, version: &str, with_script: bool) -> Element {
    let meta = |name: &'static str, content: &str| Element::new("meta").with("name", name).with("content", content);
    let policy =
        Element::new("meta").with("http-equiv", "Content-Security-Policy").with("content", script::policy(with_script));
    Element::new("head")
        .child(Element::new("meta").with("charset", "utf-8"))
        .child(policy)
        .child(meta("viewport", "width=device-width, initial-scale=1"))
        .child(meta("generator", &format!("creepage {version}")))
        .child(holding("title", title))
        .child(Element::new("style").text(style::page()))
}

fn page_body(report: &Report, pictures: &Pictures) -> Element {
    let map = map::section(report, pictures);
    // Runs that were not fitted have no forecasts: their paths and the gap, where there are such, tell the story.
    let story = if map.is_none() { story::figure(report, pictures) } else { None };
    let evidence = evidence(report, pictures);
    Element::new("main")
        .child(head::header(report, pictures))
        .children(cards::cards(report, pictures))
        .children(change::section(&pictures.changes, report.next_experiment.as_ref()))
        .children(map)
        .children(story)
        .children(contents(&evidence))
        .children(evidence.into_iter().map(|(id, heading, open, content)| fold(id, heading, open, content)))
}

/// A folded part: its id, its heading, whether it is open, and what it holds.
type Folded = (&'static str, &'static str, bool, Vec<Element>);

/// The evidence in its parts; those without content are left out.
fn evidence(report: &Report, pictures: &Pictures) -> Vec<Folded> {
    let gaps = gap::figure(report, pictures).into_iter().chain(tables::gaps(report)).collect();
    let found: Vec<Element> = head::found(report).into_iter().chain(tables::effects(report, pictures)).collect();
    let parts: Vec<Folded> = vec![
        ("effects", "What was found, by name", true, found),
        ("gap", "The error at every horizon", true, gaps),
        ("candidates", "Every candidate weighed", false, candidates::figure(pictures).into_iter().collect()),
        (
            "residuals",
            "The violated constraints over time",
            false,
            tables::residuals(report, residuals::figure(pictures)),
        ),
        ("paths", "Every run from above", false, paths::figure(pictures).into_iter().collect()),
        ("runs", "Run by run", false, runs::tables(report)),
        ("data", "Data: rows, clocks, warnings", false, tables::data(report)),
        ("words", "Words", false, vec![words::list(report)]),
        ("provenance", "Provenance: version, seed, files", false, tables::provenance(report)),
    ];
    parts.into_iter().filter(|(_, _, _, content)| !content.is_empty()).collect()
}

/// Links to the parts.
fn contents(parts: &[Folded]) -> Option<Element> {
    let link = |(id, heading, _, _): &Folded| holding("a", *heading).with("href", format!("#{id}"));
    (!parts.is_empty()).then(|| {
        Element::new("nav")
            .with("aria-label", "Evidence")
            .child(holding("h2", "Evidence"))
            .children(parts.iter().map(link))
    })
}
