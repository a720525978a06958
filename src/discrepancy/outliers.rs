//! Gross errors of the measured pose: rows that no smooth motion passes through.

use super::angle::wrapped;
use super::gap::Predictor;
use super::record::{Channel, Record};
use super::smooth;
use crate::error::Result;
use crate::model::Model;

/// Windows over which the model takes the motion's own curvature out, s.
const WINDOW: f64 = 2.0;
/// How many of the usual errors a gross one is: noise that is normal gives one in 10¹⁵.
const GROSS: f64 = 8.0;
/// More than this share of a column is no gross error but its noise.
const MOST: f64 = 0.05;
/// Rounds in which the largest errors are taken out; a gross error hides its neighbours.
const ROUNDS: usize = 6;
/// Rows this close to the edge of a window are judged in the other windows, where a gross error beyond the edge is seen.
const EDGE: usize = 4;
/// Errors from which a usual one is told.
const FEWEST: usize = 20;
/// Rows on either side within which only the largest is taken out in one round.
const NEAR: usize = 3;

/// A record without the rows whose measured pose is grossly wrong, and how many there were; inputs are kept.
///
/// | quantity | how |
/// |---|---|
/// | residual | measured minus the model restarted every two seconds: smooth, whatever the model misses |
/// | error of a row | its residual minus the cubic through its four neighbours, over what unit noise makes of it |
/// | gross | eight times the usual, by the median over the record |
///
/// # Errors
/// When the model's formulas are malformed.
pub fn without_gross_errors(record: &Record, model: &Model) -> Result<(Record, usize)> {
    let whole = Record { rows: 0..record.rows.end, ..record.clone() };
    let predictor = Predictor::new(model, &whole)?;
    let mut gross = vec![false; record.rows.end];
    // Twice, half a window apart: where the model restarts its residual jumps, and rows there cannot be judged.
    for shift in [0, 1] {
        let windows = windows(&predictor, shift);
        for column in &residuals(&whole, &predictor, &windows) {
            mark(&record.time, column, &windows, &mut gross);
        }
    }
    let first = record.rows.start;
    let dropped = gross[first..].iter().filter(|g| **g).count();
    if !gross.contains(&true) {
        return Ok((record.clone(), 0));
    }
    let kept = |i: &usize| !gross.get(*i).copied().unwrap_or(false);
    let before = (0..first).filter(kept).count();
    let end = (0..record.rows.end).filter(kept).count();
    let pick = |column: &[f64]| (0..column.len()).filter(kept).map(|i| column[i]).collect::<Vec<f64>>();
    let columns = record.columns.iter().map(|c| pick(c)).collect();
    Ok((Record { time: pick(&record.time), columns, rows: before..end, ..record.clone() }, dropped))
}

/// Windows of two halves each, beginning with the first half or the second.
fn windows(predictor: &Predictor, shift: usize) -> Vec<(usize, usize)> {
    let halves = predictor.windows(0.5 * WINDOW);
    let whole = halves[shift.min(halves.len())..].chunks(2);
    whole.filter(|w| w.len() < 2 || w[0].1 == w[1].0).map(|w| (w[0].0, w[w.len() - 1].1)).collect()
}

/// Measured minus modelled, column by column; nothing outside the windows.
fn residuals(record: &Record, predictor: &Predictor, windows: &[(usize, usize)]) -> Vec<Vec<f64>> {
    let mut found = vec![vec![f64::NAN; record.rows.end]; record.columns.len()];
    let channels = record.channels();
    for (from, to) in windows.iter().copied() {
        for (i, y) in (from..to).zip(predictor.outputs(from, to)) {
            for (c, column) in found.iter_mut().enumerate() {
                let r = record.columns[c][i] - y[record.output_of(c)];
                column[i] = if channels[c] == Channel::Position { r } else { wrapped(r) };
            }
        }
    }
    found
}

