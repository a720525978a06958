//! The effects of one vehicle, with the equations they rewrite and their relatives.

use super::page::Page;
use super::vehicles::{sample_train, tractors};
use crate::effects::{Applied, Effect};
use crate::equivalence::{Change, Measured, Relation, relation};
use crate::error::{Error, Result};
use crate::files::advice;
use crate::model::effect_equation::equation;
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
    let all = applied(&model, library);
    let related: Vec<Vec<String>> = all.par_iter().map(|a| relatives(&model, a, &all, str::to_string)).collect();
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

/// Every effect on every vehicle, or on one: the equations it rewrites and its relatives, a Markdown page with a table for
/// each vehicle.
///
/// Vehicles whose constraints leave their motion open are named at the end.
///
/// # Errors
/// When no vehicle has that name, one cannot be built, or the constraints of the only one do not determine its motion.
///
/// ```
/// use creepage::{describe::every_effect_page, effects, vehicles};
/// let page = every_effect_page(Some("car"), vehicles::all(), effects::all()).unwrap();
/// assert!(page.contains("| `wheel-radius` | `r = wheel_radius*(1 + scale)` | identical to `rotation-creep`"));
/// ```
pub fn every_effect_page(only: Option<&str>, vehicles: &[Vehicle], library: &[Effect]) -> Result<String> {
    let ids: Vec<&str> = match only {
        Some(id) => vec![id],
        None => ids_of(vehicles),
    };
    let mut page = format!("# Every effect on every vehicle\n\n{PAGE}\n");
    let mut open = Vec::new();
    for id in ids {
        let model = model_of(id, vehicles)?;
        match model.determined() {
            Ok(()) => page += &format!("\n## {id}\n\n{}", table(&model, &applied(&model, library))),
            Err(why) if only.is_some() => return Err(why),
            Err(_) => open.push(format!("`{id}`")),
        }
    }
    if !open.is_empty() {
        let open = open.join(", ");
        page += &format!("\nNo effect is fitted on {open}: their constraints alone do not determine their motion.\n");
    }
    Ok(page)
}

/// What stands above the tables.
const PAGE: &str = "What `discover` can name, with the equations that stand in the patched model; letters are those of \
                    `creepage describe`. The sensor sits at the reference point and measures heading and trailers.";

fn table(model: &Model, all: &[Applied]) -> String {
    if all.is_empty() {
        return "No effect applies.\n".into();
    }
    let rows: Vec<String> = all.par_iter().map(|a| table_row(model, a, all)).collect();
    format!("| effect | what it rewrites | relatives |\n|---|---|---|\n{}", rows.concat())
}

fn table_row(model: &Model, a: &Applied, all: &[Applied]) -> String {
    let code = |text: &str| format!("`{text}`");
    let equations: Vec<String> = equation(a, model).split("; ").map(code).collect();
    let relatives = relatives(model, a, all, code).join("<br>");
    format!("| {} | {} | {relatives} |\n", code(&a.label()), equations.join("<br>"))
}

fn applied(model: &Model, library: &[Effect]) -> Vec<Applied> {
    model.applicable(library).into_iter().map(|(e, t)| open(e, t)).collect()
}

/// As [`vehicle_effects_text`], as JSON: id, trailer, meaning, equations and relatives of every effect.
///
/// # Errors
/// As [`vehicle_effects_text`].
pub fn vehicle_effects_json(vehicle: &str, vehicles: &[Vehicle], library: &[Effect]) -> Result<Value> {
    let model = model_of(vehicle, vehicles)?;
    model.determined()?;
    let all = applied(&model, library);
    let entry = |a: &Applied| {
        let equation = equation(a, &model);
        json!({
            "id": a.effect.id, "trailer": a.trailer, "where": a.effect.place, "says": a.effect.says,
            "equations": equation.split("; ").collect::<Vec<_>>(), "relatives": relatives(&model, a, &all, str::to_string),
        })
    };
    let entries: Vec<Value> = all.par_iter().map(entry).collect();
    Ok(json!({ "schema": 1, "vehicle": vehicle, "effects": entries }))
}

/// What `--vehicle` may name.
fn ids_of(vehicles: &[Vehicle]) -> Vec<&str> {
    vehicles.iter().map(|v| v.id.as_str()).chain([WITH_TRAILERS]).collect()
}

fn open(effect: &Effect, trailer: Option<usize>) -> Applied {
    Applied::new(effect, trailer, effect.starts().swap_remove(0)).freed()
}

/// The vehicle with every parameter one and no arm to its sensor.
fn model_of(name: &str, vehicles: &[Vehicle]) -> Result<Model> {
    let unknown = || {
        Error::input(format!("no vehicle is called {name:?}")).help(advice(name, "known vehicles", &ids_of(vehicles)))
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

/// What an effect is to each of the others, as far as it is anything; names and formulas set as they are to be.
fn relatives(model: &Model, a: &Applied, all: &[Applied], set: impl Fn(&str) -> String) -> Vec<String> {
    let others = all.iter().filter(|b| !b.same_as(a));
    let known = |b: &Applied| relation(model, std::slice::from_ref(a), std::slice::from_ref(b), Measured::ALL);
    others.filter_map(|b| words(&known(b), &set(&b.label()), &set)).collect()
}

fn words(relation: &Relation, name: &str, set: impl Fn(&str) -> String) -> Option<String> {
    let formulas = |change: &Change| {
        let all: Vec<String> = change.iter().map(|(s, f)| set(&format!("{s} = {f}"))).collect();
        all.join(", ")
    };
    Some(match relation {
        Relation::Identical(change) => format!("identical to {name}: {}", formulas(change)),
        Relation::Contained(change) => format!("a special case of {name}: {}", formulas(change)),
        Relation::Contains(change) => format!("{name} is a special case of it: {}", formulas(change)),
        Relation::FirstOrder => format!("agrees with {name} to first order"),
        Relation::Different => return None,
    })
}
