//! A vehicle: a body with wheels, trailers, inputs and parameters.

use super::moves::Moves;
use crate::formula::{Expr, Symbol};
use crate::mechanism::Constraint;
use crate::provenance::Origin;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A body with wheels: the description from which constraints and motion are derived.
///
/// ```
/// use creepage::vehicles;
/// let car = vehicles::named("car").unwrap();
/// assert!(car.parameters.contains_key("wheelbase") && car.wheels.len() > 1);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vehicle {
    /// Its name in model files.
    pub id: String,
    /// What it is, in a line.
    pub title: String,
    /// Parameters of the model file.
    #[serde(default)]
    pub parameters: BTreeMap<String, Quantity>,
    /// Measured inputs.
    #[serde(default)]
    pub inputs: BTreeMap<String, Input>,
    /// The symbols of its formulas.
    #[serde(default)]
    pub define: BTreeMap<Symbol, Definition>,
    /// Its wheels.
    #[serde(default)]
    pub wheels: Vec<Wheel>,
    /// Wheels that only follow: they constrain nothing that the others do not, and the motion gives the rate of each that
    /// rolls and the coefficient of traverse creep of each that has a direction.
    #[serde(default)]
    pub followers: Vec<Wheel>,
    /// Its constraints beside those of wheels: of any type, in rates of its coordinates.
    #[serde(default)]
    pub constraints: Vec<Constraint>,
    /// Its coordinates, where they are not those of a body in the plane with its wheels.
    #[serde(default)]
    pub coordinates: Vec<Coordinate>,
    /// The coordinate that is its heading, for a vehicle with coordinates of its own; phi where it has that.
    pub heading: Option<Symbol>,
    /// Trailers that are a part of it, the one behind the body first.
    #[serde(default)]
    pub trailers: Vec<Section>,
    /// It moves along a line in the direction of its heading: one coordinate s, no yaw, no sideways motion.
    #[serde(default)]
    pub line: bool,
    /// Names of the motion that no effect may rewrite, because the effects take them to mean something else: a
    /// forward speed across the wheels, a yaw rate that the geometry forbids.
    #[serde(default)]
    pub held: Vec<Symbol>,
    /// What to use instead, for a vehicle whose constraints do not determine its motion.
    pub instead: Option<String>,
    /// The file of a user that describes it; none for one of the catalogue.
    #[serde(skip)]
    pub origin: Option<Arc<Origin>>,
}

impl Vehicle {
    /// Whether the constraints determine the motion from the inputs; if not, it can only be described.
    pub fn moves(&self) -> bool {
        self.instead.is_none()
    }

    /// Whether trailers can be put behind it.
    pub fn pulls(&self) -> bool {
        self.moves() && !self.line && self.coordinates.is_empty()
    }

    /// Its wheels, those that only follow last.
    pub fn all_wheels(&self) -> impl Iterator<Item = &Wheel> {
        self.wheels.iter().chain(&self.followers)
    }

    /// The coefficients of creep of its wheels and other constraints; one that several share comes once for each. The
    /// traverse creep of a wheel that follows is none to choose.
    pub fn creeps(&self) -> impl Iterator<Item = &Symbol> {
        let wheels = self.wheels.iter().flat_map(|w| [&w.rotation_creep, &w.traverse_creep]).flatten();
        let following = self.followers.iter().filter_map(|w| w.rotation_creep.as_ref());
        wheels.chain(self.constraints.iter().map(|c| &c.creep)).chain(following)
    }

    /// What a logged input does to the body, an input or a column in the place of one: as it is declared, else by its
    /// name; `None` where neither says.
    pub fn moved_by(&self, role: &str) -> Option<Moves> {
        let instead = || self.inputs.values().filter_map(|i| i.instead.as_ref()).find(|i| i.role == role)?.moves;
        let declared = self.inputs.get(role).map_or_else(instead, |i| i.moves);
        declared.or_else(|| Moves::usual(role))
    }

    /// The unit of a logged input; a speed may be logged in the place of a wheel's rate, whatever the vehicle.
    pub fn unit_of(&self, role: &str) -> &str {
        self.inputs.get(role).map_or("m/s", |input| &input.unit)
    }

    /// The first input that does this to the body.
    pub fn input_that(&self, moves: Moves) -> Option<&str> {
        self.inputs.keys().find(|role| self.moved_by(role) == Some(moves)).map(String::as_str)
    }

    /// The coordinate of that name among those of its own.
    pub fn coordinate(&self, name: &str) -> Option<&Coordinate> {
        self.coordinates.iter().find(|c| c.name.as_str() == name)
    }

    /// Whether it has coordinates of its own and none of them is a place in the plane: only its shape and its heading
    /// move.
    pub fn stays(&self) -> bool {
        !self.coordinates.is_empty() && self.coordinate("x").is_none()
    }

    /// Whether no effect may rewrite a name.
    pub fn holds(&self, name: &Symbol) -> bool {
        let moves = || ["v_d", "v_n", "v_l", "v_t", "x'", "y'"].contains(&name.as_str());
        self.held.contains(name) || !self.coordinates.is_empty() && moves()
    }

