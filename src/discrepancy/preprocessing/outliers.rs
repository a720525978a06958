//! Gross errors of the measured pose, and of what is measured beside it: rows that no smooth motion passes through.

use crate::discrepancy::record::local_polynomial;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::shooting::rollout::Rollout;
use crate::error::Result;
use crate::model::Model;
use std::ops::Range;

/// Windows over which the model takes the motion's own curvature out, s.
const WINDOW: f64 = 2.0;
/// How many of the usual errors a gross one is: noise that is normal gives one in 10¹⁵.
const GROSS_DEVIATIONS: f64 = 8.0;
/// More than this share of a column is no gross error but its noise.
const MOST: f64 = 0.05;
/// Rounds in which the largest errors are taken out; a gross error hides its neighbours.
const ROUNDS: usize = 6;
/// Rows this close to a restart are judged in the other windows, where a gross error beyond the edge is seen.
const EDGE: usize = 4;
/// Rows that a row is compared with, and itself.
const COMPARED: usize = 5;
/// Errors from which a usual one is told.
const FEWEST: usize = 20;
/// Rows on either side in which an error is to stand out.
const AROUND: usize = 15;
/// Rows on either side within which only the largest is taken out in one round.
const NEAR: usize = 3;

/// A record without the rows whose measured pose is grossly wrong, and how many there were; inputs are kept.
///
/// | quantity | how |
/// |---|---|
/// | residual | measured minus the model restarted every two seconds: smooth, whatever the model misses |
/// | error of a row | its residual minus the cubic through its four neighbours, over what unit noise makes of it |
/// | gross | eight times the usual, by the median over the record and by that over the rows around: hard driving is rough |
///
/// Where the log begins, ends or is interrupted the neighbours are those on the other side.
///
/// # Errors
/// When the model's formulas are malformed.
pub fn without_gross_errors(record: &Record, model: &Model) -> Result<(Record, usize)> {
    let whole = Record { rows: 0..record.rows.end, ..record.clone() };
    let predictor = Rollout::new(model, &whole)?;
    let mut gross = vec![false; record.rows.end];
    // Twice, half a window apart: where the model restarts its residual jumps, and rows there cannot be judged.
    for shift in [0.0, 0.5] {
        let windows = windows(&whole, shift);
        for column in &residuals(&whole, &predictor, &windows) {
            mark(&record.time, column, &windows, &mut gross);
        }
        // What is measured beside the pose is smooth by itself.
        for column in &whole.quantities {
            mark(&record.time, &column[..whole.rows.end], &windows, &mut gross);
        }
    }
    let first = record.rows.start;
    let dropped = gross[first..].iter().filter(|g| **g).count();
    if !gross.contains(&true) {
        return Ok((record.clone(), 0));
    }
    let kept = |i: usize| !gross.get(i).copied().unwrap_or(false);
    Ok((record.keeping(kept), dropped))
}

/// Rows along which the model runs without a restart.
struct Window {
    rows: Range<usize>,
    /// Whether the log begins with it, or goes on with it after an interruption.
    first: bool,
    /// Whether the log ends with it, or is interrupted after it.
    last: bool,
}

/// Windows one behind the other through every stretch without a gap, the first one shorter by a share; what is left at the
/// end belongs to the last.
fn windows(record: &Record, shorter: f64) -> Vec<Window> {
    let of_stretch = |stretch: Range<usize>| {
        let elapsed = |i: usize| (record.time[i] - record.time[stretch.start]) / WINDOW + shorter;
        let most = (elapsed(stretch.end - 1) - 0.5) as usize;
        let number = |i: &usize| (elapsed(*i) as usize).min(most);
        let rows: Vec<usize> = stretch.clone().collect();
        let window = |w: &[usize]| {
            let rows = w[0]..w[w.len() - 1] + 1;
            Window { first: rows.start == stretch.start, last: rows.end == stretch.end, rows }
        };
        rows.chunk_by(|a, b| number(a) == number(b)).map(window).collect::<Vec<_>>()
    };
    record.segments(0.0).into_iter().flat_map(of_stretch).collect()
}

