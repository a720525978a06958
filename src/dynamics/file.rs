//! Dynamics read from a model file, and its simulation.

use super::{Dynamics, Start, laws, simulate_dynamics};
use crate::effects::Effect;
use crate::error::{Error, Result};
use crate::files::{DynamicsEntry, Initial, Known, KnownDynamics, KnownLaw, ModelFile};
use crate::model;
use crate::model::forces::{castors, rate_role, roles, slug};
use crate::model::{Model, mechanism};
use crate::motion::{Drive, Integrator, Table};
use crate::vehicles;
use crate::vehicles::Vehicle;

/// What a model file may name, `[dynamics]` included: the vehicles of the catalogue and the effects of a library.
///
/// ```
/// use creepage::files::ModelFile;
/// let text = "vehicle = \"disk\"\n[parameters]\nwheel_radius = 0.5\n[dynamics]\nmass = 2.0\nwheel_inertia = 0.2\n\
///             inputs = [\"wheel_torque\"]\n[dynamics.friction]\nrolling = { law = \"viscous\", coefficient = 100.0 }\n";
/// let file = ModelFile::parse(text, "disk.toml", &creepage::dynamics::known(&[])).unwrap();
/// assert_eq!(file.dynamics.unwrap().friction[0].contact, "disk-rolling");
/// ```
pub fn known(library: &[Effect]) -> Known {
    known_on(vehicles::all(), library)
}

/// As [`known`] for these vehicles.
pub fn known_on(vehicles: &[Vehicle], library: &[Effect]) -> Known {
    let mut known = model::known_on(vehicles, library);
    for entry in &mut known.vehicles {
        let vehicle = vehicles.iter().find(|v| v.id == entry.id);
        entry.dynamics = vehicle.map(known_dynamics).unwrap_or_default();
    }
    known
}

fn known_dynamics(vehicle: &Vehicle) -> KnownDynamics {
    let mechanism = mechanism(vehicle, 0);
    let steers = |q: &&crate::formula::Symbol| vehicle.define.contains_key(q);
    let parts = mechanism.coordinates.iter().filter(steers).flat_map(|q| vehicle.define[q].formula.symbols());
    let parts: Vec<_> = parts.collect();
    let steering = vehicle.inputs.keys().filter(|role| parts.iter().any(|s| s.as_str() == role.as_str()));
    let steering: Vec<String> = steering.cloned().collect();
    let law = |l: &super::Law| KnownLaw {
        id: l.id.clone(),
        parameters: l.parameters.iter().map(|p| (p.name.clone(), p.unit.clone())).collect(),
    };
    KnownDynamics {
        // A body in the air has no contacts and no pose in the plane; of sections behind it no masses are known.
        allowed: vehicle.coordinates.is_empty() && vehicle.trailers.is_empty(),
        line: vehicle.line,
        wheels: vehicle.wheels.iter().filter(|w| w.rate.is_some()).map(|w| slug(&w.name)).collect(),
        castors: !castors(vehicle).is_empty(),
        forces: roles(vehicle).into_iter().map(|(role, _, _)| role).collect(),
        steering_rates: steering.iter().map(|s| rate_role(s)).collect(),
        steering,
        contacts: mechanism.constraints.iter().map(|c| slug(&c.name)).collect(),
        laws: laws().iter().map(law).collect(),
    }
}

impl Dynamics {
    /// The dynamics that a file with `[dynamics]` describes.
    ///
    /// # Errors
    /// When the file has no such section, or includes effects.
    pub fn from_file(file: &ModelFile) -> Result<Self> {
        let at = |e: Error, (line, column): (usize, usize)| e.at_file(&file.path).at(line, column);
        let entry = file.dynamics.as_ref().ok_or_else(|| {
            Error::input("table [dynamics] is missing").at_file(&file.path).help("write [dynamics] and below it: mass")
        })?;
        if let Some(effect) = file.effects.first() {
            return Err(Error::input(format!("the effect {} has no place beside [dynamics]", effect.id))
                .at_file(&file.path)
                .at(effect.line, 1)
                .help("remove it or [dynamics]: with forces, creep follows from the laws of contact"));
        }
        let model = Model::from_file(&ModelFile { effects: vec![], dynamics: None, ..file.clone() }, &[], &[])?;
        Self::of_entry(entry, &model).map_err(|e| at(e, entry.place))
    }
}

/// Simulates what a file with `[dynamics]` describes, from a pose; friction may be stiff.
///
/// # Errors
/// As [`Dynamics::from_file`] and [`simulate_dynamics`]; what the file leaves open is told at its `[dynamics]`.
///
/// ```
/// use creepage::dynamics::{known, simulate_file};
/// use creepage::files::{Initial, ModelFile};
/// use creepage::motion::{Formulas, Integrator};
/// let text = "vehicle = \"sleigh\"\n[parameters]\nmass = 1.0\ninertia = 0.5\nmass_offset = 0.3\n[dynamics]\n[initial]\n\
///             x = 0.0\ny = 0.0\nheading = 0.0\nspeed = 0.5\nyaw_rate = 1.2\n";
/// let file = ModelFile::parse(text, "sleigh.toml", &known(&[])).unwrap();
/// let no_inputs = Formulas::new(&[], &[]).unwrap();
/// let run = simulate_file(&file, &no_inputs, &[0.0, 4.0], &Initial::default(), &Integrator::default()).unwrap();
/// assert!(run.column("speed").unwrap()[1] > 1.0);
/// ```
pub fn simulate_file(
    file: &ModelFile,
    inputs: &impl Drive,
    times: &[f64],
    pose: &Initial,
    integrator: &Integrator,
) -> Result<Table> {
    let dynamics = Dynamics::from_file(file)?;
    run_of(&dynamics, file, inputs, times, pose, &integrator.for_friction(dynamics.has_friction()))
}

/// As [`simulate_file`], by the method given even where friction is stiff.
///
/// # Errors
/// As [`simulate_file`].
pub fn simulate_file_by(
    file: &ModelFile,
    inputs: &impl Drive,
    times: &[f64],
    pose: &Initial,
    integrator: &Integrator,
) -> Result<Table> {
    run_of(&Dynamics::from_file(file)?, file, inputs, times, pose, integrator)
}

fn run_of(
    dynamics: &Dynamics,
    file: &ModelFile,
    inputs: &impl Drive,
    times: &[f64],
    pose: &Initial,
    integrator: &Integrator,
) -> Result<Table> {
    let entry = file.dynamics.clone().unwrap_or_default();
    let (line, column) = entry.place;
    simulate_dynamics(dynamics, inputs, times, &Start::from_file(&entry, pose), integrator).map_err(|e| {
        match e.exit_code() {
            2 => e.at_file(&file.path).at(line, column),
            _ => e,
        }
    })
}

impl Start {
    /// The start that a file and a pose give.
    pub fn from_file(entry: &DynamicsEntry, pose: &Initial) -> Self {
        let start = entry.start;
        Self {
            pose: [&[pose.x, pose.y, pose.heading], &pose.trailer_headings[..]].concat(),
            speed: start.speed,
            lateral_speed: start.lateral_speed,
            yaw_rate: start.yaw_rate,
            steering_angle: start.steering_angle,
        }
    }
}
