//! Measurements smoothed around a time, and the noise they carry.

/// Half width of the local fit, s.
const HALF_WIDTH: f64 = 0.4;

/// Half width of the local fit of a direction of travel, s: a slope needs more than a value.
const SLOPE_HALF_WIDTH: f64 = 1.0;

/// Weights of the rows around row `i` whose sum is the smoothed value at its time.
///
/// A local polynomial of degree four by least squares; the weights depend on the times alone. Rows are taken from
/// `range` only. Where they are too few to overrule one another a row stands for itself: a lower degree would cut the
/// corners of a path by more than its noise.
pub fn weights(time: &[f64], range: std::ops::Range<usize>, i: usize) -> Vec<(usize, f64)> {
    local(time, range, i, HALF_WIDTH, &|rows| (rows > 5).then_some(4), 0).unwrap_or_else(|| vec![(i, 1.0)])
}

/// Weights of the rows around row `i` whose sum is the rate at its time, by a local cubic, of few rows by a line.
///
/// `None` with fewer than three rows nearby.
pub fn slope_weights(time: &[f64], range: std::ops::Range<usize>, i: usize) -> Option<Vec<(usize, f64)>> {
    let degree = |rows| match rows {
        0..=2 => None,
        3..=6 => Some(1),
        _ => Some(3),
    };
    local(time, range, i, SLOPE_HALF_WIDTH, &degree, 1)
}

/// Weights of the value (0) or the rate (1) at row `i` of a local parabola over so many seconds to either side.
///
/// `None` with fewer than five rows.
pub fn parabola(
    time: &[f64],
    range: std::ops::Range<usize>,
    i: usize,
    half_width: f64,
    derivative: usize,
) -> Option<Vec<(usize, f64)>> {
    local(time, range, i, half_width, &|rows| (rows >= 5).then_some(2), derivative)
}

/// Weights of a derivative (0: the value) at row `i` of a local polynomial, whose degree the number of rows decides.
fn local(
    time: &[f64],
    range: std::ops::Range<usize>,
    i: usize,
    half_width: f64,
    degree: &dyn Fn(usize) -> Option<usize>,
    derivative: usize,
) -> Option<Vec<(usize, f64)>> {
    let near = |j: &usize| (time[*j] - time[i]).abs() <= half_width;
    let first = (range.start..i).rev().take_while(near).last().unwrap_or(i);
    let last = (i..range.end).take_while(near).last().unwrap_or(i);
    let rows = last + 1 - first;
    let degree = degree(rows)?;
    let at = |r: usize| (time[first + r] - time[i]) / half_width;
    let design = nalgebra::DMatrix::from_fn(rows, degree + 1, |r, c| at(r).powi(c as i32));
    let gram = design.tr_mul(&design).cholesky()?;
    // A coefficient of the polynomial is a row of (XᵀX)⁻¹Xᵀ; the value is the first, the rate the second.
    let mut unit = nalgebra::DVector::zeros(degree + 1);
    unit[derivative] = half_width.powi(-(derivative as i32));
    let w = &design * gram.solve(&unit);
    Some(w.iter().enumerate().map(|(r, w)| (first + r, *w)).collect())
}

/// The smoothed value of a column.
pub fn value(column: &[f64], weights: &[(usize, f64)]) -> f64 {
    weights.iter().map(|(j, w)| w * column[*j]).sum()
}

/// Standard deviation of white noise on a smooth column, robust against outliers.
///
/// Each row is predicted by the cubic through two neighbours on either side; the median of the standardised
/// errors, scaled to a normal distribution, is the estimate. `None` with fewer than eight rows.
pub fn noise(time: &[f64], column: &[f64]) -> Option<f64> {
    if time.len() < 8 {
        return None;
    }
    let mut errors: Vec<f64> = (2..time.len() - 2).filter_map(|i| standardised(time, column, i)).collect();
    deviation(&mut errors)
}

/// The standard deviation of a normal distribution whose sizes have this median; `None` without any.
pub fn deviation(sizes: &mut [f64]) -> Option<f64> {
    // The median of |N(0,1)|.
    Some(median(sizes)? / 0.674_489_750_196_081_7)
}

