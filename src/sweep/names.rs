//! The names of what a sweep varies, checked against the model.

use crate::error::{Error, Result};
use crate::files::{ModelFile, Spot, advice, shown};
use crate::formula::Symbol;
use crate::model::Model;
use crate::motion::Varied;

/// A quantity of the model that may vary: its name in the file, what it is, and the values it may take.
pub(crate) struct Quantity {
    pub name: String,
    pub varied: Varied,
    pub allowed: Allowed,
}

/// Values a quantity may take.
#[derive(Clone, Copy)]
pub(crate) struct Allowed {
    min: f64,
    max: f64,
    /// Whether `min` itself is not allowed.
    above: bool,
}

impl Allowed {
    const ANY: Self = Self { min: f64::NEG_INFINITY, max: f64::INFINITY, above: false };
    const POSITIVE: Self = Self { min: 0.0, max: f64::INFINITY, above: true };

    pub fn holds(&self, value: f64) -> bool {
        value <= self.max && if self.above { value > self.min } else { value >= self.min }
    }

    /// Refuses a value that is not allowed.
    pub fn check(&self, name: &str, value: f64, spot: &Spot) -> Result<()> {
        if self.holds(value) { Ok(()) } else { Err(spot.told(self.refusal(name, value))) }
    }

    /// Why a value is not allowed.
    pub fn refusal(&self, name: &str, value: f64) -> Error {
        let advice = match self.above {
            true => "it must be greater than zero, in SI units".to_string(),
            false => format!("it must lie within {:?} and {:?}", self.min, self.max),
        };
        Error::input(format!("{name} = {value:?} is out of range")).help(advice)
    }
}

/// Everything of the model that may vary.
pub(crate) fn quantities(file: &ModelFile, model: &Model) -> Vec<Quantity> {
    let of_model = |name: String, symbol: Symbol, allowed| Quantity { name, varied: Varied::Model(symbol), allowed };
    let sign = |name: &str| if name.ends_with("offset") { Allowed::ANY } else { Allowed::POSITIVE };
    let mut found: Vec<Quantity> =
        file.parameters.keys().map(|k| of_model(k.clone(), Symbol::new(k), sign(k))).collect();
    for i in 1..=model.trailers.len() {
        // The file counts the trailers it adds, the model those of the vehicle before them.
        let number = model.vehicle.trailers.len() + i;
        let [length, hitch] = ["trailer_length", "hitch_offset"].map(|name| Symbol::new(&format!("{name}_{number}")));
        found.push(of_model(format!("trailer_lengths.{i}"), length, Allowed::POSITIVE));
        found.push(of_model(format!("hitch_offsets.{i}"), hitch, Allowed::ANY));
    }
    for (name, symbol) in [
        ("sensor.lever_arm.1", "sensor.a"),
        ("sensor.lever_arm.2", "sensor.b"),
        ("sensor.heading_offset", "sensor.heading_offset"),
    ] {
        found.push(of_model(name.into(), symbol.into(), Allowed::ANY));
    }
    for applied in &model.effects {
        let title = match applied.trailer {
            Some(i) => format!("{}.{i}", applied.effect.id),
            None => applied.effect.id.clone(),
        };
        for (name, parameter) in &applied.effect.parameters {
            let allowed = Allowed { min: parameter.range[0], max: parameter.range[1], above: false };
            found.push(of_model(format!("{title}.{name}"), applied.symbol(name), allowed));
        }
    }
    for symbol in model.values().into_keys() {
        // Masses, moments and coefficients of contacts, by the names that the equations have for them.
        if let Some(name) = symbol.as_str().strip_prefix("stated.") {
            found.push(of_model(name.into(), symbol.clone(), sign(name)));
        }
    }
    let pose = ["initial.x", "initial.y", "initial.heading"].map(String::from).into_iter();
    let pose = pose.chain((1..=model.trailer_count()).map(|i| format!("initial.trailer_headings.{i}")));
    let speeds = model.forced.iter().flat_map(|forced| &forced.nodes).map(|speed| format!("start.{speed}"));
    let initial = |(i, name)| Quantity { name, varied: Varied::Initial(i), allowed: Allowed::ANY };
    found.extend(pose.chain(speeds).enumerate().map(initial));
    found
}

/// The quantity of a name: one of the model, or a constant of the inputs' formulas.
pub(super) fn find(name: &str, spot: &Spot, known: &[Quantity], used: &[Symbol]) -> Result<(Varied, Allowed)> {
    if let Some(found) = quantity(name, known) {
        return Ok(found);
    }
    if used.iter().any(|s| s.as_str() == name) {
        return Ok((Varied::Input(Symbol::new(name)), Allowed::ANY));
    }
    let names: Vec<&str> = used.iter().map(Symbol::as_str).chain(known.iter().map(|q| q.name.as_str())).collect();
    Err(unknown(name, spot, &names))
}

/// The quantity of the model that has a name.
pub(crate) fn of_model(name: &str, known: &[Quantity]) -> Result<(Varied, Allowed)> {
    quantity(name, known).ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|q| q.name.as_str()).collect();
        let message = format!("no quantity of the model is called \"{}\"", shown(name));
        Error::input(message).help(advice(name, "what may vary", &names))
    })
}

fn quantity(name: &str, known: &[Quantity]) -> Option<(Varied, Allowed)> {
    known.iter().find(|q| q.name == name).map(|q| (q.varied.clone(), q.allowed))
}

fn unknown(name: &str, spot: &Spot, names: &[&str]) -> Error {
    let message = format!("nothing is called \"{}\": no quantity of the model, no name of a formula", shown(name));
    spot.error(message).help(advice(name, "what may vary", names))
}
