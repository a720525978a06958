//! An independent simulator of vehicles that forces move.
//!
//! It shares nothing with the library: every body has its own place and velocity in the world (maximal coordinates), hitches
//! and ideal contacts are kept by multipliers and by projection, slipping contacts push by their laws, and the classical
//! Runge–Kutta method of order four with steps far below every time constant integrates it all.

mod drawn;
mod hidden;
mod machine;
mod motion;
mod newton;
mod run;

pub use drawn::{Drawn, MAKES, Make, Wave};
pub use hidden::{Secret, secrets};
pub use machine::{Contact, Grip, Hitch, Law, Machine, Solid, Wheel};
pub use motion::{State, advance};
pub use newton::Inputs;
pub use run::{Drive, Run, begun};
