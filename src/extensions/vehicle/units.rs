//! The check of units in the description of a user's vehicle.

use crate::error::{Error, Result};
use crate::extensions::units::mixed;
use crate::files::{FormulaText, UserVehicle};
use crate::formula::{Symbol, Unit};

/// What a key of a wheel is measured in.
const SYMBOLS: [(&str, &str); 3] = [("steering", "rad"), ("radius", "m"), ("rate", "rad/s")];

const CORRECT: &str = "correct the formula, or a unit";

/// That each formula has the unit of what it stands for, and each part of a wheel its own.
pub(crate) fn check(own: &UserVehicle) -> Result<()> {
    let of = |s: &Symbol| unit_of(own, s);
    for (symbol, formula) in &own.define {
        let wanted = unit(&own.vehicle.define[symbol].unit);
        expect(formula, &wanted, &of, symbol.as_str()).map_err(|e| e.help(CORRECT))?;
    }
    for (role, formula) in &own.replaced {
        let wanted = unit(&own.vehicle.inputs[role].unit);
        expect(formula, &wanted, &of, role).map_err(|e| e.help(CORRECT))?;
    }
    for (key, formula) in own.parts().flat_map(|p| &p.lengths) {
        let (wanted, help) = match *key {
            "roller" => ("rad", "the angle of rollers is a formula in rad: write roller = \"pi/4\""),
            _ => ("m", "a length is a formula of parameters and defined symbols in m"),
        };
        expect(formula, &unit(wanted), &of, key).map_err(|e| e.help(help))?;
    }
    for (wheel, part) in own.wheels_and_parts() {
        let symbols = [&wheel.steering, &wheel.radius, &wheel.rate];
        for ((key, wanted), symbol) in SYMBOLS.iter().zip(symbols) {
            let Some(definition) = symbol.as_ref().and_then(|s| own.vehicle.define.get(s)) else { continue };
            if !unit(&definition.unit).fits(&unit(wanted)) {
                let name = symbol.as_ref().map_or("", Symbol::as_str);
                let message = format!("the {key} {name} is in {}, but a {key} is in {wanted}", definition.unit);
                let error =
                    part.symbols.get(key).map_or_else(|| part.name.error(&message), |spot| spot.error(&message));
                return Err(error.help("name another symbol, or correct its definition"));
            }
        }
    }
    yaw_rate(own)
}

/// A unit that was checked when it was read.
fn unit(text: &str) -> Unit {
    Unit::parse(text).unwrap_or(Unit::number_unit())
}

fn unit_of(own: &UserVehicle, s: &Symbol) -> Unit {
    let (v, name) = (&own.vehicle, s.as_str());
    let replaced = v.inputs.values().filter_map(|i| i.instead.as_ref()).find(|i| i.role == name);
    let found = v.parameters.get(name).map(|p| &p.unit);
    let found = found.or(v.inputs.get(name).map(|i| &i.unit)).or(v.define.get(s).map(|d| &d.unit));
    // Every name is declared by now.
    unit(found.or(replaced.map(|r| &r.unit)).map_or("1", String::as_str))
}

fn expect(formula: &FormulaText, wanted: &Unit, of: &impl Fn(&Symbol) -> Unit, name: &str) -> Result<()> {
    match formula.formula.eval(of) {
        None => Err(mixed(formula, of, "")),
        Some(found) if found.fits(wanted) => Ok(()),
        Some(found) => Err(wrong(formula, name, &found, wanted)),
    }
}

/// The error of a formula that has the unit of something else.
fn wrong(formula: &FormulaText, name: &str, found: &Unit, wanted: &Unit) -> Error {
    formula.error(format!("the formula for {name} is in {found}, but {name} is in {wanted}"))
}

fn yaw_rate(own: &UserVehicle) -> Result<()> {
    let symbol = Symbol::from("phi'");
    match own.vehicle.define.get(&symbol).filter(|d| !unit(&d.unit).fits(&unit("rad/s"))) {
        None => Ok(()),
        Some(d) => {
            let error = own.names[&symbol].error(format!("the yaw rate phi' is in rad/s, not in {}", d.unit));
            Err(error.help("write unit = \"rad/s\""))
        }
    }
}
