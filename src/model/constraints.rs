//! The constraints of a model, in the world's coordinates.

use super::trailer::trailer_heading;
use super::vehicle_model::Model;
use crate::formula::{Expr, Fun, Symbol};
use crate::mechanism::{Constraint, Direction, Heading, Mechanism, Rolling, Velocity};
use crate::vehicles::{Vehicle, Wheel};

/// The heading of a wheel on a body of heading φ.
pub(super) fn wheel_heading(wheel: &Wheel, body: &Heading) -> Heading {
    wheel.steering.iter().fold(body.clone(), |h, angle| h.turned_by(angle.clone()))
}

/// The velocity of a wheel's contact, from that of the reference point.
pub(super) fn contact(wheel: &Wheel, reference: &Velocity, body: &Heading) -> Velocity {
    let axis = reference.at_offset(body, &wheel.forward).at_offset(&body.left(), &wheel.left);
    match wheel.trail.is_zero() {
        true => axis,
        false => axis.at_offset(&wheel_heading(wheel, body), &-&wheel.trail),
    }
}

/// The rolling constraint of a wheel, if it rolls.
pub(super) fn rolling(wheel: &Wheel, reference: &Velocity, body: &Heading) -> Option<Constraint> {
    let (radius, rate, creep) = (wheel.radius.as_ref()?, wheel.rate.as_ref()?, wheel.rotation_creep.as_ref()?);
    let contact = contact(wheel, reference, body);
    let heading = wheel_heading(wheel, body);
    let rolling = Rolling::new(&contact, &heading, &Expr::sym(radius.clone()), rate, &Expr::sym(creep.clone()));
    Some(match &wheel.roller {
        None => rolling.constraint(&format!("{}, rolling", wheel.name), creep),
        Some(angle) => {
            let name = format!("{}, rolling, its rollers at {angle}", wheel.name);
            rolling.over_rollers(&contact, &heading, angle).constraint(&name, creep)
        }
    })
}

/// The direction constraint of a wheel, if it has one.
pub(super) fn direction(wheel: &Wheel, reference: &Velocity, body: &Heading) -> Option<Constraint> {
    let creep = wheel.traverse_creep.as_ref()?;
    let contact = contact(wheel, reference, body);
    let direction = Direction::new(&contact, &wheel_heading(wheel, body), &Expr::sym(creep.clone()));
    Some(direction.constraint(&format!("{}, direction", wheel.name), creep))
}

/// The coefficient of traverse creep of a wheel on a moving body: how far its contact goes to the left of the wheel for
/// each metre ahead, with the tangent of its angle in place of sine and cosine.
pub(super) fn sideways(wheel: &Wheel, reference: &Velocity, body: &Heading) -> Expr {
    let contact = contact(wheel, reference, body);
    let (ahead, left) = (contact.along(body).expr(), contact.along(&body.left()).expr());
    let Some(angle) = &wheel.steering else { return &left / &ahead };
    let tangent = Expr::call(Fun::Tan, &Expr::sym(angle.clone()));
    &(&left - &(&tangent * &ahead)) / &(&ahead + &(&tangent * &left))
}

/// The coefficient of traverse creep of a trailer.
pub(super) fn trailer_creep(i: usize) -> Symbol {
    Symbol::new(&format!("e_tc_{i}"))
}

/// Symbols of a trailer's length and hitch.
pub(super) fn trailer_lengths(i: usize) -> (Symbol, Symbol) {
    (Symbol::new(&format!("d_{i}")), Symbol::new(&format!("c_{i}")))
}

/// The direction constraint of a trailer's axle, given the velocity of the axle.
pub(crate) fn trailer_direction(vehicle: &Vehicle, i: usize, axle: &Velocity) -> Constraint {
    let creep = trailer_creep(i);
    let direction = Direction::new(axle, &Heading::along(trailer_heading(i)), &Expr::sym(creep.clone()));
    let name = match vehicle.trailers.get(i - 1) {
        Some(own) => format!("{}, trailer {i}, direction", own.name),
        None => format!("trailer {i}, direction"),
    };
    direction.constraint(&name, &creep)
}

/// The velocity of an axle from that of the axle ahead: back to the hitch, back along the trailer.
pub(crate) fn behind(ahead: &Velocity, i: usize) -> Velocity {
    let (length, hitch) = trailer_lengths(i);
    let hitch_point = ahead.at_offset(&section_heading(i - 1), &-&Expr::sym(hitch));
    hitch_point.at_offset(&Heading::along(trailer_heading(i)), &-&Expr::sym(length))
}

