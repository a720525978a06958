//! `[[vehicle.coordinates]]` and `[[vehicle.constraints]]`: a vehicle that is more than a body with wheels.

use super::constraint_types::read_type;
use super::effect_parameter::read_unit;
use super::user_vehicle::{UserConstraint, UserVehicle};
use super::vehicle_quantities::{MAX_NAMES, check_symbol, read_meaning};
use crate::error::Result;
use crate::files::toml::location::Spot;
use crate::files::toml::spanned_table::{Section, Value};
use crate::files::toml::suggestions;
use crate::files::toml::user_file::{at_most, bounded};
use crate::formula::Symbol;
use crate::mechanism::{Constraint, ConstraintType, Momentum, Part, Slot};
use crate::vehicles::Coordinate;
use std::sync::Arc;

/// Reads the coordinates of its own, and which of them is its heading.
pub(crate) fn read_coordinates(own: &mut UserVehicle, section: &Section) -> Result<()> {
    if let Some(value) = section.get("coordinates") {
        let list = value.list("[[vehicle.coordinates]], with double brackets, before each coordinate")?;
        at_most(&value, list.len(), MAX_NAMES)?;
        for element in list {
            let table = element.section("[[vehicle.coordinates]]".into())?;
            table.only(&["name", "unit", "meaning"])?;
            let value = table.need("name", "name = \"psi\"")?;
            let name = plain(&value)?;
            if own.vehicle.coordinate(name.as_str()).is_some() {
                return Err(value.error(format!("two coordinates are called \"{name}\"")).help("remove one of them"));
            }
            own.coordinates.push(Spot::at(value.source, value.span().start));
            own.vehicle.coordinates.push(Coordinate { name, unit: read_unit(&table)?, meaning: read_meaning(&table)? });
        }
    }
    let Some(value) = section.get("heading") else { return Ok(()) };
    let heading = plain(&value)?;
    let names: Vec<&str> = own.vehicle.coordinates.iter().map(|c| c.name.as_str()).collect();
    if !names.contains(&heading.as_str()) {
        return Err(value
            .error(format!("the heading {heading} is no coordinate of its own"))
            .help(suggestions::advice(heading.as_str(), "coordinates", &names)));
    }
    own.vehicle.heading = Some(heading);
    Ok(())
}

/// A symbol that is no rate.
fn plain(value: &Value) -> Result<Symbol> {
    let name = value.text()?;
    check_symbol(value, name)?;
    match name.ends_with('\'') {
        false => Ok(Symbol::new(name)),
        true => Err(value.error(format!("\"{name}\" is a rate")).help("write it without the '")),
    }
}

/// Reads the constraints.
pub(crate) fn read_constraints(own: &mut UserVehicle, section: &Section) -> Result<()> {
    let Some(value) = section.get("constraints") else { return Ok(()) };
    let list = value.list("[[vehicle.constraints]], with double brackets, before each constraint")?;
    at_most(&value, list.len(), MAX_NAMES)?;
    for element in list {
        let table = element.section("[[vehicle.constraints]]".into())?;
        let (constraint, places) = read_constraint(&table)?;
        if own.vehicle.constraints.iter().any(|c| c.name == constraint.name) {
            let error =
                places.name.error(format!("two constraints are called \"{}\"", suggestions::shown(&constraint.name)));
            return Err(error.help("give one another name"));
        }
        own.vehicle.constraints.push(constraint);
        own.constraints.push(places);
    }
    Ok(())
}

fn read_constraint(table: &Section) -> Result<(Constraint, UserConstraint)> {
    table.only(&["name", "type", "creep", "slots", "energy", "generator"])?;
    let name = table.need("name", "name = \"rope\"")?;
    let creep = table.need("creep", "creep = \"e_c\", its coefficient")?;
    let mut places = UserConstraint {
        name: Spot::at(table.source, name.span().start),
        creep: Spot::at(table.source, creep.span().start),
        formulas: vec![],
    };
    let (name, creep) = (name.text()?, plain(&creep)?);
    let kind = read_type(&table.need("type", "type = \"momentum\", or { id = …, letter = …, form = … }")?)?;
    let constraint = match table.get("energy") {
        Some(energy) => derived(table, &energy, name, &creep, &kind, &mut places)?,
        None => filled(table, name, &creep, &kind, &mut places)?,
    };
    Ok((constraint, places))
}

