//! The list of effects, as text and as JSON.

use super::page::Page;
use super::vehicles::{sample_train, tractors};
use crate::effects::{Effect, Parameter};
use crate::error::Result;
use crate::formula::{Symbol, latex_symbol};
use crate::model::Model;
use crate::model::WITH_TRAILERS;
use crate::vehicles::Vehicle;
use serde_json::{Map, Value, json};

/// How changes are to be read.
const READING: &str = "In a change, `it` is the definition as it was; a name ending in * is every definition of that \
                       stem; {trailer} is the number of the trailer. An effect vanishes where its parameters are 0; a \
                       positive parameter approaches that without reaching it.";

/// Every effect of a library with parameters, changes and the vehicles it applies to, as text.
///
/// # Errors
/// When a vehicle of the catalogue cannot be built.
pub fn effects_text(vehicles: &[Vehicle], library: &[Effect]) -> Result<String> {
    let mut page = Page::default();
    page.heading(1, "Effects");
    page.paragraph(READING);
    for e in library {
        page.heading(2, &e.id);
        page.paragraph(&format!("{}. Acts on the {}; source: {}.", e.says, e.place, e.source));
        e.parameters.iter().for_each(|(name, p)| page.entry(&format!("{name}: {}", parameter_text(p))));
        page.entry(&format!("vehicles: {}", applies_to(e, vehicles)?.join(", ")));
        e.changes.iter().for_each(|(name, f)| page.formula(&format!("{name} = {f}")));
        e.states.iter().for_each(|(name, s)| page.formula(&format!("{name}' = {}", s.rate)));
    }
    Ok(page.finished())
}

fn parameter_text(p: &Parameter) -> String {
    let unit = if p.unit == "1" { "a number".to_string() } else { p.unit.clone() };
    let [low, high] = p.range;
    let edge = if p.positive { "above" } else { "from" };
    let wraps = if p.periodic { ", an angle that wraps" } else { "" };
    format!("{unit}, {edge} {low} to {high}, usual size {}{wraps}", p.size)
}

/// The ids of the vehicles it applies to.
fn applies_to<'v>(e: &Effect, vehicles: &'v [Vehicle]) -> Result<Vec<&'v str>> {
    let mut found = Vec::new();
    for v in vehicles {
        if applies(e, &Model::sample(v)?) {
            found.push(v.id.as_str());
        }
    }
    for v in tractors(vehicles) {
        if !found.contains(&WITH_TRAILERS) && applies(e, &sample_train(v)?) {
            found.push(WITH_TRAILERS);
        }
    }
    Ok(found)
}

/// Whether an effect applies to a model; one that acts on an input, on any of its inputs, and one on a sensor beside the
/// pose wherever there is one.
fn applies(e: &Effect, model: &Model) -> bool {
    e.per_quantity || !model.applicable(&model.on_each_input(e)).is_empty()
}

/// Every effect of a library as JSON.
///
/// # Errors
/// As [`effects_text`].
pub fn effects_json(vehicles: &[Vehicle], library: &[Effect]) -> Result<Value> {
    let entries = library.iter().map(|e| entry(e, vehicles)).collect::<Result<Vec<_>>>()?;
    Ok(json!({ "schema": 1, "reading": READING, "effects": entries }))
}

fn entry(e: &Effect, vehicles: &[Vehicle]) -> Result<Value> {
    let parameter = |p: &Parameter| json!({ "unit": p.unit, "range": p.range, "size": p.size, "positive": p.positive, "periodic": p.periodic });
    let parameters: Map<String, Value> = e.parameters.iter().map(|(name, p)| (name.clone(), parameter(p))).collect();
    let change = |(name, f): (&String, &crate::formula::Expr)| json!({ "name": name, "formula": { "text": f.to_string(), "latex": f.latex() } });
    let state = |(name, s): (&String, &crate::effects::State)| {
        let rate = json!({ "text": s.rate.to_string(), "latex": s.rate.latex() });
        json!({ "name": name, "latex": latex_symbol(&Symbol::new(name)), "unit": s.unit, "rate": rate })
    };
    Ok(json!({
        "id": e.id, "where": e.place, "says": e.says, "source": e.source, "per_trailer": e.per_trailer,
        "limit": e.limit,
        "parameters": parameters,
        "changes": e.changes.iter().map(change).collect::<Vec<_>>(),
        "states": e.states.iter().map(state).collect::<Vec<_>>(),
        "vehicles": applies_to(e, vehicles)?,
    }))
}
