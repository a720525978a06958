//! Cases shared out over threads; the answers come back in the order of the cases.

use crate::suite::case::Case;
use crate::suite::judgement::{Judgement, judge};
use crate::suite::trial::{self, Trial};
use rayon::ThreadPoolBuilder;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

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
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let slots: Vec<Mutex<Option<Outcome>>> = seeds.iter().map(|_| Mutex::new(None)).collect();
    let work = || {
        let pool = ThreadPoolBuilder::new().num_threads(1).build().expect("a thread can be started");
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            let Some(seed) = seeds.get(i) else { return };
            let outcome = pool.install(|| one(*seed));
            *slots[i].lock().expect("no worker panics while it holds a slot") = Some(outcome);
            said(done.fetch_add(1, Ordering::Relaxed) + 1);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            scope.spawn(work);
        }
    });
    let filled = |slot: Mutex<Option<Outcome>>| slot.into_inner().ok().flatten().expect("every case has its turn");
    slots.into_iter().map(filled).collect()
}
