//! The model file (TOML): vehicle, parameters, effects, and the columns of the log.

use super::dynamics::DynamicsEntry;
use super::effect_entry::{EffectEntry, read_effects};
use super::known::Known;
use super::measured::MeasuredEntry;
use super::measurement::{Initial, InputTiming, Noise, Sensor};
use super::parameters::{Machine, Parameters};
use super::patch;
use crate::error::{Error, Result};
use crate::files::log::columns::Columns;
use crate::files::toml::spanned_table::{Section, Source};
use crate::files::toml::suggestions;
use crate::files::toml::text::{BOM, hex, read_hashed};
use crate::provenance::Origin;
use crate::vehicles::Vehicle;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A model file, read and checked.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelFile {
    /// Where it was read.
    pub path: PathBuf,
    /// Its text, without byte order mark.
    pub text: String,
    /// SHA-256 of its bytes, hexadecimal.
    pub sha256: String,
    /// Id of the vehicle.
    pub vehicle: String,
    /// Id of the vehicle in front, for one that pulls trailers.
    pub tractor: Option<String>,
    /// What that vehicle is made of, or the one in front; without it one of the catalogue is meant.
    pub description: Option<Vehicle>,
    /// How many trailers are a part of it, ahead of those it pulls.
    pub sections: usize,
    /// What a row of inputs means.
    pub input_timing: InputTiming,
    /// Parameters of the vehicle and its tractor, SI units.
    pub parameters: BTreeMap<String, f64>,
    /// From hitch to axle, m, nearest trailer first.
    pub trailer_lengths: Vec<f64>,
    /// From the axle ahead back to the hitch, m, one per trailer.
    pub hitch_offsets: Vec<f64>,
    /// Where a log holds what.
    pub columns: Columns,
    /// What a log measures of the motion beside the pose.
    pub measured: Vec<MeasuredEntry>,
    /// Where the measured pose sits on the body.
    pub sensor: Sensor,
    /// Where a simulation begins, if the file says so.
    pub initial: Option<Initial>,
    /// Standard deviations of the measured pose, where the file gives them.
    pub noise: Noise,
    /// Effects the model includes, in the order of the file.
    pub effects: Vec<EffectEntry>,
    /// Masses, forces and laws of contact, where the file gives them: then a simulation is one of forces.
    pub dynamics: Option<DynamicsEntry>,
}

impl AsRef<ModelFile> for ModelFile {
    fn as_ref(&self) -> &Self {
        self
    }
}

impl ModelFile {
    /// Reads and checks a model file.
    ///
    /// # Errors
    /// As [`read_text`](crate::files::read_text) and [`ModelFile::parse`].
    ///
    /// ```
    /// use creepage::files::ModelFile;
    /// let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/runs/cornering/model.toml");
    /// let file = ModelFile::read(path, &creepage::model::known(&[])).unwrap();
    /// assert_eq!((file.vehicle.as_str(), file.sha256.len()), ("unicycle", 64));
    /// ```
    pub fn read(path: impl AsRef<Path>, known: &Known) -> Result<Self> {
        let (text, sha256) = read_hashed(path.as_ref())?;
        Ok(Self { sha256, ..Self::parse(&text, path, known)? })
    }

    /// Checks the text of a model file; `path` is only named in errors.
    ///
    /// # Errors
    /// With line and column and what to do: no TOML, an unknown vehicle or key, a key that is missing, a value of the
    /// wrong kind or out of range.
    ///
    /// ```
    /// use creepage::files::ModelFile;
    /// let known = creepage::model::known(&[]);
    /// let parse = |text: &str| ModelFile::parse(text, "model.toml", &known);
    /// let file = parse("vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n").unwrap();
    /// assert_eq!(file.parameters["wheel_radius"], 0.5);
    /// let error = parse("vehicle = \"unicycle\"\n[parameters]\nwheel_radius = -0.5\n").unwrap_err();
    /// assert!(error.to_string().starts_with("model.toml:3:16: wheel_radius = -0.5 is out of range"));
    /// ```
    pub fn parse(text: &str, path: impl AsRef<Path>, known: &Known) -> Result<Self> {
        let sha256 = hex(&Sha256::digest(text));
        let text = text.strip_prefix(BOM).unwrap_or(text);
        let source = Source { path: path.as_ref(), text };
        let document = source.parse()?;
        let top = Section::top(source, &document);
        let machine = Machine::read(&top, known)?;
        movable(&top, &machine)?;
        top.only(&top_keys(&machine))?;
        let parameters = Parameters::read(&top, &machine)?;
        let sections = machine.sections();
        let trailers = sections + parameters.trailer_lengths.len();
        let dynamics = DynamicsEntry::read(&top, &machine, &parameters)?;
        let mut columns = Columns::read(&top, &machine, trailers, &forced(&top, DynamicsEntry::roles(&machine)))?;
        if let Some(entry) = &dynamics {
            // Under forces the motion of the wheels is what comes out.
            columns.inputs.clone_from(&entry.inputs);
            columns.entries.extend(entry.entries.clone());
        }
        let driven: Vec<&str> = columns.inputs.iter().map(|i| i.role.as_str()).collect();
        let measured = MeasuredEntry::read(&top, &machine, &driven)?;
        columns.measure(&top, &measured)?;
        Ok(Self {
            path: source.path.to_path_buf(),
            text: text.to_string(),
            sha256,
            vehicle: machine.vehicle.id.clone(),
            tractor: machine.tractor.map(|v| v.id.clone()),
            description: machine.tractor.unwrap_or(machine.vehicle).description.clone(),
            sections,
            input_timing: InputTiming::read(&top)?,
            dynamics,
            columns,
            sensor: Sensor::read(&top)?,
            initial: Initial::read(
                &top,
                machine.vehicle,
                trailers,
                &forced(&top, DynamicsEntry::initial_keys(&machine)),
            )?,
            noise: Noise::read(&top)?,
            effects: read_effects(&top, known, trailers, &machine.inputs(), &measured)?,
            measured,
            parameters: parameters.values,
            trailer_lengths: parameters.trailer_lengths,
            hitch_offsets: parameters.hitch_offsets,
        })
    }

