//! The regimes of creep: what a coefficient, or a motion, is called.
//!
//! | coefficient | e ≤ e₂ | e₂ < e < 0 | 0 | 0 < e < e₁ | e ≥ e₁ |
//! |---|---|---|---|---|---|
//! | rotation, e_rc | skidding | forward-creep | ideal | backward-creep | slipping |
//! | traverse, e_tc | side-slip | right-creep | ideal | left-creep | side-slip |
//!
//! The limits e₁ > 0 > e₂ are inputs: nothing in the geometry determines them. Without them a coefficient is named by
//! its sign.

mod coefficient;
mod limits;
mod rotation;
mod traverse;

pub use limits::Limits;
pub use rotation::{Landmark, RotationMotion, RotationRegime, Way};
pub use traverse::{Side, TraverseMotion, TraverseRegime};