    /// The number of the trailer that a wheel stands on, from one; zero for a wheel of the body.
    ///
    /// A name that no trailer has means the body; a file with such a name is refused.
    pub fn section_of(&self, wheel: &Wheel) -> usize {
        let on = |name: &String| self.trailers.iter().position(|t| t.name == *name);
        wheel.on.as_ref().and_then(on).map_or(0, |i| i + 1)
    }

    /// The wheels of the body (zero) or of one of its trailers.
    pub fn wheels_on(&self, section: usize) -> impl Iterator<Item = &Wheel> {
        self.wheels.iter().filter(move |w| self.section_of(w) == section)
    }

    /// Whether a symbol is no formula of the inputs: the angle of a castor, the rate of a passive wheel.
    pub fn is_free(&self, symbol: &Symbol) -> bool {
        !self.define.contains_key(symbol)
    }
}

/// A coordinate of its own.
///
/// ```
/// use creepage::vehicles::{self, Coordinate};
/// let all: Vec<&Coordinate> = vehicles::all().iter().flat_map(|vehicle| &vehicle.coordinates).collect();
/// assert!(all.iter().all(|coordinate| !coordinate.meaning.is_empty()));
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coordinate {
    /// Its symbol.
    pub name: Symbol,
    /// SI unit.
    pub unit: String,
    /// Meaning.
    pub meaning: String,
}

/// Unit and meaning of a number.
///
/// ```
/// use creepage::vehicles;
/// let car = vehicles::named("car").unwrap();
/// assert_eq!(car.parameters["wheelbase"].unit, "m");
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantity {
    /// SI unit.
    pub unit: String,
    /// Meaning.
    pub meaning: String,
    /// Whether it may be left out.
    #[serde(default)]
    pub optional: bool,
}

/// A measured input.
///
/// ```
/// use creepage::vehicles;
/// let car = vehicles::named("car").unwrap();
/// assert!(car.inputs.values().all(|input| !input.unit.is_empty()));
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// SI unit.
    pub unit: String,
    /// Meaning.
    pub meaning: String,
    /// What it does to the body; by its name where it is not declared.
    pub moves: Option<Moves>,
    /// Another column that may be logged in its place.
    pub instead: Option<Instead>,
}

/// A column that may stand for an input, and the formula that gives the input from it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Instead {
    /// Role of the column.
    pub role: String,
    /// What it does to the body; by its name where it is not declared.
    pub moves: Option<Moves>,
    /// SI unit.
    pub unit: String,
    /// The input as a formula of this role and the parameters.
    pub formula: Expr,
}

/// A symbol of the vehicle's formulas.
///
/// ```
/// use creepage::vehicles;
/// let car = vehicles::named("car").unwrap();
/// assert!(car.define.values().all(|definition| definition.formula.to_string() != ""));
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Definition {
    /// Its formula in parameters and inputs.
    pub formula: Expr,
    /// SI unit.
    pub unit: String,
    /// Meaning.
    pub meaning: String,
}

/// A trailer that is a part of a vehicle: a bar from its hitch back to an axle that keeps its direction.
///
/// Its heading is phi_i, the coefficient of its traverse creep e_tc_i, with i its number from one.
///
/// ```
/// use creepage::vehicles::{self, Section};
/// let all: Vec<&Section> = vehicles::all().iter().flat_map(|vehicle| &vehicle.trailers).collect();
/// assert!(all.iter().all(|section| !section.name.is_empty()));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Section {
    /// What it is called.
    pub name: String,
    /// From its hitch back to its axle, m.
    pub length: Expr,
    /// The hitch behind the reference point of the body, or behind the axle of the trailer ahead, m.
    #[serde(default = "zero")]
    pub hitch: Expr,
}

/// A wheel, or an axle's worth of aligned wheels.
///
/// ```
/// use creepage::vehicles;
/// let car = vehicles::named("car").unwrap();
/// assert!(car.wheels.iter().all(|wheel| wheel.on.is_none()));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wheel {
    /// What it is called.
    pub name: String,
    /// The trailer it stands on, by name; the body when left out. Its place is then counted from that trailer's axle.
    pub on: Option<String>,
    /// Distance ahead of the reference point, m.
    #[serde(default = "zero")]
    pub forward: Expr,
    /// Distance to the left of the reference point, m.
    #[serde(default = "zero")]
    pub left: Expr,
    /// Angle from the body's heading to the wheel's, rad. With a definition it is known: steered by an input, or
    /// mounted at a constant angle; without one it turns freely, as a castor's does.
    pub steering: Option<Symbol>,
    /// Distance from the axis of steering back to the contact along the wheel, m; of a castor, its trail.
    #[serde(default = "zero")]
    pub trail: Expr,
    /// Angle from the wheel's heading to the axis of the roller that stands on the ground, rad, of a Swedish wheel (mecanum):
    /// the contact is free across that axis. An omni wheel's is 0, which is the same as none for a wheel without a direction.
    /// `pi` may stand in it.
    pub roller: Option<Expr>,
    /// Rolling radius, m.
    pub radius: Option<Symbol>,
    /// Its rate: then it rolls (type R). With a definition it is measured; without one the wheel is passive.
    pub rate: Option<Symbol>,
    /// Coefficient of its rotation creep.
    pub rotation_creep: Option<Symbol>,
    /// Coefficient of its traverse creep: then it has a direction (type T).
    pub traverse_creep: Option<Symbol>,
}

fn zero() -> Expr {
    Expr::int(0)
}
