//! A generated vehicle as a description, its coordinates and constraints, and its configuration.

use super::stand::{Facing, Placed};
use super::vehicle::{Drive, Generated};
use crate::formula::{Exact, Expr, Symbol};
use crate::mechanism::{Mechanism, Point};
use crate::model::mechanism;
use crate::vehicles::{Definition, Input, Vehicle, Wheel};
use std::collections::BTreeMap;

/// How far the contact of a castor is behind its axis.
pub(crate) const TRAIL: (i64, i64) = (1, 4);

pub(crate) fn symbol(stem: &str, i: usize) -> Symbol {
    Symbol::new(&format!("{stem}_{i}"))
}

fn number(v: &Exact) -> Expr {
    // A place that is no number has no row that could be evaluated.
    v.as_rational().map_or_else(|| Expr::sym("nowhere"), Expr::number)
}

fn defined(formula: &str) -> Definition {
    Definition { formula: Expr::sym(formula), unit: "rad".into(), meaning: "angle of a wheel".into() }
}

impl Placed {
    /// The angle from the body's heading to the wheel's; none for a wheel along the body.
    pub(crate) fn angle(&self) -> Option<Symbol> {
        match &self.facing {
            Facing::Fixed(heading) => heading.as_rational().is_none().then(|| symbol("mount", self.k)),
            Facing::Steered => Some("delta".into()),
            Facing::Castor => Some(symbol("gamma", self.k)),
        }
    }

    fn described(&self) -> Wheel {
        let castor = matches!(self.facing, Facing::Castor);
        let rolls = |s: Symbol| self.radius.as_ref().map(|_| s);
        Wheel {
            name: self.name.clone(),
            on: None,
            forward: number(&self.place[0]),
            left: number(&self.place[1]),
            steering: self.angle(),
            trail: if castor { number(&Exact::ratio(TRAIL.0, TRAIL.1)) } else { Expr::int(0) },
            roller: None,
            radius: rolls(symbol("r", self.k)),
            rate: rolls(symbol("theta", self.k).rate()),
            rotation_creep: rolls(symbol("e_rc", self.k)),
            traverse_creep: self.directed.then(|| symbol("e", self.k)),
        }
    }
}

impl Generated {
    /// The description. A mounting angle has a definition that is no input, and so is no coordinate.
    pub fn vehicle(&self) -> Vehicle {
        let wheels = self.wheels().unwrap_or_default();
        let mounted = wheels.iter().filter(|w| matches!(w.facing, Facing::Fixed(_))).filter_map(Placed::angle);
        let mut define: BTreeMap<Symbol, Definition> = mounted.map(|s| (s, defined("as_mounted"))).collect();
        define.insert("delta".into(), defined("steering_angle"));
        let steering = Input { unit: "rad".into(), meaning: "steering angle".into(), moves: None, instead: None };
        Vehicle {
            id: "generated".into(),
            wheels: wheels.iter().map(Placed::described).collect(),
            inputs: BTreeMap::from([("steering_angle".to_string(), steering)]),
            define,
            ..Vehicle::default()
        }
    }

    /// Coordinates and constraints.
    pub fn mechanism(&self) -> Mechanism {
        mechanism(&self.vehicle(), self.trailers.len())
    }

    /// The rates that are measured: of the driven wheels, of all angles of wheels, and of the yaw where asked for.
    pub fn measured(&self, yaw: bool) -> Vec<Symbol> {
        let driven: &[usize] = match self.drive {
            Drive::Unicycle | Drive::Car => &[1],
            Drive::Tricycle => &[2],
            Drive::Differential | Drive::Splayed => &[1, 2],
        };
        let mut rates: Vec<Symbol> = driven.iter().map(|k| symbol("theta", *k).rate()).collect();
        rates.push(Symbol::from("delta").rate());
        rates.extend((0..self.further.len()).map(|i| symbol("gamma", i + 11).rate()));
        if yaw || self.drive == Drive::Unicycle {
            rates.push(Symbol::from("phi").rate());
        }
        rates
    }

    /// The configuration with all lengths.
    pub fn point(&self) -> Point {
        let mut angles = self.angles.iter().cloned();
        let mut next = || angles.next().unwrap_or_else(|| Exact::ratio(0, 1));
        let mut at = Point::default().with("phi", next()).with("delta", next());
        for i in 0..self.further.len() {
            at.set(symbol("gamma", i + 11), next());
        }
        for (i, (bar, hitch)) in self.trailers.iter().enumerate() {
            at.set(symbol("phi", i + 1), next());
            at.set(symbol("d", i + 1), bar.clone());
            at.set(symbol("c", i + 1), hitch.clone());
        }
        for wheel in self.wheels().unwrap_or_default() {
            if let Some(radius) = &wheel.radius {
                at.set(symbol("r", wheel.k), radius.clone());
            }
            if let (Facing::Fixed(heading), Some(angle)) = (&wheel.facing, wheel.angle()) {
                at.set(angle, heading.clone());
            }
        }
        at
    }
}
