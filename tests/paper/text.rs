//! The text: it has no number of its own, and what it names is there.

use super::ledger::LEDGER;
use super::{GENERATED, paper};
use std::collections::BTreeSet;

fn text() -> String {
    std::fs::read_to_string(paper("paper.typ")).unwrap()
}

/// What stands between two marks, everywhere.
fn between<'t>(text: &'t str, from: &str, to: char) -> Vec<&'t str> {
    text.split(from).skip(1).filter_map(|rest| rest.split(to).next()).collect()
}

/// Names after a mark.
fn names<'t>(text: &'t str, mark: &str) -> BTreeSet<&'t str> {
    let end = |c: char| !(c.is_ascii_alphanumeric() || c == '-' || c == '_');
    text.split(mark).skip(1).map(|rest| rest.split(end).next().unwrap().trim_end_matches('-')).collect()
}

#[test]
fn every_claim_is_in_the_ledger() {
    let text = text();
    let quoted = |ids: &'static str| ids.split('"').skip(1).step_by(2);
    let calls: Vec<&'static str> = between(text.leak(), "#claim(", ')');
    let cited: BTreeSet<&str> = calls.into_iter().flat_map(quoted).collect();
    assert!(cited.len() > 30, "{cited:?}");
    for id in cited {
        assert!(LEDGER.entries.iter().any(|e| e.claim.id == id), "paper.typ: no claim is called {id}");
    }
}

#[test]
fn every_figure_and_table_is_referred_to() {
    let text = text();
    for kind in ["fig-", "tab-"] {
        let [labelled, referred] = ["<", "@"].map(|mark| names(&text, &format!("{mark}{kind}")));
        assert_eq!(labelled, referred, "paper.typ: labels (left) and references (right) of {kind}");
    }
}

#[test]
fn everything_generated_is_used() {
    let text = text();
    let files = &*GENERATED;
    let keys = |file: &str, from: &str| -> Vec<String> {
        let part = files[file].split(from).nth(1).unwrap().split("\n)").next().unwrap();
        let key = |l: &str| {
            l.strip_prefix("  ").filter(|l| !l.starts_with(' ')).and_then(|l| Some(l.split_once(':')?.0.to_string()))
        };
        part.lines().filter_map(key).collect()
    };
    for (file, from, mark) in [("numbers.typ", "#let n = (", "n."), ("equations.typ", "#let eq = (", "eq.")] {
        let used = names(&text, mark);
        for key in keys(file, from) {
            assert!(used.contains(key.as_str()), "paper.typ does not use {mark}{key} of {file}");
        }
    }
    for name in files.keys().filter_map(|f| f.strip_suffix(".svg")) {
        assert!(text.contains(&format!("\"{name}\"")), "paper.typ does not show {name}.svg");
    }
}

#[test]
fn no_number_is_written_by_hand() {
    for (i, line) in text().lines().enumerate() {
        let prose = without_code(line);
        assert!(!prose.chars().any(|c| c.is_ascii_digit()), "paper.typ:{}: a number by hand: {line}", i + 1);
    }
}

/// A line without comments, strings, labels, references and names after `#`.
fn without_code(line: &str) -> String {
    let line = line.split("//").next().unwrap_or("");
    let plain: String = line.split('"').step_by(2).collect();
    let mut out = String::new();
    let mut name = false;
    for c in plain.chars() {
        name = matches!(c, '#' | '@' | '<') || (name && (c.is_alphanumeric() || "-_.".contains(c)));
        if !name {
            out.push(c);
        }
    }
    out
}

#[test]
fn a_number_by_hand_is_seen() {
    assert!(without_code("in 12 of 13 cases").contains("12"));
    assert!(!without_code("#n.ratio-C1 @tab-1 #claim(\"E17\") <fig-7>").contains(|c: char| c.is_ascii_digit()));
}
