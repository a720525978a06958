//! Test vehicles that forces move, against which a user's effects of forces are checked.

use super::test_vehicle::TestVehicle;
use crate::error::Result;
use crate::model::forces::{Dynamics, Masses, TrailerMass, castors, roles, rolling_rates};
use crate::model::{Model, Trailer, WITH_TRAILERS};
use crate::vehicles::Vehicle;

/// Trailers of a train.
const TRAILERS: usize = 2;
/// The viscous coefficient of every contact, N·s/m: a law lets effects rewrite the force of a contact.
const COEFFICIENT: f64 = 100.0;

impl TestVehicle {
    /// Every vehicle that forces may move, driven by all that may drive it; then each that pulls, with two trailers.
    pub fn forced(vehicles: &[Vehicle]) -> Result<Vec<Self>> {
        let moved = |trailers: usize, label: &dyn Fn(&Vehicle) -> String| -> Result<Vec<Self>> {
            let able = vehicles.iter().filter(|v| trailers == 0 || v.pulls());
            able.filter_map(|v| Some(Self::of(label(v), under_forces(v, trailers)?))).collect()
        };
        let alone = moved(0, &|v| format!("{} with [dynamics]", v.id))?;
        let trains = moved(TRAILERS, &|v| format!("{WITH_TRAILERS} behind {} with [dynamics]", v.id))?;
        Ok(alone.into_iter().chain(trains).collect())
    }
}

/// A vehicle under forces; `None` where it has sections of its own, or something that no force moves.
fn under_forces(vehicle: &Vehicle, trailers: usize) -> Option<Model> {
    let model = Model::sample(vehicle).ok()?.with_trailers(&vec![Trailer { length: 1.0, hitch: 1.0 }; trailers]);
    let masses = Masses {
        mass: 1.0,
        inertia: 1.0,
        mass_offset: 0.1,
        wheels: rolling_rates(vehicle).into_iter().map(|rate| (rate, 0.1)).collect(),
        castors: castors(vehicle).into_iter().map(|angle| (angle, 0.1)).collect(),
        trailers: vec![TrailerMass { mass: 1.0, inertia: 1.0, mass_offset: 0.1 }; trailers],
    };
    let names = roles(vehicle);
    let driven: Vec<&str> = names.iter().map(|(role, ..)| role.as_str()).collect();
    let dynamics = Dynamics::new(&model, &masses).ok()?.driven_by(&driven).ok()?;
    dynamics.with_laws("viscous", &[COEFFICIENT]).ok()?.model().ok()
}
