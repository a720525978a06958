//! `[dynamics]`: masses and moments of inertia, forces and torques, and the laws of friction of the contacts.

use super::known::{KnownDynamics, KnownLaw};
use super::parameters::{Machine, Parameters, one_per_trailer};
use crate::error::Result;
use crate::files::log::column_entry::ColumnEntry;
use crate::files::log::columns::{self, InputColumn};
use crate::files::log::unit::Dimension;
use crate::files::toml::spanned_table::{Section, Value};
use crate::files::toml::suggestions;
use std::collections::BTreeMap;

/// The dynamics of a model file, read and checked.
///
/// | key | unit | meaning |
/// |---|---|---|
/// | `mass`, `inertia`, `mass_offset` | kg, kg·m², m | of the body; a vehicle that has them under `[parameters]` has them there |
/// | `wheel_inertia` | kg·m² | about the axle: one number for all wheels that roll, or one each by the wheel's name; 0 when left out |
/// | `castor_inertia` | kg·m² | of a castor about its axis of steering; 0 when left out |
/// | `trailer_masses`, `trailer_inertias`, `trailer_mass_offsets` | | of the trailers; offsets ahead of the axle |
/// | `inputs` | | forces and torques that drive it, columns of the inputs file; a steering rate in place of the angle |
/// | `[dynamics.friction]` | | a law by contact, or for all of `rolling` and of `direction`; a contact left out is ideal |
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DynamicsEntry {
    /// Line and column of its heading.
    pub place: (usize, usize),
    /// Mass, inertia and offset of the body.
    pub body: [f64; 3],
    /// Moments of inertia by the wheel's name, lower case with `-`.
    pub wheel_inertia: BTreeMap<String, f64>,
    /// Of castors about their axis.
    pub castor_inertia: f64,
    /// Mass, inertia and offset of the trailers.
    pub trailers: Vec<[f64; 3]>,
    /// Forces and torques, in the order of the file.
    pub forces: Vec<String>,
    /// Whether the steering is given by its rate.
    pub steered_by_rate: bool,
    /// Laws of contacts; later ones count.
    pub friction: Vec<ContactEntry>,
    /// The columns of the inputs file: forces, then the steering.
    pub inputs: Vec<InputColumn>,
    /// How those are read from there of which the file says more than a name.
    pub entries: BTreeMap<String, ColumnEntry>,
    /// Speeds at the start.
    pub start: StartEntry,
}

/// The law of a contact.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactEntry {
    /// Its name, such as `rear-axle-rolling`.
    pub contact: String,
    /// The law.
    pub law: String,
    /// Its parameters in their order.
    pub values: Vec<f64>,
}

/// Speeds of `[initial]` that only a vehicle with forces has.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StartEntry {
    /// Forward, m/s.
    pub speed: f64,
    /// To the left, m/s.
    pub lateral_speed: Option<f64>,
    /// rad/s
    pub yaw_rate: Option<f64>,
    /// rad, where the steering is given by its rate.
    pub steering_angle: f64,
}

/// `ideal` as a law.
const IDEAL: &str = "ideal";
/// Keys of all contacts of a kind.
const KINDS: [(&str, &str); 2] = [("rolling", "-rolling"), ("direction", "-direction")];

impl DynamicsEntry {
    pub(crate) fn read(top: &Section, machine: &Machine, parameters: &Parameters) -> Result<Option<Self>> {
        let Some(section) = top.section("dynamics")? else { return Ok(None) };
        let known = &machine.tractor.unwrap_or(machine.vehicle).dynamics;
        let trailers = parameters.trailer_lengths.len();
        let own = |key: &&str| !parameters.values.contains_key(*key);
        let body: Vec<&str> = body_keys(known).into_iter().filter(own).collect();
        section.only(&keys(known, &body, trailers))?;
        let mut read = Self { place: section.place_of(), ..Self::default() };
        for (at, key) in ["mass", "inertia", "mass_offset"].into_iter().enumerate() {
            read.body[at] = match parameters.values.get(key) {
                Some(value) => *value,
                None if !body.contains(&key) => 0.0,
                None => body_value(&section, key)?,
            };
        }
        read.wheel_inertia = wheel_inertia(&section, known)?;
        read.castor_inertia = section.get("castor_inertia").map_or(Ok(0.0), |v| not_negative(&v))?;
        read.trailers = trailer_masses(&section, trailers)?;
        (read.forces, read.steered_by_rate) = driving(&section, known)?;
        read.friction = friction(&section, known, trailers)?;
        read.start = StartEntry::read(top, known, read.steered_by_rate)?;
        (read.inputs, read.entries) = input_columns(top, &read, known)?;
        Ok(Some(read))
    }

