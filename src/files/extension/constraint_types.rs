//! `type` of `[[vehicle.constraints]]`: a constraint type of the catalogue by its id, or a new one as a table.

use super::effect_parameter::read_unit;
use super::vehicle_quantities::check_symbol;
use crate::error::Result;
use crate::files::toml::spanned_table::{Section, Value};
use crate::files::toml::suggestions;
use crate::files::toml::user_file::bounded;
use crate::formula::Symbol;
use crate::mechanism::{ConstraintType, Printed, Regimes, Slot, constraint_types};
use std::sync::Arc;

const KEYS: [&str; 12] =
    ["id", "letter", "form", "meaning", "creep", "source", "latex", "slots", "gives", "singular", "printed", "regimes"];

/// Reads a type: the id of one of the catalogue, or a table with the fields of [`ConstraintType`].
pub(crate) fn read_type(value: &Value) -> Result<Arc<ConstraintType>> {
    if value.is_text() {
        let name = value.text()?;
        let known: Vec<&str> = constraint_types().iter().map(|t| t.id.as_str()).collect();
        return ConstraintType::named(name).map_err(|_| {
            value
                .error(format!("no type of constraint is called \"{}\"", suggestions::shown(name)))
                .help(format!("{}; one of your own is {EXAMPLE}", suggestions::advice(name, "types", &known)))
        });
    }
    let table = value.section_like("type".into(), &format!("type = {EXAMPLE}"))?;
    table.only(&KEYS)?;
    let example = format!("the form, as in {EXAMPLE}");
    let form = bounded(&table.need("form", &example)?)?;
    let id = table.need("id", "id = \"cable\"")?.text()?;
    let kind = ConstraintType::new(id, letter(&table)?, &form.text).map_err(|e| form.at_start(e))?;
    Ok(Arc::new(refined(kind, &table)?))
}

const EXAMPLE: &str = "{ id = \"cable\", letter = \"C\", form = \"pays' - (1 - e)*drum*turns'\" }";

/// One capital letter that no type of the catalogue has.
fn letter(table: &Section) -> Result<char> {
    let value = table.need("letter", "letter = \"C\", for signatures")?;
    let mut chars = value.text()?.chars();
    let one = chars.next().filter(|c| c.is_ascii_uppercase() && chars.next().is_none());
    let one = one.ok_or_else(|| value.error("letter must be one capital letter").help("write letter = \"C\""))?;
    match constraint_types().iter().find(|t| t.letter == one) {
        None => Ok(one),
        Some(taken) => Err(value
            .error(format!("{one} is the letter of the type {}", taken.id))
            .help("write another, or the type of the catalogue by its id")),
    }
}

/// The type with what else the table says of it.
fn refined(kind: ConstraintType, table: &Section) -> Result<ConstraintType> {
    let text = |key: &str| table.get(key).map(|v| v.text().map(str::to_string)).transpose();
    let slot = |key: &str| table.get(key).map(|v| slot_named(&v, &kind)).transpose();
    Ok(ConstraintType {
        meaning: text("meaning")?.unwrap_or(kind.meaning.clone()),
        creep: text("creep")?.unwrap_or(kind.creep.clone()),
        source: text("source")?.unwrap_or_default(),
        latex: text("latex")?,
        gives: slot("gives")?,
        singular: slot("singular")?,
        printed: one_of(table, "printed", &[("form", Printed::Form), ("row", Printed::Row)])?,
        regimes: one_of(
            table,
            "regimes",
            &[("none", Regimes::None), ("rotation", Regimes::Rotation), ("traverse", Regimes::Traverse)],
        )?,
        slots: slots(&kind, table)?,
        ..kind
    })
}

fn slot_named(value: &Value, kind: &ConstraintType) -> Result<Symbol> {
    let name = value.text()?;
    let known: Vec<&str> = kind.slots.iter().map(|s| s.name.as_str()).collect();
    match known.contains(&name) {
        true => Ok(Symbol::new(name)),
        false => Err(value
            .error(format!("the form has no slot \"{}\"", suggestions::shown(name)))
            .help(suggestions::advice(name, "slots", &known))),
    }
}

/// One of some words; the first when left out.
fn one_of<T: Copy>(table: &Section, key: &str, words: &[(&str, T)]) -> Result<T> {
    let Some(value) = table.get(key) else { return Ok(words[0].1) };
    let word = value.text()?;
    let names: Vec<&str> = words.iter().map(|(w, _)| *w).collect();
    words.iter().find(|(w, _)| *w == word).map(|(_, t)| *t).ok_or_else(|| {
        value.error(format!("{key} cannot be \"{}\"", suggestions::shown(word))).help(suggestions::advice(
            word,
            "it is one of",
            &names,
        ))
    })
}

/// The slots as the table words and orders them; those it leaves out stay as the form names them.
fn slots(kind: &ConstraintType, table: &Section) -> Result<Vec<Slot>> {
    let Some(value) = table.get("slots") else { return Ok(kind.slots.clone()) };
    let mut found: Vec<Slot> = Vec::new();
    for element in value.list("slots = [{ name = \"drum\", meaning = \"its radius, m\" }]")? {
        let section = element.section("slots".into())?;
        section.only(&["name", "meaning", "unit", "latex", "formula", "optional"])?;
        let name = section.need("name", "name = \"drum\"")?;
        check_symbol(&name, name.text()?)?;
        let formula = section.get("formula").map(|v| bounded(&v)).transpose()?.map(|f| f.formula);
        let text = |key: &str| section.get(key).map(|v| v.text().map(str::to_string)).transpose();
        let slot = Slot {
            name: if formula.is_none() { slot_named(&name, kind)? } else { Symbol::new(name.text()?) },
            meaning: text("meaning")?.unwrap_or_default(),
            unit: section.get("unit").map(|_| read_unit(&section)).transpose()?,
            latex: text("latex")?,
            formula,
            optional: section.get("optional").map_or(Ok(false), |v| v.truth())?,
        };
        if found.iter().any(|s| s.name == slot.name) {
            return Err(name.error(format!("the slot {} is named twice", slot.name)).help("remove one of the two"));
        }
        found.push(slot);
    }
    let left = kind.slots.iter().filter(|s| found.iter().all(|f| f.name != s.name)).cloned().collect::<Vec<_>>();
    found.extend(left);
    Ok(found)
}
