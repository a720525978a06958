//! Increments of a random walk: they do not follow what the vehicle does, and none stands out (residual analysis of a
//! structural time-series model, Harvey 1989, section 5.4).
//!
//! A law that is not an effect's, asked block by block, looks like a parameter that moves: but then it moves with the inputs.
//! What begins and ends is a few large steps between many small ones.

use crate::discrepancy::record::run_record::Record;
use crate::model::observation::BODY_HEADING;
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// The share of the increments' variance that the driving explains, beyond its own number of columns, at most.
const FOLLOWS: f64 = 0.25;
/// The largest increment, in units of their root mean square, at most.
const STANDS_OUT: f64 = 5.0;

/// What the vehicle is asked to do on the mean of some rows: inputs, their sizes, products and rates, and where it heads.
pub(crate) fn driving(record: &Record, rows: &Range<usize>) -> Vec<f64> {
    let channels = record.signals.channels();
    let (mut u, mut slope) = (vec![0.0; channels], vec![0.0; channels]);
    let mut sum: Vec<f64> = vec![];
    for i in rows.clone() {
        record.signals.at(record.time[i], &mut u, &mut slope);
        let products = (0..channels).flat_map(|i| (i..channels).map(move |j| (i, j)));
        let mut here: Vec<f64> = u.iter().chain(&slope).copied().collect();
        here.extend(u.iter().map(|u| u.abs()));
        here.extend(products.map(|(i, j)| u[i] * u[j]));
        if record.has_heading() {
            let (sin, cos) = record.columns[BODY_HEADING][i].sin_cos();
            here.extend([sin, cos]);
        }
        sum.resize(here.len(), 0.0);
        sum.iter_mut().zip(here).for_each(|(s, h)| *s += h);
    }
    let n = rows.len().max(1) as f64;
    sum.into_iter().map(|s| s / n).collect()
}

/// Whether increments may be those of a walk: of each the change of the driving beside it, in a row.
pub(crate) fn are_random(increments: &[f64], driving: &[Vec<f64>]) -> bool {
    let n = increments.len();
    let all = increments.iter().map(|d| d * d).sum::<f64>();
    let largest = increments.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
    if all == 0.0 || largest > STANDS_OUT * (all / n as f64).sqrt() {
        return false;
    }
    let columns = driving.first().map_or(0, Vec::len);
    let explained = DMatrix::from_fn(n, columns, |i, j| driving[i][j]);
    let left = residual(explained, &DVector::from_column_slice(increments));
    let Some((left, used)) = left else { return true };
    let free = n as f64 - used as f64;
    free > 1.0 && 1.0 - (left / free) / (all / n as f64) < FOLLOWS
}

/// The sum of squares that a regression leaves, and how many columns it uses.
fn residual(mut x: DMatrix<f64>, y: &DVector<f64>) -> Option<(f64, usize)> {
    x.column_iter_mut().for_each(|mut column| _ = column.try_normalize_mut(0.0));
    let svd = x.svd(true, false);
    let rank = svd.rank(1e-6 * svd.singular_values.max());
    let u = svd.u?;
    let projected: f64 = (0..rank).map(|j| u.column(j).dot(y).powi(2)).sum();
    Some((y.norm_squared() - projected, rank))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// Random numbers in (−1, 1).
    fn noise(n: usize, seed: u64) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        (0..n).map(|_| random.random_range(-1.0..1.0)).collect()
    }

    #[test]
    fn steps_that_follow_the_driving_or_stand_out_are_no_walk() {
        let n = 80;
        let driving: Vec<Vec<f64>> = (0..n).map(|i| (0..6).map(|j| noise(n, 10 + j)[i]).collect()).collect();
        let walk = noise(n, 1);
        assert!(are_random(&walk, &driving));
        let with = |share: f64| -> Vec<f64> { walk.iter().zip(&driving).map(|(w, d)| w + share * d[2]).collect() };
        assert!(are_random(&with(0.3), &driving) && !are_random(&with(1.5), &driving));
        let mut jump: Vec<f64> = walk.iter().map(|w| 0.1 * w).collect();
        jump[30] = 2.0;
        assert!(!are_random(&jump, &driving) && !are_random(&vec![0.0; n], &driving));
    }
}
