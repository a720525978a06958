//! The dynamics of a model from the `[dynamics]` of its file.

use super::bodies::castors;
use super::contact::slug;
use super::description::Dynamics;
use super::masses::{Masses, TrailerMass};
use crate::error::Result;
use crate::files::DynamicsEntry;
use crate::formula::Symbol;
use crate::model::vehicle_model::Model;
use crate::vehicles::Vehicle;

impl Model {
    /// The model with the forces that the section of a file describes, before any effect.
    ///
    /// # Errors
    /// As [`Dynamics::model`].
    pub(crate) fn with_forces(&self, entry: &DynamicsEntry) -> Result<Self> {
        Dynamics::of_entry(entry, self)?.model()
    }

    /// The speeds that are free at the start, as the section of a file gives them, those of trailers and wheels at rest; none
    /// without the section.
    pub fn speeds_at_start(&self, entry: Option<&DynamicsEntry>) -> Vec<f64> {
        let start = entry.map(|entry| entry.start).unwrap_or_default();
        let speed = |name: &Symbol| match name.as_str() {
            "body.u" => start.speed,
            "body.w" => start.lateral_speed.unwrap_or(0.0),
            "body.omega" => start.yaw_rate.unwrap_or(0.0),
            _ => 0.0,
        };
        self.forced.iter().flat_map(|forced| &forced.nodes).map(speed).collect()
    }
}

impl Dynamics {
    /// The dynamics of a model without effects as the section of a file describes them.
    ///
    /// # Errors
    /// When masses, laws or inputs do not fit the vehicle.
    pub(crate) fn of_entry(entry: &DynamicsEntry, model: &Model) -> Result<Self> {
        let dynamics = Self::new(model, &masses(entry, &model.vehicle))?;
        let dynamics = entry.friction.iter().try_fold(dynamics, |d, c| d.with_law(&c.contact, &c.law, &c.values))?;
        let forces: Vec<&str> = entry.forces.iter().map(String::as_str).collect();
        let driven = dynamics.driven_by(&forces)?;
        Ok(if entry.steered_by_rate { driven.steered_by_rate() } else { driven })
    }

    /// Whether any contact has a law: then the motion may be stiff.
    pub fn has_friction(&self) -> bool {
        self.contacts.iter().any(|c| c.law.is_some())
    }
}

fn masses(entry: &DynamicsEntry, vehicle: &Vehicle) -> Masses {
    let [mass, inertia, mass_offset] = entry.body;
    let wheel = |w: &crate::vehicles::Wheel| Some((w.rate.clone()?, *entry.wheel_inertia.get(&slug(&w.name))?));
    let trailer = |[mass, inertia, mass_offset]: &[f64; 3]| TrailerMass {
        mass: *mass,
        inertia: *inertia,
        mass_offset: *mass_offset,
    };
    Masses {
        mass,
        inertia,
        mass_offset,
        wheels: vehicle.wheels.iter().filter_map(wheel).collect(),
        castors: castors(vehicle).into_iter().map(|a| (a, entry.castor_inertia)).collect(),
        trailers: entry.trailers.iter().map(trailer).collect(),
    }
}
