//! A symbol of a model: what it stands for, its unit, its meaning and its value.

use crate::formula::Symbol;

/// What a symbol stands for; the order is that of the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A coordinate of the configuration.
    Coordinate,
    /// The rate of a coordinate.
    Rate,
    /// A parameter of the model file.
    Parameter,
    /// A logged input.
    Input,
    /// A coefficient of creep; zero is ideal.
    Creep,
    /// A quantity defined by a formula.
    Defined,
    /// A state that no sensor sees.
    State,
    /// A parameter of an effect.
    EffectParameter,
    /// Where the sensor sits, as stated.
    Sensor,
    /// What the sensor measures.
    Measured,
}

impl Kind {
    /// Its name in listings.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Coordinate => "coordinate",
            Kind::Rate => "rate",
            Kind::Parameter => "parameter",
            Kind::Input => "input",
            Kind::Creep => "creep",
            Kind::Defined => "defined",
            Kind::State => "state",
            Kind::EffectParameter => "effect",
            Kind::Sensor => "sensor",
            Kind::Measured => "measured",
        }
    }
}

/// A symbol of a model.
#[derive(Clone, Debug)]
pub struct SymbolEntry {
    /// The symbol.
    pub symbol: Symbol,
    /// Its form in LaTeX, no two alike.
    pub latex: String,
    /// SI unit.
    pub unit: String,
    /// What it means.
    pub meaning: String,
    /// What it stands for.
    pub kind: Kind,
    /// Its value, where the model fixes one.
    pub value: Option<f64>,
}
