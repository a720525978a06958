//! Another vehicle behind the same log: models that are not nested, compared by BIC (Burnham & Anderson, Model Selection
//! and Multimodel Inference, 2002, 2.11).
//!
//! Asked where a rest remains, or a law without a name stands for one. Told where the other vehicle, with the effects it
//! misses in turn, leaves nothing beyond the noise.

use super::choice::{Refusal, Refused, Selected};
use super::search::{Search, SearchState, find, first_of};
use super::transients;
use crate::discrepancy::estimation::bounds::is_possible;
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::estimation::unexplained::remains;
use crate::discrepancy::evidence::information_criterion::bic;
use crate::effects::{self, Applied, Effect};
use crate::error::Result;
use crate::model::Model;
use crate::model::effect_equation::is_term;
use crate::progress::OnProgress;
use crate::vehicles::{self, Vehicle};

/// The share of what was found that another vehicle explains at least before anything is added to it.
const BY_ITSELF: f64 = 0.2;

/// A wheel that is nearer to the middle than such a share of its usual place is none beside it.
const OFF_THE_MIDDLE: f64 = 0.02;

/// What the log is of.
#[derive(Clone, Debug)]
pub enum LogReading {
    /// A vehicle of the catalogue, by its id and its title.
    Vehicle {
        /// Its id.
        id: String,
        /// Its title.
        title: String,
    },
    /// One wheel in the place of the middle of its axle, at its fitted place.
    Wheel {
        /// The effect that says so.
        applied: Box<Applied>,
        /// Standard deviations of its values.
        std: Vec<Option<f64>>,
    },
}

/// Another vehicle that explains the data to their noise.
#[derive(Clone, Debug)]
pub struct OtherVehicle {
    /// The vehicle of the model file.
    pub given: String,
    /// What it is instead.
    pub reading: LogReading,
    /// What it misses in turn.
    pub misses: Vec<Applied>,
}

/// What stands, another vehicle first: where one explains the data nothing that was found on the given one is named.
pub(crate) fn in_its_place(
    problem: &Problem,
    library: &[Effect],
    choice: Selected,
    progress: &OnProgress,
) -> Result<(Selected, Option<OtherVehicle>)> {
    if !(remains(&choice.after) || choice.chosen.iter().any(|c| is_term(&c.applied))) {
        return Ok((choice, None));
    }
    let other = best(problem, library, &choice, progress)?;
    Ok((if other.is_some() { without_names(choice) } else { choice }, other))
}

/// The model as given, all that was found on it refused.
fn without_names(choice: Selected) -> Selected {
    let names = choice.chosen.iter().filter(|c| !is_term(&c.applied));
    let refused = names.map(|c| Refused::of(&choice.chosen, c.applied.clone(), Refusal::OtherVehicle));
    let refused = choice.refused.iter().cloned().chain(refused).collect();
    Selected {
        after: choice.before.clone(),
        chosen: vec![],
        steps: vec![],
        missed: vec![],
        inconsistent: vec![],
        sampling_sensitive: vec![],
        refused,
        ..choice
    }
}

fn best(
    problem: &Problem,
    library: &[Effect],
    choice: &Selected,
    progress: &OnProgress,
) -> Result<Option<OtherVehicle>> {
    let mut best: Option<(f64, OtherVehicle)> = None;
    for (model, reading) in alternatives(&choice.before.model) {
        let Some(begun) = begun(problem, &model, choice)? else { continue };
        let Some(grown) = explained(problem, library, &begun, choice, progress)? else { continue };
        let score = bic(&grown, choice.after.sample_size);
        if best.as_ref().is_none_or(|(least, _)| score < *least) {
            let given = choice.before.model.vehicle.id.clone();
            let Some(other) = told(given, reading, &grown) else { continue };
            best = Some((score, other));
        }
    }
    Ok(best.map(|(_, other)| other))
}

/// The other vehicle alone, where that explains a good part of what was found.
fn begun(problem: &Problem, model: &Model, choice: &Selected) -> Result<Option<Fit>> {
    let Ok(starts) = problem.starts(model) else { return Ok(None) };
    let fit = problem.fit(model, &starts, &choice.before.variances, Effort::FULL)?;
    let found = choice.before.deviance - choice.after.deviance;
    Ok(fit.filter(|f| choice.before.deviance - f.deviance > BY_ITSELF * found.max(0.0)))
}

/// The other vehicle with what it misses, where these explain the data to their noise and better than what was found.
fn explained(
    problem: &Problem,
    library: &[Effect],
    begun: &Fit,
    choice: &Selected,
    progress: &OnProgress,
) -> Result<Option<Fit>> {
    let quick = transients::without_transients(library);
    let search = Search::over(problem, begun, &quick);
    let SearchState { fit, .. } =
        if remains(begun) { search.grown(begun, progress)? } else { SearchState::from(begun) };
    let n = choice.after.sample_size;
    let is_better = bic(&fit, n) + search.margin() < bic(&choice.after, n);
    let is_told = fit.p.is_empty() || fit.covariance.is_some();
    let stands = !remains(&fit) && is_better && is_told && fit.model.free_effects().all(is_possible);
    Ok(stands.then_some(fit))
}

