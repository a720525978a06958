//! Values run by run, and whether they are one: the Q of Cochran (1954) and the variance between runs by restricted maximum
//! likelihood, as in a random-effects meta-analysis.
//!
//! | symbol | meaning |
//! |---|---|
//! | θ_k, v_k | what a run says alone, to first order about the fit, and its variance |
//! | Q = Σ (θ_k − θ̄)²/v_k | χ² of K − 1 where the K runs have one value |
//! | τ² | variance between runs, θ_k ~ N(μ, v_k + τ²) |
//! | 1/Σ 1/(v_k + τ²) | variance of μ |

use super::chi_squared::tail;
use crate::discrepancy::estimation::fit::{Fit, inverse};

/// Steps of the iteration for τ² at most.
const STEPS: usize = 100;
/// A probability below which runs have values of their own.
const ALIKE: f64 = 0.01;

/// What one run says of a value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RunValue {
    /// The run among those of the fit.
    pub run: usize,
    pub value: f64,
    pub variance: f64,
}

/// How a value differs between runs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Spread {
    /// Run by run, as far as a run tells it.
    pub values: Vec<RunValue>,
    /// Mean over the runs and its standard deviation, τ included.
    pub mean: f64,
    pub std: f64,
    /// Standard deviation between runs.
    pub tau: f64,
    /// Cochran's Q, and the probability of so much where all runs have one value.
    pub q: f64,
    pub p_value: f64,
}

impl Spread {
    /// Of values of runs; `None` of fewer than two.
    pub fn of(values: Vec<RunValue>) -> Option<Self> {
        let runs = values.len();
        if runs < 2 {
            return None;
        }
        let (mean, _) = weighted(&values, 0.0);
        let q: f64 = values.iter().map(|v| (v.value - mean).powi(2) / v.variance).sum();
        let between = restricted_maximum_likelihood(&values, q);
        let (mean, std) = weighted(&values, between);
        Some(Self { mean, std, tau: between.sqrt(), q, p_value: tail(q, runs - 1), values })
    }

    /// Whether every run that tells its value beyond its own deviation tells it in the direction of another.
    pub fn is_along(&self, value: f64) -> bool {
        self.values.iter().all(|v| v.value * value > 0.0 || v.value.abs() < v.variance.sqrt())
    }

    /// Whether runs have values of their own.
    pub fn is_real(&self) -> bool {
        self.p_value < ALIKE
    }
}

/// The spread of every value of a fit between its runs.
pub(crate) fn spreads(fit: &Fit) -> Vec<Option<Spread>> {
    let runs = fit.of_runs.iter().map(|form| {
        let p = fit.p.len();
        let covariance = inverse(&form.view((0, 0), (p, p)).into_owned())?;
        let values = -(&covariance * form.view((0, p), (p, 1)).column(0));
        Some((values, covariance))
    });
    let runs: Vec<_> = runs.enumerate().filter_map(|(run, told)| Some((run, told?))).collect();
    let of = |i: usize| {
        let each = runs.iter().map(|(run, (step, covariance))| RunValue {
            run: *run,
            value: fit.p[i] + step[i],
            variance: covariance[(i, i)] * fit.inflation_of(i),
        });
        Spread::of(each.collect())
    };
    (0..fit.p.len()).map(of).collect()
}

/// τ² of a value, where it is more than the noise of the runs.
pub(crate) fn variance_between_runs(spread: &Option<Spread>) -> f64 {
    spread.as_ref().filter(|s| s.is_real()).map_or(0.0, |s| s.tau * s.tau)
}

/// Mean weighted by 1/(v + τ²), and its standard deviation.
fn weighted(values: &[RunValue], between: f64) -> (f64, f64) {
    let weights = || values.iter().map(|v| (1.0 / (v.variance + between), v.value));
    let total: f64 = weights().map(|(w, _)| w).sum();
    (weights().map(|(w, value)| w * value).sum::<f64>() / total, total.sqrt().recip())
}

/// τ² by Fisher scoring from the moment estimate of DerSimonian & Laird (1986).
fn restricted_maximum_likelihood(values: &[RunValue], q: f64) -> f64 {
    let sum = |of: &dyn Fn(&RunValue) -> f64| values.iter().map(of).sum::<f64>();
    let (first, second) = (sum(&|v| v.variance.recip()), sum(&|v| v.variance.powi(-2)));
    let free = values.len() as f64 - 1.0;
    let mut between = ((q - free) / (first - second / first)).max(0.0);
    for _ in 0..STEPS {
        let (mean, std) = weighted(values, between);
        let weight = |v: &RunValue| (v.variance + between).powi(-2);
        let excess = sum(&|v| weight(v) * ((v.value - mean).powi(2) - v.variance));
        let next = (excess / sum(&weight) + std * std).max(0.0);
        let is_settled = (next - between).abs() <= 1e-9 * between;
        between = next;
        if is_settled {
            break;
        }
    }
    between
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{fit_of, unicycle};
    use nalgebra::dmatrix;

    fn runs(values: &[f64], variance: f64) -> Spread {
        let each = values.iter().enumerate();
        Spread::of(each.map(|(run, value)| RunValue { run, value: *value, variance }).collect()).unwrap()
    }

    /// Of equal variances τ² is s² − v, and the mean has s²/K.
    #[test]
    fn runs_that_scatter_by_more_than_their_noise_have_a_spread() {
        let spread = runs(&[1.0, 2.0, 3.0, 6.0], 0.5);
        let square = 14.0 / 3.0;
        assert!((spread.tau - f64::sqrt(square - 0.5)).abs() < 1e-6, "{spread:?}");
        assert!((spread.mean - 3.0).abs() < 1e-12 && (spread.std - f64::sqrt(square / 4.0)).abs() < 1e-6);
        assert!((spread.q - 28.0).abs() < 1e-9 && spread.is_real());
        // As far as their noise lets them.
        let alike = runs(&[1.0, 2.0, 3.0, 6.0], 5.0);
        assert_eq!((alike.tau, alike.is_real()), (0.0, false));
        assert!((alike.std - f64::sqrt(5.0 / 4.0)).abs() < 1e-12);
    }

    /// A form ½·(δ − d)ᵀ·H·(δ − d) is a run that says p + d with the variance 1/H.
    #[test]
    fn a_run_says_its_value_by_its_part_of_the_form() {
        let of = |h: f64, d: f64| dmatrix![h, -h * d; -h * d, h * d * d];
        let mut fit = fit_of(unicycle(&[("traverse-creep", &[0.05])]));
        fit.of_runs = vec![of(4.0, 0.01), of(0.0, 0.0), of(1.0, -0.04)];
        let spread = spreads(&fit).remove(0).unwrap();
        let told: Vec<(usize, f64, f64)> = spread.values.iter().map(|v| (v.run, v.value, v.variance)).collect();
        assert_eq!(told.iter().map(|t| (t.0, t.2)).collect::<Vec<_>>(), [(0, 0.25), (2, 1.0)]);
        assert!((told[0].1 - 0.06).abs() < 1e-12 && (told[1].1 - 0.01).abs() < 1e-12);
        fit.of_runs.truncate(2);
        assert_eq!(spreads(&fit), [None]);
    }
}
