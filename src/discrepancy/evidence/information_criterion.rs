//! The Bayesian information criterion (Schwarz, 1978) with an effective sample size.

use crate::discrepancy::estimation::fit::Fit;

pub(crate) fn bic(fit: &Fit, sample_size: f64) -> f64 {
    fit.deviance + fit.size() * sample_size.ln()
}

/// ΔBIC of a model against a smaller one, its gain of deviance as far as rows are independent.
pub(crate) fn delta_bic(larger: &Fit, smaller: &Fit, sample_size: f64) -> f64 {
    inflated_delta_bic(larger, smaller, sample_size, larger.inflation_beside(smaller))
}

/// The same where windows hang together as much as in all of what remains, for an effect may explain a part of that.
pub(crate) fn careful_delta_bic(larger: &Fit, smaller: &Fit, sample_size: f64) -> f64 {
    inflated_delta_bic(larger, smaller, sample_size, larger.variance_inflation())
}

fn inflated_delta_bic(larger: &Fit, smaller: &Fit, sample_size: f64, inflation: f64) -> f64 {
    (smaller.deviance - larger.deviance) / inflation - (larger.size() - smaller.size()) * sample_size.ln()
}
