//! What values the parameters of free effects may take.

use super::angle::wrapped;
use crate::effects::Applied;
use crate::model::Model;
use nalgebra::DVector;

/// A positive value below this share of its plausible size is as good as neutral, and a stiff state to integrate.
const LEAST_SHARE: f64 = 0.04;

/// Whether an effect stands at the edge of its range where it vanishes.
pub fn vanishes(effect: &Applied) -> bool {
    let mut values = effect.effect.parameters.values().zip(&effect.values);
    values.any(|(p, v)| p.positive && *v <= p.size * LEAST_SHARE * 1.001)
}

/// What values the parameters may take.
pub struct Bounds {
    range: Vec<[f64; 2]>,
    positive: Vec<bool>,
    periodic: Vec<bool>,
}

impl Bounds {
    /// The bounds of a model's free effects.
    pub fn of(model: &Model) -> Self {
        let all = || model.free_effects().flat_map(|e| e.effect.parameters.values());
        Self {
            range: all().map(|p| if p.positive { [p.size * LEAST_SHARE, p.range[1]] } else { p.range }).collect(),
            positive: all().map(|p| p.positive).collect(),
            periodic: all().map(|p| p.periodic).collect(),
        }
    }

    /// The point a step leads to, held inside: a positive value is at most divided or multiplied by five.
    pub fn within(&self, p: &DVector<f64>, step: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(p.len(), |i, _| {
            let target = p[i] + step[i];
            let target = if self.positive[i] { target.clamp(p[i] / 5.0, p[i] * 5.0) } else { target };
            if self.periodic[i] {
                return wrapped(target);
            }
            target.clamp(self.range[i][0], self.range[i][1])
        })
    }
}
