//! A user's own vehicles, held against what every vehicle of the catalogue does.
//!
//! Names, units, places that stay where they are, constraints that determine the motion, effects of the library that
//! mean on it what they say: what passes can be used like a vehicle of the catalogue.

mod actions;
mod constraints;
mod motion;
mod names;
mod places;
mod units;
mod user_vehicles;

pub use user_vehicles::{vehicles_of, vehicles_with_own};
