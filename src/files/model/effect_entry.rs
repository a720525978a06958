//! `[[effects]]`: the effects that a model already includes, with their values.

use super::known::{Known, KnownEffect, KnownInput, KnownParameter};
use super::measured::MeasuredEntry;
use super::prior_entry::{KnownBefore, read_known};
use super::scope_entry::{CourseEntry, read_course, read_scope};
use crate::effects::Scope;
use crate::error::{Error, Result};
use crate::files::toml::spanned_table::{Section, Value};
use crate::files::toml::suggestions;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// An effect with its values, as one entry of a model file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EffectEntry {
    /// Which effect.
    pub id: String,
    /// The trailer it acts on, 1 = nearest the tractor, for an effect that acts on one.
    pub trailer: Option<usize>,
    /// The role of the input it acts on, or the name of the measured quantity, for an effect that acts on one.
    pub input: Option<String>,
    /// Whether that is a quantity measured beside the pose, named by the key `measured`.
    pub of_sensor: bool,
    /// When, where or in which regime it holds.
    pub scope: Option<Scope>,
    /// Which of its parameters moves with time.
    pub course: Option<CourseEntry>,
    /// Its parameters, in their own units.
    pub parameters: BTreeMap<String, f64>,
    /// What is known of its parameters before any run, for `fit`.
    pub known: BTreeMap<String, KnownBefore>,
    /// The line of the model file where the entry begins; 0 for one that is not in a file.
    pub line: usize,
    /// The file of effects that defines it, for an effect of a user's own that is to be written into a model file.
    pub defined_in: Option<PathBuf>,
}

impl EffectEntry {
    /// Both say something of the same target, so that a model file may hold only one of them.
    pub fn same_target(&self, other: &EffectEntry) -> bool {
        self.id == other.id && self.trailer == other.trailer && self.input == other.input
    }

    /// Id and target in words.
    pub fn title(&self) -> String {
        match (self.trailer, &self.input) {
            (Some(trailer), _) => format!("\"{}\" on trailer {trailer}", self.id),
            (None, Some(input)) => format!("\"{}\" on {input}", self.id),
            (None, None) => format!("\"{}\"", self.id),
        }
    }
}

/// Reads all entries of a model file.
pub(crate) fn read_effects(
    top: &Section,
    known: &Known,
    trailers: usize,
    inputs: &[&KnownInput],
    measured: &[MeasuredEntry],
) -> Result<Vec<EffectEntry>> {
    let Some(value) = top.get("effects") else { return Ok(Vec::new()) };
    let mut entries: Vec<EffectEntry> = Vec::new();
    for element in value.list("[[effects]], with double brackets, before each effect")? {
        let section = element.section("[[effects]]".into())?;
        let entry = read_entry(&section, known, trailers, (inputs, measured))?;
        if let Some(first) = entries.iter().find(|e| e.same_target(&entry)) {
            return Err(section
                .error(format!("effect {} is listed twice, first at line {}", entry.title(), first.line))
                .help("merge the two entries into one"));
        }
        entries.push(entry);
    }
    Ok(entries)
}

fn read_entry(
    section: &Section,
    known: &Known,
    trailers: usize,
    (inputs, measured): (&[&KnownInput], &[MeasuredEntry]),
) -> Result<EffectEntry> {
    let id = section.need("id", "id = \"…\"; `creepage effects` lists the ids")?;
    let effect = find(&id, known)?;
    let mut keys = vec!["id", "scope", "course", "prior", "bounds"];
    keys.extend((effect.per_input || effect.input_optional).then_some("input"));
    keys.extend(effect.per_quantity.then_some("measured"));
    keys.extend(effect.per_trailer.then_some("trailer"));
    keys.extend(effect.parameters.iter().map(|p| p.name.as_str()));
    section.only(&keys)?;
    let trailer = if effect.per_trailer { Some(read_trailer(section, &id, trailers)?) } else { None };
    let named = effect.per_input || effect.input_optional && section.get("input").is_some();
    let input = match (named, effect.per_quantity) {
        (true, _) => Some(read_input(section, &id, inputs)?),
        (false, true) => Some(read_measured(section, &id, measured)?),
        (false, false) => None,
    };
    let mut parameters = BTreeMap::new();
    for parameter in &effect.parameters {
        parameters.insert(parameter.name.clone(), read_parameter(section, effect, parameter)?);
    }
    Ok(EffectEntry {
        id: effect.id.clone(),
        trailer,
        input,
        of_sensor: effect.per_quantity,
        scope: read_scope(section)?,
        course: read_course(section, effect)?,
        known: read_known(section, effect)?,
        parameters,
        line: section.source.line(section.at),
        defined_in: None,
    })
}