/// A constraint whose slots are given.
fn filled(
    table: &Section,
    name: &str,
    creep: &Symbol,
    kind: &Arc<ConstraintType>,
    places: &mut UserConstraint,
) -> Result<Constraint> {
    let known: Vec<&str> = kind.slots.iter().filter(|s| s.formula.is_none()).map(|s| s.name.as_str()).collect();
    let example =
        format!("slots = {{ … }} with {}, such as {}", suggestions::list(&known), "\"q1'\" = \"cos(phi)*x'\"");
    let value = table.need("slots", &example)?;
    if let Some(stray) = table.get("generator") {
        return Err(stray.key_error("a generator goes with an energy").help("remove it, or write energy = \"…\""));
    }
    let entries = value.section_like("slots".into(), &example)?.entries();
    let mut slots = Vec::new();
    for entry in entries {
        if !known.contains(&entry.name.as_str()) {
            let error =
                entry.key_error(format!("type {} has no slot \"{}\"", kind.id, suggestions::shown(&entry.name)));
            return Err(error.help(suggestions::advice(&entry.name, "slots", &known)));
        }
        let text = bounded(&entry)?;
        let part = Part::of(&text.formula).map_err(|e| text.at_start(e.help(LINEAR)))?;
        if !matches!(part, Part::Rates(_)) && entry.name.ends_with('\'') {
            return Err(text.error(format!("the slot {} holds no rate", entry.name)).help(LINEAR));
        }
        slots.push((Symbol::new(&entry.name), part));
        places.formulas.push(text);
    }
    let is_given = |slot: &Slot| slots.iter().any(|(name, _)| *name == slot.name);
    if let Some(slot) = kind.slots.iter().find(|s| s.formula.is_none() && !s.optional && !is_given(s)) {
        let error = value.key_error(format!("the slot {} of type {} is missing", slot.name, kind.id));
        let meaning = if slot.meaning.is_empty() { String::new() } else { format!(", {}", slot.meaning) };
        return Err(error.help(format!("write {} = \"…\" in slots{meaning}", quoted(slot.name.as_str()))));
    }
    Constraint::of(name, kind, &slots, creep.clone())
        .map_err(|e| Spot::at(value.source, value.key_at).here(e.help("each slot holds a factor or rates")))
}

/// A key of TOML: a name with ' stands in quotes.
fn quoted(name: &str) -> String {
    if name.contains('\'') { format!("\"{name}\"") } else { name.into() }
}

const LINEAR: &str = "names that end in ' are rates: write a sum of rates with factors, such as cos(phi)*x' + b*phi'";

/// A momentum that is derived from an energy.
fn derived(
    table: &Section,
    energy: &Value,
    name: &str,
    creep: &Symbol,
    kind: &Arc<ConstraintType>,
    places: &mut UserConstraint,
) -> Result<Constraint> {
    if let Some(slots) = table.get("slots") {
        return Err(slots.key_error("the slots of a momentum with an energy are derived").help("remove them"));
    }
    if kind.id != "momentum" {
        return Err(energy.key_error("an energy gives a momentum").help("write type = \"momentum\""));
    }
    let text = bounded(energy)?;
    let example = "generator = { psi = \"1\" }, how the symmetry moves the coordinates";
    let value = table.need("generator", example)?;
    let mut generator = Vec::new();
    for entry in value.section_like("generator".into(), example)?.entries() {
        check_symbol(&entry, &entry.name)?;
        let component = bounded(&entry)?;
        generator.push((Symbol::new(&entry.name), component.formula.clone()));
        places.formulas.push(component);
    }
    let momentum = Momentum::of(&text.formula, &generator).map_err(|e| text.at_start(e))?;
    let constraint = momentum.constraint(name, creep.as_str()).map_err(|e| text.at_start(e))?;
    places.formulas.push(text);
    Ok(constraint)
}
