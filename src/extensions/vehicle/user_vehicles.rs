//! The vehicles of the catalogue together with those of a user's file, each checked before it is used.

use super::{actions, constraints, motion, names, places, units};
use crate::error::Result;
use crate::extensions::test_vehicle::TestVehicle;
use crate::files::{ModelFile, UserVehicle, VehiclesFile};
use crate::model::WITH_TRAILERS;
use crate::vehicles;
use crate::vehicles::Vehicle;
use std::path::Path;

/// The vehicles of the catalogue, followed by those of a file.
///
/// ```toml
/// [[vehicle]]
/// id = "scooter"
/// title = "driven behind, steered in front"
/// [vehicle.parameters.wheel_radius]
/// unit = "m"
/// meaning = "wheel radius"
/// [vehicle.parameters.wheelbase]
/// unit = "m"
/// meaning = "distance between the wheels"
/// [vehicle.inputs.wheel_rate]
/// unit = "rad/s"
/// meaning = "rate of the rear wheel"
/// [vehicle.inputs.steering_angle]
/// unit = "rad"
/// meaning = "angle of the front wheel, left positive"
/// [vehicle.define]
/// r = { formula = "wheel_radius", unit = "m", meaning = "rolling radius" }
/// L = { formula = "wheelbase", unit = "m", meaning = "wheelbase" }
/// delta = { formula = "steering_angle", unit = "rad", meaning = "steering angle" }
/// "theta'" = { formula = "wheel_rate", unit = "rad/s", meaning = "rate of the rear wheel" }
/// [[vehicle.wheels]]
/// name = "rear wheel"
/// radius = "r"
/// rate = "theta'"
/// rotation_creep = "e_rc"
/// traverse_creep = "e_tc"
/// [[vehicle.wheels]]
/// name = "front wheel"
/// forward = "L"
/// steering = "delta"
/// traverse_creep = "e_f"
/// ```
///
/// # Errors
/// With file, line and column when the file is not of this form, or a vehicle cannot do what the catalogue's can: have
/// units, be determined by its constraints, bear the effects that speak of its names.
///
/// ```
/// use creepage::{extensions, model::Model};
/// let vehicles = extensions::vehicles_with_own("examples/bus/bus.toml").unwrap();
/// let bus = vehicles.iter().find(|v| v.id == "articulated-bus").unwrap();
/// assert_eq!(Model::sample(bus).unwrap().states(), ["x", "y", "phi", "phi_1"].map(Into::into));
/// ```
pub fn vehicles_with_own(path: impl AsRef<Path>) -> Result<Vec<Vehicle>> {
    let file = VehiclesFile::read(path.as_ref())?;
    let mut found = vehicles::all().to_vec();
    for own in file.vehicles {
        check(&own)?;
        found.push(own.vehicle);
    }
    Ok(found)
}

/// The vehicles that a model file may speak of: those of the catalogue, of a file given beside it, and of the file it names
/// by `vehicles = "…"`. Of two with one name, the given one counts.
///
/// # Errors
/// As [`vehicles_with_own`], and where the model file cannot be read.
///
/// ```
/// let vehicles = creepage::extensions::vehicles_of("examples/bus/model.toml", None).unwrap();
/// assert!(vehicles.iter().any(|v| v.id == "articulated-bus"));
/// ```
pub fn vehicles_of(model: impl AsRef<Path>, given: Option<&Path>) -> Result<Vec<Vehicle>> {
    let mut all = given.map_or_else(|| Ok(vehicles::all().to_vec()), vehicles_with_own)?;
    if let Some(path) = ModelFile::named_vehicles(model)? {
        let named = vehicles_with_own(path)?;
        let new: Vec<Vehicle> = named.into_iter().filter(|v| all.iter().all(|a| a.id != v.id)).collect();
        all.extend(new);
    }
    Ok(all)
}

fn check(own: &UserVehicle) -> Result<()> {
    distinct(own)?;
    names::check(own)?;
    units::check(own)?;
    places::check(own)?;
    constraints::check(own)?;
    motion::check(own)?;
    actions::check(own, &TestVehicle::of_vehicle(&own.vehicle)?)
}

/// That the name of a vehicle is no other's.
fn distinct(own: &UserVehicle) -> Result<()> {
    let id = own.vehicle.id.as_str();
    match vehicles::named(id).is_some() || id == WITH_TRAILERS {
        true => Err(own.id.error(format!("the catalogue has a vehicle \"{id}\"")).help("give yours another id")),
        false => Ok(()),
    }
}