/// Measured minus modelled, column by column; nothing outside the windows.
fn residuals(record: &Record, predictor: &Rollout, windows: &[Window]) -> Vec<Vec<f64>> {
    let mut found = vec![vec![f64::NAN; record.rows.end]; record.columns.len()];
    let channels = record.channels();
    for Window { rows, .. } in windows {
        for (i, y) in rows.clone().zip(predictor.outputs(rows.start, rows.end - 1)) {
            for c in &channels {
                found[c.column][i] = c.difference(record.columns[c.column][i] - y[c.output]);
            }
        }
    }
    found
}

/// Marks the gross errors of one column.
fn mark(time: &[f64], column: &[f64], windows: &[Window], gross: &mut [bool]) {
    let mut own = gross.to_vec();
    for _ in 0..ROUNDS {
        let rows: Vec<usize> = (0..column.len()).filter(|i| !own[*i] && column[*i].is_finite()).collect();
        let errors = errors(time, column, windows, &rows);
        let Some(usual) = usual(&errors) else { return };
        let is_gross = |k: usize| {
            let near = k.saturating_sub(NEAR)..(k + NEAR + 1).min(rows.len());
            let is_largest = errors[near].iter().all(|e| e.is_nan() || *e <= errors[k]);
            errors[k] > GROSS_DEVIATIONS * usual
                && is_largest
                && stands_out(&errors, k)
                && !beside_restart(windows, &rows, k)
        };
        let found: Vec<usize> = (0..rows.len()).filter(|k| is_gross(*k)).map(|k| rows[k]).collect();
        if found.is_empty() {
            break;
        }
        found.into_iter().for_each(|i| own[i] = true);
    }
    readmit(time, column, windows, gross, &mut own);
    let marked = own.iter().filter(|g| **g).count();
    if (marked as f64) < MOST * column.len() as f64 {
        gross.copy_from_slice(&own);
    }
}

/// Takes back what fits the rows that were left: beside two gross errors a good row looks worst.
fn readmit(time: &[f64], column: &[f64], windows: &[Window], before: &[bool], own: &mut [bool]) {
    let is_good = |own: &[bool], i: usize| !own[i] && column[i].is_finite();
    let left: Vec<usize> = (0..column.len()).filter(|i| is_good(own, *i)).collect();
    let Some(usual) = usual(&errors(time, column, windows, &left)) else { return };
    for i in (0..column.len()).filter(|i| own[*i] && !before[*i]).collect::<Vec<usize>>() {
        // Only the nearest good rows are asked.
        let mut rows: Vec<usize> = (0..i).rev().filter(|j| is_good(own, *j)).take(EDGE).collect();
        rows.reverse();
        let k = rows.len();
        rows.push(i);
        rows.extend((i + 1..column.len()).filter(|j| is_good(own, *j)).take(EDGE));
        let fits = |near| error(time, column, &rows, near, k) <= GROSS_DEVIATIONS * usual;
        if around(windows, &rows, k).is_some_and(|(_, near)| fits(near)) {
            own[i] = false;
        }
    }
}

/// The window of the k-th of some rows, and which of the rows are in it.
fn around<'a>(windows: &'a [Window], rows: &[usize], k: usize) -> Option<(&'a Window, Range<usize>)> {
    let window = windows.get(windows.partition_point(|w| w.rows.end <= rows[k]))?;
    let [first, end] = [window.rows.start, window.rows.end].map(|edge| rows.partition_point(|i| *i < edge));
    Some((window, first..end))
}

/// The error of every one of some rows, in one walk along the windows.
fn errors(time: &[f64], column: &[f64], windows: &[Window], rows: &[usize]) -> Vec<f64> {
    let mut found = vec![f64::NAN; rows.len()];
    let mut end = 0;
    for window in windows {
        let until = |from: usize, edge: usize| from + rows[from..].iter().take_while(|i| **i < edge).count();
        let first = until(end, window.rows.start);
        end = until(first, window.rows.end);
        (first..end).for_each(|k| found[k] = error(time, column, rows, first..end, k));
    }
    found
}

