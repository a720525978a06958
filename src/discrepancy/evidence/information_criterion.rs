//! The Bayesian information criterion (Schwarz, 1978) with an effective sample size.

use crate::discrepancy::estimation::fit::Fit;

pub(crate) fn bic(fit: &Fit, sample_size: f64) -> f64 {
    fit.deviance + fit.size() * sample_size.ln()
}

/// ΔBIC of a model against a smaller one, its gain of deviance as far as rows are independent.
pub(crate) fn delta_bic(larger: &Fit, smaller: &Fit, sample_size: f64) -> f64 {
    let more = larger.size() - smaller.size();
    (smaller.deviance - larger.deviance) / larger.inflation_beside(smaller) - more * sample_size.ln()
}
