//! The ledger of claims as text for a terminal.

use crate::claims::kernel::{ClaimFile, Proofs, kernel, proofs_of};
use crate::claims::{Correction, CorrectionCounts, Entry, Evidence, Gives, Ledger, Outcome, Shown, Status};
use std::fmt::Write;

/// Width of the column of statuses.
const INDENT: usize = 11;

/// Width of a line.
const WIDTH: usize = 118;

/// Every claim with the status it earned and what its evidence did, then a count.
pub fn text(ledger: &Ledger) -> String {
    let mut out = String::new();
    let proofs = proofs_of(ledger);
    ledger.entries.iter().for_each(|e| entry(&mut out, e, proofs.accepted(&e.claim.id)));
    out.push_str(&summary(ledger, &proofs));
    out
}

fn entry(out: &mut String, e: &Entry, accepted: Option<&ClaimFile>) {
    let claim = &e.claim;
    let _ = writeln!(out, "{:<INDENT$}{}", e.earned.name(), claim.id);
    paragraph(out, &claim.says);
    let under = if claim.hypotheses.is_empty() { String::new() } else { format!("; under: {}", claim.hypotheses) };
    paragraph(out, &format!("{}{under}", claim.place));
    if let Some(kind) = claim.correction {
        let part = if claim.part_of.is_empty() { String::new() } else { format!(", a part of {}", claim.part_of) };
        paragraph(out, &format!("the print: {}{part}", kind.name()));
    }
    if !e.is_earned() {
        paragraph(out, &format!("NOT EARNED: stated {}, earned {}", claim.stated, e.earned));
    }
    for (evidence, shown) in claim.evidence.iter().zip(&e.shown) {
        let mark = if shown.as_stated && shown.survivors.is_empty() { "+" } else { "!" };
        let gives = evidence.gives.name();
        paragraph(out, &format!("{mark} {gives}: {}: {}", evidence.shows, outcome(evidence, shown)));
        shown.survivors.iter().for_each(|s| paragraph(out, &format!("not noticed: {s}")));
    }
    if let Some(&ClaimFile { theorems, .. }) = accepted {
        let s = if theorems == 1 { "" } else { "s" };
        paragraph(out, &format!("+ kernel: {} accepts the proof{s} as {theorems} theorem{s}", kernel()));
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

/// How many theorems were written for another kernel, and which proofs have none.
pub fn proofs_text(proofs: &Proofs, dir: &str) -> String {
    let with = || proofs.claims.iter().filter(|c| c.theorems > 0);
    let theorems: usize = with().map(|c| c.theorems).sum();
    let counted = |n: usize, one: &str| format!("{n} {one}{}", if n == 1 { "" } else { "s" });
    let (theorems, claims) = (counted(theorems, "theorem"), counted(with().count(), "claim"));
    let mut out = format!("{theorems} of {claims} in {dir}\nsh {dir}/check.sh puts them to the kernel\n");
    if proofs.claims.iter().any(|c| !c.left_out.is_empty()) {
        out.push_str("\nno theorem of all that these proofs say:\n");
    }
    for claim in &proofs.claims {
        claim.left_out.iter().for_each(|shows| paragraph(&mut out, &format!("{}: {shows}", claim.claim)));
    }
    out
}

/// How many corrections are of which kind; nothing where none has a kind.
pub(super) fn kinds(found: &CorrectionCounts) -> Option<String> {
    let counted = |(kind, n): (&Correction, usize)| format!("{n} {}", kind.name());
    let kinds: Vec<String> = Correction::ALL.iter().zip(found.by_kind).map(counted).collect();
    (found.by_kind != [0; 3]).then(|| kinds.join(", "))
}

/// How many claims have which status, and how many sabotages were noticed.
fn summary(ledger: &Ledger, proofs: &Proofs) -> String {
    let of = |s: Status| ledger.entries.iter().filter(|e| e.earned == s).count();
    let counts: Vec<String> = Status::ALL.iter().map(|s| format!("{} {s}", of(*s))).collect();
    let unearned: Vec<&str> = ledger.entries.iter().filter(|e| !e.is_earned()).map(|e| e.claim.id.as_str()).collect();
    let (killed, all) = ledger.kills();
    let mut out = format!("{} claims: {}\n", ledger.entries.len(), counts.join(", "));
    let percent = if all == 0 { 100.0 } else { 100.0 * killed as f64 / all as f64 };
    let found = ledger.corrections();
    if let Some(kinds) = kinds(&found) {
        let _ =
            writeln!(out, "corrected: {kinds}; {} statements, for parts of one theorem count once", found.statements);
    }
    let _ = writeln!(out, "sabotages noticed: {killed} of {all} ({percent:.1} %)");
    let _ =
        writeln!(out, "cases: {} (--cases {} --seed {})", ledger.cases(), ledger.options.cases, ledger.options.seed);
    let (theorems, claims) = proofs.count_accepted();
    if theorems > 0 {
        let _ =
            writeln!(out, "checked by an independent kernel ({}): {theorems} theorems of {claims} claims", kernel());
    }
    match unearned.is_empty() {
        true => out.push_str("every stated status is earned\n"),
        false => {
            let _ = writeln!(out, "NOT EARNED: {}", unearned.join(", "));
        }
    }
    out
}
