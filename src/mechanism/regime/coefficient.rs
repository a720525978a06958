//! A coefficient of creep from velocities: the quotient of a slip and a speed.

/// A coefficient as numerator over denominator; `None` where it does not exist.
///
/// A quotient too small for its type keeps its sign: only a numerator of zero is ideal.
pub(super) fn coefficient(numerator: f64, denominator: f64) -> Option<f64> {
    if !numerator.is_finite() || !denominator.is_finite() {
        return None;
    }
    // A denominator of zero makes this infinite or no number at all.
    let e = numerator / denominator;
    let lost = e == 0.0 && numerator != 0.0;
    Some(if lost { f64::from_bits(1).copysign(e) } else { e }).filter(|e| e.is_finite())
}
