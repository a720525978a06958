//! Verification: the evidence of claims is run, and each earns its status.

use super::{Claim, Evidence, Gives, Mutant, Outcome, Sampling, Statement, Status, mutants};
use crate::error::Result;
use crate::progress::{OnProgress, Stage, tell};
use rayon::prelude::*;
use sha2::{Digest, Sha256};
use std::sync::atomic::{AtomicUsize, Ordering};

/// How many cases, from which seed.
///
/// ```
/// let brief = creepage::claims::Options { cases: 20, ..Default::default() };
/// assert_eq!(brief.seed, 0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Cases of each sampled check; checks that cost much take a stated share of it.
    pub cases: u32,
    /// Everything generated follows from it.
    pub seed: u64,
}

impl Default for Options {
    fn default() -> Self {
        Self { cases: 200, seed: 0 }
    }
}

/// What the evidence of a claim did.
///
/// ```
/// let ledger = creepage::verify(&["eq-21"], &creepage::Options::default())?;
/// assert!(ledger.entries[0].shown.iter().all(|shown| shown.as_stated && shown.survivors.is_empty()));
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Shown {
    /// What became of the statement.
    pub outcome: Outcome,
    /// Whether it did what its kind demands: a refutation fails, everything else holds.
    pub as_stated: bool,
    /// How many sabotaged statements were put to the same check.
    pub sabotages: usize,
    /// Those that the check did not notice.
    pub survivors: Vec<String>,
}

/// A claim and what it earned.
///
/// ```
/// let ledger = creepage::verify(&["eq-21"], &creepage::Options::default())?;
/// assert_eq!(ledger.entries[0].earned, ledger.entries[0].claim.stated);
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Entry {
    /// The claim.
    pub claim: Claim,
    /// What each piece of evidence did, in order.
    pub shown: Vec<Shown>,
    /// The status earned.
    pub earned: Status,
}

/// Every claim with what it earned.
///
/// ```
/// let ledger = creepage::verify(&["eq-21"], &creepage::Options::default())?;
/// let (noticed, all) = ledger.kills();
/// assert!(ledger.all_earned() && noticed == all);
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Ledger {
    /// The claims in their order.
    pub entries: Vec<Entry>,
    /// How it was made.
    pub options: Options,
}

impl Entry {
    /// Whether the stated status is the earned one.
    pub fn is_earned(&self) -> bool {
        self.claim.stated == self.earned
    }
}

impl Ledger {
    /// Whether every claim earned the status stated for it.
    pub fn all_earned(&self) -> bool {
        self.entries.iter().all(Entry::is_earned)
    }

    /// Sabotaged statements that were noticed, and all of them.
    pub fn kills(&self) -> (usize, usize) {
        let shown = || self.entries.iter().flat_map(|e| &e.shown);
        let all = shown().map(|s| s.sabotages).sum();
        let survived: usize = shown().map(|s| s.survivors.len()).sum();
        (all - survived, all)
    }

    /// Cases tried by all sampled checks.
    pub fn cases(&self) -> u64 {
        let cases = |s: &Shown| match s.outcome {
            Outcome::Holds { cases } => cases,
            _ => 0,
        };
        self.entries.iter().flat_map(|e| &e.shown).map(cases).sum()
    }
}

/// Runs all evidence of all claims; progress counts its pieces.
///
/// The result is the same for any number of threads: every check has its own seed, made from its claim's id.
///
/// ```
/// use creepage::claims::{self, Claim, Options};
/// let some: Vec<Claim> = claims::all().into_iter().filter(|claim| claim.id == "eq-21").collect();
/// let ledger = claims::verify(&some, &Options { cases: 20, seed: 7 }, &|_| std::ops::ControlFlow::Continue(()))?;
/// assert!(ledger.all_earned());
/// # Ok::<(), creepage::Error>(())
/// ```
///
/// # Errors
/// When the listener stops it.
pub fn verify(claims: &[Claim], options: &Options, progress: &OnProgress) -> Result<Ledger> {
    let tasks: Vec<(&Claim, usize)> = claims.iter().flat_map(|c| (0..c.evidence.len()).map(move |i| (c, i))).collect();
    let done = AtomicUsize::new(0);
    let one = |(claim, i): &(&Claim, usize)| {
        let shown = run(&claim.evidence[*i], &sampling(claim, *i, options));
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        tell(progress, Stage::Claims { id: claim.id.clone() }, done, tasks.len()).map(|()| shown)
    };
    let shown: Vec<Shown> = tasks.par_iter().with_max_len(1).map(one).collect::<Result<_>>()?;
    let mut shown = shown.into_iter();
    let entry = |claim: &Claim| {
        let shown: Vec<Shown> = shown.by_ref().take(claim.evidence.len()).collect();
        let earned = earned(claim, &shown);
        Entry { claim: claim.clone(), shown, earned }
    };
    Ok(Ledger { entries: claims.iter().map(entry).collect(), options: *options })
}

