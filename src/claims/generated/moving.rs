//! Motions of generated vehicles, from places and rates alone: nothing of the constraints is used.

use super::describe::{TRAIL, symbol};
use super::plane::{Pair, dot, is_nonzero, left_of, plus, times, toward};
use super::stand::{Facing, Placed};
use super::vehicle::Generated;
use crate::claims::exact_point::written;
use crate::formula::{Exact, Scalar, Symbol};
use crate::mechanism::Point;
use std::collections::BTreeMap;

/// How a contact with the ground moves.
#[derive(Clone, Debug)]
pub struct Contact {
    /// Speed along the wheel.
    pub along: Exact,
    /// Speed to the left of it.
    pub across: Exact,
    /// Radius and rate of a wheel that rolls, with the name of its coefficient.
    pub rolls: Option<(Exact, Exact, Symbol)>,
    /// The name of the coefficient of its direction.
    pub directed: Option<Symbol>,
}

/// A vehicle in any motion.
#[derive(Clone, Debug)]
pub struct Moving {
    /// The vehicle.
    pub vehicle: Generated,
    /// Velocity of the reference point in the body, and yaw rate.
    twist: [Exact; 3],
    /// The same velocity in the world.
    velocity: [Exact; 2],
    /// Rates of the coordinates other than the pose.
    rates: BTreeMap<Symbol, Exact>,
}

impl Moving {
    /// A vehicle with a twist and rates for steering, wheels, castors and trailers.
    pub(crate) fn new(vehicle: Generated, twist: [Exact; 3], rates: Vec<Exact>) -> Self {
        let wheels = vehicle.wheels().unwrap_or_default();
        let turning = wheels.iter().flat_map(|w| [symbol("theta", w.k), symbol("gamma", w.k)]);
        let trailers = (1..=vehicle.trailers()).map(|i| symbol("phi", i));
        let names = std::iter::once(Symbol::from("delta")).chain(turning).chain(trailers);
        let rates = names.map(|q| q.rate()).zip(rates).collect();
        let forward = toward(&vehicle.point().value(&"phi".into()));
        let velocity = plus(&times(&twist[0], &forward), &times(&twist[1], &left_of(&forward)));
        Self { vehicle, twist, velocity, rates }
    }

    /// What it is, for people.
    pub fn shown(&self) -> Vec<(String, String)> {
        let names = ["v_l", "v_t", "phi'"].map(String::from);
        let twist = names.into_iter().zip(self.twist.each_ref().map(written));
        let rates = self.rates.iter().map(|(q, v)| (q.to_string(), written(v)));
        self.vehicle.shown().into_iter().chain(twist).chain(rates).collect()
    }

    /// The rate of a coordinate; `None` for what is none.
    pub fn rate(&self, name: &Symbol) -> Option<Exact> {
        match name.as_str() {
            "x'" => Some(self.velocity[0].clone()),
            "y'" => Some(self.velocity[1].clone()),
            "phi'" => Some(self.twist[2].clone()),
            _ => self.rates.get(name).cloned(),
        }
    }

    /// The contacts of all wheels and of the trailers' axles.
    pub fn contacts(&self) -> Vec<Contact> {
        let at = self.vehicle.point();
        let wheels = self.vehicle.wheels().unwrap_or_default();
        let mut found: Vec<Contact> = wheels.iter().map(|w| self.contact(w, &at)).collect();
        let rate = |i: usize| self.given(&symbol("phi", i).rate());
        let axles = self.vehicle.axles(&at, &self.twist, |i, _| rate(i));
        found.extend(axles.into_iter().enumerate().map(|(i, [along, across])| Contact {
            along,
            across,
            rolls: None,
            directed: Some(symbol("e_tc", i + 1)),
        }));
        found
    }

    fn given(&self, rate: &Symbol) -> Exact {
        self.rates.get(rate).cloned().unwrap_or_else(|| Exact::ratio(0, 1))
    }

    fn contact(&self, wheel: &Placed, at: &Point) -> Contact {
        let [along, mut across] = seen_from(wheel, at, &self.twist);
        if let (Facing::Castor, Some(angle)) = (&wheel.facing, wheel.angle()) {
            let turning = self.twist[2].add(&self.given(&angle.rate()));
            across = across.sub(&turning.mul(&Exact::ratio(TRAIL.0, TRAIL.1)));
        }
        let k = wheel.k;
        let rolls = wheel.radius.clone().map(|r| (r, self.given(&symbol("theta", k).rate()), symbol("e_rc", k)));
        Contact { along, across, rolls, directed: wheel.directed.then(|| symbol("e", k)) }
    }
}

/// Velocity of a wheel's axis along the wheel and to its left, for a twist of the body.
fn seen_from(wheel: &Placed, at: &Point, [v_l, v_t, yaw]: &[Exact; 3]) -> Pair {
    let heading = wheel.angle().map_or_else(|| Exact::ratio(0, 1), |angle| at.value(&angle));
    let velocity = plus(&[v_l.clone(), v_t.clone()], &times(yaw, &left_of(&wheel.place)));
    let forward = toward(&heading);
    [dot(&velocity, &forward), dot(&velocity, &left_of(&forward))]
}

impl Generated {
    /// Whether the ideal motion it was made around moves every wheel it needs and every trailer along itself: where
    /// one of them is at rest in every ideal motion its coefficient does nothing, and there is no realisation near by.
    pub fn is_regular(&self) -> bool {
        let (Some(wheels), Some(turning)) = (self.wheels(), self.turning()) else { return false };
        let (at, [forward, left]) = (self.point(), toward(&self.axle));
        let ideal = [forward, left, turning];
        let own = wheels.len() - self.further.len();
        // A trailer's rate is what keeps its axle from moving sideways.
        let axles = self.axles(&at, &ideal, |i, across| across.div(&at.value(&symbol("d", i))));
        wheels[..own].iter().all(|w| is_nonzero(&seen_from(w, &at, &ideal)[0]))
            && axles.iter().all(|v| is_nonzero(&v[0]))
    }

    /// Velocity of each trailer's axle along the trailer and to its left. `rate` gives the yaw rate of the i-th, told
    /// how fast its hitch moves sideways.
    fn axles(&self, at: &Point, twist: &[Exact; 3], rate: impl Fn(usize, &Exact) -> Exact) -> Vec<Pair> {
        let [mut along, mut across, mut yaw] = twist.clone();
        let mut heading = at.value(&"phi".into());
        let mut axle = |i: usize, (bar, hitch): &(Exact, Exact)| {
            let own = at.value(&symbol("phi", i));
            let hitched = [along.clone(), across.sub(&hitch.mul(&yaw))];
            // The trailer's axes as the body ahead sees them.
            let forward = toward(&own.sub(&heading));
            let sideways = dot(&hitched, &left_of(&forward));
            yaw = rate(i, &sideways);
            (along, across, heading) = (dot(&hitched, &forward), sideways.sub(&bar.mul(&yaw)), own);
            [along.clone(), across.clone()]
        };
        self.trailers.iter().enumerate().map(|(i, trailer)| axle(i + 1, trailer)).collect()
    }
}
