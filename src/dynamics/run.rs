//! The simulation of a motion with forces, as a table.

use super::{Dynamics, Start, System};
use crate::error::{Error, Result};
use crate::motion::{Drive, Integrator, Table, integrate};

/// Simulates a vehicle under forces and tabulates what a logger would see.
///
/// | column | unit | meaning |
/// |---|---|---|
/// | `time` | s | the given times |
/// | `x`, `y`, `heading`, `trailer_heading_1` … | m, rad | measured pose, headings not wrapped |
/// | the steering, such as `steering_angle` | rad | as prescribed |
/// | `speed`, `lateral_speed`, `yaw_rate` | m/s, rad/s | of the reference point |
/// | `wheel_rate` … | rad/s | rates of the wheels, by the names they are logged under |
/// | `slip.`contact | m/s | v_A or v_t of each contact |
/// | `force.`contact | N | the force along that slip |
/// | `energy` | J | kinetic energy of bodies and wheels |
/// | `input_power`, `friction_power` | W | what inputs and contacts deliver |
///
/// An explicit method is enough for ideal contacts; give friction [`Method::Radau5`](crate::motion::Method).
///
/// # Errors
/// When the inputs or the start do not fit, nothing accelerates a coordinate, or the motion becomes undefined.
///
/// ```
/// use creepage::dynamics::{Dynamics, Masses, Start, simulate_dynamics};
/// use creepage::formula::Expr;
/// use creepage::model::Model;
/// use creepage::motion::{Formulas, Integrator};
/// let sleigh = Model::new("sleigh", &[("mass", 1.0), ("inertia", 0.5), ("mass_offset", 0.3)]).unwrap();
/// let masses = Masses { mass: 1.0, inertia: 0.5, mass_offset: 0.3, ..Masses::default() };
/// let sleigh = Dynamics::new(&sleigh, &masses).unwrap();
/// let start = Start { pose: vec![0.0; 3], speed: 0.5, yaw_rate: Some(1.2), ..Start::default() };
/// let no_inputs = Formulas::new(&[], &[]).unwrap();
/// let run = simulate_dynamics(&sleigh, &no_inputs, &[0.0, 4.0], &start, &Integrator::default()).unwrap();
/// // Nothing drives it and the ideal blade does no work: the energy stays.
/// let energy = run.column("energy").unwrap();
/// assert!((energy[1] - energy[0]).abs() < 1e-9 && run.column("speed").unwrap()[1] > 1.0);
/// ```
pub fn simulate_dynamics(
    dynamics: &Dynamics,
    inputs: &impl Drive,
    times: &[f64],
    start: &Start,
    integrator: &Integrator,
) -> Result<Table> {
    let system = dynamics.compile()?;
    let first = *times.first().ok_or_else(|| Error::input("a simulation needs at least one time"))?;
    if inputs.channels() != system.inputs.len() {
        let (given, wanted) = (inputs.channels(), system.inputs.len());
        return Err(Error::input(format!("{given} inputs are given, the vehicle has {wanted}")));
    }
    let at = |t: f64| {
        let (mut u, mut slope) = (vec![0.0; inputs.channels()], vec![0.0; inputs.channels()]);
        inputs.at(t, &mut u, &mut slope);
        (u, slope)
    };
    let (u, slope) = at(first);
    let z0 = dynamics.initial(&system, start, &u, &slope)?;
    system.check_determined(&z0, &u, &slope)?;
    let states = system.follow(inputs, &z0, times, integrator)?;
    let mut w = system.work();
    let row = |(t, z): (&f64, &Vec<f64>)| {
        let (u, slope) = at(*t);
        let row = dynamics.row(&system, &system.observe(&mut w, z, &u, &slope), *t, z, &u, start);
        match row.iter().all(|v| v.is_finite()) {
            true => Ok(row),
            false => Err(Error::run(format!("the motion is undefined at t = {t}"))
                .help("rocard friction is undefined at rest; elastic and viscous friction are not")),
        }
    };
    let rows: Vec<Vec<f64>> = times.iter().zip(&states).map(row).collect::<Result<_>>()?;
    let names = dynamics.names(&system);
    let columns = (0..names.len()).map(|c| rows.iter().map(|r| r[c]).collect()).collect();
    Ok(Table { names, columns })
}

impl Dynamics {
    fn names(&self, system: &System) -> Vec<String> {
        let trailers = (1..=self.model.trailers.len()).map(|i| format!("trailer_heading_{i}"));
        let pose = ["time", "x", "y", "heading"].map(String::from).into_iter().chain(trailers);
        pose.chain(self.steering()).chain(system.observed.names.clone()).collect()
    }

    fn row(&self, system: &System, observed: &[f64], t: f64, z: &[f64], u: &[f64], start: &Start) -> Vec<f64> {
        let state = |name: &str| system.states.iter().position(|s| s.as_str() == name).map(|i| z[i]);
        let [mut x, mut y, heading] = match self.model.vehicle.line {
            true => [start.pose[0], start.pose[1], start.pose[2] - self.model.sensor.heading_offset],
            false => ["x", "y", "phi"].map(|name| state(name).unwrap_or(f64::NAN)),
        };
        let ([a, b], (sin, cos)) = (self.model.sensor.lever_arm, heading.sin_cos());
        match state("s") {
            // On a line the pose of the start, lever arm included, is carried along.
            Some(s) if self.model.vehicle.line => (x, y) = (x + s * cos, y + s * sin),
            _ => (x, y) = (x + a * cos - b * sin, y + a * sin + b * cos),
        }
        let mut row = vec![t, x, y, heading + self.model.sensor.heading_offset];
        let trailer = |i: usize| state(crate::model::trailer_heading(i).as_str()).unwrap_or(f64::NAN);
        row.extend((1..=self.model.trailers.len()).map(trailer));
        match self.by_rate {
            true => row.extend(self.prescribed.iter().take(self.steering().len()).filter_map(|q| state(q.as_str()))),
            false => row.extend(&u[u.len() - self.steering().len()..]),
        }
        row.extend(observed);
        row
    }
}

impl System {
    /// The states at times under inputs, with exact slopes for a stiff method.
    fn follow(&self, inputs: &impl Drive, z0: &[f64], times: &[f64], by: &Integrator) -> Result<Vec<Vec<f64>>> {
        let channels = inputs.channels();
        let mut w = self.work();
        let mut input = (vec![0.0; channels], vec![0.0; channels]);
        let rates = |t: f64, z: &[f64], rates: &mut [f64]| {
            inputs.at(t, &mut input.0, &mut input.1);
            self.carried_rates(&mut w, z, &input.0, &input.1, rates);
        };
        let mut w = self.work();
        let mut input = (vec![0.0; channels], vec![0.0; channels]);
        let slopes = |t: f64, z: &[f64], slopes: &mut [f64]| {
            inputs.at(t, &mut input.0, &mut input.1);
            self.carried_slopes(&mut w, z, &input.0, &input.1, slopes);
        };
        let states = integrate(inputs.knots(), &self.to_body(z0), times, by, rates, slopes)?;
        Ok(states.iter().map(|z| self.to_world(z)).collect())
    }
}
