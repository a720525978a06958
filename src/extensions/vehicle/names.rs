//! The check of names in the description of a user's vehicle.

use crate::describe::universal;
use crate::error::Result;
use crate::files::{FormulaText, Spot, UserPart, UserVehicle, advice, shown};
use crate::formula::Symbol;
use crate::vehicles::Wheel;
use std::collections::BTreeSet;

/// That every name is declared, is not one that all models have, and stands for one thing.
pub(crate) fn check(own: &UserVehicle) -> Result<()> {
    for (symbol, spot) in &own.names {
        // A logged yaw rate is the one name of every model that a vehicle may define.
        let is_yaw_rate = symbol.as_str() == "phi'" && own.define.contains_key(symbol);
        free(symbol, spot).or_else(|e| if is_yaw_rate { Ok(()) } else { Err(e) })?;
    }
    let declared = |s: &Symbol| own.names.contains_key(s) && !is_replacement(own, s);
    own.define.values().try_for_each(|f| formula(own, f, declared))?;
    for (input, f) in &own.replaced {
        let role = own.vehicle.inputs[input].instead.as_ref().map(|i| Symbol::new(&i.role));
        formula(own, f, |s| Some(s) == role.as_ref() || own.vehicle.parameters.contains_key(s.as_str()))?;
    }
    own.parts()
        .flat_map(|p| &p.lengths)
        .try_for_each(|(key, f)| formula(own, f, |s| declared(s) || *key == "roller" && s.as_str() == "pi"))?;
    own.wheels_and_parts().try_for_each(|(w, part)| symbols(own, w, part))?;
    circle(own)
}

fn is_replacement(own: &UserVehicle, s: &Symbol) -> bool {
    own.vehicle.inputs.values().filter_map(|i| i.instead.as_ref()).any(|i| i.role == s.as_str())
}

fn free(symbol: &Symbol, spot: &Spot) -> Result<()> {
    match universal(symbol.as_str()) {
        None => Ok(()),
        Some(meaning) => Err(spot
            .error(format!("{symbol} is a name of every model: {meaning}"))
            .help("give yours another name, such as one with a letter as its index")),
    }
}

fn formula(own: &UserVehicle, f: &FormulaText, may: impl Fn(&Symbol) -> bool) -> Result<()> {
    match f.formula.symbols().into_iter().find(|s| !may(s)) {
        None => Ok(()),
        Some(name) => {
            let error = f.error_at(&name, format!("nothing here is called \"{}\"", shown(name.as_str())));
            Err(error.help(suggestion(own, &name, may)))
        }
    }
}

/// The symbols of a wheel: some are defined, some are its own.
fn symbols(own: &UserVehicle, wheel: &Wheel, part: &UserPart) -> Result<()> {
    let defined = |s: &Symbol| own.define.contains_key(s);
    let all = [
        ("steering", &wheel.steering),
        ("radius", &wheel.radius),
        ("rate", &wheel.rate),
        ("rotation_creep", &wheel.rotation_creep),
        ("traverse_creep", &wheel.traverse_creep),
    ];
    for (key, symbol) in all {
        let (Some(symbol), Some(spot)) = (symbol, part.symbols.get(key)) else { continue };
        if own.names.contains_key(symbol) && !defined(symbol) {
            let unit = unit(own, symbol);
            let message = format!("{key} = \"{symbol}\" is a name of model files, not a symbol of formulas");
            let letter = if key == "steering" {
                "delta"
            } else if key == "radius" {
                "r"
            } else {
                "theta'"
            };
            let line = format!("{letter} = {{ formula = \"{symbol}\", unit = \"{unit}\", meaning = \"…\" }}");
            return Err(spot.error(message).help(format!("below [vehicle.define] write {line}, and here {letter}")));
        }
        if key == "radius" && !defined(symbol) {
            let error = spot.error(format!("the radius {symbol} has no definition"));
            return Err(error.help(suggestion(own, symbol, defined)));
        }
        if key.ends_with("creep") {
            coefficient(own, key, symbol, spot)?;
        } else if !defined(symbol) {
            free(symbol, spot)?;
        }
    }
    Ok(())
}

fn unit(own: &UserVehicle, s: &Symbol) -> String {
    let parameter = own.vehicle.parameters.get(s.as_str()).map(|p| &p.unit);
    parameter.or(own.vehicle.inputs.get(s.as_str()).map(|i| &i.unit)).cloned().unwrap_or_else(|| "1".into())
}

/// A coefficient of creep is no other quantity, and of one kind.
fn coefficient(own: &UserVehicle, key: &str, symbol: &Symbol, spot: &Spot) -> Result<()> {
    free(symbol, spot)?;
    let refuse = |why: String| Err(spot.error(why).help("give the coefficient a name of its own, such as e_b"));
    if own.names.contains_key(symbol) {
        return refuse(format!("{symbol} is also a defined symbol"));
    }
    let wheels = || own.vehicle.all_wheels();
    let is = |s: &Option<Symbol>| s.as_ref() == Some(symbol);
    let other = if key == "rotation_creep" { "traverse" } else { "rotation" };
    let clash = wheels().find(|w| is(if other == "traverse" { &w.traverse_creep } else { &w.rotation_creep }));
    if let Some(clash) = clash {
        return refuse(format!("{symbol} is also the {other} creep of the wheel \"{}\"", shown(&clash.name)));
    }
    match wheels().find(|w| is(&w.steering) || is(&w.radius)) {
        Some(clash) => refuse(format!("{symbol} is also an angle or a radius of the wheel \"{}\"", shown(&clash.name))),
        None => Ok(()),
    }
}

/// That definitions lead from one to the next.
fn circle(own: &UserVehicle) -> Result<()> {
    let mut open: BTreeSet<&Symbol> = own.define.keys().collect();
    loop {
        let ready: Vec<&Symbol> = open
            .iter()
            .filter(|s| own.define[**s].formula.symbols().iter().all(|p| !open.contains(p)))
            .copied()
            .collect();
        if ready.is_empty() {
            break;
        }
        open.retain(|s| !ready.contains(s));
    }
    let Some(first) = open.iter().min_by_key(|s| own.names[**s].line()) else { return Ok(()) };
    let names: Vec<&str> = open.iter().map(|s| s.as_str()).collect();
    let error = own.define[*first].error(format!("the formulas of {} use each other in a circle", names.join(", ")));
    Err(error.help("define each from parameters, inputs and what needs none of the others"))
}

/// Advice for a name that the vehicle does not have.
fn suggestion(own: &UserVehicle, name: &Symbol, may: impl Fn(&Symbol) -> bool) -> String {
    let names: Vec<&str> = own.names.keys().filter(|s| may(s)).map(Symbol::as_str).collect();
    advice(name.as_str(), "it has", &names)
}
