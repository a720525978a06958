//! Where a model disagrees with the measurements, and in which regime of driving most.

use super::constraint_residuals::{ConstraintResiduals, Window};
use crate::model::state::JUMPS;

/// Which windows belong to a regime.
type Holds = fn(&Window, &Window, &Typical) -> bool;

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

/// How a vehicle is driven in some windows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrivingRegime {
    /// All of the run: no regime stands out.
    Whole,
    /// Turning to the left.
    LeftTurns,
    /// Turning to the right.
    RightTurns,
    /// Turning to either side.
    Turns,
    /// Hardly turning.
    Straight,
    /// Faster than usual.
    Fast,
    /// Slower than usual.
    Slow,
    /// Speeding up.
    SpeedingUp,
    /// Slowing down.
    SlowingDown,
    /// A large lateral acceleration.
    HighLoad,
    /// A large curvature.
    TightCurves,
    /// A changing curvature.
    Transitions,
}

/// A stretch of a run in which a constraint is violated by more than the noise.
#[derive(Clone, Debug)]
pub struct Stretch {
    /// Name of the run.
    pub run: String,
    /// The constraint.
    pub place: &'static str,
    /// Start and end, s.
    pub span: [f64; 2],
    /// The regime in which it is violated most.
    pub regime: DrivingRegime,
    /// Share of the whole disagreement of all runs.
    pub share: f64,
}

const REGIMES: [(DrivingRegime, Holds); 11] = [
    (DrivingRegime::LeftTurns, |w, _, t| w.yaw > 0.5 * t.yaw),
    (DrivingRegime::RightTurns, |w, _, t| w.yaw < -0.5 * t.yaw),
    (DrivingRegime::Turns, |w, _, t| w.yaw.abs() > 0.5 * t.yaw),
    (DrivingRegime::Straight, |w, _, t| w.yaw.abs() < 0.3 * t.yaw),
    (DrivingRegime::Fast, |w, _, t| w.speed > 1.15 * t.speed),
    (DrivingRegime::Slow, |w, _, t| w.speed < 0.85 * t.speed),
    (DrivingRegime::SpeedingUp, |w, last, t| w.speed - last.speed > 0.08 * t.speed),
    (DrivingRegime::SlowingDown, |w, last, t| w.speed - last.speed < -0.08 * t.speed),
    (DrivingRegime::HighLoad, |w, _, t| w.load().abs() > 1.3 * t.load),
    (DrivingRegime::TightCurves, |w, _, t| w.curve(t.speed).abs() > 1.3 * t.curve),
    (DrivingRegime::Transitions, |w, last, t| (w.curve(t.speed) - last.curve(t.speed)).abs() > 0.5 * t.curve),
];

/// The regime in which a constraint is violated most, when one stands out.
fn regime(v: &ConstraintResiduals, c: usize) -> DrivingRegime {
    let speed = v.rms_of(|w| w.speed);
    let typical =
        Typical { speed, yaw: v.rms_of(|w| w.yaw), load: v.rms_of(Window::load), curve: v.rms_of(|w| w.curve(speed)) };
    let mean = v.rms_of(|w| w.rates[c]).powi(2);
    let mut best = (DrivingRegime::Whole, 1.4);
    for (regime, holds) in REGIMES {
        let inside: Vec<f64> = v
            .windows
            .iter()
            .zip(std::iter::once(&v.windows[0]).chain(&v.windows))
            .filter(|(w, last)| holds(w, last, &typical))
            .map(|(w, _)| w.rates[c].powi(2))
            .collect();
        let ratio = inside.iter().sum::<f64>() / inside.len().max(1) as f64 / mean;
        if inside.len() >= 5 && ratio > best.1 {
            best = (regime, ratio);
        }
    }
    best.0
}

/// Where the model disagrees with the measurements by more than their noise: run by run, constraint by constraint,
/// from the first to the last window that stands out, with its share of the whole disagreement.
pub fn disagreements(violations: &[ConstraintResiduals]) -> Vec<Stretch> {
    let total: f64 = violations
        .iter()
        .map(|v| (0..v.constraints()).filter(|c| v.has(*c)).map(|c| v.chi_squared(c)).sum::<f64>())
        .sum();
    let mut found = Vec::new();
    for v in violations {
        for (c, jump) in JUMPS.iter().enumerate().filter(|(c, _)| v.has(*c)) {
            let energy = v.chi_squared(c);
            let out: Vec<&Window> = v.windows.iter().filter(|w| w.rates[c].abs() > 3.0 * v.noise[c]).collect();
            // Noise alone gives one window in 370; a disagreement fills more.
            if out.len() < 3 || energy < 2.0 * v.windows.len() as f64 {
                continue;
            }
            found.push(Stretch {
                run: v.run.clone(),
                place: jump.place,
                span: [out[0].span[0], out[out.len() - 1].span[1]],
                regime: regime(v, c),
                share: energy / total,
            });
        }
    }
    found.sort_by(|a, b| b.share.total_cmp(&a.share));
    found
}
