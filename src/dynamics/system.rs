//! The equations of motion with forces, evaluated: accelerations, and exact slopes for a stiff integration.

use super::linear_solution::{SINGULAR_PIVOT, solution, solutions};
use super::observed::Observed;
use crate::error::{Error, Result};
use crate::formula::{Program, Symbol};
use crate::model::forces::without_inertia;
use nalgebra::{DMatrix, DVector};

/// ż = f(z, u) of a vehicle with forces, compiled once.
///
/// | symbol | meaning |
/// |---|---|
/// | z | coordinates q, their rates q̇, states of the laws of contact, steering angles that are given by their rates |
/// | u | inputs of [`Dynamics::inputs`](super::Dynamics::inputs); a steering angle with its slope |
///
/// The accelerations solve [M, −Aᵀ; A, 0]·(q̈, λ) = (Q − h, −Ȧq̇) with A = ∂slip/∂q̇ of the ideal contacts. Contacts
/// that say the same twice share their force; the accelerations do not depend on how.
#[derive(Clone, Debug)]
pub struct System {
    /// z by name.
    pub states: Vec<Symbol>,
    /// The inputs.
    pub inputs: Vec<String>,
    /// How many coordinates move by forces.
    pub(super) n: usize,
    /// How many contacts are ideal.
    pub(super) ideal: usize,
    /// Whether the body moves along a line.
    pub(super) line: bool,
    pub(super) observed: Observed,
    /// How many of the inputs are forces; the others steer.
    pub(super) forces: usize,
    pub(super) memory: usize,
    pub(super) by_rate: bool,
    pub(super) constants: Vec<f64>,
    pub(super) motion: Program,
    pub(super) slopes: Program,
    pub(super) steering: Program,
    pub(super) prescribed: usize,
}

/// Working memory for one thread that evaluates a [`System`].
#[derive(Clone, Debug)]
pub(super) struct Work {
    pub slots: Vec<f64>,
    registers: Vec<f64>,
    parts: Vec<f64>,
    slopes: Vec<f64>,
    /// Accelerations and multipliers found last.
    pub solved: DVector<f64>,
}

/// How far beside a kink slopes are taken, as a share of one.
const KINK_DISTANCE: f64 = 1e-9;

impl System {
    pub(super) fn work(&self) -> Work {
        let programs = [&self.motion, &self.slopes, &self.steering, &self.observed.program];
        let most = |size: &dyn Fn(&Program) -> usize| programs.iter().map(|p| size(p)).max().unwrap_or(0);
        let moving = 2 * self.n + self.memory + 2 * self.prescribed + self.forces + self.n + self.ideal;
        let mut slots = vec![0.0; moving];
        slots.extend_from_slice(&self.constants);
        Work {
            slots,
            registers: vec![0.0; most(&Program::len)],
            parts: vec![0.0; most(&Program::outputs)],
            slopes: vec![0.0; self.slopes.outputs()],
            solved: DVector::zeros(self.n + self.ideal),
        }
    }

    /// How many states there are.
    pub(super) fn size(&self) -> usize {
        self.states.len()
    }

    /// How many of the states stand in the formulas as they are.
    fn inner(&self) -> usize {
        2 * self.n + self.memory
    }

    /// Puts a state and inputs with their slopes into the slots.
    pub(super) fn load(&self, w: &mut Work, z: &[f64], u: &[f64], slope: &[f64]) {
        let (inner, p) = (self.inner(), self.prescribed);
        w.slots[..inner].copy_from_slice(&z[..inner]);
        let (forces, steering) = u.split_at(self.forces);
        if self.by_rate {
            w.slots[inner..inner + p].copy_from_slice(&z[inner..]);
            // One rate for each prescribed coordinate, or one for all.
            (0..p).for_each(|i| w.slots[inner + p + i] = steering[i.min(steering.len() - 1)]);
        } else if p > 0 {
            let slots = [steering, &slope[self.forces..], &self.constants].concat();
            self.steering.run(&slots, &mut w.registers, &mut w.slots[inner..inner + 2 * p]);
        }
        w.slots[inner + 2 * p..inner + 2 * p + self.forces].copy_from_slice(forces);
    }

