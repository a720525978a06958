//! A model: a vehicle with its parameters, its sensor and the effects it includes.
//!
//! From the description everything else is derived: the constraints in the two forms, and by solving
//! them the equations of motion as [`Definitions`](crate::mechanism::Definitions).

mod applicable;
mod body;
mod build;
mod compilation;
mod constraints;
pub mod effect_equation;
mod equations;
mod file;
pub(crate) mod forced_motion;
pub(crate) mod forces;
mod free;
pub mod freedom;
pub mod measured;
mod measured_definitions;
pub mod observation;
mod own;
mod rate_along_motion;
pub(crate) mod reference_speeds;
mod solution;
pub mod state;
mod terms;
mod trailer;
mod vehicle_model;

pub use constraints::mechanism;
pub(crate) use equations::{Derived, RatesAlone};
pub use equations::{Equations, Fineness, Workspace};
pub use file::{WITH_TRAILERS, known, known_on};
pub use terms::{COEFFICIENT, PREFIX, is_term};
pub use trailer::{Trailer, trailer_heading};
pub use vehicle_model::{Model, Sensor};
