//! Simulated motions for claims: a model driven by formulas of time.

use super::sampling::Fault;
use crate::error::{Error, Result};
use crate::model::Model;
use crate::motion::{Integrator, Method, Table, driven_by};

pub use crate::motion::{Creep, assembled as model};

/// As [`driven`](crate::motion::driven) by the crate `ode_solvers`, so that a claim does not rest on the code that fits and
/// `simulate` use.
///
/// # Errors
/// As [`driven`](crate::motion::driven).
pub fn driven(
    model: &Model,
    inputs: &[(&str, &str)],
    constants: &[f64],
    start: &[f64],
    times: &[f64],
) -> Result<Vec<Vec<f64>>> {
    let exact = Integrator { method: Method::Dopri5, ..Integrator::default() }.with_tolerance(1e-12, 1e-13);
    driven_by(model, inputs, constants, start, times, &exact)
}

/// A column of a simulated motion.
///
/// # Errors
/// When there is none of that name.
pub fn column<'t>(table: &'t Table, name: &str) -> Result<&'t [f64]> {
    table.column(name).ok_or_else(|| Error::run(format!("the motion has no {name}")))
}

/// A failed run of the program is never a result about the claim.
pub fn undefined(error: &Error) -> Fault {
    Fault::Undefined(error.to_string())
}

/// Smooth inputs that neither stand still nor repeat themselves: rates of wheel and yaw with seven constants.
pub const WHEEL: &str = "3 + c_0 + c_1*sin((2 + c_2)*t + c_3)";
/// As [`WHEEL`], for the yaw rate or a second wheel.
pub const TURN: &str = "c_4 + c_5*cos((2 + c_6)*t)";
