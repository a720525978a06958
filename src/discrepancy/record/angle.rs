//! Angles that are the same but for whole turns.

use std::f64::consts::TAU;

/// An angle without its whole turns, in [−π, π].
///
/// ```
/// use creepage::discrepancy::record::angle::wrapped;
/// assert!((wrapped(7.0) - (7.0 - std::f64::consts::TAU)).abs() < 1e-15);
/// ```
pub fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}
