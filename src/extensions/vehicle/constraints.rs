//! The check of constraints beside those of wheels: of known names, of one unit, in rates of coordinates.

use crate::describe::universal;
use crate::error::Result;
use crate::extensions::units::{mixed, unlike};
use crate::files::{UserConstraint, UserVehicle, advice, shown};
use crate::formula::{Symbol, Unit};
use crate::mechanism::Constraint;
use crate::model::mechanism;
use std::collections::BTreeSet;

/// That each constraint speaks of the vehicle's coordinates and has one unit.
pub(crate) fn check(own: &UserVehicle) -> Result<()> {
    coordinates(own)?;
    let coordinates = mechanism(&own.vehicle, 0).coordinates;
    let each = || own.vehicle.constraints.iter().zip(&own.constraints);
    each().try_for_each(|(c, places)| {
        coefficient(own, c, places)?;
        names(own, places, &coordinates)?;
        rates(c, places, &coordinates)?;
        units(own, c, places)
    })
}

/// A coordinate is a place and a heading by the names that every model has, or has a name of its own.
fn coordinates(own: &UserVehicle) -> Result<()> {
    for (c, spot) in own.vehicle.coordinates.iter().zip(&own.coordinates) {
        let (name, v) = (c.name.as_str(), &own.vehicle);
        let place = [("x", "m"), ("y", "m"), ("phi", "rad")].into_iter().find(|(n, _)| *n == name);
        if let Some((_, unit)) = place.filter(|(_, unit)| *unit != c.unit) {
            return Err(spot.error(format!("{name} is in {unit}, not in {}", c.unit)).help("correct its unit"));
        }
        if let (None, Some(meaning)) = (place, universal(name)) {
            let error = spot.error(format!("{name} is a name of every model: {meaning}"));
            return Err(error.help("give the coordinate another name"));
        }
        if v.parameters.contains_key(name) || v.inputs.contains_key(name) {
            let error = spot.error(format!("the coordinate {name} is also a parameter or an input"));
            return Err(error.help("give the input another name, and define the coordinate from it"));
        }
    }
    match (own.vehicle.coordinate("x").is_some(), own.vehicle.coordinate("y").is_some()) {
        (true, false) | (false, true) => {
            Err(own.id.error("the place of a vehicle has two coordinates, x and y").help("give both, or none"))
        }
        _ => Ok(()),
    }
}

fn names(own: &UserVehicle, places: &UserConstraint, coordinates: &[Symbol]) -> Result<()> {
    let moves = |s: &Symbol| coordinates.iter().any(|q| q == s || q.rate() == *s);
    let replaced =
        |s: &Symbol| own.vehicle.inputs.values().filter_map(|i| i.instead.as_ref()).any(|i| i.role == s.as_str());
    let known = |s: &Symbol| own.names.contains_key(s) && !replaced(s) || moves(s);
    for f in &places.formulas {
        if let Some(name) = f.formula.symbols().into_iter().find(|s| !known(s)) {
            let all = own.names.keys().cloned().chain(coordinates.iter().flat_map(|q| [q.clone(), q.rate()]));
            let all: BTreeSet<Symbol> = all.filter(known).collect();
            let names: Vec<&str> = all.iter().map(Symbol::as_str).collect();
            let error = f.error_at(&name, format!("nothing here is called \"{}\"", shown(name.as_str())));
            return Err(error.help(advice(name.as_str(), "it has", &names)));
        }
    }
    Ok(())
}

fn rates(c: &Constraint, places: &UserConstraint, coordinates: &[Symbol]) -> Result<()> {
    let row = c.row();
    let Some(stray) = row.rates().find(|r| coordinates.iter().all(|q| q.rate() != **r)) else { return Ok(()) };
    let names: Vec<&str> = coordinates.iter().map(Symbol::as_str).collect();
    let at = places.formulas.iter().find(|f| f.formula.mentions(stray));
    let message = format!("{stray} is the rate of no coordinate; the coordinates are {}", names.join(", "));
    let error = at.map_or_else(|| places.name.error(&message), |f| f.error_at(stray, &message));
    Err(error.help("give the vehicle coordinates of its own, all of them, below [[vehicle.coordinates]]"))
}

fn units(own: &UserVehicle, c: &Constraint, places: &UserConstraint) -> Result<()> {
    let of = |s: &Symbol| unit_of(own, s);
    if let Some(f) = places.formulas.iter().find(|f| f.formula.eval(&of).is_none()) {
        return Err(mixed(f, &of, ""));
    }
    let form = c.generic();
    match form.eval(&of) {
        Some(_) => Ok(()),
        None => Err(places
            .name
            .error(format!("with its slots put in, {}", unlike(&form, &of, "")))
            .help("every term of a constraint has one unit; correct a slot")),
    }
}

/// The unit of a declared name, of a coordinate, or of a rate.
fn unit_of(own: &UserVehicle, s: &Symbol) -> Unit {
    let parse = |text: &str| Unit::parse(text).unwrap_or(Unit::number_unit());
    let v = &own.vehicle;
    let declared = v.define.get(s).map(|d| d.unit.as_str());
    let declared = declared.or_else(|| v.parameters.get(s.as_str()).map(|p| p.unit.as_str()));
    let declared = declared.or_else(|| v.inputs.get(s.as_str()).map(|i| i.unit.as_str()));
    if let Some(unit) = declared {
        return parse(unit);
    }
    let coordinate = |name: &str| match (v.coordinate(name), name) {
        (Some(c), _) => c.unit.clone(),
        (None, "x" | "y" | "s") => "m".into(),
        _ => "rad".into(),
    };
    match s.as_str().strip_suffix('\'') {
        Some(q) => parse(&format!("{}/s", coordinate(q))),
        None if v.creeps().any(|e| e == s) => Unit::number_unit(),
        None => parse(&coordinate(s.as_str())),
    }
}

/// A coefficient has a name of its own.
fn coefficient(own: &UserVehicle, c: &Constraint, places: &UserConstraint) -> Result<()> {
    let is = |s: &Option<Symbol>| s.as_ref() == Some(&c.creep);
    let on_wheel =
        |w: &crate::vehicles::Wheel| [&w.steering, &w.radius, &w.rotation_creep, &w.traverse_creep].into_iter().any(is);
    let what = match universal(c.creep.as_str()) {
        Some(meaning) => meaning,
        None if own.names.contains_key(&c.creep) => "a declared name".into(),
        None if own.vehicle.coordinate(c.creep.as_str()).is_some() => "a coordinate".into(),
        None if own.vehicle.wheels.iter().any(on_wheel) => "a symbol of a wheel".into(),
        None => return Ok(()),
    };
    let error = places.creep.error(format!("the coefficient {} is also {what}", c.creep));
    Err(error.help("give it a name of its own, such as e_b"))
}
