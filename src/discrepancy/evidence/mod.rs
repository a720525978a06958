//! Whether an effect is real: information criterion, score test, Wald test, cross-validation, bootstrap, jackknife.

pub(crate) mod chi_squared;
pub mod cross_validation;
pub(crate) mod heterogeneity;
pub mod information_criterion;
mod input_noise_bootstrap;
pub mod jackknife;
pub mod parametric_bootstrap;
pub(crate) mod random_walk;
pub mod regime_stability;
pub(crate) mod scope_scan;
pub mod score_test;
pub(crate) mod wald_test;
mod walk_increments;
