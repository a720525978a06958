//! Cumulative counts and positions as rates: the mean since the row before, or about a row.

use super::row_order;
use std::f64::consts::TAU;

/// Counters of so many bits roll over.
const BITS: [u32; 2] = [16, 32];

/// Counts without their roll-overs.
///
/// A counter of `bits` rolls over where it moves by more than half of its range from one row to the next; without `bits`
/// it has the fewest that hold all its values.
pub(crate) fn unrolled(counts: &[f64], bits: Option<u32>) -> Vec<f64> {
    let Some(range) = bits.or_else(|| fewest_bits(counts)).map(|b| 2f64.powi(b as i32)) else { return counts.to_vec() };
    let mut total = counts.first().copied().unwrap_or(0.0);
    let steps = counts.windows(2).map(|w| w[1] - w[0]);
    let mut found = vec![total; counts.len().min(1)];
    found.extend(steps.map(|step| {
        total += step - range * (step / range).round();
        total
    }));
    found
}

/// The fewest bits, with a sign or without, that hold whole counts.
fn fewest_bits(counts: &[f64]) -> Option<u32> {
    let (least, most) = counts.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), c| (a.min(*c), b.max(*c)));
    let whole = counts.iter().all(|c| c.fract() == 0.0);
    BITS.into_iter().find(|bits| {
        let range = 2f64.powi(*bits as i32);
        whole && (least >= 0.0 && most < range || least >= -range / 2.0 && most < range / 2.0)
    })
}

/// Positions without their jumps, where all lie within one turn; others are taken as they are.
pub(crate) fn unwound(positions: Vec<f64>, turn: f64) -> Vec<f64> {
    let (least, most) = positions.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), c| (a.min(*c), b.max(*c)));
    if most - least > turn * (1.0 + 1e-6) {
        return positions;
    }
    let mut angles: Vec<f64> = positions.iter().map(|p| p * TAU / turn).collect();
    row_order::unwrap(&mut angles);
    angles.iter().map(|a| a * turn / TAU).collect()
}

/// The mean rate since the row before; the first row has that of the second.
pub(crate) fn mean_rates(time: &[f64], position: &[f64]) -> Vec<f64> {
    let rates = time.windows(2).zip(position.windows(2)).map(|(t, p)| (p[1] - p[0]) / (t[1] - t[0]));
    // What floating point cannot hold is no motion.
    let rates = rates.map(|rate| if rate.is_finite() { rate } else { 0.0 });
    let mut found: Vec<f64> = rates.collect();
    found.insert(0, found.first().copied().unwrap_or(0.0));
    found.truncate(time.len());
    found
}

/// The mean rate from the row before to the row behind; at the ends to or from the one neighbour.
pub(crate) fn central_rates(time: &[f64], position: &[f64]) -> Vec<f64> {
    let of = |i: usize| {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(time.len() - 1));
        (position[after] - position[before]) / (time[after] - time[before])
    };
    (0..time.len()).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counters_of_either_size_roll_over_both_ways() {
        assert_eq!(unrolled(&[65_530.0, 65_535.0, 4.0, 65_534.0], None), [65_530.0, 65_535.0, 65_540.0, 65_534.0]);
        assert_eq!(unrolled(&[32_760.0, -32_760.0, 32_760.0], None), [32_760.0, 32_776.0, 32_760.0]);
        let top = 2f64.powi(31);
        assert_eq!(unrolled(&[top - 10.0, -top + 5.0], None), [top - 10.0, top + 5.0]);
        assert_eq!(unrolled(&[2.0 * top - 1.0, 3.0], None), [2.0 * top - 1.0, 2.0 * top + 3.0]);
        assert_eq!(unrolled(&[0.0, 70_000.0, 140_000.0], None), [0.0, 70_000.0, 140_000.0], "too large for 16 bits");
        assert_eq!(unrolled(&[70_000.0, 10.0], Some(16)), [70_000.0, 65_546.0]);
        assert_eq!(unrolled(&[1e12, 0.0], None), [1e12, 0.0], "no counter of 32 bits");
        assert!(unrolled(&[], None).is_empty());
    }

    #[test]
    fn wrapped_angles_go_on() {
        let found = unwound(vec![3.0, -3.0, -2.0], TAU);
        assert!((found[1] - (TAU - 3.0)).abs() < 1e-12 && (found[2] - (TAU - 2.0)).abs() < 1e-12);
        assert_eq!(unwound(vec![0.0, 4.0, 8.0], TAU), [0.0, 4.0, 8.0], "cumulative positions");
        let turns = unwound(vec![0.0, 0.75, 0.65], 1.0);
        assert!((turns[1] + 0.25).abs() < 1e-12 && (turns[2] + 0.35).abs() < 1e-12, "turns: {turns:?}");
    }

    #[test]
    fn rates_are_means_since_the_row_before() {
        assert_eq!(mean_rates(&[0.0, 0.5, 2.5], &[1.0, 2.0, 4.0]), [2.0, 2.0, 1.0]);
        assert_eq!(mean_rates(&[0.0, 1e-300], &[0.0, 1e300]), [0.0, 0.0]);
        assert_eq!((mean_rates(&[1.0], &[2.0]), mean_rates(&[], &[])), (vec![0.0], vec![]));
    }
}
