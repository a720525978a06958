//! A small part of the benchmark of trust; `examples/trust` runs the whole.

#[path = "../../examples/trust/suite/mod.rs"]
mod suite;

use rayon::prelude::*;
use suite::case::{Case, Kind, seed};
use suite::judgement::{Judgement, judge};
use suite::trial;

/// Which suite; the benchmark's own is another one.
const SUITE: u64 = 7;

/// The first n short logs that are wanted; the whole benchmark has the long ones. Drawing a case takes as long as to
/// answer it, so no more are drawn than are asked for.
fn outcomes(kind: Kind, wanted: impl Fn(&Case) -> bool + Sync, n: usize) -> Vec<(Case, Judgement)> {
    let mut cases: Vec<Case> = vec![];
    let mut drawn = 0;
    while cases.len() < n {
        let next = drawn + (n - cases.len()) as u64;
        let more = (drawn..next).into_par_iter().map(|i| Case::drawn(seed(SUITE, kind, i)));
        cases.par_extend(more.filter(|c| c.scenario.duration * c.scenario.rate < 2500.0 && wanted(c)));
        drawn = next;
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
