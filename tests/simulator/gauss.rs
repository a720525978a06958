//! The three-stage Gauss collocation scheme: implicit, symmetric in time, of order six.

use std::array::from_fn;

/// Enough for the contraction factors met here (step/time constant below 1/5).
const MAX_ITERATIONS: usize = 60;

/// Nodes 1/2 − √15/10, 1/2, 1/2 + √15/10 of the interval.
fn nodes() -> [f64; 3] {
    let half = 15f64.sqrt() / 10.0;
    [0.5 - half, 0.5, 0.5 + half]
}

/// `weights[i][j]`: how much stage j moves stage i.
fn weights() -> [[f64; 3]; 3] {
    let s = 15f64.sqrt();
    [
        [5.0 / 36.0, 2.0 / 9.0 - s / 15.0, 5.0 / 36.0 - s / 30.0],
        [5.0 / 36.0 + s / 24.0, 2.0 / 9.0, 5.0 / 36.0 - s / 24.0],
        [5.0 / 36.0 + s / 30.0, 2.0 / 9.0 + s / 15.0, 5.0 / 36.0],
    ]
}

/// One step of `y' = rates(t, y)` from `t` to `t + h`; `h` may be negative.
fn step(rates: &impl Fn(f64, &[f64]) -> Vec<f64>, t: f64, y: &[f64], h: f64) -> Vec<f64> {
    let (nodes, weights) = (nodes(), weights());
    let start = rates(t, y);
    let mut slopes: [Vec<f64>; 3] = from_fn(|_| start.clone());
    for _ in 0..MAX_ITERATIONS {
        let next: [Vec<f64>; 3] = from_fn(|i| rates(t + nodes[i] * h, &moved(y, &slopes, &weights[i], h)));
        let change = largest_change(&slopes, &next);
        slopes = next;
        if change * h.abs() < 1e-16 {
            break;
        }
    }
    moved(y, &slopes, &[5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0], h)
}

/// `y + h·Σ weightⱼ·slopeⱼ`
fn moved(y: &[f64], slopes: &[Vec<f64>; 3], weight: &[f64; 3], h: f64) -> Vec<f64> {
    let slope = |i: usize| (0..3).map(|j| weight[j] * slopes[j][i]).sum::<f64>();
    y.iter().enumerate().map(|(i, yi)| yi + h * slope(i)).collect()
}

fn largest_change(old: &[Vec<f64>; 3], new: &[Vec<f64>; 3]) -> f64 {
    let pairs = old.iter().flatten().zip(new.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Integrates `y' = rates(t, y)` from `from` to `to` in equal steps no longer than `longest` (s).
pub fn advance(rates: &impl Fn(f64, &[f64]) -> Vec<f64>, y: Vec<f64>, from: f64, to: f64, longest: f64) -> Vec<f64> {
    let steps = ((to - from).abs() / longest).ceil();
    let h = (to - from) / steps.max(1.0);
    (0..steps as usize).fold(y, |y, i| step(rates, from + i as f64 * h, &y, h))
}
