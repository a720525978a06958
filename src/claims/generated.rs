//! Vehicles that are generated: wheels in any place, steered, fixed or castors, and trailers.

use super::point::{Domain, value, written};
use crate::formula::{Exact, Expr, Scalar, Symbol};
use crate::mechanism::{Mechanism, Point};
use crate::model::mechanism;
use crate::vehicles::{Definition, Input, Vehicle, Wheel};
use proptest::prelude::*;
use std::collections::BTreeMap;

/// How a generated vehicle is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    /// One wheel at the reference point; its yaw rate is measured.
    Unicycle,
    /// Two wheels with a rate each on the axle of the reference point.
    Differential,
    /// One drive angle at the rear axle, a steered front axle.
    Car,
    /// The front wheel is driven and steered.
    Tricycle,
}

/// A further wheel: place, whether it is a castor. A fixed one stands on the line of the axle; anywhere else it would
/// leave the ideal vehicle no turn.
#[derive(Clone, Debug)]
pub struct Further {
    forward: Exact,
    left: Exact,
    castor: bool,
}

/// A generated vehicle in a generated configuration; all lengths are rational numbers.
#[derive(Clone, Debug)]
pub struct Generated {
    /// How it is driven.
    pub drive: Drive,
    radius: Exact,
    size: Exact,
    further: Vec<Further>,
    trailers: Vec<(Exact, Exact)>,
    angles: Vec<Exact>,
}

/// Vehicles of one kind with up to `further` more wheels and `trailers` trailers.
pub fn vehicles(
    drive: impl Strategy<Value = Drive> + Sync + 'static,
    further: usize,
    trailers: usize,
) -> impl Strategy<Value = Generated> + Sync {
    let place = || (value(Domain::Any), value(Domain::Any), any::<bool>());
    let wheel = place().prop_map(|(forward, left, castor)| Further {
        forward: if castor { forward } else { Exact::ratio(0, 1) },
        left,
        castor,
    });
    let bar = (value(Domain::Positive), value(Domain::Creep));
    (
        drive,
        value(Domain::Positive),
        value(Domain::Positive),
        prop::collection::vec(wheel, 0..=further),
        prop::collection::vec(bar, 0..=trailers),
        prop::collection::vec(value(Domain::Angle), 2 + further + trailers),
    )
        .prop_map(|(drive, radius, size, further, trailers, angles)| Generated {
            drive,
            radius,
            size,
            further,
            trailers,
            angles,
        })
}

/// Any of the four ways to be driven.
pub fn any_drive() -> impl Strategy<Value = Drive> + Sync {
    prop::sample::select(vec![Drive::Unicycle, Drive::Differential, Drive::Car, Drive::Tricycle])
}

fn number(v: &Exact) -> Expr {
    v.as_rational().map_or_else(|| Expr::int(0), Expr::number)
}

fn symbol(stem: &str, i: usize) -> Symbol {
    Symbol::new(&format!("{stem}_{i}"))
}

impl Generated {
    /// How many trailers it pulls.
    pub fn trailers(&self) -> usize {
        self.trailers.len()
    }

    /// What it is, for people.
    pub fn shown(&self) -> Vec<(String, String)> {
        let mut shown = vec![
            ("drive".to_string(), format!("{:?}", self.drive).to_lowercase()),
            ("r".into(), written(&self.radius)),
            (if self.drive == Drive::Differential { "a" } else { "L" }.into(), written(&self.size)),
        ];
        for (i, w) in self.further.iter().enumerate() {
            let kind = if w.castor { "castor" } else { "wheel" };
            shown.push((format!("{kind} {}", i + 1), format!("({}, {})", written(&w.forward), written(&w.left))));
        }
        for (i, (bar, hitch)) in self.trailers.iter().enumerate() {
            shown.push((format!("trailer {}", i + 1), format!("(d {}, c {})", written(bar), written(hitch))));
        }
        shown
    }

