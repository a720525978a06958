//! The paper's errata, from the claims.

use crate::claims::{Entry, Gives, Ledger, Outcome, Status};
use std::fmt::Write;

/// `theory/ERRATA.md`: what the paper prints that is not so, with the counterexample the program found, and what is.
///
/// The numbers come from a run, so that the file can be no older than the claims.
pub fn errata(ledger: &Ledger) -> String {
    let mut out = String::from(
        "# Errata of the paper\n\nGenerated from the claims by `creepage verify --format errata`; a test fails when it \
         is stale. Every counterexample was found by the machine and made as simple as it could; check it by hand.\n",
    );
    let parts: [(&str, &[Status]); 3] = [
        ("Corrected and refuted", &[Status::Corrected, Status::Refuted]),
        ("Editorial", &[Status::Editorial]),
        ("Open", &[Status::Open]),
    ];
    for (title, statuses) in parts {
        let wanted = |e: &&Entry| statuses.contains(&e.earned);
        if !ledger.entries.iter().any(|e| wanted(&e)) {
            continue;
        }
        let _ = writeln!(out, "\n## {title}");
        ledger.entries.iter().filter(wanted).for_each(|e| erratum(&mut out, e));
    }
    out
}

fn erratum(out: &mut String, e: &Entry) {
    let c = &e.claim;
    let _ = writeln!(out, "\n### `{}`\n\n{} *{}.*\n", c.id, c.says, c.place);
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
