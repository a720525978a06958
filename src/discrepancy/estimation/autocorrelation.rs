//! How far what remains unexplained hangs together over time.
//!
//! The statistical model takes jumps at the ends of windows as independent. Where a law is missing they are not: a
//! creep that nobody modelled violates its constraint the same way for as long as the vehicle moves the same way. Then
//! n windows say no more than n/τ independent ones, with the integrated correlation
//!
//! τ = 1 + 2·Σₖ ρₖ,
//!
//! and a gain of deviance counts for its τ-th part. With nothing unexplained there is nothing to hang together: τ = 1.

use crate::discrepancy::shooting::block_sums::SCALES;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Deviance from which on unexplained motion is more than chance.
pub const NOTICEABLE: f64 = 25.0;

/// Lags that are looked at, as a share of the series: longer ones are seen too seldom.
const LONGEST: usize = 3;

/// The integrated correlation of series that belong together, 1 where they are white or too short to tell.
///
/// Lags are summed in pairs as long as a pair's sum is positive: what a sum of all lags adds beyond that is noise.
///
/// ```
/// use creepage::discrepancy::estimation::autocorrelation::integrated_correlation;
/// let alternating = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0];
/// assert_eq!(integrated_correlation(&[alternating.to_vec()]), 1.0);
/// let standing = [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
/// assert_eq!(integrated_correlation(&[standing.to_vec()]), 5.0);
/// ```
pub fn integrated_correlation(series: &[Vec<f64>]) -> f64 {
    let longest = series.iter().map(Vec::len).max().unwrap_or(0) / LONGEST;
    let covariance = |lag: usize| {
        let pairs = series.iter().flat_map(|s| s.iter().zip(s.iter().skip(lag)));
        let (sum, n) = pairs.fold((0.0, 0.0), |(sum, n), (a, b)| (sum + a * b, n + 1.0));
        if n > 0.0 { sum / n } else { 0.0 }
    };
    let here = covariance(0);
    if here <= 0.0 {
        return 1.0;
    }
    let mut sum = 0.0;
    for lag in (1..longest).step_by(2) {
        let pair = (covariance(lag) + covariance(lag + 1)) / here;
        if pair <= 0.0 {
            break;
        }
        sum += pair;
    }
    1.0 + 2.0 * sum
}

/// The integrated correlation of each kind of jump that a fit needs; 1 of those that it does not need.
pub fn of_each_kind(linear: &[Vec<LinearisedWindow>], unexplained: &[f64]) -> Vec<f64> {
    let rates = |c: usize| -> Vec<Vec<f64>> {
        let of_window = |w: &LinearisedWindow| w.mismatch.get(c).map(|m| m / w.duration.sqrt());
        linear.iter().map(|segment| segment.iter().filter_map(of_window).collect()).collect()
    };
    let of = |(c, worth): (usize, &f64)| if *worth > NOTICEABLE { integrated_correlation(&rates(c)) } else { 1.0 };
    unexplained.iter().enumerate().map(of).collect()
}

/// The integrated correlation of what a fit leaves unexplained, each kind of jump by the deviance it is worth.
pub fn of_what_remains(each: &[f64], unexplained: &[f64]) -> f64 {
    let noticeable = || each.iter().zip(unexplained).filter(|(_, worth)| **worth > NOTICEABLE);
    let weight: f64 = noticeable().map(|(_, worth)| worth).sum();
    if weight > 0.0 { noticeable().map(|(tau, worth)| tau * worth).sum::<f64>() / weight } else { 1.0 }
}

/// Probability that white noise is taken for coloured, at each scale.
const BY_CHANCE: f64 = 5e-4;

/// How many rows in a row the noise of a fit is alike: over blocks of two rows, of four …
///
/// τ = Σ (Σ r)² / (n·⟨r²⟩),
///
/// the inner sum over the n rows of a block. For white noise this is about one at every scale; the largest that chance
/// does not explain is taken, each channel by itself. What is slower than a window moves its pose and is not seen here.
pub fn of_noise(linear: &[Vec<LinearisedWindow>]) -> f64 {
    let windows = || linear.iter().flatten();
    let mut found: f64 = 1.0;
    for channel in 0..windows().next().map_or(0, |w| w.count.len()) {
        let rows: usize = windows().map(|w| w.count[channel]).sum();
        let mean = windows().map(|w| w.square(channel)).sum::<f64>() / rows as f64;
        for k in 0..SCALES {
            let count: usize = windows().map(|w| w.blocks[channel].count[k]).sum();
            let squares: f64 = windows().map(|w| w.blocks[channel].squares[k]).sum();
            let tau = squares / (count as f64 * (2 << k) as f64 * mean);
            if tau > found && tau > by_chance(count as f64) {
                found = tau;
            }
        }
    }
    found
}

/// What the mean square of so many independent standard normal numbers hardly exceeds by chance.
fn by_chance(count: f64) -> f64 {
    ChiSquared::new(count).map_or(f64::INFINITY, |d| d.inverse_cdf(1.0 - BY_CHANCE) / count)
}
