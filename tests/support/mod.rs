//! Shared by the property tests: how they are run, random formulas, a carrier that bounds rounding.
#![allow(dead_code)] // every test binary uses its own part

pub mod described;
pub mod fragment;
pub mod laws;
pub mod rounding;
pub mod tree;

use proptest::prelude::*;
use proptest::test_runner::{FileFailurePersistence, RngSeed, TestRunner};
use std::fmt::Debug;
use std::panic::Location;

pub type Outcome = Result<(), TestCaseError>;

/// Tries a law on `cases` random values; the same values on every machine and in every run.
///
/// A failure is kept in `tests/proptest-regressions/`, in a file for each file of tests, and tried first from then on.
#[track_caller]
pub fn check<S: Strategy>(cases: u32, values: S, law: impl Fn(S::Value) -> Outcome)
where
    S::Value: Debug,
{
    let config = ProptestConfig {
        cases,
        max_shrink_iters: 4000,
        rng_seed: RngSeed::Fixed(0x0063_7265_6570),
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct(kept(Location::caller().file())))),
        ..ProptestConfig::default()
    };
    if let Err(failure) = TestRunner::new(config).run(&values, law) {
        panic!("{failure}");
    }
}

/// Where failures of a file of tests are kept, which has to live as long as the process.
fn kept(file: &str) -> &'static str {
    let name = file.trim_start_matches("tests/").trim_end_matches(".rs").replace('/', "_");
    format!("tests/proptest-regressions/{name}.txt").leak()
}

/// A finite number of modest size, often a small whole one or zero.
pub fn modest() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![1 => Just(0.0), 2 => (-3i32..4).prop_map(f64::from), 6 => -3.0..3.0f64]
}

/// A number of modest size away from zero.
pub fn nonzero() -> impl Strategy<Value = f64> + Clone {
    (0.2..3.0f64, any::<bool>()).prop_map(|(x, negative)| if negative { -x } else { x })
}
