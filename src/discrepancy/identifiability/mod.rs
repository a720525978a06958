//! What runs can tell of a model before anything is fitted to them: how well each effect would be known, which would be
//! missed, which would not be told apart, and what to drive to mend that.
//!
//! | quantity | formula |
//! |---|---|
//! | information of effects | I = Σ JᵀJ over the rows, poses and jumps eliminated, at the neutral value |
//! | deviation of a value | √(τ·(I⁻¹)ᵢᵢ), I restricted to the effect, τ the rows and windows in a row that are alike |
//! | gain of naming an effect of size s | min over jumps of D(noise + J·s) − D(noise), over τ, block by block: jumps are what it is mistaken for |
//! | what is seen | √gain > √(k·ln n + 2·ln M) + 1.645: with 95 % the effect passes the bar that `discover` sets for one of M |
//! | misfit of b where a is fitted | sᵀ(I_bb − I_ba·I_aa⁻¹·I_ab)s/τ: what tells a from b |
//!
//! An effect that has no derivative at its neutral value (it adds a state, or vanishes at the edge of its range) is
//! looked at where it has its plausible size.

mod advice;
pub(crate) mod check;
pub(crate) mod check_report;
pub(crate) mod confusable_pairs;
pub(crate) mod data_finding;
pub(crate) mod data_quality;
pub(crate) mod detection_power;
pub(crate) mod driving_statistics;
pub(crate) mod expected_gain;
pub(crate) mod fisher_information;

pub use check::Checked;
pub use check_report::{Check, Health, Pair, Parameter, Prospect, RunHealth, Seen, Standing};
