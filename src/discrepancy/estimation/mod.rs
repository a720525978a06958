//! The fit: windows linked by process noise, parameters by Gauss–Newton, variances by REML.

pub mod autocorrelation;
pub(crate) mod bounds;
pub(crate) mod descent;
pub mod elimination;
pub mod fit;
pub mod noise_model;
pub mod priors;
pub mod problem;
pub mod rate_regression;
mod rate_sums;
pub mod unexplained;
pub mod variance_components;
mod variance_inflation;
