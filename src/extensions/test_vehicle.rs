//! A test vehicle: a model without effects, with the unit of every name, against which a user's effects are checked.

use crate::describe::Symbols;
use crate::error::Result;
use crate::formula::{Symbol, Unit};
use crate::mechanism::Definitions;
use crate::model::{Model, Trailer, WITH_TRAILERS, trailer_heading};
use crate::vehicles::Vehicle;
use std::collections::{BTreeMap, BTreeSet};

/// A model without effects, with the unit of every name that a formula may speak of.
pub(crate) struct TestVehicle {
    /// What a user calls it.
    pub label: String,
    pub model: Model,
    pub definitions: Definitions,
    pub units: BTreeMap<Symbol, Unit>,
}

impl TestVehicle {
    /// Every vehicle, once for each column that may stand for an input; then each that pulls, with two trailers.
    pub fn all(vehicles: &[Vehicle]) -> Result<Vec<Self>> {
        let each: Vec<Vec<Self>> = vehicles.iter().map(Self::alone).collect::<Result<_>>()?;
        let pulling = vehicles.iter().filter(|v| v.pulls());
        let trains: Vec<Self> = pulling.map(Self::train).collect::<Result<_>>()?;
        Ok(each.into_iter().flatten().chain(trains).collect())
    }

    /// One vehicle in all these ways.
    pub fn of_vehicle(vehicle: &Vehicle) -> Result<Vec<Self>> {
        Self::all(std::slice::from_ref(vehicle))
    }

    fn alone(vehicle: &Vehicle) -> Result<Vec<Self>> {
        let alone = Model::sample(vehicle)?;
        let mut found = vec![Self::of(vehicle.id.clone(), alone.clone())?];
        for (role, input) in &vehicle.inputs {
            if let Some(other) = &input.instead {
                let mut logged = alone.clone();
                logged.inputs.iter_mut().filter(|i| *i == role).for_each(|i| i.clone_from(&other.role));
                found.push(Self::of(format!("{} logged by {}", vehicle.id, other.role), logged)?);
            }
        }
        Ok(found)
    }

    fn train(vehicle: &Vehicle) -> Result<Self> {
        let train = Model::sample(vehicle)?.with_trailers(&[Trailer { length: 1.0, hitch: 1.0 }; 2]);
        Self::of(format!("{WITH_TRAILERS} behind {}", vehicle.id), train)
    }

    pub(super) fn of(label: String, model: Model) -> Result<Self> {
        let definitions = model.bare_definitions();
        let mut used: BTreeSet<Symbol> = definitions.iter().map(|(n, _)| n.clone()).collect();
        used.extend(model.values().into_keys().chain(model.states()));
        used.extend(model.inputs.iter().map(|i| Symbol::new(i)));
        let symbols = Symbols::of(&model, &definitions, &used)?;
        let unit = |s: &Symbol| Unit::parse(&symbols.get(s)?.unit);
        let mut units: BTreeMap<Symbol, Unit> = used.iter().filter_map(|s| Some((s.clone(), unit(s)?))).collect();
        if model.forced.is_some() {
            units.extend(units.clone().iter().filter_map(|(name, unit)| Some((of_any_contact(name)?, *unit))));
        }
        Ok(Self { label, model, definitions, units })
    }

    /// The names that an effect may rewrite.
    pub fn defined(&self) -> Vec<Symbol> {
        self.definitions.iter().map(|(n, _)| n.clone()).collect()
    }
}

/// The name by which an effect with a state at every contact speaks of a quantity of one: `contact_2.speed` is `contact_n.speed`.
fn of_any_contact(name: &Symbol) -> Option<Symbol> {
    let (named, quantity) = name.as_str().split_once('.').map_or((name.as_str(), None), |(n, q)| (n, Some(q)));
    let (stem, number) = named.rsplit_once('_')?;
    number.parse::<usize>().ok()?;
    Some(Symbol::new(&quantity.map_or_else(|| format!("{stem}_n"), |q| format!("{stem}_n.{q}"))))
}

/// What a log can show of a model: the rates of the pose and what the sensor measures.
pub(crate) fn visible(model: &Model) -> Vec<Symbol> {
    let fixed = ["x'", "y'", "phi'", "x_m", "y_m", "heading_m", "delay"].map(Symbol::from);
    let trailers = (1..=model.trailer_count()).map(|i| trailer_heading(i).rate());
    // Under forces speeds are states, too.
    fixed.into_iter().chain(trailers).chain(model.states().iter().map(Symbol::rate)).collect()
}

/// Every name that the given ones are made of.
pub(crate) fn reached(definitions: &Definitions, from: &[Symbol]) -> BTreeSet<Symbol> {
    let mut found: BTreeSet<Symbol> = from.iter().cloned().collect();
    let mut waiting = from.to_vec();
    while let Some(name) = waiting.pop() {
        let parts = definitions.get(&name).map(|f| f.symbols()).unwrap_or_default();
        waiting.extend(parts.into_iter().filter(|s| found.insert(s.clone())));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vehicles;

    /// A column that may stand for an input stands in its place, and leaves the others where they are.
    #[test]
    fn one_input_is_logged_by_another_column() {
        let mut seen = 0;
        for vehicle in vehicles::all() {
            let test_vehicles = TestVehicle::of_vehicle(vehicle).unwrap();
            let plain = &test_vehicles[0].model.inputs;
            for test_vehicle in test_vehicles.iter().filter(|m| m.label.contains(" logged by ")) {
                let (_, column) = test_vehicle.label.split_once(" logged by ").unwrap();
                let changed: Vec<usize> =
                    (0..plain.len()).filter(|i| plain[*i] != test_vehicle.model.inputs[*i]).collect();
                let [i] = changed[..] else { panic!("{}: {:?}", test_vehicle.label, test_vehicle.model.inputs) };
                assert_eq!(test_vehicle.model.inputs[i], column);
                assert_eq!(vehicle.inputs[&plain[i]].instead.as_ref().unwrap().role, column);
                seen += 1;
            }
        }
        assert!(seen > 0);
    }
}
