//! `[vehicle.parameters.…]`, `[vehicle.inputs.…]` and `[vehicle.define]`: parameters, inputs and defined symbols.

use super::effect_parameter::read_unit;
use super::user_vehicle::UserVehicle;
use crate::error::Result;
use crate::files::toml::formula_text::FormulaText;
use crate::files::toml::spanned_table::{Section, Value};
use crate::files::toml::suggestions::shown;
use crate::files::toml::user_file::at_most;
use crate::formula::{Fun, Symbol};
use crate::vehicles::{Definition, Input, Instead, Moves, Quantity};
use serde::Deserialize;
use serde::de::IntoDeserializer;
use serde::de::value::StrDeserializer;

/// The most parameters, inputs, defined symbols, coordinates or constraints of a vehicle: the constraints are
/// solved as formulas, and the time for this grows faster than their number.
pub(crate) const MAX_NAMES: usize = 60;
/// Keys of a model file's `[parameters]` and `[columns]` that mean something of every vehicle, and `it` of effects.
const TAKEN: [&str; 7] = ["tractor", "trailer_lengths", "hitch_offsets", "time", "heading", "trailer_headings", "it"];

/// The tables below a heading, each with its name.
fn tables<'a, 'd>(section: &Section<'a, 'd>, key: &str) -> Result<Vec<Value<'a, 'd>>> {
    let Some(value) = section.get(key) else { return Ok(vec![]) };
    let entries = value.section(format!("[vehicle.{key}]"))?.entries();
    at_most(&value, entries.len(), MAX_NAMES)?;
    Ok(entries)
}

/// Reads the parameters.
pub(crate) fn read_quantities(own: &mut UserVehicle, section: &Section) -> Result<()> {
    for entry in tables(section, "parameters")? {
        check_role(&entry, &entry.name)?;
        own.declare(Symbol::new(&entry.name), &entry)?;
        let table = entry.section(format!("[vehicle.parameters.{}]", entry.name))?;
        table.only(&["unit", "meaning", "optional"])?;
        let optional = table.get("optional").map_or(Ok(false), |v| v.truth())?;
        let quantity = Quantity { unit: read_unit(&table)?, meaning: read_meaning(&table)?, optional };
        own.vehicle.parameters.insert(entry.name.clone(), quantity);
    }
    Ok(())
}

/// Reads the inputs.
pub(crate) fn read_inputs(own: &mut UserVehicle, section: &Section) -> Result<()> {
    for entry in tables(section, "inputs")? {
        check_role(&entry, &entry.name)?;
        own.declare(Symbol::new(&entry.name), &entry)?;
        let table = entry.section(format!("[vehicle.inputs.{}]", entry.name))?;
        table.only(&["unit", "meaning", "moves", "instead"])?;
        let instead = table.get("instead").map(|v| read_instead(own, &entry.name, &v)).transpose()?;
        let moves = read_moves(&table)?;
        let input = Input { unit: read_unit(&table)?, meaning: read_meaning(&table)?, moves, instead };
        own.vehicle.inputs.insert(entry.name.clone(), input);
    }
    Ok(())
}

fn read_instead(own: &mut UserVehicle, input: &str, value: &Value) -> Result<Instead> {
    let example = "instead = { role = \"speed\", unit = \"m/s\", formula = \"speed/wheel_radius\" }";
    let table = value.section_like("instead".into(), example)?;
    table.only(&["role", "unit", "formula", "moves"])?;
    let role = table.need("role", example)?;
    check_role(&role, role.text()?)?;
    own.declare(Symbol::new(role.text()?), &role)?;
    let formula = FormulaText::read(&table.need("formula", example)?)?;
    let instead = Instead {
        role: role.text()?.into(),
        moves: read_moves(&table)?,
        unit: read_unit(&table)?,
        formula: formula.formula.clone(),
    };
    own.replaced.insert(input.into(), formula);
    Ok(instead)
}

/// Reads what an input does to the body; where it is left out, the usual names say it.
fn read_moves(section: &Section) -> Result<Option<Moves>> {
    let Some(value) = section.get("moves") else { return Ok(None) };
    let named: StrDeserializer<'_, serde::de::value::Error> = value.text()?.into_deserializer();
    Moves::deserialize(named).map(Some).map_err(|e| value.error(format!("moves: {e}")))
}

/// Reads the defined symbols.
pub(crate) fn read_definitions(own: &mut UserVehicle, section: &Section) -> Result<()> {
    let example = "r = { formula = \"wheel_radius\", unit = \"m\", meaning = \"rolling radius\" }";
    for entry in tables(section, "define")? {
        check_symbol(&entry, &entry.name)?;
        let symbol = Symbol::new(&entry.name);
        own.declare(symbol.clone(), &entry)?;
        let table = entry.section_like(format!("[vehicle.define.{}]", entry.name), example)?;
        table.only(&["formula", "unit", "meaning"])?;
        let formula = FormulaText::read(&table.need("formula", example)?)?;
        let (unit, meaning) = (read_unit(&table)?, read_meaning(&table)?);
        let definition = Definition { formula: formula.formula.clone(), unit, meaning };
        own.vehicle.define.insert(symbol.clone(), definition);
        own.define.insert(symbol, formula);
    }
    Ok(())
}

/// Reads `meaning`, one line on what a quantity is.
pub(crate) fn read_meaning(section: &Section) -> Result<String> {
    Ok(section.need("meaning", "meaning = \"what it is, in a line\"")?.text()?.to_string())
}

/// A name that is a key of model files or a column of logs.
fn check_role(value: &Value, name: &str) -> Result<()> {
    let plain = name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.len() <= 60
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        && Fun::named(name).is_none();
    match plain && !TAKEN.contains(&name) {
        true => Ok(()),
        false => Err(value.key_error(format!("\"{}\" cannot name a parameter or an input", shown(name))).help(
            "begin with a letter, go on with letters, digits and _; functions, it, and time, heading, tractor and other \
             keys of model files are taken",
        )),
    }
}

/// A name of formulas: as a role, with primes for rates.
pub(crate) fn check_symbol(value: &Value, name: &str) -> Result<()> {
    let stem = name.trim_end_matches('\'');
    let plain = stem.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.len() <= 60
        && stem.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        && Symbol::new(name).is_well_formed();
    match plain && name != "it" {
        true => Ok(()),
        false => Err(value.error(format!("\"{}\" is no symbol", shown(name))).help(
            "begin with a letter, go on with letters, digits and _, end with ' for a rate; functions and it are taken",
        )),
    }
}