/// Vehicles that are driven by the same inputs, and wheels in the place of an axle.
fn alternatives(given: &Model) -> Vec<(Model, LogReading)> {
    let vehicles = vehicles::all().iter().filter(|v| v.id != given.vehicle.id && stands_in(v, given));
    let of_other = |v: &Vehicle| {
        let model = of_vehicle(given, v);
        model
            .free_equations()
            .is_ok()
            .then_some((model, LogReading::Vehicle { id: v.id.clone(), title: v.title.clone() }))
    };
    let readings: Vec<&Effect> = effects::all().iter().filter(|e| e.unsought && !e.per_input).collect();
    let of_wheel = |e: &&Effect| {
        let applied = Applied::new(e, None, vec![0.0; e.parameters.len()]);
        let is_open = !given.effects.iter().any(|a| a.effect.id == e.id);
        let applies = is_open && !given.applicable(std::slice::from_ref(*e)).is_empty();
        let model = given.clone().with_effect(applied.clone().freed());
        applies.then_some((model, LogReading::Wheel { applied: Box::new(applied), std: vec![] }))
    };
    vehicles.filter_map(of_other).chain(readings.iter().filter_map(of_wheel)).collect()
}

/// The model with another vehicle in the place of its own.
fn of_vehicle(given: &Model, vehicle: &Vehicle) -> Model {
    let known = given.parameters.iter().filter(|(name, _)| vehicle.parameters.contains_key(*name));
    let parameters = known.map(|(name, value)| (name.clone(), *value)).collect();
    Model { vehicle: vehicle.clone(), parameters, solution: Default::default(), ..given.clone() }
}

/// Whether a vehicle takes the logged inputs, and has its parameters among those of the model.
fn stands_in(vehicle: &Vehicle, given: &Model) -> bool {
    let of_given = |role: &str| given.vehicle.inputs.get(role).map(|i| &i.unit);
    let is_known = |role: &str| vehicle.inputs.get(role).map(|i| &i.unit) == of_given(role);
    let has_all = vehicle.parameters.iter().all(|(name, p)| p.optional || given.parameters.contains_key(name));
    let same_inputs = vehicle.inputs.len() == given.vehicle.inputs.len() && vehicle.inputs.keys().all(|r| is_known(r));
    vehicle.moves() && vehicle.line == given.vehicle.line && has_all && same_inputs
}

/// What explains a log, as a fit has it; `None` where the fit gave the reading up for other effects, or has its wheel in the
/// middle, and so is no more of it than the model as given.
fn told(given: String, reading: LogReading, fit: &Fit) -> Option<OtherVehicle> {
    let reading = match reading {
        LogReading::Wheel { applied, .. } => {
            let applied = Box::new(find(&fit.model, &applied).filter(is_off_the_middle)?);
            let first = first_of(fit, &applied);
            let std = (first..first + applied.values.len()).map(|i| fit.variance(i).map(f64::sqrt)).collect();
            LogReading::Wheel { applied, std }
        }
        vehicle => vehicle,
    };
    let is_reading = |e: &Applied| matches!(&reading, LogReading::Wheel { applied, .. } if e.same_as(applied));
    let misses = fit.model.free_effects().filter(|e| !is_reading(e)).cloned().collect();
    Some(OtherVehicle { given, reading, misses })
}

fn is_off_the_middle(wheel: &Applied) -> bool {
    let mut places = wheel.effect.parameters.values().zip(&wheel.values);
    places.any(|(usual, place)| place.abs() > OFF_THE_MIDDLE * usual.size)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{applied, fit_of, unicycle};
    use nalgebra::DMatrix;

    /// A search may drop the reading it began with: what it ends with is then told of no reading.
    #[test]
    fn a_reading_that_was_given_up_is_not_told() {
        let told = |known: &[(&str, &[f64])]| {
            let fit = fit_of(unicycle(known));
            let covariance = Some(DMatrix::identity(fit.p.len(), fit.p.len()) * 4e-4);
            let reading = LogReading::Wheel { applied: Box::new(applied("rate-of-one-wheel")), std: vec![] };
            super::told("unicycle".into(), reading, &Fit { covariance, ..fit })
        };
        assert!(told(&[("traverse-creep", &[0.1])]).is_none());
        // Two millimetres from the middle is the middle.
        assert!(told(&[("rate-of-one-wheel", &[0.002])]).is_none());
        let kept = told(&[("traverse-creep", &[0.1]), ("rate-of-one-wheel", &[0.2])]).unwrap();
        let LogReading::Wheel { applied, std } = kept.reading else { panic!("a wheel became a vehicle") };
        assert_eq!((applied.values, std, kept.misses.len()), (vec![0.2], vec![Some(0.02)], 1));
    }
}
