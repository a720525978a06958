//! The χ² distribution.

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Probability that χ² with k degrees of freedom exceeds x.
pub(crate) fn tail(x: f64, k: usize) -> f64 {
    ChiSquared::new(k as f64).map_or(f64::NAN, |d| d.sf(x))
}
