//! The effects of one vehicle, with the equations they rewrite and their relatives.

use super::page::Page;
use super::vehicles::{sample_train, tractors};
use crate::discrepancy::identity::{Change, Measured, Relation, relation};
use crate::discrepancy::picture::equation;
use crate::effects::{Applied, Effect};
use crate::error::{Error, Result};
use crate::files::advice;
use crate::model::{Model, WITH_TRAILERS};
use crate::vehicles::Vehicle;
use rayon::prelude::*;
use serde_json::{Value, json};

/// Every effect that applies to a vehicle: the equations it rewrites, and the effects that are the same under another
/// name, as text.
///
/// The sensor is taken to sit at the reference point and to measure heading and trailers.
///
/// # Errors
/// When no vehicle has that name, or its constraints do not determine its motion.
///
/// ```
/// use creepage::{describe::vehicle_effects_text, effects, vehicles};
/// let car = vehicle_effects_text("car", vehicles::all(), effects::all()).unwrap();
/// assert!(car.contains("identical to wheel-radius: wheel_radius.scale = -rotation_creep.e_rc"));
/// ```
pub fn vehicle_effects_text(vehicle: &str, vehicles: &[Vehicle], library: &[Effect]) -> Result<String> {
    let model = model_of(vehicle, vehicles)?;
    model.determined()?;
    let all: Vec<Applied> = model.applicable(library).into_iter().map(|(e, t)| open(e, t)).collect();
    let related: Vec<Vec<String>> = all.par_iter().map(|a| relatives(&model, a, &all)).collect();
    let mut page = Page::default();
    page.heading(1, &format!("Effects on {vehicle}"));
    for (a, related) in all.iter().zip(related) {
        page.heading(2, &a.label());
        page.paragraph(&format!("{}.", a.effect.says));
        related.iter().for_each(|line| page.entry(line));
        equation(a, &model).split("; ").for_each(|line| page.formula(line));
    }
    Ok(page.finished())
}

/// As [`vehicle_effects_text`], as JSON: id, trailer, meaning, equations and relatives of every effect.
///
/// # Errors
/// As [`vehicle_effects_text`].
pub fn vehicle_effects_json(vehicle: &str, vehicles: &[Vehicle], library: &[Effect]) -> Result<Value> {
    let model = model_of(vehicle, vehicles)?;
    model.determined()?;
    let all: Vec<Applied> = model.applicable(library).into_iter().map(|(e, t)| open(e, t)).collect();
    let entry = |a: &Applied| {
        let equation = equation(a, &model);
        json!({
            "id": a.effect.id, "trailer": a.trailer, "where": a.effect.place, "says": a.effect.says,
            "equations": equation.split("; ").collect::<Vec<_>>(), "relatives": relatives(&model, a, &all),
        })
    };
    let entries: Vec<Value> = all.par_iter().map(entry).collect();
    Ok(json!({ "schema": 1, "vehicle": vehicle, "effects": entries }))
}

fn open(effect: &Effect, trailer: Option<usize>) -> Applied {
    Applied::new(effect, trailer, effect.starts().swap_remove(0)).freed()
}

/// The vehicle with every parameter one and no arm to its sensor.
fn model_of(name: &str, vehicles: &[Vehicle]) -> Result<Model> {
    let unknown = || {
        let ids: Vec<&str> = vehicles.iter().map(|v| v.id.as_str()).chain([WITH_TRAILERS]).collect();
        Error::input(format!("no vehicle is called {name:?}")).help(advice(name, "known vehicles", &ids))
    };
    match vehicles.iter().find(|v| v.id == name) {
        Some(vehicle) => Model::sample(vehicle),
        None if name == WITH_TRAILERS => {
            let car = tractors(vehicles).find(|v| v.id == "car").or_else(|| tractors(vehicles).next());
            sample_train(car.ok_or_else(unknown)?)
        }
        None => Err(unknown()),
    }
}

/// What an effect is to each of the others, as far as it is anything.
fn relatives(model: &Model, a: &Applied, all: &[Applied]) -> Vec<String> {
    let others = all.iter().filter(|b| !b.same_as(a));
    others
        .filter_map(|b| words(&relation(model, std::slice::from_ref(a), std::slice::from_ref(b), Measured::ALL), b))
        .collect()
}

fn words(relation: &Relation, other: &Applied) -> Option<String> {
    let name = other.label();
    Some(match relation {
        Relation::Identical(change) => format!("identical to {name}: {}", formulas(change)),
        Relation::Contained(change) => format!("a special case of {name}: {}", formulas(change)),
        Relation::Contains(change) => format!("{name} is a special case of it: {}", formulas(change)),
        Relation::FirstOrder => format!("agrees with {name} to first order"),
        Relation::Different => return None,
    })
}

fn formulas(change: &Change) -> String {
    change.iter().map(|(s, f)| format!("{s} = {f}")).collect::<Vec<_>>().join(", ")
}
