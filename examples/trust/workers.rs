//! A case put before the program, and what its answer is worth.

use crate::suite::case::Case;
use crate::suite::judgement::{Judgement, judge};
use crate::suite::trial::{self, Trial};
use crate::worker_pool::shared_out;

/// A case, the answer and its worth.
pub struct Outcome {
    /// The case.
    pub case: Case,
    /// The answer.
    pub trial: Trial,
    /// What it is worth.
    pub judgement: Judgement,
}

/// The outcome of one case.
pub fn one(seed: u64) -> Outcome {
    let case = Case::drawn(seed);
    let trial = trial::run(&case);
    let judgement = judge(&case, &trial);
    Outcome { case, trial, judgement }
}

/// The outcomes of cases, each worked out on a single thread so that its time means something.
pub fn all(seeds: &[u64], threads: usize, said: &(dyn Fn(usize) + Sync)) -> Vec<Outcome> {
    shared_out(seeds, threads, &|seed| one(*seed), &|done, _, _| said(done))
}