    /// The description.
    pub fn vehicle(&self) -> Vehicle {
        let half = &number(&self.size) / &Expr::int(2);
        let length = number(&self.size);
        let mut wheels = match self.drive {
            Drive::Unicycle => vec![wheel("wheel", 1).rolling(1).directed(1)],
            Drive::Differential => vec![
                wheel("right wheel", 1).at(Expr::int(0), -&half).rolling(1),
                wheel("left wheel", 2).at(Expr::int(0), half).rolling(2),
                wheel("axle", 1).directed(1),
            ],
            Drive::Car => vec![
                wheel("rear axle", 1).rolling(1).directed(1),
                wheel("front axle", 2).at(length, Expr::int(0)).steered("delta").directed(2),
            ],
            Drive::Tricycle => vec![
                wheel("rear axle", 1).directed(1),
                wheel("front wheel", 2).at(length, Expr::int(0)).steered("delta").rolling(1).directed(2),
            ],
        };
        for (i, w) in self.further.iter().enumerate() {
            let k = i + 11;
            let further = wheel("further wheel", k).at(number(&w.forward), number(&w.left)).directed(k);
            wheels.push(match w.castor {
                true => further.steered(symbol("gamma", k).as_str()).trailing(),
                false => further,
            });
        }
        let inputs = BTreeMap::from([("steering_angle".to_string(), input())]);
        let define = BTreeMap::from([(Symbol::from("delta"), defined())]);
        Vehicle {
            id: "generated".into(),
            wheels: wheels.into_iter().map(|w| w.0).collect(),
            inputs,
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
        let driven = if self.drive == Drive::Differential { 2 } else { 1 };
        let mut rates: Vec<Symbol> = (1..=driven).map(|i| symbol("theta", i).rate()).collect();
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
        let mut at = Point::default().with("phi", next()).with("delta", next()).with("r", self.radius.clone());
        for i in 0..self.further.len() {
            at = at.with(symbol("gamma", i + 11), next());
        }
        for (i, (bar, hitch)) in self.trailers.iter().enumerate() {
            at = at.with(symbol("phi", i + 1), next()).with(symbol("d", i + 1), bar.clone());
            at = at.with(symbol("c", i + 1), hitch.clone());
        }
        at
    }

    /// Whether no part of it stands across what pulls it: there the ideal motion has no speed for a coefficient.
    pub fn is_regular(&self) -> bool {
        let at = self.point();
        let delta_is_straight =
            at.value(&"delta".into()).as_direction().is_some_and(|(x, _)| !num_traits::Zero::is_zero(&x));
        let heading = |i: usize| match i {
            0 => at.value(&"phi".into()),
            i => at.value(&symbol("phi", i)),
        };
        let follows = |i: usize| {
            let between = heading(i - 1).sub(&heading(i));
            between.as_direction().is_some_and(|(x, _)| !num_traits::Zero::is_zero(&x))
        };
        delta_is_straight && (1..=self.trailers.len()).all(follows)
    }
}

/// A wheel while it is being described.
struct Described(Wheel);

fn wheel(name: &str, i: usize) -> Described {
    Described(Wheel { name: format!("{name} {i}"), ..Wheel::default() })
}

impl Described {
    fn at(mut self, forward: Expr, left: Expr) -> Self {
        (self.0.forward, self.0.left) = (forward, left);
        self
    }

    fn steered(mut self, angle: &str) -> Self {
        self.0.steering = Some(angle.into());
        self
    }

    fn trailing(mut self) -> Self {
        self.0.trail = &Expr::int(1) / &Expr::int(4);
        self
    }

    fn rolling(mut self, i: usize) -> Self {
        self.0.radius = Some("r".into());
        self.0.rate = Some(symbol("theta", i).rate());
        self.0.rotation_creep = Some(symbol("e_rc", i));
        self
    }

    fn directed(mut self, i: usize) -> Self {
        self.0.traverse_creep = Some(symbol("e", i));
        self
    }
}

fn input() -> Input {
    Input { unit: "rad".into(), meaning: "steering angle".into(), instead: None }
}

fn defined() -> Definition {
    Definition { formula: Expr::sym("steering_angle"), unit: "rad".into(), meaning: "steering angle".into() }
}
