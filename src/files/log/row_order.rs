//! Rows in the order of time, each time once, and angles without jumps.

use std::f64::consts::TAU;

/// Sorts rows by time, the first column; gives the number of steps back in time there were.
///
/// Rows of one time keep their order.
pub(crate) fn sort(columns: &mut [Vec<f64>]) -> usize {
    let time = &columns[0];
    let back = time.windows(2).filter(|pair| pair[1] < pair[0]).count();
    if back > 0 {
        let mut order: Vec<usize> = (0..time.len()).collect();
        order.sort_by(|&i, &j| time[i].total_cmp(&time[j]));
        for column in columns {
            *column = order.iter().map(|&i| column[i]).collect();
        }
    }
    back
}

/// Rows left out because their time comes more than once.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Repeats {
    /// Copies of a row that is kept.
    pub identical: usize,
    /// Rows that contradict each other; none of them is kept, as nothing tells which is right.
    pub conflicting: usize,
}

/// Leaves each time once, in rows sorted by time.
pub(crate) fn merge(columns: &mut [Vec<f64>]) -> Repeats {
    let mut repeats = Repeats::default();
    let (rows, mut kept, mut from) = (columns[0].len(), 0, 0);
    while from < rows {
        let time = columns[0][from];
        let to = from + columns[0][from..].iter().take_while(|t| **t == time).count();
        let same = columns.iter().all(|column| column[from..to].iter().all(|value| *value == column[from]));
        if same {
            columns.iter_mut().for_each(|column| column[kept] = column[from]);
            kept += 1;
            repeats.identical += to - from - 1;
        } else {
            repeats.conflicting += to - from;
        }
        from = to;
    }
    columns.iter_mut().for_each(|column| column.truncate(kept));
    repeats
}

/// Adds whole turns so that every angle lies within half a turn of the one before it.
pub(crate) fn unwrap(angles: &mut [f64]) {
    for i in 1..angles.len() {
        let turns = ((angles[i - 1] - angles[i]) / TAU).round();
        // Angles near the end of floating point have no turns left to count.
        if turns.is_finite() {
            angles[i] += turns * TAU;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn rows_are_sorted_together() {
        let mut columns = [vec![3.0, 1.0, 2.0, 1.0], vec![30.0, 10.0, 20.0, 11.0]];
        assert_eq!(sort(&mut columns), 2);
        assert_eq!(columns, [vec![1.0, 1.0, 2.0, 3.0], vec![10.0, 11.0, 20.0, 30.0]]);
        assert_eq!(sort(&mut columns), 0);
    }

    #[test]
    fn a_time_comes_once_or_not_at_all() {
        let mut columns = [vec![0.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0], vec![0.0, 5.0, 5.0, 6.0, 6.0, 7.0, 8.0]];
        assert_eq!(merge(&mut columns), Repeats { identical: 1, conflicting: 3 });
        assert_eq!(columns, [vec![0.0, 1.0, 3.0], vec![0.0, 5.0, 8.0]]);
    }

    #[test]
    fn both_zeros_are_one_time() {
        let mut columns = [vec![0.0, -0.0], vec![1.0, 1.0]];
        assert_eq!((sort(&mut columns), merge(&mut columns).identical), (0, 1));
    }

    #[test]
    fn angles_follow_the_last_row_they_have() {
        let mut angles = [3.1, -3.1, -2.9, 3.0 - 5.0 * TAU];
        unwrap(&mut angles);
        let expect = [3.1, TAU - 3.1, TAU - 2.9, 3.0];
        assert!(angles.iter().zip(expect).all(|(a, b)| (a - b).abs() < 1e-12), "{angles:?}");
        let mut huge = [1e308, -1e308, f64::MAX, 0.0];
        unwrap(&mut huge);
        assert!(huge.iter().all(|angle| angle.is_finite()));
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]
        #[test]
        fn unwrapping_undoes_wrapping(steps in proptest::collection::vec(-3.1..3.1f64, 1..50)) {
            let mut angle = 0.0;
            let smooth: Vec<f64> = steps.iter().map(|step| { angle += step; angle }).collect();
            let mut angles: Vec<f64> = smooth.iter().map(|a| a.sin().atan2(a.cos())).collect();
            let turns = smooth[0] - angles[0];
            unwrap(&mut angles);
            for (a, b) in angles.iter().zip(&smooth) {
                prop_assert!((a + turns - b).abs() < 1e-9);
            }
        }
    }
}
