//! Where a model disagrees with the measurements, and in which regime of driving most.

use super::constraint_residuals::{ConstraintResiduals, Window};
use crate::discrepancy::report::Disagreement;
use crate::model::state::JUMPS;

/// Which windows belong to a regime.
type Regime = fn(&Window, &Window, &Typical) -> bool;

/// Typical motion of a run.
struct Typical {
    speed: f64,
    yaw: f64,
    load: f64,
    curve: f64,
}

impl Window {
    /// The lateral acceleration v·ω, m/s², which the tyres carry.
    fn load(&self) -> f64 {
        self.speed * self.yaw
    }

    /// The curvature of the path, 1/m: what a steered wheel asks for. None where the vehicle turns on the spot.
    fn curve(&self, typical_speed: f64) -> f64 {
        if self.speed > 0.2 * typical_speed { self.yaw / self.speed } else { 0.0 }
    }
}

const REGIMES: [(&str, Regime); 11] = [
    ("left turns", |w, _, t| w.yaw > 0.5 * t.yaw),
    ("right turns", |w, _, t| w.yaw < -0.5 * t.yaw),
    ("turns to both sides", |w, _, t| w.yaw.abs() > 0.5 * t.yaw),
    ("straight driving", |w, _, t| w.yaw.abs() < 0.3 * t.yaw),
    ("fast driving", |w, _, t| w.speed > 1.15 * t.speed),
    ("slow driving", |w, _, t| w.speed < 0.85 * t.speed),
    ("speeding up", |w, last, t| w.speed - last.speed > 0.08 * t.speed),
    ("slowing down", |w, last, t| w.speed - last.speed < -0.08 * t.speed),
    ("high lateral load", |w, _, t| w.load().abs() > 1.3 * t.load),
    ("tight curves", |w, _, t| w.curve(t.speed).abs() > 1.3 * t.curve),
    ("entering and leaving curves", |w, last, t| (w.curve(t.speed) - last.curve(t.speed)).abs() > 0.5 * t.curve),
];

/// The regime in which a constraint is violated most, when one stands out.
fn regime(v: &ConstraintResiduals, c: usize) -> &'static str {
    let speed = v.rms_of(|w| w.speed);
    let typical =
        Typical { speed, yaw: v.rms_of(|w| w.yaw), load: v.rms_of(Window::load), curve: v.rms_of(|w| w.curve(speed)) };
    let mean = v.rms_of(|w| w.rates[c]).powi(2);
    let mut best = ("the whole run", 1.4);
    for (name, holds) in REGIMES {
        let inside: Vec<f64> = v
            .windows
            .iter()
            .zip(std::iter::once(&v.windows[0]).chain(&v.windows))
            .filter(|(w, last)| holds(w, last, &typical))
            .map(|(w, _)| w.rates[c].powi(2))
            .collect();
        let ratio = inside.iter().sum::<f64>() / inside.len().max(1) as f64 / mean;
        if inside.len() >= 5 && ratio > best.1 {
            best = (name, ratio);
        }
    }
    best.0
}

/// Where the model disagrees with the measurements by more than their noise: run by run, constraint by constraint,
/// from the first to the last window that stands out, with its share of the whole disagreement.
pub fn disagreements(violations: &[ConstraintResiduals]) -> Vec<Disagreement> {
    let total: f64 = violations.iter().map(|v| (0..v.constraints()).map(|c| v.chi_squared(c)).sum::<f64>()).sum();
    let mut found = Vec::new();
    for v in violations {
        for (c, jump) in JUMPS.iter().enumerate().take(v.constraints()) {
            let energy = v.chi_squared(c);
            let out: Vec<&Window> = v.windows.iter().filter(|w| w.rates[c].abs() > 3.0 * v.noise[c]).collect();
            // Noise alone gives one window in 370; a disagreement fills more.
            if out.len() < 3 || energy < 2.0 * v.windows.len() as f64 {
                continue;
            }
            found.push(Disagreement {
                run: v.run.clone(),
                place: jump.place.into(),
                from: out[0].span[0],
                to: out[out.len() - 1].span[1],
                regime: regime(v, c).into(),
                share_of_gap: energy / total,
            });
        }
    }
    found.sort_by(|a, b| b.share_of_gap.total_cmp(&a.share_of_gap));
    found
}
