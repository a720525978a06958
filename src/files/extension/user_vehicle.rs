//! `UserVehicle`: a vehicle of a user's own and the places of its parts in the file, for errors found after it was read.

use crate::error::Result;
use crate::files::toml::formula_text::FormulaText;
use crate::files::toml::location::Spot;
use crate::files::toml::spanned_table::Value;
use crate::formula::Symbol;
use crate::vehicles::{Vehicle, Wheel};
use std::collections::BTreeMap;

/// A vehicle and the places of its parts.
#[derive(Clone, Debug)]
pub struct UserVehicle {
    /// The vehicle.
    pub vehicle: Vehicle,
    /// Where its id stands.
    pub id: Spot,
    /// Where it says what to use instead.
    pub instead: Option<Spot>,
    /// Where each parameter, input, replacement of an input and defined symbol is named.
    pub names: BTreeMap<Symbol, Spot>,
    /// The formulas of the defined symbols.
    pub define: BTreeMap<Symbol, FormulaText>,
    /// The formulas of inputs from the columns logged in their place, by input.
    pub replaced: BTreeMap<String, FormulaText>,
    /// The wheels.
    pub wheels: Vec<UserPart>,
    /// The wheels that only follow.
    pub followers: Vec<UserPart>,
    /// The trailers.
    pub trailers: Vec<UserPart>,
    /// Where each coordinate of its own is named.
    pub coordinates: Vec<Spot>,
    /// Its constraints beside those of wheels.
    pub constraints: Vec<UserConstraint>,
    /// Where each held name stands.
    pub held: Vec<Spot>,
}

impl UserVehicle {
    /// The places of all wheels and trailers.
    pub fn parts(&self) -> impl Iterator<Item = &UserPart> {
        self.wheels.iter().chain(&self.followers).chain(&self.trailers)
    }

    /// All wheels with their places.
    pub fn wheels_and_parts(&self) -> impl Iterator<Item = (&Wheel, &UserPart)> {
        self.vehicle.all_wheels().zip(self.wheels.iter().chain(&self.followers))
    }
}

/// The places of a wheel or a trailer.
#[derive(Clone, Debug)]
pub struct UserPart {
    /// Where it is named.
    pub name: Spot,
    /// Its lengths by key.
    pub lengths: BTreeMap<&'static str, FormulaText>,
    /// Where its symbols stand, by key.
    pub symbols: BTreeMap<&'static str, Spot>,
}

/// The places of a constraint.
#[derive(Clone, Debug)]
pub struct UserConstraint {
    /// Where it is named.
    pub name: Spot,
    /// Where its coefficient stands.
    pub creep: Spot,
    /// What stands in its slots, or the energy and the generator it is derived from.
    pub formulas: Vec<FormulaText>,
}

impl UserVehicle {
    /// Declares a name that a formula or a model file may use.
    pub(crate) fn declare(&mut self, symbol: Symbol, value: &Value) -> Result<()> {
        match self.names.insert(symbol.clone(), Spot::at(value.source, value.key_at)) {
            None => Ok(()),
            Some(first) => Err(value
                .key_error(format!("{symbol} is declared twice, first at line {}", first.line()))
                .help("parameters, inputs and defined symbols share one set of names; give one of them another")),
        }
    }
}
