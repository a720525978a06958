//! Noise and unexplained motion, estimated together with the parameters by restricted maximum likelihood.

use super::chain::{Eliminated, Variances, eliminate};
use super::windows::Linear;

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

/// Which variances are free.
#[derive(Clone, Copy, Debug)]
pub struct Free {
    /// Noise of position, heading, trailer heading.
    pub noise: [bool; 3],
    /// Jumps along, across, yaw, trailer.
    pub jump: [bool; 4],
}

/// Improves the variances by a pattern search in their logarithms.
///
/// Seven numbers at most, a smooth function with a flat tail towards zero jumps: robust beats fast here.
pub fn improve(
    segments: &[Vec<Linear>],
    start: Variances,
    free: Free,
    parameters: usize,
    first_step: f64,
) -> Variances {
    let mut best = start;
    let mut lowest = restricted(segments, &best, parameters);
    let mut steps = [first_step; 7];
    for _ in 0..60 {
        for (k, step) in steps.iter_mut().enumerate() {
            if !is_free(&free, k) || step.abs() < 0.02 {
                continue;
            }
            let mut moved = false;
            for direction in [1.0, -1.0] {
                let candidate = moved_by(best, k, *step * direction);
                if candidate == best {
                    continue;
                }
                let d = restricted(segments, &candidate, parameters);
                if d < lowest - 1e-6 {
                    (best, lowest, moved) = (candidate, d, true);
                    *step *= 1.5 * direction;
                    break;
                }
            }
            if !moved {
                *step *= 0.4;
            }
        }
        if steps.iter().enumerate().all(|(k, s)| !is_free(&free, k) || s.abs() < 0.02) {
            break;
        }
    }
    best
}

fn is_free(free: &Free, k: usize) -> bool {
    if k < 3 { free.noise[k] } else { free.jump[k - 3] }
}

/// One variance multiplied by e^step, jumps bounded from below.
fn moved_by(mut v: Variances, k: usize, step: f64) -> Variances {
    match k {
        0..=2 => v.noise[k] *= step.exp(),
        _ => {
            let noise = v.noise[[0, 0, 1, 2][k - 3]];
            v.jump[k - 3] = (v.jump[k - 3] * step.exp()).max(noise * LEAST_JUMP * LEAST_JUMP);
        }
    }
    v
}