    /// The text of the file with effects added, or their values replaced where the file already lists
    /// the same effect for the same target; everything else, comments included, stays as it is.
    ///
    /// A vehicle of a user's own is then looked for in the file [`VEHICLES_FILE`](crate::files::VEHICLES_FILE) beside it.
    pub fn patched(&self, added: &[EffectEntry]) -> String {
        let text = patch::patched(&self.text, added);
        if self.vehicle_origin().is_some() { patch::with_vehicles(&text) } else { text }
    }

    /// The vehicle in words: "car with 2 trailers".
    pub fn title(&self) -> String {
        let tractor = self.tractor.as_ref().unwrap_or(&self.vehicle);
        match self.trailers() {
            0 => tractor.clone(),
            n => format!("{tractor} with {}", crate::wording::counted(n, "trailer")),
        }
    }

    /// The model with effects added, or in the place of those for the same target; its text stays as it is.
    pub fn with_effects(&self, added: &[EffectEntry]) -> Self {
        let mut file = self.clone();
        for entry in added {
            match file.effects.iter_mut().find(|e| e.same_target(entry)) {
                Some(old) => *old = entry.clone(),
                None => file.effects.push(entry.clone()),
            }
        }
        file
    }

    /// How many trailers it has: those that are a part of the vehicle, then those it pulls.
    pub fn trailers(&self) -> usize {
        self.sections + self.trailer_lengths.len()
    }

    /// Whether a contact has a law of force: then its motion may be stiff.
    pub fn has_friction(&self) -> bool {
        self.dynamics.as_ref().is_some_and(|forces| !forces.friction.is_empty())
    }

    /// The file of a user's own that describes the vehicle, if it is none of the catalogue.
    pub fn vehicle_origin(&self) -> Option<&Origin> {
        self.description.as_ref()?.origin.as_deref()
    }

    /// That no forces stand in the file, for what knows of none.
    ///
    /// # Errors
    /// At `[dynamics]`, where the file has it.
    pub fn no_forces(&self, what: &str) -> Result<()> {
        let Some(entry) = &self.dynamics else { return Ok(()) };
        let (line, column) = entry.place;
        Err(Error::input(format!("{what} knows no forces: [dynamics] has no place in its model"))
            .at_file(&self.path)
            .at(line, column)
            .help("remove [dynamics] from a copy of the file; its inputs are then rates and angles again"))
    }

    /// A file of vehicles that a model file names by `vehicles = "…"`, if it does; the path is relative to the model's.
    ///
    /// # Errors
    /// When the model file cannot be read, or there is no file of that name.
    pub fn named_vehicles(path: impl AsRef<Path>) -> Result<Option<PathBuf>> {
        let path = path.as_ref();
        let (text, _) = read_hashed(path)?;
        let source = Source { path, text: &text };
        let document = source.parse()?;
        let Some(value) = Section::top(source, &document).get("vehicles") else { return Ok(None) };
        let found = path.parent().unwrap_or(Path::new("")).join(value.text()?);
        match found.is_file() {
            true => Ok(Some(found)),
            false => Err(value
                .error(format!("no file of vehicles is at \"{}\"", suggestions::shown(&found.display().to_string())))
                .help("give its path from the folder of the model file")),
        }
    }
}

/// That forces are known for the vehicle, where the file speaks of them.
fn movable(top: &Section, machine: &Machine) -> Result<()> {
    let vehicle = machine.tractor.unwrap_or(machine.vehicle);
    match top.section("dynamics")? {
        Some(section) if !vehicle.dynamics.allowed => Err(section
            .error(format!("[dynamics] has no place here: no forces are known for the vehicle \"{}\"", vehicle.id))
            .help("remove it; forces move a vehicle of one section in the plane and the trailers behind it")),
        _ => Ok(()),
    }
}

/// What only a file with `[dynamics]` may name.
fn forced(top: &Section, names: Vec<String>) -> Vec<String> {
    if top.get("dynamics").is_some() { names } else { vec![] }
}

fn top_keys(machine: &Machine) -> Vec<&'static str> {
    let mut keys = vec![
        "vehicle",
        "vehicles",
        "input_timing",
        "parameters",
        "columns",
        "measured",
        "sensor",
        "initial",
        "noise",
        "effects",
    ];
    keys.extend(machine.tractor.map(|_| "tractor"));
    keys.extend(machine.tractor.unwrap_or(machine.vehicle).dynamics.allowed.then_some("dynamics"));
    keys
}