    /// Keys that `[initial]` may hold beside the pose.
    pub(crate) fn initial_keys(machine: &Machine) -> Vec<String> {
        let known = &machine.tractor.unwrap_or(machine.vehicle).dynamics;
        let planar = (!known.line).then_some(["lateral_speed", "yaw_rate"]).into_iter().flatten();
        let keys = std::iter::once("speed").chain(planar).map(String::from);
        keys.chain(known.steering.iter().cloned()).collect()
    }

    /// Roles that `[columns]` may name beside those of the vehicle.
    pub(crate) fn roles(machine: &Machine) -> Vec<String> {
        let known = &machine.tractor.unwrap_or(machine.vehicle).dynamics;
        known.forces.iter().chain(&known.steering_rates).cloned().collect()
    }
}

fn body_keys(known: &KnownDynamics) -> Vec<&'static str> {
    if known.line { vec!["mass"] } else { vec!["mass", "inertia", "mass_offset"] }
}

fn keys<'a>(known: &KnownDynamics, body: &[&'a str], trailers: usize) -> Vec<&'a str> {
    let mut keys = [body, &["inputs", "friction"]].concat();
    keys.extend((!known.wheels.is_empty()).then_some("wheel_inertia"));
    keys.extend(known.castors.then_some("castor_inertia"));
    if trailers > 0 {
        keys.extend(["trailer_masses", "trailer_inertias", "trailer_mass_offsets"]);
    }
    keys
}

fn body_value(section: &Section, key: &str) -> Result<f64> {
    let units = [("mass", "1200.0", "kg"), ("inertia", "1500.0", "kg·m², about the centre of mass")];
    match units.iter().find(|(name, _, _)| *name == key) {
        Some((name, example, unit)) => {
            section.need(name, &format!("{name} = {example} under [dynamics], {unit}"))?.positive()
        }
        // The middle of the axle is a natural place of the centre of mass.
        None => section.get(key).map_or(Ok(0.0), |v| v.number()),
    }
}

fn not_negative(value: &Value) -> Result<f64> {
    match value.number()? {
        number if number >= 0.0 => Ok(number),
        number => Err(value
            .error(format!("{} = {number:?} is out of range", value.name))
            .help("it must not be negative, in SI units")),
    }
}

fn wheel_inertia(section: &Section, known: &KnownDynamics) -> Result<BTreeMap<String, f64>> {
    let Some(value) = section.get("wheel_inertia") else { return Ok(BTreeMap::new()) };
    if !value.is_table() {
        let each = not_negative(&value)?;
        return Ok(known.wheels.iter().map(|w| (w.clone(), each)).collect());
    }
    let table = value.section("wheel_inertia".into())?;
    table.only(&known.wheels.iter().map(String::as_str).collect::<Vec<_>>())?;
    table.entries().iter().map(|v| Ok((v.name.clone(), not_negative(v)?))).collect()
}

fn trailer_masses(section: &Section, trailers: usize) -> Result<Vec<[f64; 3]>> {
    let mut found = vec![[0.0; 3]; trailers];
    for (at, key, needed) in
        [(0, "trailer_masses", true), (1, "trailer_inertias", true), (2, "trailer_mass_offsets", false)]
    {
        let example = format!("{key} = [..], one number per trailer, SI units");
        let value = match section.get(key) {
            None if needed && trailers > 0 => section.need(key, &example)?,
            None => continue,
            Some(value) => value,
        };
        let number = |v: &Value| if needed { v.positive() } else { v.number() };
        let numbers: Vec<f64> = value.list(&example)?.iter().map(number).collect::<Result<_>>()?;
        one_per_trailer(&value, numbers.len(), trailers)?;
        numbers.into_iter().zip(&mut found).for_each(|(n, trailer)| trailer[at] = n);
    }
    Ok(found)
}

/// Forces in the order of the file, and whether a steering rate is among them.
fn driving(section: &Section, known: &KnownDynamics) -> Result<(Vec<String>, bool)> {
    let Some(value) = section.get("inputs") else { return Ok((vec![], false)) };
    let all: Vec<&str> = known.forces.iter().chain(&known.steering_rates).map(String::as_str).collect();
    let (mut forces, mut by_rate) = (Vec::new(), false);
    for item in value.list("inputs = [\"force\"]")? {
        let name = item.text()?;
        if !all.contains(&name) {
            let message = format!("unknown input \"{}\" of [dynamics]", suggestions::shown(name));
            return Err(item.error(message).help(suggestions::advice(name, "it may be driven by", &all)));
        }
        if forces.iter().any(|f| f == name) {
            return Err(item.error(format!("the input \"{name}\" is listed twice")).help("remove one of the two"));
        }
        match known.steering_rates.iter().any(|s| s == name) {
            true => by_rate = true,
            false => forces.push(name.to_string()),
        }
    }
    Ok((forces, by_rate))
}

