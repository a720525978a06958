//! The paper's errata, from the claims.

use super::text::kinds;
use crate::claims::{Correction, Entry, Gives, Ledger, Outcome, Status};
use std::fmt::Write;

/// `theory/ERRATA.md`: what the paper prints that is not so, with the counterexample the program found, and what is.
///
/// The numbers come from a run, so that the file can be no older than the claims.
pub fn errata(ledger: &Ledger) -> String {
    let mut out = String::from(
        "# Errata of the paper\n\nGenerated from the claims by `creepage verify --format errata`; a test fails when it \
         is stale. Every counterexample was found by the machine and made as simple as it could; check it by hand.\n",
    );
    let counts = ledger.corrections();
    if let Some(kinds) = kinds(&counts) {
        let entries: usize = counts.by_kind.iter().sum();
        let _ = writeln!(
            out,
            "\nA correction is of one of three kinds. {} statements were corrected in {entries} entries, for the parts of a \
             theorem are told one by one: {kinds}.",
            counts.statements
        );
    }
    let wrong = |e: &Entry| matches!(e.earned, Status::Corrected | Status::Refuted);
    for kind in Correction::ALL {
        part(&mut out, title(kind), ledger, |e| wrong(e) && e.claim.correction == Some(kind));
    }
    part(&mut out, "Corrected and refuted", ledger, |e| wrong(e) && e.claim.correction.is_none());
    part(&mut out, "Editorial", ledger, |e| e.earned == Status::Editorial);
    part(&mut out, "Open", ledger, |e| e.earned == Status::Open);
    out
}

fn title(kind: Correction) -> &'static str {
    match kind {
        Correction::FalseAsPrinted => "False as printed",
        Correction::LacksHypothesis => "True under a hypothesis that is not printed",
        Correction::ContestedReading => "False in one reading, which the text does not force",
    }
}

fn part(out: &mut String, title: &str, ledger: &Ledger, wanted: impl Fn(&Entry) -> bool) {
    let entries: Vec<&Entry> = ledger.entries.iter().filter(|e| wanted(e)).collect();
    if entries.is_empty() {
        return;
    }
    let _ = writeln!(out, "\n## {title}");
    entries.into_iter().for_each(|e| erratum(out, e));
}

fn erratum(out: &mut String, e: &Entry) {
    let c = &e.claim;
    let _ = writeln!(out, "\n### `{}`\n\n{} *{}.*\n", c.id, c.says, c.place);
    if !c.part_of.is_empty() {
        let _ = writeln!(out, "A part of `{}`.\n", c.part_of);
    }
    if !c.remark.is_empty() {
        let _ = writeln!(out, "{}\n", c.remark);
    }
    for (evidence, shown) in c.evidence.iter().zip(&e.shown) {
        let statement = evidence.statements(|formula| format!("`{formula}`")).join(", ");
        match (&shown.outcome, evidence.gives) {
            (Outcome::Fails(found), Gives::Refutation) => {
                let _ = writeln!(out, "- As printed: {}: {statement}. False at {found}.", evidence.shows);
            }
            (Outcome::Holds { .. }, gives) => {
                let _ = writeln!(out, "- True ({}): {}: {statement}.", gives.name(), evidence.shows);
            }
            _ => {}
        }
    }
    if !c.chapter.is_empty() {
        let _ = writeln!(out, "\nDerived in [{}]({}.md).", c.chapter, c.chapter);
    }
}
