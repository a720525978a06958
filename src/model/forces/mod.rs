//! Forces on a vehicle, and its equations of motion in the quasi-velocities of its ideal contacts (Kane's method).
//!
//! ```text
//! q̇ = B(q)·ν        (BᵀMB)·ν̇ = Bᵀ(Q − h − M·Ḃν)
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | ν | rates that the ideal contacts leave free, in the axes of the bodies |
//! | M | masses and moments of inertia |
//! | Q | forces and torques that drive, forces of contacts with a law |
//! | h | what the turning of the bodies' axes asks for |
//!
//! The equations are written as ordinary definitions, so that everything that reads a model reads one with forces.

mod applied_forces;
mod bodies;
mod contact;
mod description;
mod driving_force;
mod entry;
mod forced_model;
mod kinetic_energy;
mod law;
mod ldl_factors;
mod lowering;
mod masses;
mod quasi_velocities;
mod rate_forms;
mod slow_speeds;
mod time_derivative;

pub(crate) use bodies::{castors, rolling_rates};
pub use contact::Contact;
pub(crate) use contact::slug;
pub use description::Dynamics;
pub(crate) use description::rate_role;
pub(crate) use driving_force::roles;
pub use law::{Law, LawParameter, laws};
pub(crate) use masses::without_inertia;
pub use masses::{Masses, TrailerMass};