/// |r_i − cubic through its neighbours| over the deviation that unit noise gives it, for the k-th of some rows; `own` are
/// those in its window.
fn error(time: &[f64], column: &[f64], rows: &[usize], own: Range<usize>, k: usize) -> f64 {
    if own.len() < COMPARED {
        return f64::NAN;
    }
    let from = (k.max(own.start + COMPARED / 2) - COMPARED / 2).min(own.end - COMPARED);
    let other = |j: usize| rows[from + j + usize::from(from + j >= k)];
    local_polynomial::beside_cubic(time, column, rows[k], [other(0), other(1), other(2), other(3)])
}

/// Whether the model restarts near the k-th of some rows.
fn beside_restart(windows: &[Window], rows: &[usize], k: usize) -> bool {
    around(windows, rows, k)
        .is_none_or(|(w, own)| (k < own.start + EDGE && !w.first) || (k + EDGE >= own.end && !w.last))
}

/// Whether an error is gross beside those around it.
fn stands_out(errors: &[f64], k: usize) -> bool {
    let around = &errors[k.saturating_sub(AROUND)..(k + AROUND + 1).min(errors.len())];
    usual(around).is_none_or(|usual| errors[k] > GROSS_DEVIATIONS * usual)
}

/// The usual error, as a standard deviation; `None` with too few errors or none at all.
fn usual(errors: &[f64]) -> Option<f64> {
    let mut known: Vec<f64> = errors.iter().copied().filter(|e| e.is_finite()).collect();
    if known.len() < FEWEST {
        return None;
    }
    local_polynomial::deviation(&mut known).filter(|usual| *usual > 0.0)
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
        for wrong in [vec![], vec![7], vec![50, 51, 200, 330], vec![0, 398], vec![2, 397, 399]] {
            let (time, y) = column(&wrong);
            let mut gross = vec![false; y.len()];
            mark(&time, &y, &[Window { rows: 0..y.len(), first: true, last: true }], &mut gross);
            let found: Vec<usize> = (0..y.len()).filter(|i| gross[*i]).collect();
            assert_eq!(found, wrong);
        }
    }

    /// Hard driving leaves rough residuals, which are no gross errors; one that stands out of them is.
    #[test]
    fn a_rough_stretch_is_left_alone() {
        let (time, mut y) = column(&[]);
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
        let rough = rand_distr::Normal::new(0.0, 1.5e-3).unwrap();
        y[150..185].iter_mut().for_each(|v| *v += random.sample(rough));
        for wrong in [None, Some(170)] {
            wrong.into_iter().for_each(|i: usize| y[i] += 0.1);
            let mut gross = vec![false; y.len()];
            mark(&time, &y, &[Window { rows: 0..y.len(), first: true, last: true }], &mut gross);
            let found: Vec<usize> = (0..y.len()).filter(|i| gross[*i]).collect();
            assert_eq!(found, wrong.into_iter().collect::<Vec<_>>());
        }
    }

    #[test]
    fn noise_with_heavy_tails_is_left_alone() {
        let (time, mut y) = column(&[]);
        (0..400).step_by(7).for_each(|i| y[i] += 0.02);
        let mut gross = vec![false; y.len()];
        mark(&time, &y, &[Window { rows: 0..y.len(), first: true, last: true }], &mut gross);
        assert!(!gross.contains(&true));
    }

    /// What is left at the end is a window of its own from half a window on.
    #[test]
    fn a_short_rest_belongs_to_the_window_before() {
        let record = |n: u32| {
            let time: Vec<f64> = (0..n).map(|i| 0.125 * f64::from(i)).collect();
            let still = vec![0.0; time.len()];
            Record::new("", time, vec![still.clone(), still.clone()], false, &[still], crate::motion::Timing::Sample)
        };
        let ends =
            |n: u32, shorter: f64| -> Vec<usize> { windows(&record(n), shorter).iter().map(|w| w.rows.end).collect() };
        assert_eq!(ends(40, 0.0), [16, 40]);
        assert_eq!(ends(41, 0.0), [16, 32, 41]);
        assert_eq!(ends(41, 0.5), [8, 24, 41]);
        let edges: Vec<[bool; 2]> = windows(&record(41), 0.0).iter().map(|w| [w.first, w.last]).collect();
        assert_eq!(edges, [[true, false], [false, false], [false, true]]);
    }
}
