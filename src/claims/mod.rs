//! What the paper says, each claim with evidence that can be run.
//!
//! A [`Claim`] states a status; [`verify`] runs its evidence and says which status it *earned*. Evidence is a
//! [`Statement`], equations given as data, and a check that puts them to the test: by the normal form
//! ([`prove`]), exactly at generated points ([`at_points`]), or against simulated motion. Because the statement is
//! data, sabotage is mechanical: every statement one slip away (`mutants`) must be noticed by the same check, or
//! the evidence counts for nothing.
//!
//! | status | earned when |
//! |---|---|
//! | proved | all evidence is proof in exact arithmetic |
//! | sampled | it held in every generated case |
//! | corrected | what is printed fails, with a counterexample, and the corrected form is proved or sampled |
//! | refuted | what is printed fails, with a counterexample |
//! | editorial | a misprint without mathematics |
//! | open | there is no evidence, or some of it did not do what it says |

mod checks;
mod claim;
mod correction;
mod corrections;
mod count_check;
mod counted;
pub(crate) mod derived_formulas;
mod divisors;
pub(crate) mod exact_point;
#[doc(hidden)]
pub mod generated;
pub(crate) mod generated_forced;
#[doc(hidden)]
pub mod kernel;
#[doc(hidden)]
pub mod ledger;
mod mutants;
mod outcome;
mod paper;
mod proved;
mod sampling;
pub(crate) mod simulated;
mod statement;
mod status;
mod user;
mod verify;
pub(crate) mod with_forces;

#[doc(hidden)]
pub use checks::{at_points, counterexample, near, value_said};
pub use checks::{prove, proving};
#[doc(hidden)]
pub use claim::{Check, Relation};
pub use claim::{Claim, Evidence, Gives};
pub use correction::Correction;
#[doc(hidden)]
pub use corrections::CorrectionCounts;
pub use derived_formulas::DerivedFormulas;
#[doc(hidden)]
pub use exact_point::{Domain, Point, domains, points, simplest, value, written};
#[doc(hidden)]
pub use mutants::{Mutant, mutants};
#[doc(hidden)]
pub use outcome::Counterexample;
pub use outcome::Outcome;
pub use paper::all;
#[doc(hidden)]
pub use sampling::{Fault, Sampling, Verdict};
#[doc(hidden)]
pub use statement::Equation;
pub use statement::Statement;
pub use status::Status;
pub use user::read;
pub use verify::{Entry, Ledger, Options, Shown, verify};
