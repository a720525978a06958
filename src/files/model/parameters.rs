//! `[parameters]`: the lengths and other constants of the vehicle, and of the trailers it pulls.

use super::known::{Known, KnownInput, KnownVehicle};
use crate::error::Result;
use crate::files::toml::spanned_table::{Section, Value};
use crate::files::toml::suggestions;
use std::collections::BTreeMap;

/// The tractor of a vehicle with trailers when the file names none.
const USUAL_TRACTOR: &str = "car";

/// A vehicle of a model file with the tractor that drives it, if it pulls trailers.
pub(crate) struct Machine<'k> {
    pub vehicle: &'k KnownVehicle,
    pub tractor: Option<&'k KnownVehicle>,
}

/// What `[parameters]` holds, in SI units.
pub(crate) struct Parameters {
    pub values: BTreeMap<String, f64>,
    pub trailer_lengths: Vec<f64>,
    pub hitch_offsets: Vec<f64>,
}

impl<'k> Machine<'k> {
    /// Reads `vehicle` and `tractor`; the latter may stand at the top or among the parameters.
    pub fn read(top: &Section, known: &'k Known) -> Result<Self> {
        let ids: Vec<&str> = known.vehicles.iter().map(|v| v.id.as_str()).collect();
        let named =
            top.need("vehicle", &format!("vehicle = \"…\" at the top; known vehicles: {}", suggestions::list(&ids)))?;
        let id = named.text()?;
        let vehicle = known.vehicle(id).ok_or_else(|| unknown(&named, "vehicle", id, &ids))?;
        let tractor = if vehicle.trailers { Some(tractor(top, known)?) } else { None };
        Ok(Self { vehicle, tractor })
    }

    /// How many trailers are a part of the vehicle or of its tractor.
    pub fn sections(&self) -> usize {
        self.parts().map(|v| v.sections).sum()
    }

    /// Every input of its parts.
    pub fn inputs(&self) -> Vec<&'k KnownInput> {
        self.parts().flat_map(|part| &part.inputs).collect()
    }

    /// The vehicle itself and its tractor: both bring parameters and inputs.
    pub fn parts(&self) -> impl Iterator<Item = &'k KnownVehicle> {
        std::iter::once(self.vehicle).chain(self.tractor)
    }
}

fn tractor<'k>(top: &Section, known: &'k Known) -> Result<&'k KnownVehicle> {
    let ids: Vec<&str> = known.vehicles.iter().filter(|v| v.tractor).map(|v| v.id.as_str()).collect();
    let inner = top.section("parameters")?.and_then(|s| s.get("tractor"));
    let named = match (top.get("tractor"), inner) {
        (Some(_), Some(second)) => {
            return Err(second.source.error(second.key_at, "tractor is named twice").help("remove one of the two"));
        }
        (outer, inner) => outer.or(inner),
    };
    let Some(named) = named else {
        let usual = known.vehicle(USUAL_TRACTOR).filter(|v| v.tractor);
        return usual.ok_or_else(|| {
            top.error("key \"tractor\" is missing").help(suggestions::advice("", "known tractors", &ids))
        });
    };
    let id = named.text()?;
    known.vehicle(id).filter(|v| v.tractor).ok_or_else(|| unknown(&named, "tractor", id, &ids))
}

fn unknown(value: &Value, noun: &str, id: &str, ids: &[&str]) -> crate::Error {
    value.error(format!("unknown {noun} \"{}\"", suggestions::shown(id))).help(format!(
        "if it is your own, give its file with --vehicles, or name it here: vehicles = \"FILE.toml\"; {}",
        suggestions::advice(id, &format!("known {noun}s"), ids)
    ))
}

impl Parameters {
    /// Reads what the machine needs, and refuses anything else.
    pub fn read(top: &Section, machine: &Machine) -> Result<Self> {
        let needed: Vec<&str> = machine.parts().flat_map(|v| &v.parameters).map(String::as_str).collect();
        let optional: Vec<&str> = machine.parts().flat_map(|v| &v.optional_parameters).map(String::as_str).collect();
        let Some(section) = top.section("parameters")? else {
            return if needed.is_empty() && machine.tractor.is_none() {
                Ok(Self::empty())
            } else {
                Err(absent(top, &needed))
            };
        };
        let mut keys = [needed.as_slice(), &optional].concat();
        if machine.tractor.is_some() {
            keys.extend(["tractor", "trailer_lengths", "hitch_offsets"]);
        }
        section.only(&keys)?;
        let mut found = Self::empty();
        for name in needed {
            let value = section.need(name, &format!("{name} = … under [parameters], in SI units"))?;
            found.values.insert(name.into(), parameter(&value)?);
        }
        for value in optional.into_iter().filter_map(|name| section.get(name)) {
            found.values.insert(value.name.clone(), parameter(&value)?);
        }
        if machine.tractor.is_some() {
            found.read_trailers(&section)?;
        }
        Ok(found)
    }

    fn empty() -> Self {
        Self { values: BTreeMap::new(), trailer_lengths: Vec::new(), hitch_offsets: Vec::new() }
    }

    fn read_trailers(&mut self, section: &Section) -> Result<()> {
        let example = "trailer_lengths = [3.0], hitch to axle, one number per trailer";
        let lengths = section.need("trailer_lengths", example)?;
        self.trailer_lengths = lengths.list(example)?.iter().map(Value::positive).collect::<Result<_>>()?;
        if self.trailer_lengths.is_empty() {
            return Err(lengths.error("trailer_lengths is empty").help(format!("write {example}")));
        }
        self.hitch_offsets = match section.get("hitch_offsets") {
            None => vec![0.0; self.trailer_lengths.len()],
            Some(value) => value.list("hitch_offsets = [0.0]")?.iter().map(Value::number).collect::<Result<_>>()?,
        };
        match section.get("hitch_offsets") {
            Some(value) => one_per_trailer(&value, self.hitch_offsets.len(), self.trailer_lengths.len()),
            None => Ok(()),
        }
    }
}

/// Refuses a list that does not have one element for each trailer.
pub(crate) fn one_per_trailer(value: &Value, len: usize, trailers: usize) -> Result<()> {
    if len == trailers {
        return Ok(());
    }
    Err(value
        .error(format!("{} has {len} elements, but {trailers} are needed", value.name))
        .help("give one per trailer, the one nearest the tractor first"))
}

fn parameter(value: &Value) -> Result<f64> {
    if value.name.ends_with("offset") { value.number() } else { value.positive() }
}

fn absent(top: &Section, needed: &[&str]) -> crate::Error {
    let keys = if needed.is_empty() { "trailer_lengths".into() } else { suggestions::list(needed) };
    top.error("table [parameters] is missing").help(format!("write [parameters] and below it: {keys}"))
}
