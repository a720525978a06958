//! Where a sensor sits on a body that does not slide: the heading offset and the lever arm that leave least slip.

use super::body_velocity::BodyVelocity;
use crate::model::Model;
use std::f64::consts::PI;

/// Heading offsets that are tried, and how often each is looked at more closely.
const TRIED: i32 = 90;
/// How many velocities are looked at.
const MOST: usize = 500;
/// Longest lever arm, in lengths of the vehicle.
const LENGTHS: f64 = 3.0;

/// Where a sensor sits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mounting {
    /// Measured heading minus body heading up to half a turn, rad.
    offset: f64,
    /// Lever arm ahead and to the left, m.
    arm: [f64; 2],
}

impl Mounting {
    /// The mounting by least absolute slips, Σ |u·sin o + w·cos o − a·φ'|/V, which a minority of slides does not move:
    /// over a grid of offsets o, a the weighted median. The lever arm to the left moves no slip and is the model's.
    pub fn of(velocities: &[BodyVelocity], model: &Model) -> Option<Self> {
        let few: Vec<BodyVelocity> = velocities.iter().step_by(velocities.len() / MOST + 1).copied().collect();
        let longest = longest_arm(model);
        let at = |offset: f64| {
            let turned: Vec<BodyVelocity> =
                few.iter().map(|v| Self { offset, arm: [0.0; 2] }.at_reference(v)).collect();
            let ahead = lever_arm(&turned).clamp(-longest, longest);
            let missed = |v: &BodyVelocity| (v.left - ahead * v.yaw_rate).abs() / v.speed();
            (turned.iter().map(missed).sum::<f64>(), Self { offset, arm: [ahead, model.sensor.lever_arm[1]] })
        };
        let best = |around: f64, step: f64| {
            let tried = (-TRIED / 2..=TRIED / 2).map(|k| at(around + step * f64::from(k)));
            tried.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, mounting)| mounting)
        };
        let step = PI / f64::from(TRIED);
        best(best(0.0, step)?.offset, 2.0 * step / f64::from(TRIED))
    }

    /// The velocity of the reference point in the axes of the body.
    pub fn at_reference(&self, v: &BodyVelocity) -> BodyVelocity {
        let (sin, cos) = self.offset.sin_cos();
        let ahead = v.ahead * cos - v.left * sin + self.arm[1] * v.yaw_rate;
        let left = v.ahead * sin + v.left * cos - self.arm[0] * v.yaw_rate;
        BodyVelocity { ahead, left, ..*v }
    }
}

/// The longest lever arm that is one: a vehicle of more lengths than a wheel's has a size.
fn longest_arm(model: &Model) -> f64 {
    let is_length = |name: &str| model.vehicle.parameters.get(name).is_some_and(|p| p.unit == "m");
    let lengths: Vec<f64> = model.parameters.iter().filter(|(name, _)| is_length(name)).map(|(_, v)| *v).collect();
    if lengths.len() > 1 { LENGTHS * lengths.into_iter().fold(0.0, f64::max) } else { f64::INFINITY }
}

/// The lever arm ahead that leaves least slip, Σ |w − a·φ'|/V: the median of w/φ' weighted by |φ'|/V.
fn lever_arm(velocities: &[BodyVelocity]) -> f64 {
    let turning = velocities.iter().filter(|v| v.yaw_rate != 0.0);
    let mut arms: Vec<[f64; 2]> = turning.map(|v| [v.left / v.yaw_rate, v.yaw_rate.abs() / v.speed()]).collect();
    arms.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let half = 0.5 * arms.iter().map(|[_, weight]| weight).sum::<f64>();
    let mut sum = 0.0;
    let middle = arms.iter().find(|[_, weight]| {
        sum += weight;
        sum >= half
    });
    middle.map_or(0.0, |[arm, _]| *arm)
}
