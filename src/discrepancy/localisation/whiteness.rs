//! Whether what a model leaves of a constraint is white: random from window to window, as noise of the inputs or slip
//! makes it, and not a law that is missing.
//!
//! | test | of |
//! |---|---|
//! | Ljung and Box (1978) | Q = n(n + 2)·Σₖ ρₖ²/(n − k) over the first lags: no window says anything of the next ones |
//! | kurtosis | (m₄/m₂² − 3)/√(24/n): no few windows stand out |

use super::constraint_residuals::ConstraintResiduals;
use crate::discrepancy::evidence::chi_squared::tail;

/// Lags that are looked at.
const LAGS: usize = 5;
/// Windows at least: of fewer every rest looks white.
const FEWEST: usize = 30;
/// Probability that white motion is not taken for white, by its correlation.
const BY_CHANCE: f64 = 0.02;
/// Deviations of the kurtosis beyond which few windows stand out.
const HEAVY: f64 = 2.5;

/// Whether what is left of a constraint is white, all runs together.
pub(crate) fn is_white(violations: &[ConstraintResiduals], c: usize) -> bool {
    let series: Vec<Vec<f64>> = violations.iter().map(|v| v.rates(c)).collect();
    let n = series.iter().map(Vec::len).sum::<usize>();
    n >= FEWEST && tail(ljung_box(&series, n as f64), LAGS) > BY_CHANCE && excess_kurtosis(&series, n as f64) < HEAVY
}

fn moment(series: &[Vec<f64>], n: f64, power: i32) -> f64 {
    series.iter().flatten().map(|r| r.powi(power)).sum::<f64>() / n
}

fn ljung_box(series: &[Vec<f64>], n: f64) -> f64 {
    let square = n * moment(series, n, 2);
    let correlation = |lag: usize| {
        let products = series.iter().flat_map(|s| s.iter().zip(s.iter().skip(lag)));
        products.map(|(a, b)| a * b).sum::<f64>() / square
    };
    n * (n + 2.0) * (1..=LAGS).map(|k| correlation(k).powi(2) / (n - k as f64)).sum::<f64>()
}

/// In deviations of that of normal numbers.
fn excess_kurtosis(series: &[Vec<f64>], n: f64) -> f64 {
    (moment(series, n, 4) / moment(series, n, 2).powi(2) - 3.0) / (24.0 / n).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rand_distr::StandardNormal;

    fn white(n: usize) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        (0..n).map(|_| random.sample(StandardNormal)).collect()
    }

    fn told(rates: &[f64]) -> bool {
        is_white(&[ConstraintResiduals::across("a.csv", rates)], 1)
    }

    #[test]
    fn random_motion_is_white_and_a_drift_a_wave_and_a_kick_are_not() {
        let noise = white(80);
        assert!(told(&noise));
        assert!(!told(&noise[..29]), "too few to tell");
        let beside =
            |f: &dyn Fn(f64) -> f64| -> Vec<f64> { noise.iter().enumerate().map(|(k, r)| r + f(k as f64)).collect() };
        assert!(!told(&beside(&|k| 2.0 * k / 80.0)));
        assert!(!told(&beside(&|k| (0.4 * k).sin())));
        assert!(!told(&beside(&|k| if k % 20.0 == 7.0 { 6.0 } else { 0.0 })));
    }
}
