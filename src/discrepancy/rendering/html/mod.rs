//! `report.html`: the verdict in one sentence, one picture that tells the story, then the evidence.
//!
//! The page holds everything it shows: no script, no font, no request. It reads on a phone, on a dark screen, on paper
//! and aloud.

mod candidates;
mod gap;
mod head;
pub(crate) mod part;
mod paths;
mod residuals;
mod runs;
mod story;
mod style;
mod tables;

use super::summary::verdict_sentence;
use crate::discrepancy::report::{Pictures, Report};
use crate::picture::svg::Element;

pub use story::{gap_panel, gap_svg};

/// The report as a self-contained page.
pub fn html(report: &Report, pictures: &Pictures) -> String {
    let head = policy_head(&format!("creepage: {}", verdict_sentence(report)), &report.provenance.version);
    page(head, page_body(report, pictures))
}

/// A document of a head and the main part of its body.
pub(crate) fn page(head: Element, main: Element) -> String {
    let body = Element::new("body").child(main);
    let page = Element::new("html").with("lang", "en").child(head).child(body);
    format!("<!DOCTYPE html>\n{page}\n")
}

/// The head of a page that asks for nothing but itself.
pub(crate) fn policy_head(title: &str, version: &str) -> Element {
    let meta = |name: &'static str, content: &str| Element::new("meta").with("name", name).with("content", content);
    let policy = Element::new("meta")
        .with("http-equiv", "Content-Security-Policy")
        .with("content", "default-src 'none'; style-src 'unsafe-inline'");
    Element::new("head")
        .child(Element::new("meta").with("charset", "utf-8"))
        .child(policy)
        .child(meta("viewport", "width=device-width, initial-scale=1"))
        .child(meta("generator", &format!("creepage {version}")))
        .child(Element::new("title").text(title))
        .child(Element::new("style").text(style::page()))
}

fn page_body(report: &Report, pictures: &Pictures) -> Element {
    let figures = [
        story::figure(report, pictures),
        paths::figure(pictures),
        gap::figure(report, pictures),
        residuals::figure(pictures),
        candidates::figure(pictures),
    ];
    let mut drawn = figures.into_iter();
    let first = drawn.next().flatten();
    let evidence: Vec<Element> = drawn.flatten().collect();
    Element::new("main")
        .child(head::header(report))
        .children(first.map(|f| part::numbered(1, f)))
        .children(head::next_experiment(report))
        .children(part::section("Evidence", numbered_from(2, evidence)))
        .children(tables::all(report, pictures))
}

fn numbered_from(first: usize, figures: Vec<Element>) -> Vec<Element> {
    figures.into_iter().enumerate().map(|(i, f)| part::numbered(first + i, f)).collect()
}
