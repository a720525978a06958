//! Simulated motions for claims: a model driven by formulas of time.

use super::sampling::Fault;
use crate::error::Error;

pub use crate::motion::{Creep, assembled as model, driven};

/// A failed run of the program is never a result about the claim.
pub fn undefined(error: &Error) -> Fault {
    Fault::Undefined(error.to_string())
}

/// Smooth inputs that neither stand still nor repeat themselves: rates of wheel and yaw with seven constants.
pub const WHEEL: &str = "3 + c_0 + c_1*sin((2 + c_2)*t + c_3)";
/// As [`WHEEL`], for the yaw rate or a second wheel.
pub const TURN: &str = "c_4 + c_5*cos((2 + c_6)*t)";
