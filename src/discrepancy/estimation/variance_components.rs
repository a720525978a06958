//! Noise and unexplained motion, estimated together with the parameters by restricted maximum likelihood.

use super::elimination::{ReducedForm, eliminate};
use crate::discrepancy::estimation::noise_model::Estimated;
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;

/// Smallest jump that is told from none, as a share of the noise: below it the likelihood is flat.
const LEAST_JUMP: f64 = 1e-3;

/// Twice the negative log likelihood, poses integrated out, parameters at their best.
pub fn deviance(segments: &[Vec<LinearisedWindow>], v: &NoiseModel, e: &ReducedForm) -> f64 {
    let (information, gradient) = e.normal();
    let gain = information.clone().cholesky().map_or(0.0, |c| gradient.dot(&c.solve(&gradient)));
    e.cost() - gain + e.log_determinant + noise_determinant(segments, v)
}

/// Σ n·ln σ² over the measured values.
pub fn noise_determinant(segments: &[Vec<LinearisedWindow>], v: &NoiseModel) -> f64 {
    let count = |kind: usize| segments.iter().flatten().map(|w| w.count[kind]).sum::<usize>() as f64;
    (0..3).map(|kind| count(kind) * v.measurement[kind].ln()).sum()
}

/// The deviance with the parameters integrated out too, which the variances are chosen by.
fn restricted(segments: &[Vec<LinearisedWindow>], v: &NoiseModel, parameters: usize) -> f64 {
    let Some(e) = eliminate(segments, v, parameters) else { return f64::INFINITY };
    let (mut information, _) = e.normal();
    // A direction without information is left out of the determinant's changes by a weak prior.
    (0..parameters).for_each(|i| information[(i, i)] *= 1.0 + 1e-10);
    let determinant = information.cholesky().map_or(0.0, |c| 2.0 * c.l().diagonal().map(f64::ln).sum());
    let d = deviance(segments, v, &e) + determinant;
    if d.is_finite() { d } else { f64::INFINITY }
}

/// The variances without a jump beyond what is known to be there, as far as that is told from none.
pub fn without_jump(mut v: NoiseModel, c: usize, known: f64) -> NoiseModel {
    v.process[c] = least_jump(&v, c).max(known).min(v.process[c]);
    v
}

fn least_jump(v: &NoiseModel, c: usize) -> f64 {
    v.measurement[[0, 0, 1, 2][c]] * LEAST_JUMP * LEAST_JUMP
}

/// Least gain in deviance that makes another round worthwhile.
const ENOUGH: f64 = 0.05;

/// Improves the variances one after another in their logarithms, round after round until nothing is gained.
///
/// Seven numbers at most, nearly independent of each other, a smooth function with a flat tail towards zero jumps:
/// along each a bracket and a parabola through it are enough.
pub fn improve(
    segments: &[Vec<LinearisedWindow>],
    start: NoiseModel,
    free: Estimated,
    parameters: usize,
    first_step: f64,
) -> NoiseModel {
    let f = |v: &NoiseModel| restricted(segments, v, parameters);
    let mut best = (start, f(&start));
    let mut step = first_step;
    for _ in 0..12 {
        let before = best.1;
        for k in (0..7).filter(|k| is_free(&free, *k)) {
            best = along(&f, best, k, step);
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
    let at = |v: NoiseModel, s: f64| {
        let moved = moved_by(v, k, s);
        (moved, if moved == v { f64::INFINITY } else { f(&moved) })
    };
    let (up, down) = (at(here.0, step), at(here.0, -step));
    let mut best = here;
    if up.1 >= here.1 && down.1 >= here.1 {
        let bend = up.1 - 2.0 * here.1 + down.1;
        let shift = 0.5 * step * (down.1 - up.1) / bend;
        if shift.is_finite() && shift.abs() > 0.01 {
            let vertex = at(here.0, shift);
            if vertex.1 < best.1 {
                best = vertex;
            }
        }
        return best;
    }
    let mut stride = if up.1 < down.1 { step } else { -step };
    best = if up.1 < down.1 { up } else { down };
    loop {
        stride *= 1.6;
        let next = at(best.0, stride);
        if next.1 >= best.1 {
            return best;
        }
        best = next;
    }
}

fn is_free(free: &Estimated, k: usize) -> bool {
    if k < 3 { free.measurement[k] } else { free.process[k - 3] }
}

/// One variance multiplied by e^step, jumps bounded from below.
fn moved_by(mut v: NoiseModel, k: usize, step: f64) -> NoiseModel {
    match k {
        0..=2 => v.measurement[k] *= step.exp(),
        _ => {
            v.process[k - 3] = (v.process[k - 3] * step.exp()).max(least_jump(&v, k - 3));
        }
    }
    v
}
