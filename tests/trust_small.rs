//! A small part of the benchmark of trust; `examples/trust` runs the whole.

#[path = "../examples/trust/suite/mod.rs"]
mod suite;

use rayon::prelude::*;
use suite::case::{Case, Kind, seed};
use suite::judgement::{Judgement, judge};
use suite::trial;

/// Which suite; the benchmark's own is another one.
const SUITE: u64 = 7;

/// Short logs only: the whole benchmark has the long ones.
fn outcomes(kind: Kind, wanted: impl Fn(&Case) -> bool + Sync, n: usize) -> Vec<(Case, Judgement)> {
    let cases: Vec<Case> = (0..2 * n as u64).into_par_iter().map(|i| Case::drawn(seed(SUITE, kind, i))).collect();
    let cases: Vec<Case> =
        cases.into_iter().filter(|c| wanted(c) && c.scenario.duration * c.scenario.rate < 2500.0).take(n).collect();
    cases.into_par_iter().map(|case| (judge(&case, &trial::run(&case)), case)).map(|(j, c)| (c, j)).collect()
}

fn story((case, judgement): &(Case, Judgement)) -> String {
    let (hidden, named) = (&case.scenario.hidden, &judgement.named);
    format!("{} {} hides {hidden:?}: {}, {named:?}", case.seed, case.make.name, judgement.verdict)
}

#[test]
fn nothing_is_named_where_nothing_is_hidden() {
    let outcomes = outcomes(Kind::Nothing, |_| true, 25);
    let alarms: Vec<String> = outcomes.iter().filter(|o| !o.1.right).map(story).collect();
    assert!(alarms.is_empty(), "{alarms:#?}");
}

#[test]
fn nine_of_ten_hidden_effects_are_named() {
    let outcomes = outcomes(Kind::Single, Case::determined, 25);
    let wrong: Vec<String> = outcomes.iter().filter(|o| !o.1.right).map(story).collect();
    assert!(10 * wrong.len() <= outcomes.len(), "{wrong:#?}");
}
