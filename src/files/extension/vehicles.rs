//! Files of a user's own vehicles (TOML): wheels, trailers, parameters and inputs, from which the motion is derived.

use super::user_vehicle::UserVehicle;
use super::vehicle_constraints::{read_constraints, read_coordinates};
use super::vehicle_parts::{read_followers, read_trailers, read_wheels};
use super::vehicle_quantities::{read_definitions, read_inputs, read_quantities};
use crate::error::Result;
use crate::files::toml::location::Spot;
use crate::files::toml::spanned_table::{Section, Source};
use crate::files::toml::user_file::{at_most, read_id, read_user_file};
use crate::formula::Symbol;
use crate::provenance::Origin;
use crate::vehicles::Vehicle;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// The most vehicles of a file: every effect is validated against each of them.
const MAX_VEHICLES: usize = 20;
/// The most held names of a vehicle: as many as it may have wheels.
const MAX_HELD: usize = 40;

/// The vehicles of a file, read but not yet solved for their motion.
#[derive(Clone, Debug)]
pub struct VehiclesFile {
    /// The vehicles, in the order of the file.
    pub vehicles: Vec<UserVehicle>,
}

impl VehiclesFile {
    /// Reads a file of vehicles.
    ///
    /// # Errors
    /// With file, line and column, inside a formula too: a file that cannot be read, a key that is missing or unknown,
    /// a name or formula that is malformed, a wheel that constrains nothing, two parts of one name.
    pub fn read(path: &Path) -> Result<Self> {
        Self::parse(&read_user_file(path, "vehicles")?)
    }

    fn parse(origin: &Arc<Origin>) -> Result<Self> {
        let source = Source { path: &origin.path, text: &origin.text };
        let document = source.parse_as(
            "a file of vehicles holds [[vehicle]], lines like id = \"my-robot\", and below [vehicle.define] lines like \
             \"theta'\" = { formula = \"wheel_rate\", … }, where a name with ' stands in quotes",
        )?;
        let top = Section::top(source, &document);
        top.only(&["vehicle"])?;
        let example = "[[vehicle]], with double brackets, before each vehicle";
        let list = top.need("vehicle", example)?;
        let elements = list.list(example)?;
        at_most(&list, elements.len(), MAX_VEHICLES)?;
        if elements.is_empty() {
            return Err(list.error("the file holds no vehicle").help(format!("write {example}")));
        }
        let mut vehicles: Vec<UserVehicle> = Vec::new();
        for element in elements {
            let own = read_vehicle(&element.section("[[vehicle]]".into())?, origin)?;
            if vehicles.iter().any(|v| v.vehicle.id == own.vehicle.id) {
                let error = own.id.error(format!("two vehicles are called \"{}\"", own.vehicle.id));
                return Err(error.help("give one another id"));
            }
            vehicles.push(own);
        }
        Ok(Self { vehicles })
    }
}

const KEYS: [&str; 14] = [
    "id",
    "title",
    "parameters",
    "inputs",
    "define",
    "wheels",
    "followers",
    "trailers",
    "line",
    "held",
    "instead",
    "coordinates",
    "heading",
    "constraints",
];

fn read_vehicle(section: &Section, origin: &Arc<Origin>) -> Result<UserVehicle> {
    section.only(&KEYS)?;
    let id = section.need("id", "id = \"my-robot\"")?;
    let instead = section.get("instead");
    let mut own = UserVehicle {
        vehicle: Vehicle {
            id: read_id(&id, "a vehicle", &[])?,
            title: section.need("title", "title = \"what it is, in a line\"")?.text()?.into(),
            line: section.get("line").map_or(Ok(false), |v| v.truth())?,
            instead: instead.as_ref().map(|v| v.text().map(str::to_string)).transpose()?,
            origin: Some(origin.clone()),
            ..Vehicle::default()
        },
        id: Spot::at(section.source, id.span().start),
        instead: instead.map(|v| Spot::at(section.source, v.key_at)),
        names: BTreeMap::new(),
        define: BTreeMap::new(),
        replaced: BTreeMap::new(),
        wheels: vec![],
        followers: vec![],
        trailers: vec![],
        coordinates: vec![],
        constraints: vec![],
        held: vec![],
    };
    read_quantities(&mut own, section)?;
    read_inputs(&mut own, section)?;
    read_definitions(&mut own, section)?;
    read_coordinates(&mut own, section)?;
    read_constraints(&mut own, section)?;
    read_trailers(&mut own, section)?;
    read_wheels(&mut own, section)?;
    read_followers(&mut own, section)?;
    read_held(&mut own, section)?;
    Ok(own)
}

fn read_held(own: &mut UserVehicle, section: &Section) -> Result<()> {
    let Some(value) = section.get("held") else { return Ok(()) };
    let list = value.list("held = [\"v_t\"]")?;
    at_most(&value, list.len(), MAX_HELD)?;
    for name in list {
        own.vehicle.held.push(Symbol::new(name.text()?));
        own.held.push(Spot::at(section.source, name.span().start));
    }
    Ok(())
}
