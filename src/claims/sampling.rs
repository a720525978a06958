//! Sampling of cases by property-based testing: how many, from which seed, and the smallest one that fails.

use super::{Counterexample, Outcome};
use proptest::strategy::Strategy;
use proptest::test_runner::{Config, RngAlgorithm, RngSeed, TestCaseError, TestError, TestRunner};
use rayon::prelude::*;
use std::fmt::Debug;

/// How many cases a check tries, and the seed they are made from.
#[derive(Clone, Copy, Debug)]
pub struct Sampling {
    /// Number of cases.
    pub cases: u32,
    /// Seed of this check; the same seed gives the same cases on every machine.
    pub seed: u64,
    /// Whether a failing case is made as small as it can be.
    pub shrink: bool,
}

/// Cases of one lot: lots are run on several threads, each with its own seed.
const LOT_CASES: u32 = 100;

/// Why a case does not agree with a statement.
#[derive(Clone, Debug)]
pub enum Fault {
    /// It is false there; what was found and what was said.
    False(String),
    /// The case lies outside the hypotheses and is not counted.
    Outside,
    /// It cannot be told.
    Undefined(String),
}

/// What a law says of one case.
pub type Verdict = Result<(), Fault>;

impl Sampling {
    /// The same with a fraction of the cases, at least one: for cases that cost much.
    pub fn one_in(self, n: u32) -> Self {
        Self { cases: (self.cases / n).max(1), ..self }
    }

    /// The same with at most `n` cases.
    pub fn at_most(self, n: u32) -> Self {
        Self { cases: self.cases.min(n), ..self }
    }

    /// Tries a law on generated cases; a case that fails is shrunk and shown.
    ///
    /// The cases are made in lots, each from a seed of its own, so that any number of threads finds the same: of the
    /// lots that do not hold the first one counts.
    pub fn cases<S: Strategy + Sync>(
        &self,
        values: S,
        show: impl Fn(&S::Value) -> Vec<(String, String)> + Sync,
        law: impl Fn(&S::Value) -> Verdict + Sync,
    ) -> Outcome
    where
        S::Value: Debug,
    {
        let lots: Vec<Sampling> = (0..self.cases.div_ceil(LOT_CASES)).map(|i| self.lot(i)).collect();
        let outcomes: Vec<Outcome> = lots.par_iter().map(|lot| lot.run(&values, &show, &law)).collect();
        Outcome::all(outcomes)
    }

    /// The i-th lot; its seed is far from those of the others.
    fn lot(&self, i: u32) -> Sampling {
        let seed = self.seed.wrapping_add(u64::from(i).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        Sampling { cases: LOT_CASES.min(self.cases - i * LOT_CASES), seed, ..*self }
    }

    fn run<S: Strategy>(
        &self,
        values: &S,
        show: &impl Fn(&S::Value) -> Vec<(String, String)>,
        law: &impl Fn(&S::Value) -> Verdict,
    ) -> Outcome
    where
        S::Value: Debug,
    {
        let config = Config {
            cases: self.cases,
            max_shrink_iters: if self.shrink { 20_000 } else { 0 },
            max_global_rejects: self.cases.saturating_mul(64).saturating_add(4096),
            failure_persistence: None,
            rng_algorithm: RngAlgorithm::ChaCha,
            rng_seed: RngSeed::Fixed(self.seed),
            ..Config::default()
        };
        let undecided = std::cell::RefCell::new(None);
        let result = TestRunner::new(config).run_one_by_one(values, |case| match law(case) {
            Ok(()) => Ok(()),
            Err(Fault::Outside) => Err(TestCaseError::reject("outside the hypotheses")),
            Err(Fault::False(_)) => Err(TestCaseError::fail("")),
            Err(Fault::Undefined(why)) => {
                undecided.borrow_mut().get_or_insert(why);
                Ok(())
            }
        });
        match (result, undecided.into_inner()) {
            (Err(TestError::Fail(_, case)), _) => {
                let says = match law(&case) {
                    Err(Fault::False(says)) => says,
                    _ => String::new(),
                };
                Outcome::Fails(Counterexample { values: show(&case), says })
            }
            (Err(TestError::Abort(_)), _) => Outcome::Undefined("too few cases meet the hypotheses".into()),
            (Ok(()), Some(why)) => Outcome::Undefined(why),
            (Ok(()), None) => Outcome::Holds { cases: u64::from(self.cases) },
        }
    }
}

/// proptest hands a case to its test by value; a law only looks at it.
trait RunByReference {
    fn run_one_by_one<S: Strategy>(
        &mut self,
        values: &S,
        law: impl Fn(&S::Value) -> Result<(), TestCaseError>,
    ) -> Result<(), TestError<S::Value>>;
}

impl RunByReference for TestRunner {
    fn run_one_by_one<S: Strategy>(
        &mut self,
        values: &S,
        law: impl Fn(&S::Value) -> Result<(), TestCaseError>,
    ) -> Result<(), TestError<S::Value>> {
        self.run(values, |case| law(&case))
    }
}
