//! The ledger of claims as text for a terminal.

use crate::claims::{Entry, Evidence, Gives, Ledger, Outcome, Shown, Status};
use std::fmt::Write;

/// Width of the column of statuses.
const INDENT: usize = 11;

/// Width of a line.
const WIDTH: usize = 118;

/// Every claim with the status it earned and what its evidence did, then a count.
pub fn text(ledger: &Ledger) -> String {
    let mut out = String::new();
    ledger.entries.iter().for_each(|e| entry(&mut out, e));
    out.push_str(&summary(ledger));
    out
}

fn entry(out: &mut String, e: &Entry) {
    let claim = &e.claim;
    let _ = writeln!(out, "{:<INDENT$}{}", e.earned.name(), claim.id);
    paragraph(out, &claim.says);
    let under = if claim.hypotheses.is_empty() { String::new() } else { format!("; under: {}", claim.hypotheses) };
    paragraph(out, &format!("{}{under}", claim.place));
    if !e.is_earned() {
        paragraph(out, &format!("NOT EARNED: stated {}, earned {}", claim.stated, e.earned));
    }
    for (evidence, shown) in claim.evidence.iter().zip(&e.shown) {
        let mark = if shown.as_stated && shown.survivors.is_empty() { "+" } else { "!" };
        let gives = evidence.gives.name();
        paragraph(out, &format!("{mark} {gives}: {}: {}", evidence.shows, outcome(evidence, shown)));
        shown.survivors.iter().for_each(|s| paragraph(out, &format!("not noticed: {s}")));
    }
    if !claim.remark.is_empty() {
        paragraph(out, &claim.remark);
    }
    out.push('\n');
}

/// What became of a piece of evidence, in a few words.
fn outcome(evidence: &Evidence, shown: &Shown) -> String {
    let found = match &shown.outcome {
        Outcome::Holds { .. } if evidence.gives == Gives::Refutation => "NOT refuted: it holds".into(),
        Outcome::Holds { cases: 1 } if evidence.gives == Gives::Proof => "proved".into(),
        Outcome::Holds { cases } if evidence.gives == Gives::Proof => format!("proved, {cases} identities"),
        Outcome::Holds { cases } => format!("holds in {cases} {}", if *cases == 1 { "case" } else { "cases" }),
        Outcome::Fails(c) if evidence.gives == Gives::Refutation => format!("false at {c}"),
        Outcome::Fails(c) => format!("FAILS at {c}"),
        Outcome::Undefined(why) => format!("CANNOT TELL: {why}"),
    };
    let noticed = shown.sabotages - shown.survivors.len();
    let sabotage = match (evidence.gives, noticed == shown.sabotages) {
        (Gives::Refutation, true) => "the true form passes".into(),
        (Gives::Refutation, false) => "THE TRUE FORM IS REFUTED TOO".into(),
        (_, true) => format!("{noticed} of {} sabotages noticed", shown.sabotages),
        (_, false) => format!("ONLY {noticed} of {} sabotages noticed", shown.sabotages),
    };
    format!("{found}; {sabotage}")
}

/// Words put into lines behind the column of statuses.
fn paragraph(out: &mut String, text: &str) {
    let mut line = String::new();
    for word in text.split(' ') {
        if !line.is_empty() && INDENT + line.chars().count() + 1 + word.chars().count() > WIDTH {
            let _ = writeln!(out, "{:INDENT$}{line}", "");
            line.clear();
            line.push_str("  ");
        } else if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    let _ = writeln!(out, "{:INDENT$}{line}", "");
}

/// How many claims have which status, and how many sabotages were noticed.
fn summary(ledger: &Ledger) -> String {
    let of = |s: Status| ledger.entries.iter().filter(|e| e.earned == s).count();
    let counts: Vec<String> = Status::ALL.iter().map(|s| format!("{} {s}", of(*s))).collect();
    let unearned: Vec<&str> = ledger.entries.iter().filter(|e| !e.is_earned()).map(|e| e.claim.id.as_str()).collect();
    let (killed, all) = ledger.kills();
    let mut out = format!("{} claims: {}\n", ledger.entries.len(), counts.join(", "));
    let percent = if all == 0 { 100.0 } else { 100.0 * killed as f64 / all as f64 };
    let _ = writeln!(out, "sabotages noticed: {killed} of {all} ({percent:.1} %)");
    let _ =
        writeln!(out, "cases: {} (--cases {} --seed {})", ledger.cases(), ledger.options.cases, ledger.options.seed);
    match unearned.is_empty() {
        true => out.push_str("every stated status is earned\n"),
        false => {
            let _ = writeln!(out, "NOT EARNED: {}", unearned.join(", "));
        }
    }
    out
}
