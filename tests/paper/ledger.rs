//! The claims with what they earned.

use super::markup::{head, string};
use super::reviewed::reviewed;
use creepage::claims::{self, Entry, Ledger, Options, Statement, Status, ledger, verify};
use creepage::progress::unheard;
use std::sync::LazyLock;

/// The ledger that the paper speaks of.
pub static LEDGER: LazyLock<Ledger> = LazyLock::new(|| verify(&claims::all(), &Options::default(), &unheard).unwrap());

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

/// The status of every claim, for the text to name none that is not there.
pub fn file() -> String {
    let line = |e: &Entry| format!("  {}: {},\n", string(&e.claim.id), string(e.earned.name()));
    head() + "#let ledger = (\n" + &LEDGER.entries.iter().map(line).collect::<String>() + ")\n"
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

/// What every claim earned, as a person has read and accepted it.
#[test]
fn the_ledger() {
    reviewed("ledger", &ledger::text(&LEDGER));
}