/// Marks the gross errors of one column.
fn mark(time: &[f64], column: &[f64], windows: &[(usize, usize)], gross: &mut [bool]) {
    let mut window = vec![0; column.len()];
    windows.iter().enumerate().for_each(|(k, (from, to))| window[*from..*to].fill(k));
    let mut own = gross.to_vec();
    for _ in 0..ROUNDS {
        let rows: Vec<usize> = (0..column.len()).filter(|i| !own[*i] && column[*i].is_finite()).collect();
        let errors: Vec<f64> = (0..rows.len()).map(|k| error(time, column, &window, &rows, k)).collect();
        let Some(usual) = usual(&errors) else { return };
        let is_gross = |k: usize| {
            let near = k.saturating_sub(NEAR)..(k + NEAR + 1).min(rows.len());
            errors[k] > GROSS * usual && errors[near].iter().all(|e| e.is_nan() || *e <= errors[k])
        };
        let found: Vec<usize> = (0..rows.len()).filter(|k| is_gross(*k)).map(|k| rows[k]).collect();
        if found.is_empty() {
            break;
        }
        found.into_iter().for_each(|i| own[i] = true);
    }
    readmit(time, column, &window, gross, &mut own);
    let marked = own.iter().filter(|g| **g).count();
    if (marked as f64) < MOST * column.len() as f64 {
        gross.copy_from_slice(&own);
    }
}

/// Takes back what fits the rows that were left: beside two gross errors a good row looks worst.
fn readmit(time: &[f64], column: &[f64], window: &[usize], before: &[bool], own: &mut [bool]) {
    let is_good = |own: &[bool], i: usize| !own[i] && column[i].is_finite();
    let left: Vec<usize> = (0..column.len()).filter(|i| is_good(own, *i)).collect();
    let errors: Vec<f64> = (0..left.len()).map(|k| error(time, column, window, &left, k)).collect();
    let Some(usual) = usual(&errors) else { return };
    for i in (0..column.len()).filter(|i| own[*i] && !before[*i]).collect::<Vec<usize>>() {
        // Only the nearest good rows are asked.
        let mut rows: Vec<usize> = (0..i).rev().filter(|j| is_good(own, *j)).take(EDGE).collect();
        rows.reverse();
        let k = rows.len();
        rows.push(i);
        rows.extend((i + 1..column.len()).filter(|j| is_good(own, *j)).take(EDGE));
        if error(time, column, window, &rows, k) <= GROSS * usual {
            own[i] = false;
        }
    }
}

/// |r_i − cubic through its neighbours| over the deviation that unit noise gives it; nothing at the ends or
/// from one window to the next.
fn error(time: &[f64], column: &[f64], window: &[usize], rows: &[usize], k: usize) -> f64 {
    if k < EDGE || k + EDGE >= rows.len() || window[rows[k - EDGE]] != window[rows[k + EDGE]] {
        return f64::NAN;
    }
    smooth::beside_cubic(time, column, rows[k], [rows[k - 2], rows[k - 1], rows[k + 1], rows[k + 2]])
}

/// The usual error, as a standard deviation; `None` with too few errors or none at all.
fn usual(errors: &[f64]) -> Option<f64> {
    let mut known: Vec<f64> = errors.iter().copied().filter(|e| e.is_finite()).collect();
    if known.len() < FEWEST {
        return None;
    }
    smooth::deviation(&mut known).filter(|usual| *usual > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{Rng, SeedableRng};

    /// A smooth residual with noise, and gross errors at some rows, two of them neighbours.
    fn column(wrong: &[usize]) -> (Vec<f64>, Vec<f64>) {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(3);
        let time: Vec<f64> = (0..400).map(|i| 0.05 * f64::from(i)).collect();
        let noise = rand_distr::Normal::new(0.0, 1e-4).unwrap();
        let mut y: Vec<f64> = time.iter().map(|t| 0.05 * (1.3 * t).sin() + random.sample(noise)).collect();
        wrong.iter().for_each(|i| y[*i] += 0.02);
        (time, y)
    }

    #[test]
    fn gross_errors_are_found_and_nothing_else() {
        for wrong in [vec![], vec![7], vec![50, 51, 200, 330]] {
            let (time, y) = column(&wrong);
            let mut gross = vec![false; y.len()];
            mark(&time, &y, &[(0, y.len())], &mut gross);
            let found: Vec<usize> = (0..y.len()).filter(|i| gross[*i]).collect();
            assert_eq!(found, wrong);
        }
    }

    #[test]
    fn noise_with_heavy_tails_is_left_alone() {
        let (time, mut y) = column(&[]);
        (0..400).step_by(7).for_each(|i| y[i] += 0.02);
        let mut gross = vec![false; y.len()];
        mark(&time, &y, &[(0, y.len())], &mut gross);
        assert!(!gross.contains(&true));
    }
}
