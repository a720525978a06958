//! The pose that a measurement says: the sensor inverted.

use crate::model::Equations;
use crate::motion::visible_state;

/// The pose that a measurement says, or the measurement itself where the sensor's formulas cannot be undone.
pub fn pose_of(equations: &Equations, measured: &[f64]) -> Vec<f64> {
    let p = vec![0.0; equations.free.len()];
    visible_state(equations, &p, measured).unwrap_or_else(|_| measured.to_vec())
}
