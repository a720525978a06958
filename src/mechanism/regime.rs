//! The regimes of creep: what a coefficient, or a motion, is called.
//!
//! | coefficient | e ≤ e₂ | e₂ < e < 0 | 0 | 0 < e < e₁ | e ≥ e₁ |
//! |---|---|---|---|---|---|
//! | rotation, e_rc | skidding | forward-creep | ideal | backward-creep | slipping |
//! | traverse, e_tc | side-slip | right-creep | ideal | left-creep | side-slip |
//!
//! The limits e₁ > 0 > e₂ are inputs: nothing in the geometry determines them. Without them a coefficient is named by
//! its sign.

mod limits;
mod rotation;
mod traverse;

pub use limits::Limits;
pub use rotation::{Landmark, RotationMotion, RotationRegime, Way};
pub use traverse::{Side, TraverseMotion, TraverseRegime};

/// A coefficient as numerator over denominator; `None` where it does not exist.
///
/// A quotient too small for its type keeps its sign: only a numerator of zero is ideal.
fn coefficient(numerator: f64, denominator: f64) -> Option<f64> {
    if !numerator.is_finite() || !denominator.is_finite() {
        return None;
    }
    // A denominator of zero makes this infinite or no number at all.
    let e = numerator / denominator;
    let lost = e == 0.0 && numerator != 0.0;
    Some(if lost { f64::from_bits(1).copysign(e) } else { e }).filter(|e| e.is_finite())
}
