//! A signal with times of its own at other times.

/// Times further apart than this are not bridged, s.
const GAP: f64 = 0.5;

/// A column at other times by the cubic through four rows around each, or the line where rows are far apart; NaN beyond
/// the ends and in gaps.
pub(crate) fn at_times(time: &[f64], column: &[f64], times: &[f64]) -> Vec<f64> {
    let value = |t: &f64| {
        let after = time.partition_point(|k| k <= t);
        if after > 0 && time[after - 1] == *t {
            return column[after - 1];
        }
        if after == 0 || after == time.len() || time[after] - time[after - 1] > GAP {
            return f64::NAN;
        }
        let first = after.saturating_sub(2).min(time.len().saturating_sub(4));
        let wide = time.len() >= 4 && time[first + 3] - time[first] <= 3.0 * GAP;
        let rows = if wide { first..first + 4 } else { after - 1..after + 1 };
        let distinct = time[rows.clone()].windows(2).all(|w| w[0] < w[1]);
        if distinct { lagrange(&time[rows.clone()], &column[rows], *t) } else { column[after - 1] }
    };
    times.iter().map(value).collect()
}

/// The polynomial through some points.
fn lagrange(time: &[f64], column: &[f64], t: f64) -> f64 {
    let weight = |i: usize| {
        let others = (0..time.len()).filter(|k| *k != i);
        others.map(|k| (t - time[k]) / (time[i] - time[k])).product::<f64>()
    };
    (0..time.len()).map(|i| weight(i) * column[i]).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_kept_between_rows_and_nothing_is_invented_beyond() {
        let time: Vec<f64> = (0..10).map(|i| 0.1 * f64::from(i)).collect();
        let column: Vec<f64> = time.iter().map(|t| t.powi(3) - t).collect();
        let found = at_times(&time, &column, &[-0.01, 0.0, 0.25, 0.333, 0.9, 0.91]);
        assert!(found[0].is_nan() && found[5].is_nan());
        for (t, v) in [(0.0, found[1]), (0.25, found[2]), (0.333, found[3]), (0.9, found[4])] {
            assert!((v - (f64::powi(t, 3) - t)).abs() < 1e-12, "{t}");
        }
        assert!(at_times(&[0.0, 1.0], &[0.0, 1.0], &[0.5])[0].is_nan(), "a gap");
        assert!(at_times(&[], &[], &[0.5])[0].is_nan());
    }

    #[test]
    fn of_rows_at_one_time_one_is_taken() {
        let (time, column) = ([0.0, 0.1, 0.1, 0.2, 0.3], [1.0, 2.0, 3.0, 4.0, 5.0]);
        assert_eq!(at_times(&time, &column, &[0.1, 0.15]), [3.0, 3.0]);
    }

    /// Times half a second apart are bridged, further ones are not; where four rows are too far apart for a cubic it is a line.
    #[test]
    fn rows_far_apart_are_joined_by_a_line() {
        assert_eq!(at_times(&[0.0, 0.5], &[1.0, 3.0], &[0.25]), [2.0]);
        assert!(at_times(&[0.0, 0.5000001], &[1.0, 3.0], &[0.25])[0].is_nan());
        // Three rows, and four of which one is far away: the cube itself is not kept.
        let cube = |time: &[f64]| time.iter().map(|t| t.powi(3)).collect::<Vec<f64>>();
        for time in [&[0.0, 0.5, 1.0][..], &[0.0, 0.5, 1.0, 1.625], &[0.0, 0.5, 1.0, 9.0]] {
            assert_eq!(at_times(time, &cube(time), &[0.75]), [0.5625], "{time:?}");
        }
        let near = [0.0, 0.5, 1.0, 1.5];
        assert!((at_times(&near, &cube(&near), &[0.75])[0] - 0.421875).abs() < 1e-15);
    }
}
