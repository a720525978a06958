//! The vehicles that a user's effect applies to, and the definitions it rewrites there.

use super::test_vehicle::{TestVehicle, reached, visible};
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::files::UserEffect;
use crate::formula::{Expr, Symbol};
use std::collections::BTreeMap;

/// Vehicles named for a reason in a message.
const NAMED_VEHICLES: usize = 3;

/// A vehicle that an effect applies to, and what it rewrites there.
pub(crate) struct Place<'m> {
    pub vehicle: &'m TestVehicle,
    pub applied: Applied,
    /// Each definition and the key of its change.
    pub targets: Vec<Target>,
}

/// A definition that is rewritten.
pub(crate) struct Target {
    pub name: Symbol,
    pub key: String,
}

/// Where an effect applies; an error with reasons where that is nowhere.
pub(crate) fn places<'m>(own: &UserEffect, test_vehicles: &'m [TestVehicle]) -> Result<Vec<Place<'m>>> {
    let (mut found, mut reasons) = (Vec::new(), BTreeMap::<String, Vec<&str>>::new());
    for test_vehicle in test_vehicles {
        let trailers = own.effect.trailers(test_vehicle.model.trailer_count());
        if trailers.is_empty() {
            reasons.entry("no trailer".into()).or_default().push(&test_vehicle.label);
        }
        for trailer in trailers {
            match obstacle(&own.effect, trailer, test_vehicle) {
                Some(why) => reasons.entry(why).or_default().push(&test_vehicle.label),
                None => found.push(Place::of(&own.effect, trailer, test_vehicle)),
            }
        }
    }
    if !found.is_empty() {
        return Ok(found);
    }
    let mut reasons: Vec<_> = reasons.into_iter().collect();
    reasons.sort_by_key(|(_, labels)| std::cmp::Reverse(labels.len()));
    let reasons: Vec<String> = reasons.iter().take(NAMED_VEHICLES).map(|(why, labels)| reason(why, labels)).collect();
    Err(own
        .id
        .error(format!("the effect \"{}\" applies to no vehicle: {}", own.effect.id, reasons.join("; ")))
        .help("change only names that one vehicle defines, in formulas of names it knows; see `creepage vehicles`"))
}

fn reason(why: &str, labels: &[&str]) -> String {
    let mut distinct = labels.to_vec();
    distinct.dedup();
    let more = distinct.len().saturating_sub(NAMED_VEHICLES);
    let named = distinct.iter().take(NAMED_VEHICLES).copied().collect::<Vec<_>>().join(", ");
    if more > 0 { format!("{why} on {named} and {more} more") } else { format!("{why} on {named}") }
}

/// Why an effect does not apply.
fn obstacle(e: &Effect, trailer: Option<usize>, test_vehicle: &TestVehicle) -> Option<String> {
    let (model, names) = (&test_vehicle.model, test_vehicle.defined());
    if let Some(role) = e.needs.iter().find(|role| !model.vehicle.inputs.contains_key(*role)) {
        return Some(format!("no input {role}"));
    }
    let is_missing =
        |(key, formula): &(&String, &Expr)| Effect::of_change(key, formula).targets(&names, trailer).is_none();
    if let Some((key, _)) = e.changes.iter().find(is_missing) {
        return Some(format!("no definition of {key}"));
    }
    let targets = e.targets(&names, trailer).unwrap_or_default();
    if let Some((held, _)) = targets.iter().find(|(name, _)| model.vehicle.holds(name)) {
        return Some(format!("{held} cannot change"));
    }
    if let Some(stranger) = model.stranger(e, &names) {
        return Some(format!("no {stranger}"));
    }
    if !model.stays_open(&test_vehicle.definitions, e, trailer) {
        return Some("formulas that use each other in a circle".into());
    }
    let applied = Applied::new(e, trailer, e.parameters.values().map(|p| p.size).collect());
    let felt = model.clone().with_effect(applied).row_definitions().is_ok_and(|d| {
        let seen = reached(&d, &visible(model));
        targets.iter().any(|(name, _)| seen.contains(name))
    });
    (!felt && model.determined().is_ok()).then(|| "no influence on motion and sensor".into())
}

impl<'m> Place<'m> {
    fn of(e: &Effect, trailer: Option<usize>, test_vehicle: &'m TestVehicle) -> Self {
        let names = test_vehicle.defined();
        let sizes = e.parameters.values().map(|p| p.size).collect();
        let targets = e.changes.iter().flat_map(|(key, formula)| {
            let found = Effect::of_change(key, formula).targets(&names, trailer).unwrap_or_default();
            found.into_iter().map(|(name, _)| Target { name, key: key.clone() }).collect::<Vec<_>>()
        });
        let applied = test_vehicle.model.at_contacts(Applied::new(e, trailer, sizes));
        Self { vehicle: test_vehicle, targets: targets.collect(), applied }
    }
}
