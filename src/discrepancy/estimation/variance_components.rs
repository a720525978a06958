//! Noise and unexplained motion, estimated together with the parameters by restricted maximum likelihood.

use super::elimination::{ReducedForm, eliminate_forward};
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;

/// Twice the negative log likelihood, poses integrated out, parameters at their best.
pub fn deviance(segments: &[Vec<LinearisedWindow>], v: &NoiseModel, e: &ReducedForm) -> f64 {
    let (information, gradient) = e.normal();
    let gain = information.clone().cholesky().map_or(0.0, |c| gradient.dot(&c.solve(&gradient)));
    e.cost() - gain + e.log_determinant + noise_determinant(segments, v)
}

/// Σ n·ln σ² over the measured values.
pub fn noise_determinant(segments: &[Vec<LinearisedWindow>], v: &NoiseModel) -> f64 {
    let count = |kind: usize| segments.iter().flatten().map(|w| w.count[kind]).sum::<usize>() as f64;
    v.measurement().iter().enumerate().map(|(kind, noise)| count(kind) * noise.variance.ln()).sum()
}

/// The deviance with the parameters integrated out too, which the variances are chosen by.
fn restricted(segments: &[Vec<LinearisedWindow>], v: &NoiseModel, parameters: usize) -> f64 {
    let Some(e) = eliminate_forward(segments, v, parameters) else { return f64::INFINITY };
    let (mut information, _) = e.normal();
    // A direction without information is left out of the determinant's changes by a weak prior.
    (0..parameters).for_each(|i| information[(i, i)] *= 1.0 + 1e-10);
    let determinant = information.cholesky().map_or(0.0, |c| 2.0 * c.l().diagonal().map(f64::ln).sum());
    let d = deviance(segments, v, &e) + determinant;
    if d.is_finite() { d } else { f64::INFINITY }
}

/// Least gain in deviance that makes another round worthwhile.
const ENOUGH: f64 = 0.05;

/// Improves the variances one after another in their logarithms, round after round until nothing is gained.
///
/// A few numbers, nearly independent of each other, a smooth function with a flat tail towards zero jumps: along
/// each a bracket and a parabola through it are enough.
pub fn improve(
    segments: &[Vec<LinearisedWindow>],
    start: NoiseModel,
    parameters: usize,
    first_step: f64,
) -> NoiseModel {
    let f = |v: &NoiseModel| restricted(segments, v, parameters);
    let value = f(&start);
    let mut best = (start, value);
    let mut step = first_step;
    for _ in 0..12 {
        let before = best.1;
        for k in 0..best.0.components().len() {
            if best.0.components()[k].is_estimated {
                best = along(&f, best, k, step);
            }
        }
        if before - best.1 < ENOUGH {
            break;
        }
        step = (0.5 * step).max(0.15);
    }
    best.0
}

/// The lowest point found along one logarithm.
fn along(f: &impl Fn(&NoiseModel) -> f64, here: (NoiseModel, f64), k: usize, step: f64) -> (NoiseModel, f64) {
    let at = |v: &NoiseModel, s: f64| {
        let moved = v.moved_by(k, s);
        let value = if moved == *v { f64::INFINITY } else { f(&moved) };
        (moved, value)
    };
    let (up, down) = (at(&here.0, step), at(&here.0, -step));
    if up.1 >= here.1 && down.1 >= here.1 {
        let bend = up.1 - 2.0 * here.1 + down.1;
        let shift = 0.5 * step * (down.1 - up.1) / bend;
        if shift.is_finite() && shift.abs() > 0.01 {
            let vertex = at(&here.0, shift);
            if vertex.1 < here.1 {
                return vertex;
            }
        }
        return here;
    }
    let mut stride = if up.1 < down.1 { step } else { -step };
    let mut best = if up.1 < down.1 { up } else { down };
    loop {
        stride *= 1.6;
        let next = at(&best.0, stride);
        if next.1 >= best.1 {
            return best;
        }
        best = next;
    }
}
