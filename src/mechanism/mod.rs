//! Places, headings and the two constraint forms; everything a description implies is derived here.
//!
//! | form | equation | ideal σ | creeping σ |
//! |---|---|---|---|
//! | type R (13) | π̇ − σ(e)·q̇ = 0 | r | r(1 − e) |
//! | type T (20) | q̇₁ − σ(q₂, e)·q̇₃ = 0 | cot φ | cot(φ + arctan e) |
//!
//! Type T is kept as a pair (s, p) with s·q̇₁ − p·q̇₃ = 0 and σ = p/s, so that no configuration is singular.

mod constraint;
mod definitions;
mod heading;
mod regime;
mod row;
mod sample;
pub mod solve;
mod system;
mod velocity;

pub use constraint::{Constraint, Direction, Form, Rolling, sigma_closed_form};
pub use definitions::Definitions;
pub use heading::Heading;
pub use regime::{Landmark, Limits, RotationMotion, RotationRegime, Side, TraverseMotion, TraverseRegime, Way};
pub use row::Row;
pub use sample::Sample;
pub use system::Mechanism;
pub use velocity::Velocity;
