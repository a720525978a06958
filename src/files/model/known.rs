//! The vocabulary of a model file: the vehicles, effects and laws of contact that it may name.

use crate::vehicles::Vehicle;

/// Vehicles and effects a model file may name; the caller fills it from the catalogues.
#[derive(Clone, Debug, Default)]
pub struct Known {
    /// Every vehicle a model file may name.
    pub vehicles: Vec<KnownVehicle>,
    /// Every effect a model file may include.
    pub effects: Vec<KnownEffect>,
    /// Terms without a name, as `discover` writes them into a patched model.
    pub terms: Vec<KnownEffect>,
}

/// A vehicle as a model file sees it.
///
/// A parameter whose name ends in `offset` may be any finite number; every other one (a length, a
/// mass, an inertia) must be greater than zero.
#[derive(Clone, Debug, Default)]
pub struct KnownVehicle {
    /// The value of the key `vehicle`.
    pub id: String,
    /// Keys that must stand under `[parameters]`, in SI units.
    pub parameters: Vec<String>,
    /// Keys that may stand under `[parameters]`, in SI units.
    pub optional_parameters: Vec<String>,
    /// The inputs it is driven by.
    pub inputs: Vec<KnownInput>,
    /// The key under `[initial]` that may stand for `heading`: the coordinate of the vehicle that is its heading.
    pub heading: Option<String>,
    /// It has no place in the plane, so `x` and `y` may be left out of `[initial]`.
    pub stays: bool,
    /// It moves along a line: what is measured of its place is how far along it is.
    pub line: bool,
    /// It pulls trailers, so `tractor`, `trailer_lengths` and `hitch_offsets` may stand in the file.
    pub trailers: bool,
    /// It may be the `tractor` of a vehicle with trailers.
    pub tractor: bool,
    /// What `[dynamics]` may say of it.
    pub dynamics: KnownDynamics,
    /// How many trailers are a part of it.
    pub sections: usize,
    /// What it is made of, handed through to the model; without it a vehicle of the catalogue is meant.
    pub description: Option<Vehicle>,
}

/// What `[dynamics]` may say of a vehicle.
#[derive(Clone, Debug, Default)]
pub struct KnownDynamics {
    /// Whether such a section may stand in the file at all.
    pub allowed: bool,
    /// It moves along a line: no inertia, no yaw.
    pub line: bool,
    /// Names of the wheels that roll.
    pub wheels: Vec<String>,
    /// Whether it has castors.
    pub castors: bool,
    /// Roles of forces and torques.
    pub forces: Vec<String>,
    /// Roles of steering angles.
    pub steering: Vec<String>,
    /// Roles of their rates.
    pub steering_rates: Vec<String>,
    /// Names of the contacts, trailers left out.
    pub contacts: Vec<String>,
    /// Laws of contact beside the ideal one.
    pub laws: Vec<KnownLaw>,
}

/// A law of contact as a model file sees it; its parameters must be greater than zero.
#[derive(Clone, Debug, Default)]
pub struct KnownLaw {
    /// The value of the key `law`.
    pub id: String,
    /// Keys it needs, with their units.
    pub parameters: Vec<(String, String)>,
}

/// An input of a vehicle.
#[derive(Clone, Debug, Default)]
pub struct KnownInput {
    /// Its key under `[columns]`.
    pub role: String,
    /// Another role that may stand for it, as `speed` for `wheel_rate`.
    pub instead: Option<String>,
    /// Its SI unit; blank where it is not known.
    pub unit: String,
    /// SI unit of `instead`.
    pub instead_unit: String,
}

/// An effect as a model file sees it.
#[derive(Clone, Debug, Default)]
pub struct KnownEffect {
    /// The value of the key `id`.
    pub id: String,
    /// Keys every entry must give.
    pub parameters: Vec<KnownParameter>,
    /// It acts on one trailer, named by the key `trailer` (1 = nearest the tractor).
    pub per_trailer: bool,
    /// It acts on one input, named by the key `input`.
    pub per_input: bool,
    /// It may act on one input, named by the key `input`.
    pub input_optional: bool,
    /// It acts on one quantity that is measured beside the pose, named by the key `measured`.
    pub per_quantity: bool,
}

/// A parameter of an effect and the values it may take, bounds included.
#[derive(Clone, Debug, Default)]
pub struct KnownParameter {
    /// Its key.
    pub name: String,
    /// The smallest value, in the unit of the parameter.
    pub min: f64,
    /// The largest value, in the unit of the parameter.
    pub max: f64,
}

impl Known {
    /// The vehicle with this id.
    pub fn vehicle(&self, id: &str) -> Option<&KnownVehicle> {
        self.vehicles.iter().find(|v| v.id == id)
    }

    /// The effect with this id.
    pub fn effect(&self, id: &str) -> Option<&KnownEffect> {
        self.effects.iter().chain(&self.terms).find(|e| e.id == id)
    }
}