    /// The matrix and right side of the equations for accelerations and multipliers, with the slots loaded.
    pub(super) fn equations(&self, w: &mut Work) -> (DMatrix<f64>, DVector<f64>) {
        let (n, m) = (self.n, self.ideal);
        self.motion.run(&w.slots, &mut w.registers, &mut w.parts);
        let (mass, rest) = w.parts.split_at(n * n);
        let (force, rest) = rest.split_at(n);
        let (rows, drift) = rest.split_at(m * n);
        let matrix = DMatrix::from_fn(n + m, n + m, |i, k| match (i < n, k < n) {
            (true, true) => mass[i * n + k],
            (true, false) => -rows[(k - n) * n + i],
            (false, true) => rows[(i - n) * n + k],
            (false, false) => 0.0,
        });
        (matrix, DVector::from_fn(n + m, |i, _| if i < n { force[i] } else { -drift[i - n] }))
    }

    /// ż at a state, inputs and their slopes; NaN where it is undefined.
    pub fn rates(&self, z: &[f64], u: &[f64], slope: &[f64]) -> Vec<f64> {
        let mut rates = vec![0.0; self.size()];
        self.write_rates(&mut self.work(), z, u, slope, &mut rates);
        rates
    }

    pub(super) fn write_rates(&self, w: &mut Work, z: &[f64], u: &[f64], slope: &[f64], rates: &mut [f64]) {
        let (n, m, inner) = (self.n, self.ideal, self.inner());
        self.load(w, z, u, slope);
        let (matrix, side) = self.equations(w);
        w.solved = solution(matrix, &side);
        rates[..n].copy_from_slice(&z[n..2 * n]);
        rates[n..2 * n].copy_from_slice(&w.solved.as_slice()[..n]);
        rates[2 * n..inner].copy_from_slice(&w.parts[n * n + n + m * n + m..][..self.memory]);
        if self.by_rate {
            rates[inner..].copy_from_slice(&w.slots[inner + self.prescribed..inner + 2 * self.prescribed]);
        }
    }

    /// ∂ż/∂z row by row. At a kink, where the motion is defined and |speed| has no slope, that beside it.
    pub(super) fn write_slopes(&self, w: &mut Work, z: &[f64], u: &[f64], slope: &[f64], out: &mut [f64]) {
        self.slopes_at(w, z, u, slope, out);
        if out.iter().any(|v| !v.is_finite()) {
            let beside: Vec<f64> = z.iter().map(|z| z + KINK_DISTANCE * (1.0 + z.abs())).collect();
            self.slopes_at(w, &beside, u, slope, out);
        }
    }

    fn slopes_at(&self, w: &mut Work, z: &[f64], u: &[f64], slope: &[f64], out: &mut [f64]) {
        let (n, size, inner) = (self.n, self.size(), self.inner());
        let mut rates = vec![0.0; size];
        self.write_rates(w, z, u, slope, &mut rates);
        let start = inner + 2 * self.prescribed + self.forces;
        w.slots[start..start + n + self.ideal].copy_from_slice(w.solved.as_slice());
        let (matrix, _) = self.equations(w);
        self.slopes.run(&w.slots, &mut w.registers, &mut w.slopes);
        let unknowns = n + self.ideal;
        let right = DMatrix::from_fn(unknowns, size, |i, k| -w.slopes[i * size + k]);
        let accelerations = solutions(matrix, right);
        out.fill(0.0);
        for i in 0..n {
            out[i * size + n + i] = 1.0;
            (0..size).for_each(|k| out[(n + i) * size + k] = accelerations[(i, k)]);
        }
        for i in 0..self.memory {
            let row = &w.slopes[(unknowns + i) * size..][..size];
            out[(2 * n + i) * size..][..size].copy_from_slice(row);
        }
    }
}

