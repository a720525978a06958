//! The state as the body carries it: velocity along and across the body in place of that along x and y.
//!
//! Friction is stiff across a wheel. In the world's axes that direction turns with the vehicle, and a stiff method that
//! takes ∂f/∂z for constant over a step needs the more steps the stiffer it is; in the body's axes it stays.

use super::System;
use super::system::Work;

impl System {
    /// The velocity of the reference point turned by an angle: from the world to the body by −φ, back by φ.
    fn turned(&self, z: &[f64], sign: f64) -> Vec<f64> {
        let mut found = z.to_vec();
        if !self.line {
            let ((sin, cos), n) = (z[2].sin_cos(), self.n);
            found[n] = cos * z[n] - sign * sin * z[n + 1];
            found[n + 1] = sign * sin * z[n] + cos * z[n + 1];
        }
        found
    }

    /// A state with the velocity in the body.
    pub(super) fn to_body(&self, z: &[f64]) -> Vec<f64> {
        self.turned(z, -1.0)
    }

    /// A state with the velocity in the world.
    pub(super) fn to_world(&self, z: &[f64]) -> Vec<f64> {
        self.turned(z, 1.0)
    }

    /// The rates of a state carried by the body.
    pub(super) fn carried_rates(&self, w: &mut Work, z: &[f64], u: &[f64], slope: &[f64], rates: &mut [f64]) {
        self.write_rates(w, &self.to_world(z), u, slope, rates);
        self.carry(z, rates);
    }

    /// u̇ = ẍ·cos φ + ÿ·sin φ + φ̇·w, ẇ = −ẍ·sin φ + ÿ·cos φ − φ̇·u.
    fn carry(&self, z: &[f64], rates: &mut [f64]) {
        if !self.line {
            let ((sin, cos), n) = (z[2].sin_cos(), self.n);
            let (x, y) = (rates[n], rates[n + 1]);
            rates[n] = cos * x + sin * y + z[n + 2] * z[n + 1];
            rates[n + 1] = cos * y - sin * x - z[n + 2] * z[n];
        }
    }

    /// Their derivatives by the state, row by row.
    pub(super) fn carried_slopes(&self, w: &mut Work, z: &[f64], u: &[f64], slope: &[f64], out: &mut [f64]) {
        let world = self.to_world(z);
        self.write_slopes(w, &world, u, slope, out);
        if self.line {
            return;
        }
        let (size, n, (sin, cos)) = (self.size(), self.n, z[2].sin_cos());
        // By φ, u and w: the velocity in the world hangs on all three.
        for row in out.chunks_exact_mut(size) {
            let (by_x, by_y) = (row[n], row[n + 1]);
            row[2] += by_y * world[n] - by_x * world[n + 1];
            row[n] = by_x * cos + by_y * sin;
            row[n + 1] = by_y * cos - by_x * sin;
        }
        let mut rates = vec![0.0; size];
        self.write_rates(w, &world, u, slope, &mut rates);
        let (x, y) = (rates[n], rates[n + 1]);
        for k in 0..size {
            let (forward, left) = (out[n * size + k], out[(n + 1) * size + k]);
            out[n * size + k] = cos * forward + sin * left;
            out[(n + 1) * size + k] = cos * left - sin * forward;
        }
        let mut add = |row: usize, by: usize, value: f64| out[row * size + by] += value;
        add(n, 2, cos * y - sin * x);
        add(n + 1, 2, -cos * x - sin * y);
        add(n, n + 2, z[n + 1]);
        add(n, n + 1, z[n + 2]);
        add(n + 1, n + 2, -z[n]);
        add(n + 1, n, -z[n + 2]);
    }
}

#[cfg(test)]
mod tests {
    use crate::dynamics::{Dynamics, Masses, TrailerMass};
    use crate::model::{Model, Trailer};

    /// Against differences of the rates, for a car with a trailer, every law, and a steering angle that is a state.
    #[test]
    fn slopes_are_those_of_the_rates() {
        let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.0)]).unwrap();
        let car = car.with_trailers(&[Trailer { length: 1.2, hitch: 0.4 }]);
        let trailers = vec![TrailerMass { mass: 1.5, inertia: 0.4, mass_offset: 0.1 }];
        let wheels = [("theta'".into(), 0.3)].into();
        let masses = Masses { mass: 3.0, inertia: 1.2, mass_offset: 0.7, wheels, trailers, ..Masses::default() };
        let car = Dynamics::new(&car, &masses).unwrap().driven_by(&["wheel_torque", "lateral_force"]).unwrap();
        let car = car.with_law("rear-axle-rolling", "viscous", &[30.0]).unwrap();
        let car = car.with_law("rear-axle-direction", "elastic", &[40.0, 0.3]).unwrap();
        let mixed = car.clone().with_law("front-axle-direction", "rocard", &[50.0]).unwrap();
        for (dynamics, u, slope) in [
            (mixed.clone(), [1.0, 0.4, 0.2], [0.0, 0.0, 0.3]),
            (car, [1.0, 0.4, 0.2], [0.0, 0.0, 0.3]),
            (mixed.steered_by_rate(), [1.0, 0.4, 0.2], [0.0; 3]),
        ] {
            let system = dynamics.compile().unwrap();
            let (size, mut w) = (system.size(), system.work());
            let z: Vec<f64> = (0..size).map(|i| 0.3 + 0.17 * (i as f64 * 1.7).sin()).collect();
            let mut exact = vec![0.0; size * size];
            system.carried_slopes(&mut w, &z, &u, &slope, &mut exact);
            for k in 0..size {
                let rates = |by: f64| {
                    let (mut z, mut rates, mut w) = (z.clone(), vec![0.0; size], system.work());
                    z[k] += by;
                    system.carried_rates(&mut w, &z, &u, &slope, &mut rates);
                    rates
                };
                let (plus, minus) = (rates(1e-5), rates(-1e-5));
                for i in 0..size {
                    let said = (plus[i] - minus[i]) / 2e-5;
                    let found = exact[i * size + k];
                    assert!((found - said).abs() < 1e-5 * (1.0 + said.abs()), "{i} by {k}: {found} {said}");
                }
            }
        }
    }
}
