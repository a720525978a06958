//! The cubic spline through samples with the not-a-knot condition at its ends.

/// Second derivatives at the knots of the twice continuously differentiable cubic spline.
///
/// Fewer than four knots give the polynomial through them.
pub(crate) fn curvatures(t: &[f64], y: &[f64]) -> Vec<f64> {
    let n = t.len();
    match n {
        0..=2 => vec![0.0; n],
        3 => vec![2.0 * second_difference(t, y, 1); 3],
        _ => not_a_knot(t, y),
    }
}

/// The second divided difference around knot i.
fn second_difference(t: &[f64], y: &[f64], i: usize) -> f64 {
    let right = (y[i + 1] - y[i]) / (t[i + 1] - t[i]);
    let left = (y[i] - y[i - 1]) / (t[i] - t[i - 1]);
    (right - left) / (t[i + 1] - t[i - 1])
}

/// Solves the tridiagonal system for the inner knots; the ends follow from the not-a-knot condition
/// M₀ = M₁ − (h₀/h₁)(M₂ − M₁), and the same at the other end.
fn not_a_knot(t: &[f64], y: &[f64]) -> Vec<f64> {
    let n = t.len();
    let h: Vec<f64> = t.windows(2).map(|w| w[1] - w[0]).collect();
    let m = n - 2;
    let (mut below, mut diagonal, mut above, mut right) = (vec![0.0; m], vec![0.0; m], vec![0.0; m], vec![0.0; m]);
    for k in 0..m {
        let i = k + 1;
        below[k] = h[i - 1];
        diagonal[k] = 2.0 * (h[i - 1] + h[i]);
        above[k] = h[i];
        right[k] = 6.0 * (h[i - 1] + h[i]) * second_difference(t, y, i);
    }
    let (first, last) = (h[0] / h[1], h[n - 2] / h[n - 3]);
    diagonal[0] += below[0] * (1.0 + first);
    above[0] -= below[0] * first;
    diagonal[m - 1] += above[m - 1] * (1.0 + last);
    below[m - 1] -= above[m - 1] * last;
    let inner = tridiagonal(&below, &diagonal, &above, &right);
    let mut all = vec![0.0; n];
    all[1..=m].copy_from_slice(&inner);
    all[0] = inner[0] - first * (inner[1] - inner[0]);
    all[n - 1] = inner[m - 1] + last * (inner[m - 1] - inner[m - 2]);
    all
}

/// Elimination without pivoting: the spline's system is diagonally dominant, its end rows included for any
/// spacing up to a few times that of their neighbours.
fn tridiagonal(below: &[f64], diagonal: &[f64], above: &[f64], right: &[f64]) -> Vec<f64> {
    let n = diagonal.len();
    let (mut d, mut r) = (diagonal.to_vec(), right.to_vec());
    for i in 1..n {
        let factor = below[i] / d[i - 1];
        d[i] -= factor * above[i - 1];
        r[i] -= factor * r[i - 1];
    }
    for i in (0..n).rev() {
        let next = if i + 1 < n { above[i] * r[i + 1] } else { 0.0 };
        r[i] = (r[i] - next) / d[i];
    }
    r
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cubic is its own not-a-knot spline, on uneven knots too.
    #[test]
    fn a_cubic_is_reproduced() {
        let t: Vec<f64> = [0.0, 0.3, 0.4, 1.0, 1.7, 1.9].to_vec();
        for n in 4..=t.len() {
            let t = &t[..n];
            let y: Vec<f64> = t.iter().map(|t| 2.0 * t * t * t - t * t + 3.0).collect();
            for (m, t) in curvatures(t, &y).iter().zip(t) {
                assert!((m - (12.0 * t - 2.0)).abs() < 1e-10, "{m} at {t}");
            }
        }
    }

    #[test]
    fn three_knots_give_their_parabola() {
        assert_eq!(curvatures(&[0.0, 1.0, 3.0], &[0.0, 1.0, 9.0]), vec![2.0; 3]);
    }
}
