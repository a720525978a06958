//! A model that forces move: the vehicle with forces and torques for inputs, and its motion as definitions.

use super::description::{Dynamics, rate_role};
use super::driving_force::roles;
use super::slow_speeds::slow_speeds;
use crate::error::Result;
use crate::formula::Symbol;
use crate::model::forced_motion::ForcedMotion;
use crate::model::vehicle_model::Model;
use crate::vehicles::{Input, Moves, Vehicle};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Names of the motion that no effect may rewrite: they are states, or follow from states.
const HELD: [&str; 5] = ["v_d", "v_n", "v_l", "v_t", "phi'"];

impl Dynamics {
    /// The vehicle as a model: everything that reads a model reads its motion under forces.
    ///
    /// ```
    /// use creepage::dynamics::{Dynamics, Masses};
    /// use creepage::model::Model;
    /// let disk = Model::new("disk", &[("wheel_radius", 0.5)]).unwrap();
    /// let masses = Masses { mass: 2.0, wheels: [("theta'".into(), 0.25)].into(), ..Masses::default() };
    /// let disk = Dynamics::new(&disk, &masses).unwrap().driven_by(&["wheel_torque"]).unwrap().model().unwrap();
    /// let equations = disk.equations(&[]).unwrap();
    /// let mut rates = [0.0; 4];
    /// equations.rates(&mut equations.workspace(&[]), &[0.0; 4], &[1.5], &mut rates);
    /// // A torque of 1.5 N·m on a disk that rolls: v' = (τ/r)/(m + J/r²) = 1 m/s².
    /// assert!((rates[3] - 1.0).abs() < 1e-12);
    /// ```
    ///
    /// # Errors
    /// When nothing says how a coordinate accelerates, or the steering swings an ideal contact.
    pub fn model(&self) -> Result<Model> {
        let forced = self.lowered()?;
        let (vehicle, inputs) = (self.forced_vehicle(), self.inputs());
        let of = |forced: ForcedMotion| Model {
            vehicle: vehicle.clone(),
            inputs: inputs.clone(),
            forced: Some(Arc::new(forced)),
            solution: Default::default(),
            ..self.model.clone()
        };
        let nodes = slow_speeds(&of(forced.clone()), &forced)?;
        Ok(of(forced.with_nodes(nodes)))
    }

    fn forced_vehicle(&self) -> Vehicle {
        let own = &self.model.vehicle;
        let mut inputs = BTreeMap::new();
        for (role, unit, meaning) in roles(own) {
            if self.driven.iter().any(|f| f.role == role) {
                let input =
                    Input { unit: unit.into(), meaning: meaning.into(), moves: Some(Moves::Push), instead: None };
                inputs.insert(role, input);
            }
        }
        for angle in self.steering() {
            let given = own.inputs[&angle].clone();
            match self.by_rate {
                true => {
                    let meaning = format!("rate of the {}", given.meaning);
                    let input = Input { unit: "rad/s".into(), meaning, moves: Some(Moves::Shape), instead: None };
                    inputs.insert(rate_role(&angle), input);
                }
                false => {
                    inputs.insert(angle, given);
                }
            }
        }
        let mut vehicle = Vehicle { inputs, instead: None, ..own.clone() };
        let freed = self.freed();
        vehicle.define.retain(|name, _| !freed.contains(name));
        vehicle.held.extend(HELD.map(Symbol::from));
        vehicle
    }

    /// Symbols that the inputs of the vehicle define and the forces do not leave to them: rates of wheels, and steering
    /// angles whose rates are given.
    fn freed(&self) -> Vec<Symbol> {
        let vehicle = &self.model.vehicle;
        let is_input = |s: &Symbol| vehicle.inputs.contains_key(s.as_str());
        let kept = self.given();
        let moved = vehicle.define.iter().filter(|(_, f)| f.formula.symbols().iter().any(is_input));
        let freed = moved.map(|(name, _)| name.clone()).filter(|name| !kept.contains(name));
        freed.chain(self.prescribed.iter().filter(|_| self.by_rate).cloned()).collect()
    }
}