/// The coordinates and constraints of a vehicle with a number of trailers behind it, derived from the description alone.
///
/// Each wheel gives its rolling constraint and its direction constraint, each trailer a direction constraint; trailers
/// that are a part of the vehicle come first.
/// Coordinates: x, y, phi (along a line s), the angles that are steered or free, the angles of the wheels, and phi_1, phi_2, … of the
/// trailers. An angle that is a formula of others, as on an Ackermann axle, is written out.
///
/// ```
/// use creepage::{model::mechanism, vehicles};
/// let car = mechanism(vehicles::named("car").unwrap(), 1);
/// let names: Vec<String> = car.coordinates.iter().map(|q| q.to_string()).collect();
/// assert_eq!(names, ["x", "y", "phi", "delta", "theta", "phi_1"]);
/// assert_eq!(car.constraints.len(), 4);
/// ```
pub fn mechanism(vehicle: &Vehicle, trailers: usize) -> Mechanism {
    let is_input = |s: &Symbol| vehicle.inputs.contains_key(s.as_str());
    let derived = |s: &Symbol| {
        let formula = &vehicle.define.get(s)?.formula;
        formula.symbols().iter().any(|part| vehicle.define.contains_key(part)).then(|| formula.clone())
    };
    let mut angles: Vec<Symbol> = Vec::new();
    for angle in vehicle.wheels.iter().filter_map(|w| w.steering.as_ref()) {
        // What an Ackermann angle is made of is the coordinate, not the angle.
        let parts = derived(angle).map_or_else(|| [angle.clone()].into(), |f| f.symbols());
        let moves = |s: &Symbol| vehicle.define.get(s).is_none_or(|d| d.formula.symbols().iter().any(is_input));
        angles.extend(parts.into_iter().filter(moves));
    }
    let turns = vehicle.wheels.iter().filter_map(|w| w.rate.as_ref());
    let turns = turns.map(|r| Symbol::new(r.as_str().trim_end_matches('\'')));
    let mut coordinates = body_coordinates(vehicle);
    for q in angles.into_iter().chain(turns).chain((1..=vehicle.trailers.len() + trailers).map(trailer_heading)) {
        if !coordinates.contains(&q) {
            coordinates.push(q);
        }
    }
    Mechanism { coordinates, constraints: constraints_of(vehicle, trailers) }.substitute(&derived)
}

/// x, y and phi; s for a vehicle on a line; its own where it has any.
pub(super) fn body_coordinates(vehicle: &Vehicle) -> Vec<Symbol> {
    match (vehicle.coordinates.is_empty(), vehicle.line) {
        (false, _) => vehicle.coordinates.iter().map(|c| c.name.clone()).collect(),
        (true, true) => vec!["s".into()],
        (true, false) => ["x", "y", "phi"].map(Symbol::from).to_vec(),
    }
}

fn constraints_of(vehicle: &Vehicle, trailers: usize) -> Vec<Constraint> {
    let body = Heading::along("phi");
    let reference = match vehicle.line {
        true => Velocity::along_line("s'", &body),
        false => Velocity::of_reference_point(),
    };
    constraints_by(vehicle, trailers, reference)
}

/// The constraints by the velocity of the reference point, those of the body first.
fn constraints_by(vehicle: &Vehicle, trailers: usize, reference: Velocity) -> Vec<Constraint> {
    let mut found = Vec::new();
    for (i, axle) in bodies(reference, vehicle.trailers.len() + trailers).iter().enumerate() {
        let heading = section_heading(i);
        found.extend((i > 0).then(|| trailer_direction(vehicle, i, axle)));
        for wheel in vehicle.wheels_on(i) {
            found.extend(rolling(wheel, axle, &heading));
            found.extend(direction(wheel, axle, &heading));
        }
        if i == 0 {
            found.extend(vehicle.constraints.iter().cloned());
        }
    }
    found
}

/// The constraints of the body in its own axes: by v_l, v_t and the rates of its angles.
pub(crate) fn constraints_in_body(vehicle: &Vehicle) -> Vec<Constraint> {
    let turned = |c: &Constraint| in_body(c, moving(0));
    let own = Vehicle { constraints: vec![], ..vehicle.clone() };
    let wheels = constraints_by(&own, 0, moving(0));
    wheels.into_iter().chain(vehicle.constraints.iter().map(turned)).collect()
}

/// A constraint in the world's rates with the reference point moving at a velocity.
pub(super) fn in_body(c: &Constraint, reference: Velocity) -> Constraint {
    c.with_rates(&|rate| match rate.as_str() {
        "x'" => Some(reference.along(&Heading::x())),
        "y'" => Some(reference.along(&Heading::y())),
        _ => None,
    })
}

/// The velocity of the reference point (zero) or of a trailer's axle, by the names of its components.
pub(crate) fn moving(i: usize) -> Velocity {
    let [forward, sideways] = match i {
        0 => ["v_l".to_string(), "v_t".to_string()],
        _ => [format!("v_{i}"), format!("vt_{i}")],
    };
    Velocity::in_body(Symbol::new(&forward), Symbol::new(&sideways), &section_heading(i))
}

/// The velocities of the reference point and of the axle of every trailer behind it.
pub(super) fn bodies(reference: Velocity, trailers: usize) -> Vec<Velocity> {
    let mut found = vec![reference];
    for i in 1..=trailers {
        found.push(behind(&found[i - 1], i));
    }
    found
}

/// The heading of the body (zero) or of a trailer.
pub(crate) fn section_heading(i: usize) -> Heading {
    if i == 0 { Heading::along("phi") } else { Heading::along(trailer_heading(i)) }
}

impl Model {
    /// Coordinates: x, y, phi (along a line s), the angles of castors, the angles turned by the wheels, and phi_1,
    /// phi_2, … of the trailers. An angle that is steered is an input here.
    pub fn coordinates(&self) -> Vec<Symbol> {
        let mut found = body_coordinates(&self.vehicle);
        found.extend(self.vehicle.wheels.iter().filter_map(|w| w.steering.clone().filter(|s| self.vehicle.is_free(s))));
        let rates = self.vehicle.wheels.iter().filter_map(|w| w.rate.as_ref());
        found.extend(rates.map(|r| Symbol::new(r.as_str().trim_end_matches('\''))));
        found.extend((1..=self.trailer_count()).map(trailer_heading));
        found
    }

    /// The constraints of the vehicle and its trailers in their generic forms, derived from the description.
    ///
    /// Each wheel gives its rolling constraint and its direction constraint, each trailer a direction constraint;
    /// constraints of other types stand in the description.
    pub fn constraints(&self) -> Vec<Constraint> {
        constraints_of(&self.vehicle, self.trailers.len())
    }
}
