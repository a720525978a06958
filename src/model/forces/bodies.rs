//! The bodies of a vehicle and what turns in them, with their kinetic energy.

use super::masses::{inertia_of, symbols};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Heading, Row, Velocity};
use crate::model::constraints::behind as axle_behind;
use crate::vehicles::Vehicle;

/// A rigid body: the velocity of its centre of mass in two perpendicular directions, and its turning.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    /// Components of the velocity of the centre of mass.
    pub velocity: [Row; 2],
    /// The rate of its heading; nothing on a line.
    pub turning: Option<Symbol>,
    mass: Symbol,
    inertia: Symbol,
}

/// The velocity of the reference point.
pub(super) fn reference(vehicle: &Vehicle) -> Velocity {
    match vehicle.line {
        true => Velocity::along_line("s'", &Heading::along("phi")),
        false => Velocity::of_reference_point(),
    }
}

/// The towing body and the trailers behind it.
pub(super) fn bodies(vehicle: &Vehicle, trailers: usize) -> Vec<Body> {
    let body = Heading::along("phi");
    if vehicle.line {
        // No offset: on a line every point moves alike.
        let [mass, inertia, _] = symbols(0);
        let velocity = [reference(vehicle).along(&body), Row::default()];
        return vec![Body { velocity, turning: None, mass, inertia }];
    }
    let mut found = vec![rigid(0, &reference(vehicle), &body)];
    let mut axle = reference(vehicle);
    for i in 1..=trailers {
        axle = axle_behind(&axle, i);
        found.push(rigid(i, &axle, &Heading::along(crate::model::trailer::trailer_heading(i))));
    }
    found
}

fn rigid(number: usize, point: &Velocity, heading: &Heading) -> Body {
    let [mass, inertia, offset] = symbols(number);
    let centre = point.at_offset(heading, &Expr::sym(offset));
    let velocity = [Heading::x(), Heading::y()].map(|axis| centre.along(&axis));
    let turning = heading.angles().first().map(|(angle, _)| angle.rate());
    Body { velocity, turning, mass, inertia }
}

fn half(e: &Expr) -> Expr {
    e / &Expr::int(2)
}

impl Body {
    /// ½·m·|v|² + ½·I·φ̇²
    pub fn energy(&self) -> Expr {
        let moving = self.velocity.iter().map(Row::expr).filter(|v| !v.is_zero());
        let squares = moving.fold(Expr::int(0), |sum, v| &sum + &v.pow(2));
        let moving = &Expr::sym(self.mass.clone()) * &half(&squares);
        match &self.turning {
            Some(rate) => &moving + &(&Expr::sym(self.inertia.clone()) * &half(&Expr::sym(rate.clone()).pow(2))),
            None => moving,
        }
    }
}

/// ½·J·θ̇² of the wheels that roll and ½·I·(φ̇ + γ̇)² of castors about their axis.
pub(super) fn spinning(vehicle: &Vehicle) -> Expr {
    let mut energy = Expr::int(0);
    let mut add = |inertia: Symbol, rate: Expr| energy = &energy + &(&Expr::sym(inertia) * &half(&rate.pow(2)));
    for rate in rolling_rates(vehicle) {
        add(inertia_of(&unprimed(&rate)), Expr::sym(rate.clone()));
    }
    for angle in castors(vehicle) {
        add(inertia_of(&angle), &Expr::sym("phi'") + &Expr::sym(angle.rate()));
    }
    energy
}

/// The rates of the wheels that roll, each once.
pub(crate) fn rolling_rates(vehicle: &Vehicle) -> Vec<Symbol> {
    once(vehicle.wheels.iter().filter_map(|w| w.rate.clone()))
}

/// The angles of the castors, each once.
pub(crate) fn castors(vehicle: &Vehicle) -> Vec<Symbol> {
    once(vehicle.wheels.iter().filter_map(|w| w.steering.clone()).filter(|s| vehicle.is_free(s)))
}

fn once(names: impl Iterator<Item = Symbol>) -> Vec<Symbol> {
    let mut found: Vec<Symbol> = Vec::new();
    names.for_each(|n| {
        if !found.contains(&n) {
            found.push(n)
        }
    });
    found
}

/// The coordinate of a rate.
pub(super) fn unprimed(rate: &Symbol) -> Symbol {
    Symbol::new(rate.as_str().strip_suffix('\'').unwrap_or(rate.as_str()))
}
