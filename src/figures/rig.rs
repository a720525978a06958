//! A vehicle of the catalogue as it is drawn: bodies and wheels with their places, headings and velocities.

use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};
use crate::mechanism::Definitions;
use crate::model::{Model, trailer_heading};
use crate::picture::sketch::{rounded, turned};
use std::collections::BTreeMap;

/// A wheel, or an axle's worth of aligned wheels, where the model has it.
#[derive(Clone, Debug, PartialEq)]
pub struct RigWheel {
    /// What the description calls it.
    pub name: String,
    /// Its contact, m.
    pub at: [f64; 2],
    /// Where it points, rad.
    pub heading: f64,
    /// Its rolling radius, m, where it rolls.
    pub radius: Option<f64>,
    /// Velocity of its contact, m/s.
    pub velocity: [f64; 2],
    /// Its coefficient of traverse creep, where it has a direction.
    pub e_tc: Option<f64>,
    /// Whether it is steered or turns freely.
    pub steered: bool,
}

impl RigWheel {
    /// The angle from its heading to its velocity, φ_tc of (15), rad.
    pub fn creep_angle(&self) -> f64 {
        let [vx, vy] = self.velocity;
        let (sin, cos) = self.heading.sin_cos();
        (vy * cos - vx * sin).atan2(vx * cos + vy * sin)
    }

    /// Its speed, m/s.
    pub fn speed(&self) -> f64 {
        self.velocity[0].hypot(self.velocity[1])
    }
}

/// A vehicle at an instant, read off its model: places by the description, velocities by the equations of motion.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | x, y, phi, phi_1 … | m, rad | states, in the order of [`Model::states`] |
/// | inputs | | by name; also the angle of a castor |
///
/// ```
/// use creepage::figures::Rig;
/// use creepage::model::Model;
/// let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap();
/// let rig = Rig::of(&car, &[0.0; 3], &[("wheel_rate", 4.0), ("steering_angle", 0.2)]).unwrap();
/// let front = &rig.wheels[1];
/// assert_eq!((front.at, front.heading), ([2.6, 0.0], 0.2));
/// assert!(front.creep_angle().abs() < 1e-12);
/// ```
#[derive(Clone, Debug)]
pub struct Rig {
    /// Place and heading of the body and of each trailer's axle.
    pub bodies: Vec<([f64; 2], f64)>,
    /// Place of each trailer's hitch, m.
    pub hitches: Vec<[f64; 2]>,
    /// Wheels of the body, then the axles of the trailers.
    pub wheels: Vec<RigWheel>,
    /// The value of every definition of the model.
    pub values: BTreeMap<Symbol, f64>,
}

impl Rig {
    /// The rig of a model at a state.
    ///
    /// # Errors
    /// When the constraints do not determine the motion, or a value is missing or undefined.
    pub fn of(model: &Model, state: &[f64], inputs: &[(&str, f64)]) -> Result<Self> {
        let mut given = model.values();
        given.extend(model.states().into_iter().zip(state.iter().copied()));
        given.extend(inputs.iter().map(|(name, v)| (Symbol::new(name), *v)));
        Self::at(model, &model.definitions()?, given)
    }

    fn at(model: &Model, definitions: &Definitions, given: BTreeMap<Symbol, f64>) -> Result<Self> {
        let mut values = definitions.evaluate(&|s| given.get(s).copied())?;
        values.extend(given);
        let mut rig = Self { bodies: vec![], hitches: vec![], wheels: vec![], values };
        let place = [rig.value("x")?, rig.value("y")?];
        rig.bodies.push((place, rig.value("phi")?));
        for wheel in &model.vehicle.wheels {
            let wheel = rig.wheel(wheel)?;
            rig.wheels.push(wheel);
        }
        (1..=model.trailer_count()).try_for_each(|i| rig.trailer(i))?;
        Ok(rig)
    }

