//! Places, headings and the constraint forms; everything a description implies is derived here.
//!
//! | form | equation | ideal σ | creeping σ |
//! |---|---|---|---|
//! | type R (13) | π̇ − σ(e)·q̇ = 0 | r | r(1 − e) |
//! | type T (20) | q̇₁ − σ(q₂, e)·q̇₃ = 0 | cot φ | cot(φ + arctan e) |
//! | type S (20) | s·q̇₁ + (1 − e)·h = 0: a momentum is zero | −h/(s·q̇₃) | −(1 − e)·h/(s·q̇₃) |
//!
//! Type T is kept as a pair (s, p) with s·q̇₁ − p·q̇₃ = 0 and σ = p/s, so that no configuration is singular.
//! A type is data, a [`ConstraintType`]; those of the catalogue are [`constraint_types`].

mod ansatz;
mod constraint;
mod constraint_type;
mod contact;
mod definitions;
mod field;
mod form;
mod frame;
mod growth;
mod heading;
mod integrals;
mod linear;
mod momentum;
mod nonholonomy;
mod part;
mod passive;
mod point;
mod proof;
mod realisation;
mod regime;
mod row;
mod sample;
mod samples;
pub mod solve;
mod system;
mod vanish;
mod velocity;

pub use constraint::Constraint;
pub(crate) use constraint_type::rank;
pub use constraint_type::{ConstraintType, Printed, Regimes, Slot, constraint_types};
pub use contact::{Direction, Rolling, sigma_closed_form};
pub use definitions::Definitions;
pub use form::Form;
pub use growth::Growth;
pub use heading::Heading;
pub use integrals::Integral;
pub use momentum::Momentum;
pub use nonholonomy::Nonholonomy;
pub use part::Part;
pub use point::Point;
pub use realisation::Realisation;
pub(crate) use realisation::counted;
pub use regime::{Landmark, Limits, RotationMotion, RotationRegime, Side, TraverseMotion, TraverseRegime, Way};
pub use row::Row;
pub use sample::Sample;
pub use system::Mechanism;
pub use velocity::Velocity;