/// The middle value, of an even number the upper one; `None` without any.
pub fn median(values: &mut [f64]) -> Option<f64> {
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// |y_i − cubic through its four neighbours| over the standard deviation that unit noise gives it.
fn standardised(time: &[f64], column: &[f64], i: usize) -> Option<f64> {
    let error = beside_cubic(time, column, i, [i - 2, i - 1, i + 1, i + 2]);
    // Across a gap the cubic says nothing.
    let even = time[i + 2] - time[i - 2] < 8.0 * (time[i] - time[i - 1]).min(time[i + 1] - time[i]);
    even.then_some(error).filter(|e| e.is_finite())
}

/// |y_i − cubic through four other rows| over the standard deviation that unit noise gives it.
pub fn beside_cubic(time: &[f64], column: &[f64], i: usize, others: [usize; 4]) -> f64 {
    let lagrange = others.map(|j| {
        let factors = others.iter().filter(|k| **k != j).map(|k| (time[i] - time[*k]) / (time[j] - time[*k]));
        factors.product::<f64>()
    });
    let prediction: f64 = others.iter().zip(lagrange).map(|(j, l)| l * column[*j]).sum();
    let spread = (1.0 + lagrange.iter().map(|l| l * l).sum::<f64>()).sqrt();
    (column[i] - prediction).abs() / spread
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_reproduce_a_quartic_on_uneven_times() {
        let time: Vec<f64> = (0..40).map(|i| 0.03 * f64::from(i) + 0.004 * f64::from(i % 3)).collect();
        let column: Vec<f64> = time.iter().map(|t| 1.0 + t - 2.0 * t * t + t.powi(4)).collect();
        for i in [0, 5, 20, 39] {
            let w = weights(&time, 0..40, i);
            assert!((value(&column, &w) - column[i]).abs() < 1e-9);
        }
    }

    /// Whatever the time between rows, at the ends of a log too, a path with curves is smoothed to itself.
    #[test]
    fn corners_are_not_cut() {
        for step in [0.02, 0.05, 0.09, 0.1, 0.13, 0.14, 0.17, 0.2, 0.25, 0.33, 0.4, 0.5, 1.0] {
            let time: Vec<f64> = (0..(8.0 / step) as usize).map(|i| step * i as f64).collect();
            let column: Vec<f64> = time.iter().map(|t| t.sin()).collect();
            for i in 0..time.len() {
                let off = value(&column, &weights(&time, 0..time.len(), i)) - column[i];
                assert!(off.abs() < 3e-4, "{off} at row {i} of one every {step} s");
            }
        }
    }

    /// Of a cubic from seven rows on, of a line from three on; of fewer nothing.
    #[test]
    fn slopes_are_those_of_what_few_rows_can_tell() {
        let time: Vec<f64> = (0..20).map(|i| 0.2 * f64::from(i) + 0.03 * f64::from(i % 3)).collect();
        let cubic: Vec<f64> = time.iter().map(|t| 1.0 + t - 2.0 * t * t + t.powi(3)).collect();
        let slope = |t: f64| 1.0 - 4.0 * t + 3.0 * t * t;
        let found = value(&cubic, &slope_weights(&time, 0..20, 9).unwrap());
        assert!((found - slope(time[9])).abs() < 1e-9, "{found}");
        let slow: Vec<f64> = (0..20).map(|i| 0.9 * f64::from(i)).collect();
        let line: Vec<f64> = slow.iter().map(|t| 3.0 - 0.4 * t).collect();
        let few = slope_weights(&slow, 0..20, 9).unwrap();
        assert_eq!(few.len(), 3);
        assert!((value(&line, &few) + 0.4).abs() < 1e-12);
        assert!(slope_weights(&slow, 0..20, 0).is_none());
    }

    #[test]
    fn noise_is_estimated_despite_outliers() {
        use rand::{Rng, SeedableRng};
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        let time: Vec<f64> = (0..4000).map(|i| 0.04 * f64::from(i)).collect();
        let column: Vec<f64> = time
            .iter()
            .enumerate()
            .map(|(i, t)| {
                (0.7 * t).sin() + rng.sample(rand_distr::Normal::new(0.0, 0.01).unwrap()) + f64::from(i % 200 == 0)
            })
            .collect();
        let s = noise(&time, &column).unwrap();
        assert!((s - 0.01).abs() < 0.001, "{s}");
    }
}