impl System {
    /// What [`Observed`] names, at a state and inputs.
    pub(super) fn observe(&self, w: &mut Work, z: &[f64], u: &[f64], slope: &[f64]) -> Vec<f64> {
        let mut rates = vec![0.0; self.size()];
        self.write_rates(w, z, u, slope, &mut rates);
        let start = self.inner() + 2 * self.prescribed + self.forces;
        w.slots[start..start + self.n + self.ideal].copy_from_slice(w.solved.as_slice());
        let mut found = vec![0.0; self.observed.program.outputs()];
        self.observed.program.run(&w.slots, &mut w.registers, &mut found);
        found
    }

    /// That masses and contacts determine every acceleration.
    ///
    /// # Errors
    /// Names a coordinate that nothing accelerates.
    pub(super) fn check_determined(&self, z: &[f64], u: &[f64], slope: &[f64]) -> Result<()> {
        let mut w = self.work();
        self.load(&mut w, z, u, slope);
        let (matrix, side) = self.equations(&mut w);
        if matrix.iter().chain(side.iter()).any(|v| !v.is_finite()) {
            return Err(Error::run("the motion is undefined at the start")
                .help("rocard friction is undefined at rest: give a speed, or use elastic or viscous friction"));
        }
        let scaled = DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, k| {
            matrix[(i, k)] / matrix.row(i).amax().max(f64::MIN_POSITIVE)
        });
        let svd = scaled.svd(false, true);
        let Some(v) = svd.v_t else { return Ok(()) };
        let most = svd.singular_values.max();
        let still = (0..svd.singular_values.len()).filter(|i| svd.singular_values[*i] <= SINGULAR_PIVOT * most);
        for i in still {
            let moving = (0..self.n).max_by(|a, b| v[(i, *a)].abs().total_cmp(&v[(i, *b)].abs()));
            if let Some(q) = moving.filter(|q| v[(i, *q)].abs() > 1e-6) {
                let name = &self.states[q];
                return Err(without_inertia(name));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::{Dynamics, Masses};
    use crate::model::Model;

    /// |speed| has no slope at rest, where the elastic law is defined: its slopes are those of a motion ahead.
    #[test]
    fn slopes_at_a_kink_are_those_beside_it() {
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        let masses = Masses { mass: 2.0, inertia: 0.7, wheels: [("theta'".into(), 0.1)].into(), ..Masses::default() };
        let elastic = Dynamics::new(&model, &masses).unwrap().with_laws("elastic", &[40.0, 0.3]).unwrap();
        let system = elastic.compile().unwrap();
        let (size, mut w) = (system.size(), system.work());
        let slopes = |w: &mut Work, z: &[f64]| {
            let mut out = vec![0.0; size * size];
            system.write_slopes(w, z, &[], &[], &mut out);
            out
        };
        // At rest, deflected.
        let mut z = vec![0.0; size];
        z[2 * system.n..].iter_mut().enumerate().for_each(|(i, x)| *x = 0.01 * (1.0 + i as f64));
        let rest = slopes(&mut w, &z);
        let ahead: Vec<f64> = z.iter().map(|z| z + 1e-7).collect();
        let ahead = slopes(&mut w, &ahead);
        assert!(rest.iter().all(|v| v.is_finite()));
        for (i, (a, b)) in rest.iter().zip(&ahead).enumerate() {
            assert!((a - b).abs() < 1e-4 * (1.0 + b.abs()), "{i}: {a} {b}");
        }
    }

    #[test]
    fn friction_asks_for_a_stiff_method_and_ideal_contacts_do_not() {
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        let ideal = Dynamics::new(&model, &Masses { mass: 1.0, inertia: 1.0, ..Masses::default() }).unwrap();
        assert!(!ideal.has_friction());
        assert!(ideal.with_law("wheel-direction", "viscous", &[1.0]).unwrap().has_friction());
    }
}
