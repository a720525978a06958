//! The list of vehicles, as text and as JSON.

use super::Signature;
use super::jacobian::rates;
use super::json::counted;
use super::page::Page;
use crate::error::Result;
use crate::formula::latex_symbol;
use crate::mechanism::Constraint;
use crate::model::{Model, Trailer, WITH_TRAILERS};
use crate::vehicles;
use crate::vehicles::Vehicle;
use serde_json::{Value, json};

/// What the entry of vehicles with trailers says.
const TRAIN: &str = "a tractor with trailers; one more direction constraint for each trailer";

/// A vehicle with one trailer behind it, every parameter one.
pub(super) fn sample_train(vehicle: &Vehicle) -> Result<Model> {
    Ok(Model::sample(vehicle)?.with_trailers(&[Trailer { length: 1.0, hitch: 1.0 }]))
}

/// Every vehicle with parameters, inputs, trailers, signature and constraint rows, as text.
///
/// ```
/// use creepage::{describe::vehicles_text, vehicles};
/// assert!(vehicles_text(vehicles::all()).unwrap().contains("## four-wheel-car"));
/// ```
///
/// # Errors
/// When a vehicle cannot be built.
pub fn vehicles_text(vehicles: &[Vehicle]) -> Result<String> {
    let mut page = Page::default();
    page.heading(1, "Vehicles");
    page.paragraph("Every row times the rates is zero. `creepage describe` shows the whole of a model.");
    for vehicle in vehicles {
        page.heading(2, &vehicle.id);
        page.paragraph(&vehicle.title);
        for (name, p) in &vehicle.parameters {
            let optional = if p.optional { ", optional" } else { "" };
            page.entry(&format!("parameter {name} ({}{optional}): {}", p.unit, p.meaning));
        }
        for (role, i) in &vehicle.inputs {
            let instead = i.instead.as_ref().map(|o| format!(", or {} ({})", o.role, o.unit)).unwrap_or_default();
            page.entry(&format!("input {role} ({}){instead}: {}", i.unit, i.meaning));
        }
        for (i, t) in (1..).zip(&vehicle.trailers) {
            page.entry(&format!("trailer {i}: {}, {} from hitch to axle", t.name, t.length));
        }
        if let Some(advice) = &vehicle.instead {
            page.entry(&format!("motion: not determined by its constraints; {advice}"));
        }
        rows(&mut page, &Model::sample(vehicle)?);
    }
    page.heading(2, WITH_TRAILERS);
    page.paragraph(TRAIN);
    let ids: Vec<&str> = tractors(vehicles).map(|v| v.id.as_str()).collect();
    page.entry(&format!("tractor: {}; car when left out", ids.join(", ")));
    page.entry("parameter trailer_lengths (m): from hitch to axle, nearest first");
    page.entry("parameter hitch_offsets (m, optional): hitch behind the axle ahead of it");
    for vehicle in tractors(vehicles) {
        let [r, t] = letters(vehicle)?;
        page.entry(&format!("signature of N trailers behind {}: {}T^{}", vehicle.id, power('R', r), exponent(t)));
    }
    let all = sample_train(&first())?;
    let constraints = all.constraints();
    page.line("The row of the first trailer:");
    row(&mut page, &all, &constraints[constraints.len() - 1]);
    Ok(page.finished())
}

/// The vehicles that trailers can be put behind.
pub(super) fn tractors(vehicles: &[Vehicle]) -> impl Iterator<Item = &Vehicle> {
    vehicles.iter().filter(|v| v.pulls())
}

/// How many constraints of type R and of type T a tractor has.
fn letters(vehicle: &Vehicle) -> Result<[usize; 2]> {
    let signature = Signature::of(&Model::sample(vehicle)?.constraints());
    Ok(['R', 'T'].map(|letter| signature.count(letter)))
}

fn power(letter: char, n: usize) -> String {
    match n {
        0 => String::new(),
        1 => format!("{letter} "),
        n => format!("{letter}^{n} "),
    }
}

