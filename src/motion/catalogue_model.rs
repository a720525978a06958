//! A model of the catalogue with effects of the library, driven by formulas of time.

use super::{Formulas, Integrator, simulate};
use crate::effects;
use crate::effects::Applied;
use crate::error::{Error, Result};
use crate::formula::Expr;
use crate::model::{Model, Trailer};

/// An effect by id, the trailer it acts on, and its values in alphabetical order of their names.
pub type Creep = (&'static str, Option<usize>, Vec<f64>);

/// A vehicle of the catalogue with trailers and effects of the library.
///
/// ```
/// use creepage::motion::assembled;
/// let wheel = assembled("unicycle", &[("wheel_radius", 0.5)], &[], &[("rotation-creep", None, vec![0.1])]).unwrap();
/// assert_eq!(wheel.effects[0].label(), "rotation-creep");
/// ```
///
/// # Errors
/// When the vehicle, a parameter or an effect is unknown.
pub fn assembled(vehicle: &str, parameters: &[(&str, f64)], trailers: &[Trailer], with: &[Creep]) -> Result<Model> {
    let model = Model::new(vehicle, parameters)?.with_trailers(trailers);
    with.iter().try_fold(model, |model, (id, trailer, values)| {
        let effect = effects::named(id).ok_or_else(|| Error::run(format!("the library lacks the effect {id}")))?;
        Ok(model.with_effect(Applied::new(effect, *trailer, values.clone())))
    })
}

/// The states of a model at given times, driven by a formula of `t` and c_0, c_1, … for each input by name.
///
/// ```
/// use creepage::motion::{assembled, driven};
/// let wheel = assembled("unicycle", &[("wheel_radius", 0.5)], &[], &[]).unwrap();
/// let inputs = [("wheel_rate", "c_0"), ("yaw_rate", "0")];
/// let path = driven(&wheel, &inputs, &[2.0], &[0.0; 3], &[0.0, 3.0]).unwrap();
/// assert!((path[1][0] - 3.0).abs() < 1e-12);
/// ```
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
    driven_by(model, inputs, constants, start, times, &Integrator::default().with_tolerance(1e-12, 1e-13))
}

/// As [`driven`], by an integrator of one's own.
///
/// # Errors
/// As [`driven`].
pub(crate) fn driven_by(
    model: &Model,
    inputs: &[(&str, &str)],
    constants: &[f64],
    start: &[f64],
    times: &[f64],
    by: &Integrator,
) -> Result<Vec<Vec<f64>>> {
    let constants: Vec<_> = constants.iter().enumerate().map(|(i, v)| (format!("c_{i}").as_str().into(), *v)).collect();
    let formula = |input: &String| {
        let found = inputs.iter().find(|(name, _)| name == input).map(|(_, f)| *f);
        Expr::parse(found.ok_or_else(|| Error::run(format!("the input {input} has no formula")))?)
    };
    let drive = Formulas::new(&model.inputs.iter().map(formula).collect::<Result<Vec<_>>>()?, &constants)?;
    simulate(&model.equations(&[])?, &[], &drive, start, times, by)
}