fn friction(section: &Section, known: &KnownDynamics, trailers: usize) -> Result<Vec<ContactEntry>> {
    let Some(table) = section.section("friction")? else { return Ok(vec![]) };
    let mut contacts = known.contacts.clone();
    contacts.extend((1..=trailers).map(|i| format!("trailer-{i}-direction")));
    let used = KINDS.iter().filter(|(_, ending)| contacts.iter().any(|c| c.ends_with(ending))).map(|(kind, _)| *kind);
    let keys: Vec<&str> = used.chain(contacts.iter().map(String::as_str)).collect();
    table.only(&keys)?;
    let mut found = Vec::new();
    for (kind, ending) in KINDS {
        let Some(value) = table.get(kind) else { continue };
        let (law, values) = law(&value, known)?;
        let of_kind = contacts.iter().filter(|c| c.ends_with(ending));
        found.extend(of_kind.map(|c| ContactEntry { contact: c.clone(), law: law.clone(), values: values.clone() }));
    }
    for value in table.entries().iter().filter(|v| KINDS.iter().all(|(kind, _)| v.name != *kind)) {
        let (law, values) = law(value, known)?;
        found.retain(|c: &ContactEntry| c.contact != value.name);
        found.push(ContactEntry { contact: value.name.clone(), law, values });
    }
    found.retain(|c| c.law != IDEAL);
    Ok(found)
}

fn law(value: &Value, known: &KnownDynamics) -> Result<(String, Vec<f64>)> {
    let example = "{ law = \"viscous\", coefficient = 1000.0 }";
    if !value.is_table() {
        return Err(value
            .error(format!("{} must be a law of contact", value.name))
            .help(format!("write {} = {example}", value.name)));
    }
    let table = value.section(format!("[dynamics.friction.{}]", value.name))?;
    let named = table.need("law", example)?;
    let name = named.text()?;
    let ids: Vec<&str> = std::iter::once(IDEAL).chain(known.laws.iter().map(|l| l.id.as_str())).collect();
    if name == IDEAL {
        table.only(&["law"])?;
        return Ok((name.into(), vec![]));
    }
    let law: &KnownLaw = known.laws.iter().find(|l| l.id == name).ok_or_else(|| {
        let message = format!("unknown law of contact \"{}\"", suggestions::shown(name));
        named.error(message).help(suggestions::advice(name, "known laws", &ids))
    })?;
    let keys: Vec<&str> = std::iter::once("law").chain(law.parameters.iter().map(|(n, _)| n.as_str())).collect();
    table.only(&keys)?;
    let need = |(name, unit): &(String, String)| table.need(name, &format!("{name} = …, in {unit}"))?.positive();
    Ok((name.into(), law.parameters.iter().map(need).collect::<Result<_>>()?))
}

impl StartEntry {
    fn read(top: &Section, known: &KnownDynamics, by_rate: bool) -> Result<Self> {
        let Some(section) = top.section("initial")? else { return Ok(Self::default()) };
        let number = |key: &str| section.get(key).map(|v| v.number()).transpose();
        let steering = known.steering.first().and_then(|role| section.get(role));
        if let Some(value) = steering.as_ref().filter(|_| !by_rate) {
            let message = format!("{} is an input and cannot stand under [initial]", value.name);
            return Err(value.key_error(message).help("remove it, or give the steering by its rate under [dynamics]"));
        }
        Ok(Self {
            speed: number("speed")?.unwrap_or(0.0),
            lateral_speed: number("lateral_speed")?,
            yaw_rate: number("yaw_rate")?,
            steering_angle: steering.map_or(Ok(0.0), |v| v.number())?,
        })
    }
}

/// Where the inputs stand in their file, and how they are read from there.
fn input_columns(
    top: &Section,
    read: &DynamicsEntry,
    known: &KnownDynamics,
) -> Result<(Vec<InputColumn>, BTreeMap<String, ColumnEntry>)> {
    let section = top.section("columns")?;
    let (steering, of_steering) = match read.steered_by_rate {
        true => (&known.steering_rates, Dimension::Rate),
        false => (&known.steering, Dimension::Angle),
    };
    let mut entries = BTreeMap::new();
    let mut column = |(role, dimension): (&String, Option<Dimension>)| {
        let named = section.as_ref().and_then(|s| s.get(role));
        let column = named.map_or(Ok(role.clone()), |v| columns::entry(&v, dimension, &mut entries))?;
        Ok(InputColumn { role: role.clone(), column, instead: None })
    };
    let forces = read.forces.iter().map(|role| (role, None));
    let steering = steering.iter().map(|role| (role, Some(of_steering)));
    Ok((forces.chain(steering).map(&mut column).collect::<Result<_>>()?, entries))
}
