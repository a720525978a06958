//! Composite Gauss–Legendre quadrature, with panels halved until only rounding is left.

use crate::error::{Error, Result};
use std::sync::LazyLock;

/// Points of the Gauss–Legendre rule in each panel.
const GAUSS_POINTS: usize = 16;
/// The most panels along a direction; an integrand that needs more is not smooth.
const MAX_PANELS: usize = 1024;
/// The change, as a share of the sizes that are added, under which a further halving brings nothing but rounding.
const RELATIVE_CHANGE: f64 = 1e-14;

/// Nodes within −1 and 1, and weights.
static RULE: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| (1..=GAUSS_POINTS).map(node).collect());

/// The k-th zero of Legendre's polynomial by Newton's method, with its weight 2/((1 − x²)·P′²).
fn node(k: usize) -> (f64, f64) {
    let n = GAUSS_POINTS as f64;
    let mut x = (std::f64::consts::PI * (k as f64 - 0.25) / (n + 0.5)).cos();
    let mut slope = 1.0;
    for _ in 0..100 {
        let (mut before, mut p) = (1.0, x);
        for j in 2..=GAUSS_POINTS {
            let j = j as f64;
            (before, p) = (p, ((2.0 * j - 1.0) * x * p - (j - 1.0) * before) / j);
        }
        slope = n * (x * p - before) / (x * x - 1.0);
        let step = p / slope;
        x -= step;
        if step.abs() < 1e-16 {
            break;
        }
    }
    (x, 2.0 / ((1.0 - x * x) * slope * slope))
}

/// Points and weights of so many panels between two limits.
fn panels([from, to]: [f64; 2], count: usize) -> impl Iterator<Item = (f64, f64)> {
    let half = (to - from) / (2.0 * count as f64);
    let middle = move |i: usize| from + half * (2 * i + 1) as f64;
    (0..count).flat_map(move |i| RULE.iter().map(move |(x, w)| (middle(i) + half * x, half * w)))
}

/// ∫ f dt, with panels halved until the sum no longer changes.
pub(super) fn integral(limits: [f64; 2], mut f: impl FnMut(f64) -> f64) -> Result<f64> {
    settled(|count| {
        let terms = panels(limits, count).map(|(t, w)| (w * f(t), 0.0));
        terms.fold((0.0, 0.0), |(sum, size), (v, _)| (sum + v, size + v.abs()))
    })
}

/// ∬ f ds dt over a rectangle.
pub(super) fn double_integral(s: [f64; 2], t: [f64; 2], mut f: impl FnMut(f64, f64) -> f64) -> Result<f64> {
    settled(|count| {
        let mut total = (0.0, 0.0);
        for (t, w) in panels(t, count) {
            for (s, v) in panels(s, count.div_ceil(4)) {
                let term = w * v * f(s, t);
                total = (total.0 + term, total.1 + term.abs());
            }
        }
        total
    })
}

/// The limit of sums over 1, 2, 4, … panels, each with the sum of sizes, which says what rounding is.
fn settled(mut sum: impl FnMut(usize) -> (f64, f64)) -> Result<f64> {
    let mut last = sum(2).0;
    let mut count = 4;
    while count <= MAX_PANELS {
        let (next, size) = sum(count);
        if !next.is_finite() {
            return Err(Error::run("a formula is undefined on the path"));
        }
        if (next - last).abs() <= RELATIVE_CHANGE * size.max(f64::MIN_POSITIVE) {
            return Ok(next);
        }
        (last, count) = (next, 2 * count);
    }
    Err(Error::run("the integral does not settle").help("choose a path whose formulas are smooth between its ends"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_integrals_are_exact_to_rounding_and_others_are_refused() {
        // Two units in the last place: what the compiler computes of e differs by one.
        assert!((integral([0.0, 1.0], f64::exp).unwrap() - (1f64.exp() - 1.0)).abs() <= 2.0 * f64::EPSILON);
        assert!((integral([1.0, -1.0], |t| t.powi(30)).unwrap() + 2.0 / 31.0).abs() < 1e-16);
        assert!((double_integral([0.0, 1.0], [0.0, 2.0], |s, t| s * s * t).unwrap() - 2.0 / 3.0).abs() < 1e-15);
        // What rounding is depends on the size of what is added, large or small.
        for size in [1e-6, 1.0, 1e6] {
            let found = integral([0.0, 1.0], |t| size / (t + 1e-3)).unwrap();
            let exact = size * 1001f64.ln();
            assert!((found - exact).abs() < 1e-13 * exact, "{size}: {found} {exact}");
        }
        assert!(integral([0.0, 1.0], |t| 1.0 / (t - 0.3)).is_err());
        assert!(integral([0.0, 1.0], |_| f64::NAN).is_err());
    }
}