/// The cases of one piece of evidence: its seed follows from the claim and its place alone.
fn sampling(claim: &Claim, index: usize, options: &Options) -> Sampling {
    let digest = Sha256::digest(format!("{} {} {index}", options.seed, claim.id));
    let seed = digest.iter().take(8).fold(0u64, |seed, byte| seed << 8 | u64::from(*byte));
    Sampling { cases: options.cases, seed, shrink: true }
}

fn run(evidence: &Evidence, sampling: &Sampling) -> Shown {
    let statement = match Statement::parse(&evidence.equations) {
        Ok(statement) => statement,
        Err(e) => return unusable(format!("the statement cannot be read: {e}")),
    };
    let outcome = (evidence.check)(&statement, sampling);
    let as_stated = match evidence.gives {
        Gives::Refutation => outcome.fails(),
        _ => outcome.holds(),
    };
    let (sabotages, survivors) = match evidence.gives {
        Gives::Refutation => refuses_truth(evidence, sampling),
        _ => sabotage(evidence, &statement, sampling),
    };
    Shown { outcome, as_stated, sabotages, survivors }
}

fn unusable(why: String) -> Shown {
    Shown { outcome: Outcome::Undefined(why), as_stated: false, sabotages: 0, survivors: vec![] }
}

/// A refutation must not refute what is true.
fn refuses_truth(evidence: &Evidence, sampling: &Sampling) -> (usize, Vec<String>) {
    let Some((equations, check)) = &evidence.truth else { return (0, vec![]) };
    let held = Statement::parse(equations).is_ok_and(|truth| check(&truth, sampling).holds());
    (1, if held { vec![] } else { vec!["the true statement is refuted too".into()] })
}

/// Cases that a slip must show itself in.
const SABOTAGE_CASES: u32 = 60;

/// Every slip of the statement must be noticed.
fn sabotage(evidence: &Evidence, statement: &Statement, sampling: &Sampling) -> (usize, Vec<String>) {
    let brief = Sampling { shrink: false, ..sampling.at_most(SABOTAGE_CASES) };
    let all = match &evidence.sabotage {
        None => mutants(statement),
        Some(own) => match own.iter().map(|e| by_hand(e)).collect() {
            Ok(own) => own,
            Err(e) => return (1, vec![format!("a sabotage cannot be read: {e}")]),
        },
    };
    let survived = all.iter().filter(|m| (evidence.check)(&m.statement.clone().in_brief(), &brief).holds());
    let survivors = survived.map(|m| m.slip.clone()).collect();
    (all.len(), survivors)
}

fn by_hand(equations: &[(String, String)]) -> Result<Mutant> {
    let statement = Statement::parse(equations)?;
    Ok(Mutant { slip: statement.to_string(), statement })
}

/// The status that the evidence earns: nothing unless all of it did what it says and noticed every sabotage.
fn earned(claim: &Claim, shown: &[Shown]) -> Status {
    let sound = |s: &Shown| s.as_stated && s.survivors.is_empty() && s.sabotages > 0;
    if shown.is_empty() {
        return if claim.stated == Status::Editorial { Status::Editorial } else { Status::Open };
    }
    if !shown.iter().all(sound) {
        return Status::Open;
    }
    let has = |g: Gives| claim.evidence.iter().any(|e| e.gives == g);
    match (has(Gives::Refutation), has(Gives::Proof) || has(Gives::Sample)) {
        (true, true) => Status::Corrected,
        (true, false) => Status::Refuted,
        (false, true) if has(Gives::Sample) => Status::Sampled,
        (false, true) => Status::Proved,
        (false, false) => Status::Open,
    }
}