    /// Bodies and drawbars of a train: a car of a wheelbase, and trailers whose bodies go so far ahead of their axles.
    pub(super) fn outlines(&self, wheelbase: f64, ahead: f64, width: f64) -> Vec<Vec<[f64; 2]>> {
        let mut found = Vec::new();
        for (i, (at, heading)) in self.bodies.iter().enumerate() {
            let [from, to] = if i == 0 { [-0.6, wheelbase + 0.6] } else { [-0.7, ahead] };
            let middle = turned([0.5 * (from + to), 0.0], *at, *heading);
            let mut outline = rounded(middle, *heading, [to - from, width], 0.25);
            outline.push(outline[0]);
            found.push(outline);
            if i > 0 {
                found.push(vec![self.hitches[i - 1], *at]);
            }
        }
        found
    }

    /// The value of a definition.
    ///
    /// # Errors
    /// When the model has none, or it is undefined.
    pub fn value(&self, name: &str) -> Result<f64> {
        let found = self.values.get(&Symbol::new(name)).copied().filter(|v| v.is_finite());
        found.ok_or_else(|| Error::run(format!("{name} has no value in this figure")))
    }

    /// The velocity of a point of the body, m/s.
    ///
    /// # Errors
    /// As [`Rig::value`].
    pub fn velocity(&self, p: [f64; 2]) -> Result<[f64; 2]> {
        let (centre, _) = self.bodies[0];
        let turn = self.value("phi'")?;
        Ok([self.value("x'")? - turn * (p[1] - centre[1]), self.value("y'")? + turn * (p[0] - centre[0])])
    }

    fn wheel(&self, wheel: &crate::vehicles::Wheel) -> Result<RigWheel> {
        let (place, body) = self.bodies[0];
        let heading = body + wheel.steering.as_ref().map_or(Ok(0.0), |s| self.value(s.as_str()))?;
        let axis = turned([self.number(&wheel.forward)?, self.number(&wheel.left)?], place, body);
        let at = turned([-self.number(&wheel.trail)?, 0.0], axis, heading);
        let of = |symbol: &Option<Symbol>| symbol.as_ref().map(|s| self.value(s.as_str())).transpose();
        Ok(RigWheel {
            name: wheel.name.clone(),
            at,
            heading,
            radius: of(&wheel.radius)?,
            velocity: self.velocity(at)?,
            e_tc: of(&wheel.traverse_creep)?,
            steered: wheel.steering.is_some(),
        })
    }

    fn number(&self, formula: &Expr) -> Result<f64> {
        let value = formula.eval(&|s| self.values.get(s).copied().unwrap_or(f64::NAN));
        value.ok_or_else(|| Error::run(format!("{formula} has no value in this figure")))
    }

    /// Adds a trailer behind what is there: back to the hitch, back along the trailer, as [`crate::model`] has it.
    fn trailer(&mut self, i: usize) -> Result<()> {
        let (ahead, before) = self.bodies[i - 1];
        let heading = self.value(trailer_heading(i).as_str())?;
        let hitch = turned([-self.value(&format!("c_{i}"))?, 0.0], ahead, before);
        let at = turned([-self.value(&format!("d_{i}"))?, 0.0], hitch, heading);
        let speeds = [self.value(&format!("v_{i}"))?, self.value(&format!("vt_{i}"))?];
        self.hitches.push(hitch);
        self.bodies.push((at, heading));
        self.wheels.push(RigWheel {
            name: format!("trailer {i}"),
            at,
            heading,
            radius: None,
            velocity: turned(speeds, [0.0, 0.0], heading),
            e_tc: Some(self.value(&format!("e_tc_{i}"))?),
            steered: false,
        });
        Ok(())
    }

    /// The two wheels of an axle, half a track to the right and to the left of its middle.
    ///
    /// Wheels that steer point so that each creeps by the angle of the axle (Ackermann); the others are aligned.
    ///
    /// # Errors
    /// As [`Rig::velocity`].
    pub fn axle(&self, axle: &RigWheel, half_track: f64) -> Result<Vec<RigWheel>> {
        let (_, body) = self.bodies[0];
        let one = |side: f64| {
            let at = turned([0.0, side * half_track], axle.at, body);
            let velocity = self.velocity(at)?;
            let course = velocity[1].atan2(velocity[0]);
            let heading = if axle.steered { course - axle.creep_angle() } else { axle.heading };
            Ok(RigWheel { at, velocity, heading, ..axle.clone() })
        };
        [-1.0, 1.0].into_iter().map(one).collect()
    }
}