fn rows(page: &mut Page, model: &Model) {
    let constraints = model.constraints();
    page.entry(&format!("signature: {}", Signature::of(&constraints)));
    page.gap();
    for c in &constraints {
        page.line(&format!("{} (type {}, {}):", c.name, c.letter(), c.creep));
        row(page, model, c);
    }
}

fn row(page: &mut Page, model: &Model, c: &Constraint) {
    page.formula(&format!("{} = 0", c.row().ordered(&rates(&model.coordinates()))));
}

/// The vehicle whose trailers show the row of a trailer.
fn first() -> Vehicle {
    vehicles::all().first().cloned().unwrap_or_default()
}

/// Every vehicle as JSON.
///
/// # Errors
/// As [`vehicles_text`].
pub fn vehicles_json(vehicles: &[Vehicle]) -> Result<Value> {
    let single = vehicles.iter().map(|v| entry(v, &Model::sample(v)?)).collect::<Result<Vec<Value>>>()?;
    Ok(json!({ "schema": 1, "vehicles": single.into_iter().chain([train(vehicles)?]).collect::<Vec<_>>() }))
}

fn entry(vehicle: &Vehicle, model: &Model) -> Result<Value> {
    let parameter = |(name, p): (&String, &vehicles::Quantity)| json!({ "name": name, "unit": p.unit, "meaning": p.meaning, "optional": p.optional });
    let input = |(role, i): (&String, &vehicles::Input)| {
        let instead =
            i.instead.as_ref().map(|o| json!({ "role": o.role, "unit": o.unit, "formula": o.formula.to_string() }));
        json!({ "role": role, "unit": i.unit, "meaning": i.meaning, "instead": instead })
    };
    let trailer =
        |t: &vehicles::Section| json!({ "name": t.name, "length": t.length.to_string(), "hitch": t.hitch.to_string() });
    let constraints = model.constraints();
    let signature = Signature::of(&constraints);
    let mut entry = json!({
        "id": vehicle.id, "title": vehicle.title, "undetermined": vehicle.instead,
        "parameters": vehicle.parameters.iter().map(parameter).collect::<Vec<_>>(),
        "inputs": vehicle.inputs.iter().map(input).collect::<Vec<_>>(),
        "signature": counted(&signature, &[("text", signature.to_string())]),
        "constraints": constraints.iter().map(|c| constraint(model, c)).collect::<Vec<_>>(),
    });
    if !vehicle.trailers.is_empty() {
        entry["trailers"] = vehicle.trailers.iter().map(trailer).collect();
    }
    Ok(entry)
}

fn constraint(model: &Model, c: &Constraint) -> Value {
    let row = c.row().ordered(&rates(&model.coordinates())).expr();
    json!({
        "name": c.name, "form": c.letter().to_string(), "creep": c.creep.as_str(), "creep_latex": latex_symbol(&c.creep),
        "row": { "text": row.to_string(), "latex": row.latex() },
    })
}

/// How many traverse coefficients a vehicle with N trailers has, as an exponent.
fn exponent(t: usize) -> String {
    if t == 0 { "N".into() } else { format!("(N+{t})") }
}

fn train(vehicles: &[Vehicle]) -> Result<Value> {
    let parameter = |name: &str, meaning: &str, optional: bool| json!({ "name": name, "unit": "m", "meaning": meaning, "optional": optional });
    let tractor = |v: &Vehicle| -> Result<Value> {
        let [r, t] = letters(v)?;
        let text = format!("{}T^{}", power('R', r), exponent(t));
        Ok(json!({ "id": v.id, "signature": { "r": r, "t": exponent(t).trim_matches(['(', ')']), "text": text } }))
    };
    let model = sample_train(&first())?;
    let constraints = model.constraints();
    Ok(json!({
        "id": WITH_TRAILERS, "title": TRAIN,
        "parameters": [
            parameter("trailer_lengths", "from hitch to axle, nearest first", false),
            parameter("hitch_offsets", "hitch behind the axle ahead of it", true),
        ],
        "tractors": tractors(vehicles).map(tractor).collect::<Result<Vec<_>>>()?,
        "constraints": [constraint(&model, &constraints[constraints.len() - 1])],
    }))
}
