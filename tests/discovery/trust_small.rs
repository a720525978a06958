//! A small part of the benchmark of trust; `examples/trust` runs the whole.

#[path = "../../examples/trust/suite/mod.rs"]
mod suite;

use rayon::prelude::*;
use suite::case::{Case, Kind, seed};
use suite::judgement::{Judgement, judge};
use suite::trial;

/// Which suite; the benchmark's own is another one.
const SUITE: u64 = 7;

/// Whether a case has few rows; the whole benchmark has the long ones.
fn is_short(case: &Case) -> bool {
    case.scenario.duration * case.scenario.rate < 2500.0
}

/// The first n short logs that are wanted. What their data can tell takes as long to know as the answer, so it is not
/// asked of logs that are drawn long, and no more are drawn than are needed.
fn outcomes(kind: Kind, wanted: impl Fn(&Case) -> bool + Sync, n: usize) -> Vec<(Case, Judgement)> {
    let mut seeds = (0..).map(|i| seed(SUITE, kind, i)).filter(|seed| is_short(&Case::sketched(*seed)));
    let mut cases: Vec<Case> = vec![];
    while cases.len() < n {
        let next: Vec<u64> = seeds.by_ref().take(n - cases.len()).collect();
        cases.par_extend(next.into_par_iter().map(Case::drawn).filter(|c| is_short(c) && wanted(c)));
    }
    cases.into_par_iter().map(|case| (judge(&case, &trial::run(&case)), case)).map(|(j, c)| (c, j)).collect()
}

fn story((case, judgement): &(Case, Judgement)) -> String {
    let (hidden, named) = (&case.scenario.hidden, &judgement.named);
    format!("{} {} hides {hidden:?}: {}, {named:?}", case.seed, case.make.name, judgement.verdict)
}

#[test]
fn nothing_is_named_where_nothing_is_hidden() {
    let outcomes = outcomes(Kind::Nothing, |_| true, 20);
    let alarms: Vec<String> = outcomes.iter().filter(|o| !o.1.right).map(story).collect();
    assert!(alarms.is_empty(), "{alarms:#?}");
}

/// A car without a heading whose effect has relatives: what to drive next could not be thought through.
#[test]
fn a_case_that_failed_before_is_answered() {
    let case = Case::drawn(11_100_414);
    let outcome = judge(&case, &trial::run(&case));
    assert!(outcome.right, "{}", story(&(case, outcome)));
}

#[test]
fn nine_of_ten_hidden_effects_are_named() {
    let outcomes = outcomes(Kind::Single, Case::determined, 14);
    let wrong: Vec<String> = outcomes.iter().filter(|o| !o.1.right).map(story).collect();
    assert!(10 * wrong.len() <= outcomes.len(), "{wrong:#?}");
}
