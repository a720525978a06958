//! `report.html`: the finding in one sentence, what it amounts to, what to change, a map to explore, then the evidence.
//!
//! The page holds everything it shows and asks for nothing. All of it but the map's controls reads without its script, on a
//! phone, on a dark screen, on paper and aloud.

mod candidates;
pub(crate) mod cards;
mod change;
pub mod check_page;
mod columns;
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
use part::{Fold, folds, holding};

pub use story::{gap_panel, gap_svg};

/// The report as a self-contained page.
pub fn html(report: &Report, pictures: &Pictures) -> String {
    let title = format!("{} — creepage", head::sentence(report).trim_end_matches('.'));
    page(&title, &report.provenance.version, page_body(report, pictures), true)
}

/// A document that asks for nothing but itself: its title, the version that wrote it, and the main part of its body. The
/// script is for what is explored, copied or linked to.
pub(crate) fn page(title: &str, version: &str, main: Element, with_script: bool) -> String {
    let body = Element::new("body").child(main).children(with_script.then(script::element));
    let page = Element::new("html").with("lang", "en").child(head(title, version, with_script)).child(body);
    format!("<!DOCTYPE html>\n{page}\n")
}

fn head(title: &str, version: &str, with_script: bool) -> Element {
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
    Element::new("main")
        .child(head::header(report, pictures))
        .children(cards::cards(report, pictures))
        .children(change::section(&pictures.changes, report.next_experiment.as_ref()))
        .children(map)
        .children(story)
        .children(folds(evidence(report, pictures), true))
}

/// The evidence in its parts.
fn evidence(report: &Report, pictures: &Pictures) -> Vec<Fold> {
    let gaps = gap::figure(report, pictures).into_iter().chain(tables::gaps(report));
    let found = head::found(report).into_iter().chain(tables::effects(report, pictures));
    let residuals = tables::residuals(report, residuals::figure(pictures));
    vec![
        Fold::open("effects", "What was found, by name", found),
        Fold::open("columns", "The columns over time", columns::figure(&pictures.columns)),
        Fold::open("gap", "The error at every horizon", gaps),
        Fold::open("kinematic", "Without forces", tables::kinematic(report)),
        Fold::closed("candidates", "Every candidate weighed", candidates::figure(pictures)),
        Fold::closed("residuals", "The violated constraints over time", residuals),
        Fold::closed("paths", "Every run from above", paths::figure(pictures)),
        Fold::closed("runs", "Run by run", runs::tables(report)),
        Fold::closed("data", "Data: rows, clocks, warnings", tables::data(report)),
        Fold::closed("words", "Words", [words::list(report)]),
        Fold::closed("provenance", "Provenance: version, seed, files", tables::provenance(report)),
    ]
}
