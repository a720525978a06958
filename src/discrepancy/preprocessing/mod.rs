//! Data set right before a fit: outliers, errors of units, quantised inputs.

pub(crate) mod dataset;
pub(crate) mod motion_ratios;
pub mod outliers;
pub(crate) mod quantisation;
pub(crate) mod unit_errors;
