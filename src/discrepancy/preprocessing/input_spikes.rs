//! Spikes of an input: single rows far off their neighbours, which the vehicle did not follow.

use super::path_pair::PathPair;
use crate::discrepancy::record::local_polynomial::median;
use crate::files::Run;

/// A row stands out that is off by so many times what nineteen rows in twenty are, from neighbours that are nearly alike.
const STANDS_OUT: f64 = 8.0;
const USUAL_SHARE: f64 = 0.95;
const ALIKE: f64 = 0.3;
/// More rows than this share are no exceptions.
const MOST: f64 = 0.01;
/// Rows that tell what is usual.
const FEWEST: usize = 40;
/// How far, in usual distances of the two paths, a spike leads off the measured one, and what is left of it without the spike.
const LEADS_OFF: f64 = 5.0;
const LEFT: f64 = 0.5;

/// Rows of one input that stand out of those around them.
pub(super) fn candidates(column: &[f64]) -> Vec<usize> {
    if column.len() < FEWEST {
        return vec![];
    }
    let off = |i: usize| (column[i] - 0.5 * (column[i - 1] + column[i + 1])).abs();
    let inner = 1..column.len() - 1;
    let mut each: Vec<f64> = inner.clone().map(off).collect();
    let at = ((each.len() as f64 * USUAL_SHARE) as usize).min(each.len() - 1);
    let usual = *each.select_nth_unstable_by(at, f64::total_cmp).1;
    let stands_out = |i: &usize| {
        let size = off(*i);
        size > STANDS_OUT * usual && (column[i + 1] - column[i - 1]).abs() < ALIKE * size
    };
    let found: Vec<usize> = inner.filter(stands_out).collect();
    if found.len() as f64 > (MOST * column.len() as f64).max(1.0) { vec![] } else { found }
}

/// A column in which some rows are as their neighbours say.
pub(super) fn without(time: &[f64], column: &[f64], rows: &[usize]) -> Vec<f64> {
    let mut found = column.to_vec();
    for i in rows {
        let share = (time[*i] - time[i - 1]) / (time[i + 1] - time[i - 1]);
        found[*i] = column[i - 1] + share * (column[i + 1] - column[i - 1]);
    }
    found
}

/// Those of some rows of the inputs that lead the reckoned path off the measured one, where without them it does not.
pub(super) fn not_followed(run: &Run, rows: &[usize], [spiked, clean]: [&[Vec<f64>; 3]; 2]) -> Vec<usize> {
    let [spiked, clean] = [spiked, clean].map(|reckoned| PathPair { run, reckoned });
    let last = run.time.len() - 1;
    let usual = [0, 1].map(|k| {
        let each = (2..=last).map(|i| clean.apart(i - 2, i)[k]);
        median(&mut each.collect::<Vec<_>>()).unwrap_or(0.0).max(1e-9)
    });
    let size = |pair: PathPair, from, to| {
        let apart = pair.apart(from, to);
        (apart[0] / usual[0]).hypot(apart[1] / usual[1])
    };
    let time = run.input_time();
    let is_spike = |i: &usize| {
        let from = run.time.partition_point(|t| *t <= time[i - 1]).saturating_sub(1);
        let to = run.time.partition_point(|t| *t < time[i + 1]).min(last);
        let with = size(spiked, from, to);
        from < to && with > LEADS_OFF && size(clean, from, to) < LEFT * with
    };
    rows.iter().copied().filter(is_spike).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_rows_stand_out_and_steps_do_not() {
        let smooth = |i: usize| 3.0 + (0.1 * i as f64).sin() + 0.01 * ((7 * i * i) % 13) as f64;
        let with = |spikes: &[(usize, f64)]| -> Vec<usize> {
            let mut column: Vec<f64> = (0..400).map(smooth).collect();
            spikes.iter().for_each(|(i, v)| column[*i] = *v);
            candidates(&column)
        };
        assert_eq!(with(&[]), [0; 0]);
        assert_eq!(with(&[(50, 0.0), (120, 40.0), (300, -2.0)]), [50, 120, 300]);
        // Two in a row are no spike, and many are no exceptions.
        assert_eq!(with(&[(50, 0.0), (51, 0.0)]), [0; 0]);
        assert_eq!(with(&(0..20).map(|k| (10 + 15 * k, 0.0)).collect::<Vec<_>>()), [0; 0]);
        assert_eq!(candidates(&(0..400).map(|i| f64::from(i / 50)).collect::<Vec<_>>()), [0; 0]);
    }

    #[test]
    fn a_row_is_replaced_by_what_lies_between_its_neighbours() {
        assert_eq!(without(&[0.0, 1.0, 4.0], &[2.0, 90.0, 6.0], &[1]), [2.0, 3.0, 6.0]);
    }
}
