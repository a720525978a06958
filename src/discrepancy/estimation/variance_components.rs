//! Noise and unexplained motion, estimated together with the parameters by restricted maximum likelihood.

use super::elimination::{Eliminated, Variances, eliminate};
use crate::discrepancy::shooting::linearised_window::Linear;

/// Smallest jump that is told from none, as a share of the noise: below it the likelihood is flat.
const LEAST_JUMP: f64 = 1e-3;

/// Twice the negative log likelihood, poses integrated out, parameters at their best.
pub fn deviance(segments: &[Vec<Linear>], v: &Variances, e: &Eliminated) -> f64 {
    let (information, gradient) = e.normal();
    let gain = information.clone().cholesky().map_or(0.0, |c| gradient.dot(&c.solve(&gradient)));
    e.cost() - gain + e.log_determinant + noise_determinant(segments, v)
}

/// Σ n·ln σ² over the measured values.
pub fn noise_determinant(segments: &[Vec<Linear>], v: &Variances) -> f64 {
    let count = |kind: usize| segments.iter().flatten().map(|w| w.count[kind]).sum::<usize>() as f64;
    (0..3).map(|kind| count(kind) * v.noise[kind].ln()).sum()
}

/// The deviance with the parameters integrated out too, which the variances are chosen by.
fn restricted(segments: &[Vec<Linear>], v: &Variances, parameters: usize) -> f64 {
    let Some(e) = eliminate(segments, v, parameters) else { return f64::INFINITY };
    let (mut information, _) = e.normal();
    // A direction without information is left out of the determinant's changes by a weak prior.
    (0..parameters).for_each(|i| information[(i, i)] *= 1.0 + 1e-10);
    let determinant = information.cholesky().map_or(0.0, |c| 2.0 * c.l().diagonal().map(f64::ln).sum());
    let d = deviance(segments, v, &e) + determinant;
    if d.is_finite() { d } else { f64::INFINITY }
}

/// The variances without a jump, as far as that is told from none.
pub fn without_jump(mut v: Variances, c: usize) -> Variances {
    v.jump[c] = least_jump(&v, c);
    v
}

fn least_jump(v: &Variances, c: usize) -> f64 {
    v.noise[[0, 0, 1, 2][c]] * LEAST_JUMP * LEAST_JUMP
}

/// Which variances are free.
#[derive(Clone, Copy, Debug)]
pub struct Free {
    /// Noise of position, heading, trailer heading.
    pub noise: [bool; 3],
    /// Jumps along, across, yaw, trailer.
    pub jump: [bool; 4],
}

/// Least gain in deviance that makes another round worthwhile.
const ENOUGH: f64 = 0.05;

/// Improves the variances one after another in their logarithms, round after round until nothing is gained.
///
/// Seven numbers at most, nearly independent of each other, a smooth function with a flat tail towards zero jumps:
/// along each a bracket and a parabola through it are enough.
pub fn improve(
    segments: &[Vec<Linear>],
    start: Variances,
    free: Free,
    parameters: usize,
    first_step: f64,
) -> Variances {
    let f = |v: &Variances| restricted(segments, v, parameters);
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
fn along(f: &impl Fn(&Variances) -> f64, here: (Variances, f64), k: usize, step: f64) -> (Variances, f64) {
    let at = |v: Variances, s: f64| {
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

fn is_free(free: &Free, k: usize) -> bool {
    if k < 3 { free.noise[k] } else { free.jump[k - 3] }
}

/// One variance multiplied by e^step, jumps bounded from below.
fn moved_by(mut v: Variances, k: usize, step: f64) -> Variances {
    match k {
        0..=2 => v.noise[k] *= step.exp(),
        _ => {
            v.jump[k - 3] = (v.jump[k - 3] * step.exp()).max(least_jump(&v, k - 3));
        }
    }
    v
}
