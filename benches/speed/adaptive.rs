//! DOP853 written by hand for systems of a size known to the compiler.

use super::tableau::{E3, E5, ORDER_8};

const TOLERANCE: [f64; 2] = [1e-10, 1e-12];

/// The state at the end, with the tolerances of the library's default.
#[inline(always)]
pub fn dop853<const N: usize>(f: impl Fn(f64, &[f64; N]) -> [f64; N], from: f64, y0: [f64; N], to: f64) -> [f64; N] {
    let [rtol, atol] = TOLERANCE;
    let (mut t, mut y, mut k0, mut refused) = (from, y0, f(from, &y0), false);
    let mut h = first_step(&f, (from, to), &y0, &k0);
    loop {
        let last = t + 1.01 * h > to;
        if last {
            h = to - t;
        }
        let mut k = [[0.0; N]; 12];
        k[0] = k0;
        for s in 1..12 {
            let at = sum(&y, h, ORDER_8.a[s - 1], &k);
            k[s] = f(t + ORDER_8.c[s] * h, &at);
        }
        let new = sum(&y, h, ORDER_8.b, &k);
        let (mut fifth, mut third) = (0.0, 0.0);
        for i in 0..N {
            let scale = atol + rtol * y[i].abs().max(new[i].abs());
            let (mut e5, mut b) = (0.0, 0.0);
            for s in [0, 5, 6, 7, 8, 9, 10, 11] {
                e5 += E5[s] * k[s][i];
                b += ORDER_8.b[s] * k[s][i];
            }
            let e3 = b - E3[0] * k[0][i] - E3[1] * k[8][i] - E3[2] * k[11][i];
            fifth += (e5 / scale) * (e5 / scale);
            third += (e3 / scale) * (e3 / scale);
        }
        let both = fifth + 0.01 * third;
        let error = h * fifth / (if both > 0.0 { both } else { 1.0 } * (N + 1) as f64).sqrt();
        let change = error.powf(0.125) / 0.9;
        if error <= 1.0 {
            if last {
                return new;
            }
            (t, y) = (t + h, new);
            k0 = f(t, &y);
            let next = h / change.clamp(1.0 / 6.0, 1.0 / 0.333);
            h = if refused { next.min(h) } else { next };
            refused = false;
        } else {
            h /= change.min(1.0 / 0.333);
            refused = true;
        }
    }
}

#[inline(always)]
fn sum<const N: usize>(y: &[f64; N], h: f64, weights: &[f64], k: &[[f64; N]; 12]) -> [f64; N] {
    let mut out = *y;
    for (w, k) in weights.iter().zip(k).filter(|(w, _)| **w != 0.0) {
        for i in 0..N {
            out[i] += h * w * k[i];
        }
    }
    out
}

fn first_step<const N: usize>(
    f: &impl Fn(f64, &[f64; N]) -> [f64; N],
    (from, to): (f64, f64),
    y: &[f64; N],
    k: &[f64; N],
) -> f64 {
    let norm =
        |v: &[f64; N]| -> f64 { (0..N).map(|i| (v[i] / (TOLERANCE[1] + TOLERANCE[0] * y[i].abs())).powi(2)).sum() };
    let (d0, d1) = (norm(y), norm(k));
    let h0 = if d0 < 1e-10 || d1 < 1e-10 { 1e-6 } else { 0.01 * (d0 / d1).sqrt() };
    let ahead = f(from + h0, &std::array::from_fn(|i| y[i] + h0 * k[i]));
    let d2 = norm(&std::array::from_fn(|i| ahead[i] - k[i])).sqrt() / h0;
    let h1 = (0.01 / d1.sqrt().max(d2)).powf(0.125);
    (100.0 * h0).min(h1).min(to - from)
}
