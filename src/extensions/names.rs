//! The check of names in a user's formulas.

use super::applicability::Place;
use super::test_vehicle::TestVehicle;
use crate::effects::Effect;
use crate::error::Result;
use crate::files::{FormulaText, UserEffect, advice};
use crate::formula::{Expr, Symbol};
use std::collections::BTreeMap;

/// That some vehicle knows every name.
pub(crate) fn check(own: &UserEffect, test_vehicles: &[TestVehicle]) -> Result<()> {
    check_needs(own, test_vehicles)?;
    let defined = common(test_vehicles.iter().flat_map(TestVehicle::defined));
    for (key, (spot, _)) in &own.changes {
        if !stands(key, &defined) {
            let names: Vec<&str> = defined.iter().map(Symbol::as_str).collect();
            let error = spot.error(format!("no vehicle defines \"{key}\""));
            return Err(error.help(advice(key, "there are", &names)));
        }
    }
    let known = common(test_vehicles.iter().flat_map(|m| m.units.keys().cloned()));
    for (_, formula) in own.changes.values() {
        check_formula(own, formula, &known, true)?;
    }
    own.rates.values().try_for_each(|rate| check_formula(own, rate, &known, false))
}

/// Whether some of these vehicles defines everything that the effect changes.
pub(crate) fn are_defined(own: &UserEffect, test_vehicles: &[TestVehicle]) -> bool {
    let defined: Vec<Symbol> = test_vehicles.iter().flat_map(TestVehicle::defined).collect();
    own.changes.keys().all(|key| stands(key, &defined))
}

/// Whether one of these definitions is changed by this name.
fn stands(key: &str, defined: &[Symbol]) -> bool {
    let only = Effect::of_change(key, &Expr::int(0));
    [None, Some(1)].into_iter().any(|trailer| only.targets(defined, trailer).is_some())
}

fn check_needs(own: &UserEffect, test_vehicles: &[TestVehicle]) -> Result<()> {
    let inputs = common(test_vehicles.iter().flat_map(|m| m.model.vehicle.inputs.keys().map(|i| Symbol::new(i))));
    let inputs: Vec<&str> = inputs.iter().map(Symbol::as_str).collect();
    for (role, spot) in own.effect.needs.iter().zip(&own.needs) {
        if !inputs.contains(&role.as_str()) {
            let error = spot.error(format!("no vehicle has the input \"{}\"", crate::files::shown(role)));
            return Err(error.help(advice(role, "inputs", &inputs)));
        }
    }
    Ok(())
}

/// Each name once, those that most vehicles have first.
fn common(names: impl Iterator<Item = Symbol>) -> Vec<Symbol> {
    let mut counts: BTreeMap<Symbol, usize> = BTreeMap::new();
    names.for_each(|n| *counts.entry(n).or_default() += 1);
    let mut found: Vec<_> = counts.into_iter().collect();
    found.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    found.into_iter().map(|(n, _)| n).collect()
}

fn check_formula(own: &UserEffect, formula: &FormulaText, known: &[Symbol], is_change: bool) -> Result<()> {
    for s in formula.formula.symbols() {
        let name = s.as_str();
        if name == "it" && !is_change {
            let error = formula.error_at(&s, "a rate has no `it`");
            return Err(error.help("`it` is a definition as it was, in a formula below [effect.changes]"));
        }
        if name == "it" || own.names.contains_key(name) || known.contains(&s) {
            continue;
        }
        let candidates: Vec<&str> =
            own.names.keys().map(String::as_str).chain(known.iter().map(Symbol::as_str)).collect();
        let error = formula.error_at(&s, format!("no vehicle knows the name \"{}\"", crate::files::shown(name)));
        return Err(error.help(advice(name, "there are", &candidates)));
    }
    Ok(())
}

/// That no parameter or state hides a name of a vehicle.
pub(crate) fn check_clash(own: &UserEffect, place: &Place) -> Result<()> {
    for (name, spot) in &own.names {
        if place.vehicle.units.contains_key(&Symbol::new(name)) {
            let error = spot.error(format!("{name} is also a name of the vehicle {}", place.vehicle.label));
            return Err(error.help("give the parameter or state another name"));
        }
    }
    Ok(())
}
