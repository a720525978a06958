//! Round numbers for axes: steps of 1, 2 and 5 times a power of ten.

use crate::number_format::{decade, ten_to};

/// The smallest step of 1, 2 or 5 times a power of ten that is no smaller than a length.
///
/// ```
/// use creepage::picture::ticks::nice_step;
/// assert_eq!([nice_step(0.13), nice_step(3.0), nice_step(7.0)], [0.2, 5.0, 10.0]);
/// ```
pub fn nice_step(least: f64) -> f64 {
    let exponent = decade(least) - 1;
    let candidates = (0..3).flat_map(|k| [1.0, 2.0, 5.0].map(|m| scaled(m, exponent + k)));
    candidates.into_iter().find(|step| *step >= least * (1.0 - 1e-9)).unwrap_or(1.0)
}

/// A digit times a power of ten, the nearest floating-point number.
fn scaled(digit: f64, exponent: i32) -> f64 {
    format!("{digit}e{exponent}").parse().unwrap_or(1.0)
}

/// Multiples of a nice step within a range, at most about `count` of them, but two: a single one shows no scale.
pub fn linear(from: f64, to: f64, count: usize) -> (Vec<f64>, f64) {
    let at = |count: usize| multiples(from, to, nice_step((to - from) / count.max(1) as f64));
    (count..=count + 3).map(at).find(|(values, _)| values.len() > 1).unwrap_or_else(|| at(count))
}

fn multiples(from: f64, to: f64, step: f64) -> (Vec<f64>, f64) {
    let first = (from / step - 1e-9).ceil();
    let last = (to / step + 1e-9).floor();
    let steps = if last >= first { (last - first) as usize } else { 0 };
    ((0..=steps.min(200)).map(|i| (first + i as f64) * step).collect(), step)
}

/// Ticks of a count that leaves powers of ten alone: fewer than three a decade.
pub fn powers_alone(from: f64, to: f64) -> usize {
    ((3.0 * (to / from).log10()).ceil() as usize).saturating_sub(1).max(1)
}

/// Powers of ten within a positive range, with 2 and 5 between them where there is room.
pub fn logarithmic(from: f64, to: f64, count: usize) -> Vec<f64> {
    let exponents = decade(from) - 1..=decade(to) + 1;
    let stride = (exponents.clone().count() / count.max(1)).max(1);
    let mantissas: &[f64] = if (to / from).log10() * 3.0 <= count as f64 { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let within = |v: &f64| *v >= from * (1.0 - 1e-9) && *v <= to * (1.0 + 1e-9);
    exponents
        .filter(|e| e.rem_euclid(stride as i32) == 0)
        .flat_map(|e| mantissas.iter().map(move |m| scaled(*m, e)))
        .filter(within)
        .collect()
}

/// Zero and signed powers of ten from the end of the linear part on.
pub fn symmetric(from: f64, to: f64, linear: f64, count: usize) -> Vec<f64> {
    let exponents = decade(linear)..=decade(from.abs().max(to.abs()).max(linear));
    let stride = (2 * exponents.clone().count() / count.max(1)).max(1);
    let positive: Vec<f64> = exponents.step_by(stride).map(ten_to).collect();
    let negative = positive.iter().rev().map(|v| -v);
    negative.chain([0.0]).chain(positive.iter().copied()).filter(|v| (from..=to).contains(v)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_ten_are_as_many_as_there_is_room_for() {
        assert_eq!(symmetric(-1e3, 1e3, 1.0, 100), [-1e3, -100.0, -10.0, -1.0, 0.0, 1.0, 10.0, 100.0, 1e3]);
        assert_eq!(symmetric(-20.0, 1e6, 1e-3, 5), [-10.0, -1e-3, 0.0, 1e-3, 10.0, 1e5]);
        assert_eq!(symmetric(0.0, 1e6, 1e-3, 2), [0.0, 1e-3]);
        assert_eq!(logarithmic(0.5, 20.0, 10), [0.5, 1.0, 2.0, 5.0, 10.0, 20.0]);
        assert_eq!(logarithmic(1.0, 1e6, 4), [1.0, 100.0, 1e4, 1e6]);
        assert_eq!(logarithmic(1.0, 1e3, 9), [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1e3]);
        assert_eq!(logarithmic(1.0, 1e6, 3), [1.0, 1e3, 1e6]);
        assert_eq!(logarithmic(0.1, 0.5, 10), [0.1, 0.2, 0.5]);
        assert_eq!(logarithmic(1.0, 1e3, 8), [1.0, 10.0, 100.0, 1e3]);
    }
}
