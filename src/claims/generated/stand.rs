//! Where the wheels of a generated vehicle stand.

use super::plane::{Pair, is_nonzero, left_of, plus, times, toward};
use super::vehicle::{Drive, Generated, Own, Stand};
use crate::claims::exact_point::written;
use crate::formula::{Exact, Fun, Scalar};
use std::fmt;

/// The heading of a wheel in the body. A steered wheel and a castor have none of their own: the angle of the vehicle's
/// configuration, which is any, is measured from wherever they are mounted.
#[derive(Clone, Debug)]
pub enum Facing {
    /// Mounted at this angle.
    Fixed(Exact),
    /// At the steering angle.
    Steered,
    /// Free to turn, its contact behind its axis.
    Castor,
}

/// A wheel in its place; its symbols end in its number.
#[derive(Clone, Debug)]
pub struct Placed {
    /// What it is called.
    pub name: String,
    /// Its number.
    pub k: usize,
    /// Ahead of the reference point and to the left of it.
    pub place: [Exact; 2],
    /// Its heading.
    pub facing: Facing,
    /// Its radius; of an axle whose wheels are described by themselves there is none, and it does not roll.
    pub radius: Option<Exact>,
    /// Whether its direction is a constraint of its own; of the wheels of an axle it is the axle's.
    pub directed: bool,
}

/// `radius 1 at (0, 1/2) facing …`, no heading for a wheel along the body.
impl fmt::Display for Placed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [forward, left] = self.place.each_ref().map(written);
        if let Some(radius) = &self.radius {
            write!(f, "radius {} at ", written(radius))?;
        }
        write!(f, "({forward}, {left})")?;
        match &self.facing {
            Facing::Fixed(heading) if heading.as_rational().is_none() => write!(f, " facing {}", written(heading)),
            _ => Ok(()),
        }
    }
}

fn at_reference() -> Pair {
    [Exact::ratio(0, 1), Exact::ratio(0, 1)]
}

impl Generated {
    /// Every wheel in its place; `None` where no ideal motion is left for it to be made around.
    pub fn wheels(&self) -> Option<Vec<Placed>> {
        let mut wheels = self.own_wheels()?;
        for (i, further) in self.further.iter().enumerate() {
            let (place, facing) = self.stand(&further.stand)?;
            let (k, radius) = (i + 11, Some(further.radius.clone()));
            wheels.push(Placed { name: format!("further wheel {k}"), k, place, facing, radius, directed: true });
        }
        Some(wheels)
    }

    /// Yaw per length; `None` where a steered wheel stands across.
    pub(crate) fn turning(&self) -> Option<Exact> {
        if !self.is_steered() {
            return Some(self.curvature.clone());
        }
        // Both axles go through the centre: 1/curvature = L·cos δ/sin(δ − axle).
        let [cos, _] = toward(&self.steering());
        let sin = Exact::call(Fun::Sin, &self.steering().sub(&self.axle));
        Some(sin.div(&self.size.mul(&cos))).filter(Scalar::is_defined)
    }

    pub(crate) fn is_steered(&self) -> bool {
        matches!(self.drive, Drive::Car | Drive::Tricycle)
    }

    pub(crate) fn steering(&self) -> Exact {
        self.angles.get(1).cloned().unwrap_or_else(|| Exact::ratio(0, 1))
    }

    /// Different wheels, different radii: one that another has already is made half as large again until it differs.
    pub(crate) fn tell_radii_apart(&mut self) {
        let mut met: Vec<Exact> = Vec::new();
        let own = self.own.iter_mut().map(|o| &mut o.radius);
        for radius in own.chain(self.further.iter_mut().map(|f| &mut f.radius)) {
            while met.iter().any(|r| r.equals(radius)) {
                *radius = radius.mul(&Exact::ratio(3, 2));
            }
            met.push(radius.clone());
        }
    }

    fn own_wheels(&self) -> Option<Vec<Placed>> {
        let turning = self.turning()?;
        let wheel = |k: usize, name: &str, place: Pair, facing: Facing| Placed {
            name: format!("{name} {k}"),
            k,
            place,
            facing,
            radius: self.own.get(k - 1).map(|o| o.radius.clone()),
            directed: true,
        };
        let along_axle = || Facing::Fixed(self.axle.clone());
        let ahead = [self.size.clone(), Exact::ratio(0, 1)];
        Some(match self.drive {
            Drive::Unicycle => vec![wheel(1, "wheel", at_reference(), along_axle())],
            Drive::Car | Drive::Tricycle => vec![
                wheel(1, "rear wheel", at_reference(), along_axle()),
                wheel(2, "front wheel", ahead, Facing::Steered),
            ],
            Drive::Differential => {
                let half = self.size.mul(&Exact::ratio(1, 2));
                let on_axle = |k: usize, name: &str, distance: &Exact, own: &Own| {
                    let (place, facing) = self.abreast(distance, own.backwards);
                    Placed { directed: false, ..wheel(k, name, place, facing) }
                };
                vec![
                    on_axle(1, "right wheel", &half.neg(), &self.own[0]),
                    on_axle(2, "left wheel", &half, &self.own[1]),
                    wheel(3, "axle", at_reference(), along_axle()),
                ]
            }
            Drive::Splayed => {
                let [a, b] = &self.own;
                let between = Exact::call(Fun::Sin, &a.heading.sub(&b.heading));
                if !is_nonzero(&turning) || !is_nonzero(&between) {
                    return None;
                }
                let splayed = |k: usize, own: &Own| {
                    let place = self.askew(&turning, &own.heading, &own.distance);
                    wheel(k, "splayed wheel", place, Facing::Fixed(own.heading.clone()))
                };
                vec![splayed(1, a), splayed(2, b)]
            }
        })
    }

    fn stand(&self, stand: &Stand) -> Option<(Pair, Facing)> {
        let turning = self.turning()?;
        Some(match stand {
            Stand::Abreast { distance, backwards } => self.abreast(distance, *backwards),
            Stand::Castor { place } => (place.clone(), Facing::Castor),
            Stand::Loose { place, heading } => (place.clone(), Facing::Fixed(heading.clone())),
            // The centre is at infinity: all axles are parallel, and a wheel may stand anywhere.
            Stand::Askew { along, distance, .. } if !is_nonzero(&turning) => {
                ([along.clone(), distance.clone()], Facing::Fixed(self.axle.clone()))
            }
            Stand::Askew { heading, distance, .. } => {
                (self.askew(&turning, heading, distance), Facing::Fixed(heading.clone()))
            }
        })
    }

    fn abreast(&self, distance: &Exact, backwards: bool) -> (Pair, Facing) {
        let back = Exact::half_tangent(1, 0);
        let heading = if backwards { self.axle.add(&back) } else { self.axle.clone() };
        (times(distance, &left_of(&toward(&self.axle))), Facing::Fixed(heading))
    }

    /// The place of a wheel of this heading whose axle goes through the centre of turning.
    fn askew(&self, turning: &Exact, heading: &Exact, distance: &Exact) -> Pair {
        let centre = times(&turning.recip(), &left_of(&toward(&self.axle)));
        plus(&centre, &times(distance, &left_of(&toward(heading))))
    }
}