fn find<'k>(id: &Value, known: &'k Known) -> Result<&'k KnownEffect> {
    let name = id.text()?;
    known.effect(name).ok_or_else(|| {
        let ids: Vec<&str> = known.effects.iter().map(|e| e.id.as_str()).collect();
        id.error(format!("unknown effect \"{}\"", suggestions::shown(name))).help(format!(
            "if it is your own, give its file with --effects; {}",
            suggestions::advice(name, "known effects", &ids)
        ))
    })
}

fn read_trailer(section: &Section, id: &Value, trailers: usize) -> Result<usize> {
    if trailers == 0 {
        return Err(id
            .error(format!("{} acts on a trailer, but this vehicle has none", id.text()?))
            .help("remove the entry, or use a vehicle with trailers"));
    }
    let value = section.need("trailer", "trailer = 1 for the trailer nearest the tractor")?;
    match value.count()? {
        trailer if trailer <= trailers => Ok(trailer),
        trailer => Err(out_of_range(&value, &trailer.to_string(), &format!("1 to {trailers}"))),
    }
}

fn read_input(section: &Section, id: &Value, inputs: &[&KnownInput]) -> Result<String> {
    let roles: Vec<&str> =
        inputs.iter().flat_map(|i| [Some(i.role.as_str()), i.instead.as_deref()]).flatten().collect();
    if roles.is_empty() {
        return Err(id
            .error(format!("{} acts on an input, but this vehicle has none", id.text()?))
            .help("remove the entry, or use a vehicle with inputs"));
    }
    let value = section.need("input", &format!("input = {:?}", roles[0]))?;
    let role = value.text()?;
    match roles.contains(&role) {
        true => Ok(role.to_string()),
        false => Err(value
            .error(format!("this vehicle has no input {:?}", suggestions::shown(role)))
            .help(suggestions::advice(role, "its inputs", &roles))),
    }
}

fn read_measured(section: &Section, id: &Value, measured: &[MeasuredEntry]) -> Result<String> {
    let names: Vec<&str> = measured.iter().map(|m| m.name.as_str()).collect();
    if names.is_empty() {
        return Err(id
            .error(format!("{} acts on a measured quantity, but [measured] names none", id.text()?))
            .help("remove the entry, or name the column of the sensor under [measured]"));
    }
    let value = section.need("measured", &format!("measured = {:?}", names[0]))?;
    let name = value.text()?;
    match names.contains(&name) {
        true => Ok(name.to_string()),
        false => Err(value
            .error(format!("[measured] has no {:?}", suggestions::shown(name)))
            .help(suggestions::advice(name, "it has", &names))),
    }
}

fn read_parameter(section: &Section, effect: &KnownEffect, parameter: &KnownParameter) -> Result<f64> {
    let KnownParameter { name, min, max } = parameter;
    let value = section.need(name, &format!("{name} = … below id = \"{}\"", effect.id))?;
    match value.number()? {
        number if (*min..=*max).contains(&number) => Ok(number),
        number => Err(out_of_range(&value, &format!("{number:?}"), &format!("{min:?} to {max:?}"))),
    }
}

fn out_of_range(value: &Value, found: &str, range: &str) -> Error {
    value.error(format!("{} = {found} is out of range", value.name)).help(format!("it must lie within {range}"))
}
