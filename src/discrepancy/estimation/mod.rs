//! The fit: windows linked by process noise, parameters by Gauss–Newton, variances by REML.

pub mod autocorrelation;
pub(crate) mod bounds;
pub mod elimination;
pub mod fit;
pub mod levenberg_marquardt;
pub mod noise_model;
pub mod problem;
pub mod rate_regression;
pub mod unexplained;
pub mod variance_components;
