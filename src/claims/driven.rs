//! Motion for claims to look at: a model driven by formulas of time.

use super::sampling::Fault;
use crate::effects::{self, Applied};
use crate::error::{Error, Result};
use crate::formula::Expr;
use crate::model::{Model, Trailer};
use crate::motion::{Formulas, Integrator, simulate};

/// A vehicle with effects named by id, trailer and values.
///
/// # Errors
/// When the vehicle or an effect is unknown.
pub fn model(vehicle: &str, parameters: &[(&str, f64)], trailers: &[Trailer], with: &[Creep]) -> Result<Model> {
    let model = Model::new(vehicle, parameters)?.with_trailers(trailers);
    with.iter().try_fold(model, |model, (id, trailer, values)| {
        let effect = effects::named(id).ok_or_else(|| Error::run(format!("the library lacks the effect {id}")))?;
        Ok(model.with_effect(Applied::new(effect, *trailer, values.clone())))
    })
}

/// An effect by id, the trailer it acts on, and its values in alphabetical order of their names.
pub type Creep = (&'static str, Option<usize>, Vec<f64>);

/// The states of a model at given times, driven by a formula of `t` and c_0, c_1, … for each input by name.
///
/// # Errors
/// When an input has no formula, or the motion becomes undefined.
pub fn driven(
    model: &Model,
    inputs: &[(&str, &str)],
    constants: &[f64],
    start: &[f64],
    times: &[f64],
) -> Result<Vec<Vec<f64>>> {
    let constants: Vec<_> = constants.iter().enumerate().map(|(i, v)| (format!("c_{i}").as_str().into(), *v)).collect();
    let formula = |input: &String| {
        let found = inputs.iter().find(|(name, _)| name == input).map(|(_, f)| *f);
        Expr::parse(found.ok_or_else(|| Error::run(format!("the input {input} has no formula")))?)
    };
    let drive = Formulas::new(&model.inputs.iter().map(formula).collect::<Result<Vec<_>>>()?, &constants)?;
    let exact = Integrator::default().with_tolerance(1e-12, 1e-13);
    simulate(&model.equations(&[])?, &[], &drive, start, times, &exact)
}

/// A failed run of the program is never a result about the claim.
pub fn undefined(error: &Error) -> Fault {
    Fault::Undefined(error.to_string())
}

/// Smooth inputs that neither stand still nor repeat themselves: rates of wheel and yaw with seven constants.
pub const WHEEL: &str = "3 + c_0 + c_1*sin((2 + c_2)*t + c_3)";
/// As [`WHEEL`], for the yaw rate or a second wheel.
pub const TURN: &str = "c_4 + c_5*cos((2 + c_6)*t)";
