//! The claims with what they earned.

use super::markup::{head, inline, string};
use super::reviewed::reviewed;
use creepage::claims::{self, Entry, Gives, Ledger, Options, Outcome, Relation, Statement, Status, ledger, verify};
use creepage::progress::unheard;
use std::fmt::Write;
use std::sync::LazyLock;

/// Cases of each sampled check: few, for a quick test, and enough for every status to be earned.
const CASES: u32 = 16;

/// The ledger that the paper speaks of.
pub static LEDGER: LazyLock<Ledger> =
    LazyLock::new(|| verify(&claims::all(), &Options { cases: CASES, seed: 0 }, &unheard).unwrap());

/// The entry of an id.
pub fn entry(id: &str) -> &'static Entry {
    LEDGER.entries.iter().find(|e| e.claim.id == id).unwrap_or_else(|| panic!("no claim is called {id}"))
}

/// What the ledger says of a name that a claim speaks of, where it was found true.
pub fn said(id: &str, name: &str) -> Option<String> {
    let e = entry(id);
    let held = e.claim.evidence.iter().zip(&e.shown).filter(|(_, shown)| shown.outcome.holds());
    held.flat_map(|(evidence, _)| &evidence.equations).find(|(left, _)| left == name).map(|(_, right)| right.clone())
}

/// The equations of a piece of evidence of a claim, by their places; they must have been found true.
pub fn equations(id: &str, evidence: usize, places: &[usize]) -> Vec<creepage::claims::Equation> {
    let e = entry(id);
    assert!(e.shown[evidence].outcome.holds() && e.is_earned(), "{id}: not true");
    let statement = Statement::parse(&e.claim.evidence[evidence].equations).unwrap();
    places.iter().map(|i| statement.equations()[*i].clone()).collect()
}

pub fn file() -> String {
    let mut out = head() + "#let ledger = (\n";
    for e in &LEDGER.entries {
        let c = &e.claim;
        let _ = writeln!(out, "  {}: (", string(&c.id));
        let _ = writeln!(out, "    status: {},", string(e.earned.name()));
        let _ = writeln!(out, "    says: {},", string(&c.says));
        let _ = writeln!(out, "    under: {},", string(&c.hypotheses));
        let _ = writeln!(out, "    wrong: {},", wrong(e).unwrap_or_else(|| "none".into()));
        let _ = writeln!(out, "    evidence: {},\n  ),", string(&evidence(e)));
    }
    out + ")\n"
}

/// What is printed, and the case in which it is false.
fn wrong(e: &Entry) -> Option<String> {
    let refuted = e.claim.evidence.iter().zip(&e.shown).find_map(|(evidence, shown)| match &shown.outcome {
        Outcome::Fails(found) if evidence.gives == Gives::Refutation => Some((evidence, found)),
        _ => None,
    });
    let (evidence, found) = refuted?;
    let equation = |(l, r): &(String, String)| match evidence.relation {
        Relation::Equal => format!("#{} $=$ #{}", code(l), code(r)),
        Relation::UndefinedWhereZero => format!("#{} undefined exactly where #{} $= 0$", code(l), code(r)),
    };
    let printed = evidence.equations.iter().map(equation).collect::<Vec<_>>().join(", ");
    let value = |(name, value): &(String, String)| format!("#{} $=$ #{}", code(name), code(value));
    let case = found.values.iter().map(value).collect::<Vec<_>>().join(", ");
    let at = if case.is_empty() { "false: ".into() } else { format!("false at {case}: ") };
    Some(format!("[{printed}\\; {at}{}]", instead(&found.says)))
}

/// What is found in a counterexample and what the statement says.
fn instead(says: &str) -> String {
    match says.split_once(", the statement says ") {
        Some((found, stated)) => match found.split_once(" is ") {
            Some((name, value)) if stated == "otherwise" => format!("#{} is #{}", code(name), code(value)),
            Some((name, value)) => format!("#{} is #{}, not #{}", code(name), code(value), code(stated)),
            None => format!("#{}", code(says)),
        },
        None => match says.strip_suffix(" is undefined") {
            Some(name) => format!("#{} is undefined", code(name)),
            None => match says.split_once(" is undefined, and ") {
                Some((name, rest)) => {
                    let (left, value) = rest.split_once(" is ").unwrap();
                    format!("#{} is undefined, #{} is #{}", code(name), code(left), code(value))
                }
                None => format!("#{}", code(says)),
            },
        },
    }
}

/// Mathematics or text that may follow `#` in markup.
fn code(text: &str) -> String {
    let shown = inline(text);
    if shown.starts_with('$') { format!("[{shown}]") } else { shown }
}

fn evidence(e: &Entry) -> String {
    let mut parts = Vec::new();
    for gives in [Gives::Refutation, Gives::Proof, Gives::Sample, Gives::Confirmation] {
        let shown: Vec<_> =
            e.claim.evidence.iter().zip(&e.shown).filter(|(v, _)| v.gives == gives).map(|(_, s)| s).collect();
        let cases: u64 = shown.iter().map(|s| if let Outcome::Holds { cases } = s.outcome { cases } else { 0 }).sum();
        let several = |n: u64, one: &str, many: &str| format!("{n} {}", if n == 1 { one } else { many });
        match gives {
            _ if shown.is_empty() => {}
            Gives::Refutation => parts.push(several(shown.len() as u64, "refutation", "refutations")),
            Gives::Proof => parts.push(several(cases, "identity", "identities")),
            Gives::Sample => parts.push(several(cases, "sampled case", "sampled cases")),
            Gives::Confirmation => parts.push(several(cases, "simulated case", "simulated cases")),
        }
    }
    let sabotages: usize = e.shown.iter().map(|s| s.sabotages).sum();
    if sabotages > 0 {
        parts.push(format!("{sabotages} sabotages noticed"));
    }
    parts.join(", ")
}

/// How many claims have a status.
pub fn count(status: Status) -> usize {
    LEDGER.entries.iter().filter(|e| e.earned == status).count()
}

#[test]
fn every_status_is_earned() {
    assert!(LEDGER.all_earned());
    let (noticed, all) = LEDGER.kills();
    assert_eq!(noticed, all);
}

/// What every claim earned, as a person has read and accepted it; few cases, whose number stands in the text, are enough
/// to see a status change.
#[test]
fn the_ledger() {
    reviewed("ledger", &ledger::text(&LEDGER));
}
