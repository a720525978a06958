//! The check that the constraints of a user's vehicle determine its motion from the inputs it declares.

use crate::error::{Error, Result};
use crate::extensions::test_vehicle::{reached, visible};
use crate::files::{UserVehicle, advice};
use crate::formula::{Expr, Symbol};
use crate::mechanism::Definitions;
use crate::model::Model;
use crate::vehicles::Wheel;
use std::collections::{BTreeMap, BTreeSet};

/// That the constraints determine the motion, or that the vehicle says what to use instead.
pub(crate) fn check(own: &UserVehicle) -> Result<()> {
    let model = Model::sample(&own.vehicle)?;
    held(own, &model)?;
    loose(own)?;
    match (model.definitions(), &own.instead) {
        (Ok(d), None) => {
            needed(own, &model, &d)?;
            compiles(own, &model)?;
            at_rest(own, &model, &d)
        }
        (Ok(_), Some(spot)) => Err(spot
            .error("`instead` is for a vehicle that can only be described, but the constraints determine this one's motion")
            .help("remove it")),
        (Err(_), Some(_)) => Ok(()),
        (Err(e), None) => Err(undetermined(own, &model, &e)),
    }
}

/// The error of constraints that are too few, at the vehicle, or too many, at a wheel that breaks.
fn undetermined(own: &UserVehicle, model: &Model, why: &Error) -> Error {
    let broken = model.contradictions().unwrap_or_default();
    let breaks = |name: &str| broken.iter().any(|b| b.strip_prefix(name).is_some_and(|rest| rest.starts_with(", ")));
    let wheel = own.vehicle.wheels.iter().zip(&own.wheels).find(|(w, _)| breaks(&w.name));
    let other = own.vehicle.constraints.iter().zip(&own.constraints).find(|(c, _)| broken.contains(&c.name));
    let spot = wheel.map(|(_, part)| &part.name).or(other.map(|(_, places)| &places.name)).unwrap_or(&own.id);
    let loose = |w: &Wheel| why.message().ends_with(&format!("do not say what the {} does", w.name));
    if let Some((_, part)) = own.vehicle.wheels.iter().zip(&own.wheels).find(|(w, _)| loose(w)) {
        return part
            .name
            .error(why.message())
            .help("a wheel that turns freely follows by its trail: write trail = \"…\"");
    }
    let help = match broken.is_empty() {
        true => {
            "give a wheel a rate or a steering that an input defines, log the yaw rate and define \"phi'\" from it, or \
             write instead = \"what to use\" to have the vehicle described only"
        }
        false => {
            "take a direction or a rate away, set a wheel where it can roll with the others, or let it turn freely by \
             naming a steering without a definition"
        }
    };
    spot.error(why.message()).help(help)
}

/// That no wheel which turns freely has a measured rate: it follows, and cannot be told to.
fn loose(own: &UserVehicle) -> Result<()> {
    let free = |s: &Option<Symbol>| s.as_ref().is_some_and(|s| own.vehicle.is_free(s));
    let told = |w: &Wheel| free(&w.steering) && w.rate.is_some() && !free(&w.rate);
    match own.vehicle.wheels.iter().zip(&own.wheels).find(|(w, _)| told(w)) {
        None => Ok(()),
        Some((wheel, part)) => {
            let rate = wheel.rate.as_ref().map_or("", Symbol::as_str);
            let error =
                part.name.error(format!("the wheel \"{}\" turns freely, but its rate {rate} is defined", wheel.name));
            Err(error.help("give it a rate of its own without a definition, or define its steering"))
        }
    }
}

/// That held names are names of the motion.
fn held(own: &UserVehicle, model: &Model) -> Result<()> {
    let definitions = model.bare_definitions();
    let names: Vec<&str> = definitions.iter().map(|(n, _)| n.as_str()).collect();
    // A name that only trailers behind it bring may be held too.
    let known = |s: &Symbol| names.contains(&s.as_str()) || crate::describe::universal(s.as_str()).is_some();
    match own.vehicle.held.iter().zip(&own.held).find(|(s, _)| !known(s)) {
        None => Ok(()),
        Some((name, spot)) => {
            let error = spot.error(format!("nothing is called \"{}\"", crate::files::shown(name.as_str())));
            Err(error.help(advice(name.as_str(), "there are", &names)))
        }
    }
}

/// That the motion uses every input, and needs no parameter that may be left out.
fn needed(own: &UserVehicle, model: &Model, d: &Definitions) -> Result<()> {
    let used = reached(d, &visible(model));
    if let Some(role) = own.vehicle.inputs.keys().map(|i| Symbol::new(i)).find(|i| !used.contains(i)) {
        let error = own.names[&role].error(format!("the motion does not depend on the input {role}"));
        return Err(error.help("use it in a formula, or remove it"));
    }
    let optional = own.vehicle.parameters.iter().filter(|(_, p)| p.optional).map(|(k, _)| Symbol::new(k));
    match optional.into_iter().find(|p| used.contains(p)) {
        None => Ok(()),
        Some(p) => {
            let error = own.names[&p].error(format!("the parameter {p} is optional, but the motion depends on it"));
            Err(error.help("remove optional = true"))
        }
    }
}

/// That the equations of motion are closed.
fn compiles(own: &UserVehicle, model: &Model) -> Result<()> {
    let Err(why) = model.equations(&[]) else { return Ok(()) };
    let error = own.id.error(format!("the motion cannot be computed: {}", why.message()));
    let v = &own.vehicle;
    let swings = |w: &Wheel| {
        let angle = w.steering.as_ref().filter(|s| v.define.contains_key(s) && !v.define.contains_key(&s.rate()))?;
        (!w.trail.is_zero()).then(|| (w.name.clone(), angle.clone()))
    };
    Err(match v.wheels.iter().find_map(swings) {
        Some((name, angle)) => error.help(format!(
            "steering swings the contact of the {name}, which has a trail: define \"{angle}'\" from a logged rate, or \
             leave the trail out"
        )),
        None => error.help("an angle without a definition, of a wheel that turns freely, cannot drive the motion"),
    })
}

/// That the motion is defined where the vehicle stands still with everything straight: most logs begin there.
fn at_rest(own: &UserVehicle, model: &Model, d: &Definitions) -> Result<()> {
    let mut values: BTreeMap<Symbol, f64> = model.values();
    values.extend(model.states().into_iter().chain(model.inputs.iter().map(|i| Symbol::new(i))).map(|s| (s, 0.0)));
    let used: BTreeSet<Symbol> = reached(d, &visible(model));
    for (name, formula) in d.sorted()? {
        match formula.eval(&|s| values.get(s).copied().unwrap_or(f64::NAN)) {
            Some(v) => drop(values.insert(name.clone(), v)),
            None if used.contains(name) => return Err(undefined(own, name, formula)),
            None => {}
        }
    }
    Ok(())
}

fn undefined(own: &UserVehicle, name: &Symbol, formula: &Expr) -> Error {
    let message = format!("{name} is undefined where every input is 0 and every heading is along x");
    let error = own.define.get(name).map_or_else(|| own.id.error(&message), |f| f.error(&message));
    let formula = crate::files::shown(&formula.to_string());
    error.help(format!("it is {formula}; avoid a division by what is 0 there, such as the tangent of a steering angle"))
}
