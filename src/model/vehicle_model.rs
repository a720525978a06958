//! A vehicle with its parameters, its sensor and the effects it includes.

use super::forced_motion::ForcedMotion;
use super::measured::MeasuredQuantity;
use super::solution::Solution;
use super::trailer::Trailer;
use crate::effects::Applied;
use crate::error::{Error, Result};
use crate::formula::Symbol;
use crate::vehicles::Vehicle;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Where the measured pose sits on the body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensor {
    /// Forward and left of the reference point, m.
    pub lever_arm: [f64; 2],
    /// Measured heading minus body heading, rad.
    pub heading_offset: f64,
}

/// A vehicle with its parameters, its sensor and its effects.
///
/// ```
/// use creepage::model::Model;
/// let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap();
/// let front = &car.constraints()[2];
/// assert_eq!(front.ideal_row().to_string(), "sin(phi + delta)*x' - cos(phi + delta)*y' - cos(delta)*L*phi'");
/// ```
#[derive(Clone, Debug)]
pub struct Model {
    /// The tractor.
    pub vehicle: Vehicle,
    /// The trailers behind it, nearest first; those that are a part of the vehicle stand ahead of them.
    pub trailers: Vec<Trailer>,
    /// Values of the vehicle's parameters.
    pub parameters: BTreeMap<String, f64>,
    /// The sensor as far as it is known.
    pub sensor: Sensor,
    /// What a log measures beside the pose.
    pub measured: Vec<MeasuredQuantity>,
    /// Inputs as they are logged.
    pub inputs: Vec<String>,
    /// The effects the model includes.
    pub effects: Vec<Applied>,
    /// The motion under forces, for a vehicle that has them; `None` where its contacts and inputs say how it moves.
    #[doc(hidden)]
    pub forced: Option<Arc<ForcedMotion>>,
    /// What has been found out about its constraints; `Default::default()` where there is nothing yet.
    pub solution: Solution,
}

impl Model {
    /// A vehicle of the catalogue by its id; otherwise as [`Model::of`].
    ///
    /// # Errors
    /// When the vehicle or a parameter is unknown, or a parameter is missing.
    pub fn new(vehicle: &str, parameters: &[(&str, f64)]) -> Result<Self> {
        let found =
            crate::vehicles::named(vehicle).ok_or_else(|| Error::input(format!("no vehicle is called {vehicle:?}")))?;
        Self::of(found, parameters)
    }

    /// Any vehicle with parameters, logged by its own inputs, without trailers behind it or effects.
    ///
    /// ```
    /// use creepage::model::Model;
    /// use creepage::vehicles::{Vehicle, Wheel};
    /// let blade = Wheel { name: "blade".into(), traverse_creep: Some("e_tc".into()), ..Wheel::default() };
    /// let skate = Vehicle { id: "skate".into(), wheels: vec![blade], ..Vehicle::default() };
    /// let skate = Model::of(&skate, &[]).unwrap();
    /// assert_eq!(skate.constraints()[0].ideal_row().to_string(), "sin(phi)*x' - cos(phi)*y'");
    /// ```
    ///
    /// # Errors
    /// When a parameter is unknown or missing.
    pub fn of(found: &Vehicle, parameters: &[(&str, f64)]) -> Result<Self> {
        let vehicle = &found.id;
        let parameters: BTreeMap<String, f64> = parameters.iter().map(|(k, v)| ((*k).to_string(), *v)).collect();
        if let Some(extra) = parameters.keys().find(|k| !found.parameters.contains_key(*k)) {
            return Err(Error::input(format!("{vehicle} has no parameter {extra:?}")));
        }
        if let Some(missing) =
            found.parameters.iter().find(|(k, p)| !p.optional && !parameters.contains_key(*k)).map(|(k, _)| k)
        {
            return Err(Error::input(format!("{vehicle} needs the parameter {missing:?}")));
        }
        Ok(Self {
            vehicle: found.clone(),
            trailers: vec![],
            parameters,
            sensor: Sensor::default(),
            measured: vec![],
            inputs: found.inputs.keys().cloned().collect(),
            effects: vec![],
            forced: None,
            solution: Solution::default(),
        })
    }

    /// A vehicle with every parameter one: enough for its formulas.
    ///
    /// # Errors
    /// As [`Model::of`].
    pub fn sample(vehicle: &Vehicle) -> Result<Self> {
        let ones: Vec<(&str, f64)> = vehicle.parameters.keys().map(|name| (name.as_str(), 1.0)).collect();
        Self::of(vehicle, &ones)
    }

    /// The same with every effect kept at its values: nothing of it is fitted.
    pub fn fixed(&self) -> Self {
        let fixed = |e: &Applied| Applied { free: false, ..e.clone() };
        Self { effects: self.effects.iter().map(fixed).collect(), ..self.clone() }
    }

    /// The same vehicle moved by its inputs where forces move it, with those effects that it then has.
    pub fn kinematic(&self) -> Self {
        let Some(forced) = &self.forced else { return self.clone() };
        let (vehicle, inputs) = forced.kinematic.clone();
        let bare =
            Self { vehicle, inputs, effects: vec![], forced: None, solution: Solution::default(), ..self.clone() };
        let names: Vec<Symbol> = bare.bare_definitions().iter().map(|(name, _)| name.clone()).collect();
        let applies = |e: &&Applied| bare.targets(&e.effect, e.trailer, &names).is_some();
        Self { effects: self.effects.iter().filter(applies).cloned().collect(), ..bare }
    }

    /// How many trailers it has: those that are a part of the vehicle, then those behind it.
    pub fn trailer_count(&self) -> usize {
        self.vehicle.trailers.len() + self.trailers.len()
    }

    /// The model with trailers behind it.
    pub fn with_trailers(mut self, trailers: &[Trailer]) -> Self {
        self.trailers = trailers.to_vec();
        self
    }

    /// The model with one more effect; a value of the same effect and trailer is replaced.
    pub fn with_effect(mut self, applied: Applied) -> Self {
        self.effects.retain(|e| !e.same_as(&applied));
        let applied = self.at_contacts(applied);
        self.effects.push(applied);
        self
    }

    /// An effect with the states that it has at the contacts of this vehicle.
    pub(crate) fn at_contacts(&self, mut applied: Applied) -> Applied {
        if applied.effect.per_contact {
            let names: Vec<Symbol> = self.bare_definitions().iter().map(|(name, _)| name.clone()).collect();
            applied.effect = applied.effect.at_contacts(&names).into_owned();
        }
        applied
    }
}
