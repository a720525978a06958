//! The initial state of a motion with forces, completed by contacts without slip.

use super::system::Work;
use super::{Dynamics, System};
use crate::error::{Error, Result};
use crate::formula::Symbol;
use nalgebra::{DMatrix, DVector};

/// The state a motion with forces begins with.
///
/// | field | unit | meaning |
/// |---|---|---|
/// | `pose` | m, rad | what the sensor measures: x, y, heading, trailer headings |
/// | `speed` | m/s | v_l of the reference point |
/// | `lateral_speed` | m/s | v_t; from the contacts when left out |
/// | `yaw_rate` | rad/s | from the contacts when left out |
/// | `steering_angle` | rad | where the steering is given by its rate |
///
/// Whatever is not given follows from the contacts without slip, wheels and trailers too; what no contact tells is zero.
/// Deflections begin at zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Start {
    /// x, y, heading, trailer headings.
    pub pose: Vec<f64>,
    /// v_l.
    pub speed: f64,
    /// v_t.
    pub lateral_speed: Option<f64>,
    /// φ̇.
    pub yaw_rate: Option<f64>,
    /// δ.
    pub steering_angle: f64,
}

/// A slip that an ideal contact may have at the start, for each m/s of the motion.
const SLIP_TOLERANCE: f64 = 1e-9;

impl Dynamics {
    /// The states at the start, given the inputs and their slopes there.
    ///
    /// # Errors
    /// When the pose does not fit the vehicle, or the speeds given make an ideal contact slip.
    pub(super) fn initial(&self, system: &System, start: &Start, u: &[f64], slope: &[f64]) -> Result<Vec<f64>> {
        let wanted = 3 + self.model.trailers.len();
        if start.pose.len() != wanted {
            let given = start.pose.len();
            return Err(Error::input(format!("{given} numbers are given for the pose, the vehicle has {wanted}")));
        }
        let mut z = vec![0.0; system.states.len()];
        let put = |z: &mut [f64], name: Symbol, value: f64| {
            system.states.iter().position(|s| *s == name).into_iter().for_each(|i| z[i] = value);
        };
        let [x, y, heading] = self.placed(start);
        for (name, value) in [("x", x), ("y", y), ("phi", heading)] {
            put(&mut z, name.into(), value);
        }
        for (i, heading) in start.pose[3..].iter().enumerate() {
            put(&mut z, crate::model::trailer_heading(i + 1), *heading);
        }
        self.prescribed.iter().for_each(|q| put(&mut z, q.clone(), start.steering_angle));
        let rates = self.initial_rates(system, start, heading, &z, u, slope)?;
        z[system.n..2 * system.n].copy_from_slice(&rates);
        Ok(z)
    }

    /// The pose of the reference point of which the sensor measures the start.
    fn placed(&self, start: &Start) -> [f64; 3] {
        let sensor = &self.model.sensor;
        let heading = start.pose[2] - sensor.heading_offset;
        let ([a, b], (sin, cos)) = (sensor.lever_arm, heading.sin_cos());
        [start.pose[0] - a * cos + b * sin, start.pose[1] - a * sin - b * cos, heading]
    }

    /// The rates: what is given, and the rest so that the contacts slip as little as can be.
    fn initial_rates(
        &self,
        system: &System,
        start: &Start,
        heading: f64,
        z: &[f64],
        u: &[f64],
        slope: &[f64],
    ) -> Result<Vec<f64>> {
        let columns = self.columns(start, heading);
        let (free, given): (Vec<_>, Vec<_>) = columns.into_iter().partition(|c| c.value.is_none());
        let n = system.n;
        let known = given.iter().fold(DVector::zeros(n), |sum, c| sum + &c.rates * c.value.unwrap_or(0.0));
        let mut w = system.work();
        let mut slips = |rates: &DVector<f64>| {
            let mut z = z.to_vec();
            z[n..2 * n].copy_from_slice(rates.as_slice());
            DVector::from_vec(self.slips(system, &mut w, &z, u, slope))
        };
        let still = slips(&DVector::zeros(n));
        let at_given = slips(&known);
        let mut rates = known;
        if !free.is_empty() {
            let by: Vec<DVector<f64>> = free.iter().map(|c| slips(&c.rates) - &still).collect();
            let svd = DMatrix::from_columns(&by).svd(true, true);
            let found = svd.solve(&-&at_given, 1e-12 * svd.singular_values.max());
            let found = found.map_err(|why| Error::run(format!("no rates fit the contacts: {why}")))?;
            free.iter().zip(found.iter()).for_each(|(c, value)| rates += &c.rates * *value);
        }
        let left = slips(&rates);
        let size = 1.0 + rates.amax();
        // What is undefined slips, too.
        let holds = |i: usize| left[i].abs() <= SLIP_TOLERANCE * size;
        let slipping = self.ideal().find(|(i, _)| !holds(*i));
        match slipping {
            None => Ok(rates.as_slice().to_vec()),
            Some((i, contact)) => {
                let message = format!("the speeds at the start make {} slip by {:.6} m/s", contact.name, left[i]);
                Err(Error::input(message)
                    .help("an ideal contact cannot: leave speeds out, or give it a law of friction"))
            }
        }
    }

    /// The motions a start is made of, each with its size where it is given.
    fn columns(&self, start: &Start, heading: f64) -> Vec<Column> {
        let free = self.coordinates();
        let column = |value: Option<f64>, parts: &[(&str, f64)]| {
            let part = |q: &Symbol| parts.iter().find(|(name, _)| *name == q.as_str()).map_or(0.0, |(_, v)| *v);
            Column { value, rates: DVector::from_iterator(free.len(), free.iter().map(part)) }
        };
        let (sin, cos) = heading.sin_cos();
        let body: &[&str] = if self.model.vehicle.line { &["s"] } else { &["x", "y", "phi"] };
        let mut found = match self.model.vehicle.line {
            true => vec![column(Some(start.speed), &[("s", 1.0)])],
            false => vec![
                column(Some(start.speed), &[("x", cos), ("y", sin)]),
                column(start.lateral_speed, &[("x", -sin), ("y", cos)]),
                column(start.yaw_rate, &[("phi", 1.0)]),
            ],
        };
        let others = free.iter().filter(|q| !body.contains(&q.as_str()));
        found.extend(others.map(|q| column(None, &[(q.as_str(), 1.0)])));
        found
    }

    fn slips(&self, system: &System, w: &mut Work, z: &[f64], u: &[f64], slope: &[f64]) -> Vec<f64> {
        let all = system.observe(w, z, u, slope);
        let names = system.observed.names.iter().zip(all);
        names.filter(|(name, _)| name.starts_with("slip.")).map(|(_, v)| v).collect()
    }
}

/// A motion at unit rate, and how much of it there is where that is known.
struct Column {
    value: Option<f64>,
    rates: DVector<f64>,
}
