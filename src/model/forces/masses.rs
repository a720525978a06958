//! The masses and moments of inertia of a vehicle.

use crate::error::Error;
use crate::formula::Symbol;
use std::collections::BTreeMap;

/// What the bodies of a vehicle weigh; the wheels' own mass is part of the body that carries them.
///
/// | field | unit | meaning |
/// |---|---|---|
/// | `mass` | kg | of the body |
/// | `inertia` | kg·m² | of the body about the vertical through its centre of mass; 0 on a line |
/// | `mass_offset` | m | centre of mass ahead of the reference point |
/// | `wheels` | kg·m² | moments about the axle by the rate of the wheel, such as `theta_1'`; 0 where left out |
/// | `castors` | kg·m² | moments about the axis of steering by the angle of a castor; 0 where left out |
/// | `trailers` | | nearest first |
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Masses {
    /// Mass of the body.
    pub mass: f64,
    /// Its moment of inertia.
    pub inertia: f64,
    /// Its centre of mass.
    pub mass_offset: f64,
    /// Moments of the wheels.
    pub wheels: BTreeMap<Symbol, f64>,
    /// Moments of castors about their axis of steering.
    pub castors: BTreeMap<Symbol, f64>,
    /// The trailers.
    pub trailers: Vec<TrailerMass>,
}

/// What a trailer weighs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TrailerMass {
    /// Its mass, kg.
    pub mass: f64,
    /// Its moment of inertia about the vertical through its centre of mass, kg·m².
    pub inertia: f64,
    /// Its centre of mass ahead of its axle, m.
    pub mass_offset: f64,
}

/// Symbols of mass, moment of inertia and centre of mass of a body; the towing one is number 0.
pub(super) fn symbols(body: usize) -> [Symbol; 3] {
    let name = if body == 0 { "body".to_string() } else { format!("trailer_{body}") };
    ["mass", "inertia", "mass_offset"].map(|quantity| Symbol::new(&format!("{name}.{quantity}")))
}

/// The symbol of the moment of inertia that goes with a coordinate.
pub(super) fn inertia_of(coordinate: &Symbol) -> Symbol {
    Symbol::new(&format!("{coordinate}.inertia"))
}

impl Masses {
    /// The value of every symbol of the bodies.
    pub(super) fn values(&self) -> BTreeMap<Symbol, f64> {
        let first = TrailerMass { mass: self.mass, inertia: self.inertia, mass_offset: self.mass_offset };
        let bodies = std::iter::once(&first).chain(&self.trailers).enumerate();
        bodies.flat_map(|(i, b)| symbols(i).into_iter().zip([b.mass, b.inertia, b.mass_offset])).collect()
    }
}

/// What a coordinate without inertia that no contact holds is refused with.
pub(crate) fn without_inertia(coordinate: &Symbol) -> Error {
    let message = format!("nothing says how {coordinate} accelerates: it has neither mass nor an ideal contact");
    Error::input(message).help("give it a moment of inertia under [dynamics], or make its contact ideal")
}
