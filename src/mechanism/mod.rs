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

pub(crate) mod constrained_system;
mod constraint;
mod constraint_type;
mod contact;
mod definitions;
pub(crate) mod distribution_basis;
mod dual_jacobian;
pub(crate) mod exact_linear_algebra;
mod form;
pub(crate) mod growth_vector;
mod heading;
pub(crate) mod integral_ansatz;
pub(crate) mod integral_proof;
mod integrals;
mod momentum;
mod nonholonomy;
pub(crate) mod passive_coefficients;
mod point;
pub(crate) mod random_points;
mod realisation;
mod regime;
mod row;
pub(crate) mod slot_value;
#[doc(hidden)]
pub mod solve;
pub(crate) mod unit_test_point;
pub(crate) mod vector_field;
mod velocity;
pub(crate) mod zero_test;

pub use constrained_system::Mechanism;
pub use constraint::Constraint;
pub(crate) use constraint_type::rank;
pub use constraint_type::{ConstraintType, constraint_types};
#[doc(hidden)]
pub use constraint_type::{Printed, Regimes, Slot};
pub(crate) use contact::tangent;
pub use contact::{Direction, Rolling, sigma_closed_form};
#[doc(hidden)]
pub use definitions::Definitions;
#[doc(hidden)]
pub use dual_jacobian::DualJacobian;
#[doc(hidden)]
pub use form::Form;
pub use growth_vector::Growth;
pub use heading::Heading;
#[doc(hidden)]
pub use integrals::Integral;
pub use momentum::Momentum;
#[doc(hidden)]
pub use nonholonomy::Nonholonomy;
pub use point::Point;
pub use realisation::Realisation;
pub(crate) use realisation::counted;
#[doc(hidden)]
pub use regime::{Landmark, Limits, RotationMotion, RotationRegime, Side, TraverseMotion, TraverseRegime, Way};
pub use row::Row;
#[doc(hidden)]
pub use slot_value::Part;
#[doc(hidden)]
pub use unit_test_point::Sample;
pub use velocity::Velocity;
