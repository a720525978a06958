//! The equations of motion compiled: accelerations by elimination or least squares, and exact slopes for a stiff
//! integration.

use super::derive::Derived;
use super::observed::{Observed, undefined};
use super::{Dynamics, Law};
use crate::error::{Error, Result};
use crate::formula::{Expr, Graph, NodeId, Program, Symbol};
use nalgebra::{DMatrix, DVector};

/// ż = f(z, u) of a vehicle with forces, compiled once.
///
/// | symbol | meaning |
/// |---|---|
/// | z | coordinates q, their rates q̇, states of the laws of contact, steering angles that are given by their rates |
/// | u | inputs of [`Dynamics::inputs`]; a steering angle with its slope |
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
    forces: usize,
    memory: usize,
    by_rate: bool,
    constants: Vec<f64>,
    motion: Program,
    slopes: Program,
    steering: Program,
    prescribed: usize,
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

impl Dynamics {
    /// Compiles the equations of motion.
    ///
    /// ```
    /// use creepage::dynamics::{Dynamics, Masses};
    /// use creepage::model::Model;
    /// let disk = Model::new("disk", &[("wheel_radius", 0.5)]).unwrap();
    /// let masses = Masses { mass: 2.0, wheels: [("theta'".into(), 0.25)].into(), ..Masses::default() };
    /// let disk = Dynamics::new(&disk, &masses).unwrap().driven_by(&["wheel_torque"]).unwrap().compile().unwrap();
    /// // A torque of 1.5 N·m on a disk that rolls: v' = (τ/r)/(m + J/r²) = 1 m/s².
    /// assert!((disk.rates(&[0.0; 4], &[1.5], &[0.0])[2] - 1.0).abs() < 1e-12);
    /// ```
    ///
    /// # Errors
    /// When a formula uses a name that nothing defines, or the steering cannot be given as it is.
    pub fn compile(&self) -> Result<System> {
        let mut d = self.derive(true)?;
        let (free, steering) = (self.coordinates(), self.steering());
        if self.by_rate && self.prescribed.iter().any(|q| self.steered_otherwise(q)) {
            return Err(Error::input("this steering is a formula of its input and cannot be given by its rate")
                .help("give the steering angle"));
        }
        self.check_steered_rows()?;
        let rate = |s: &[Symbol]| s.iter().map(Symbol::rate).collect::<Vec<_>>();
        let memory: Vec<Symbol> =
            self.contacts.iter().enumerate().filter_map(|(i, c)| c.memory(i + 1)).map(|(s, _)| s).collect();
        let forces: Vec<Symbol> = self.driven.iter().map(|f| Symbol::new(&f.role)).collect();
        let states = [&free[..], &rate(&free), &memory].concat();
        let given = [&self.prescribed[..], &rate(&self.prescribed), &forces].concat();
        let (names, constants): (Vec<Symbol>, Vec<f64>) = self.values().into_iter().unzip();
        let unknown = unknowns(&free, self.ideal().count());
        let slots = [&states[..], &given, &unknown, &names].concat();
        let compile = |graph: &Graph, nodes: &[NodeId]| Program::compile(graph, &slots, nodes).map_err(undefined);
        let difference: Vec<NodeId> = d.force.iter().zip(&d.bias).map(|(q, h)| d.graph.sub(*q, *h)).collect();
        let motion = compile(&d.graph, &[&d.mass[..], &difference, &d.rows, &d.drift, &d.memory].concat())?;
        let mut all: Vec<Symbol> = states;
        all.extend(if self.by_rate { self.prescribed.clone() } else { vec![] });
        let slopes = residual_slopes(&mut d, &difference, &unknown, &all);
        let slopes = compile(&d.graph, &slopes)?;
        let observed = Observed::compile(self, &mut d.graph, &slots)?;
        let prescribed = self.prescribed.len();
        Ok(System {
            states: all,
            inputs: self.inputs(),
            n: free.len(),
            ideal: self.ideal().count(),
            line: self.model.vehicle.line,
            observed,
            forces: forces.len(),
            memory: memory.len(),
            by_rate: self.by_rate,
            constants,
            motion,
            slopes,
            steering: self.steering_program(&steering)?,
            prescribed,
        })
    }

    fn steered_otherwise(&self, q: &Symbol) -> bool {
        let formula = self.model.vehicle.define.get(q).map(|d| &d.formula);
        !formula.is_some_and(|f| self.steering().iter().any(|s| *f == Expr::sym(s.as_str())))
    }

    /// An ideal contact behind the axis of a steered wheel is swung by the steering itself, whose acceleration is not
    /// among the inputs.
    fn check_steered_rows(&self) -> Result<()> {
        let swung = |c: &super::Contact| self.prescribed.iter().any(|q| !c.slip.coefficient(&q.rate()).is_zero());
        match self.ideal().find(|(_, c)| swung(c)) {
            None => Ok(()),
            Some((_, c)) => {
                Err(Error::input(format!("{} is swung by the steering, whose acceleration is not known", c.name))
                    .help("give this contact a law of friction"))
            }
        }
    }

    /// Prescribed coordinates and their rates from logged angles and their slopes.
    fn steering_program(&self, steering: &[String]) -> Result<Program> {
        let mut graph = Graph::default();
        let names: Vec<Symbol> = steering.iter().map(|s| Symbol::new(s)).collect();
        let formula = |q: &Symbol| self.model.vehicle.define.get(q).map(|d| d.formula.clone()).unwrap_or_default();
        let angles: Vec<NodeId> = self.prescribed.iter().map(|q| graph.insert(&formula(q))).collect();
        let mut rates: Vec<NodeId> = angles.iter().map(|_| graph.insert(&Expr::int(0))).collect();
        for name in &names {
            let slope = graph.symbol(name.rate());
            for (rate, by) in rates.iter_mut().zip(graph.derivatives(&angles, name)) {
                let term = graph.mul(by, slope);
                *rate = graph.add(*rate, term);
            }
        }
        let values: Vec<Symbol> = self.values().into_keys().collect();
        let slopes: Vec<Symbol> = names.iter().map(Symbol::rate).collect();
        Program::compile(&graph, &[names, slopes, values].concat(), &[angles, rates].concat()).map_err(undefined)
    }
}

/// Symbols of accelerations and multipliers.
fn unknowns(free: &[Symbol], ideal: usize) -> Vec<Symbol> {
    let accelerations = free.iter().map(|q| q.rate().rate());
    accelerations.chain((1..=ideal).map(|j| Law::symbol("multiplier", j))).collect()
}

/// ∂/∂z of what the unknowns make zero: M·q̈ − Aᵀλ − (Q − h) and A·q̈ + Ȧq̇, then of the rates of the laws' states.
fn residual_slopes(d: &mut Derived, difference: &[NodeId], unknown: &[Symbol], states: &[Symbol]) -> Vec<NodeId> {
    let n = difference.len();
    let symbols: Vec<NodeId> = unknown.iter().map(|s| d.graph.symbol(s.clone())).collect();
    let (accelerations, multipliers) = symbols.split_at(n);
    let mut residual = Vec::new();
    for (i, difference) in difference.iter().enumerate() {
        let mut sum = d.graph.neg(*difference);
        for (k, a) in accelerations.iter().enumerate() {
            let term = d.graph.mul(d.mass[i * n + k], *a);
            sum = d.graph.add(sum, term);
        }
        for (j, multiplier) in multipliers.iter().enumerate() {
            let term = d.graph.mul(d.rows[j * n + i], *multiplier);
            sum = d.graph.sub(sum, term);
        }
        residual.push(sum);
    }
    for (j, drift) in d.drift.clone().into_iter().enumerate() {
        let mut sum = drift;
        for (k, a) in accelerations.iter().enumerate() {
            let term = d.graph.mul(d.rows[j * n + k], *a);
            sum = d.graph.add(sum, term);
        }
        residual.push(sum);
    }
    residual.extend(d.memory.clone());
    let columns: Vec<Vec<NodeId>> = states.iter().map(|s| d.graph.derivatives(&residual, s)).collect();
    (0..residual.len()).flat_map(|i| columns.iter().map(move |c| c[i])).collect()
}

/// A pivot below this share of the largest is rounding, and its matrix counts as singular.
const SINGULAR_PIVOT: f64 = 1e-12;
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

/// The solution; of least size where contacts say the same twice, NaN where there is none.
fn solution(matrix: DMatrix<f64>, side: &DVector<f64>) -> DVector<f64> {
    let right = DMatrix::from_column_slice(side.len(), 1, side.as_slice());
    DVector::from_column_slice(solutions(matrix, right).as_slice())
}

fn solutions(matrix: DMatrix<f64>, right: DMatrix<f64>) -> DMatrix<f64> {
    let (rows, columns) = right.shape();
    let nothing = || DMatrix::from_element(rows, columns, f64::NAN);
    if matrix.iter().chain(right.iter()).any(|v| !v.is_finite()) {
        return nothing();
    }
    // Rows of masses and rows of lengths differ in size by orders of magnitude.
    let scale: Vec<f64> = matrix.row_iter().map(|r| r.amax()).map(|s| if s > 0.0 { s } else { 1.0 }).collect();
    let matrix = DMatrix::from_fn(rows, rows, |i, k| matrix[(i, k)] / scale[i]);
    let right = DMatrix::from_fn(rows, columns, |i, k| right[(i, k)] / scale[i]);
    let lu = matrix.clone().full_piv_lu();
    let pivots = lu.u().diagonal().map(f64::abs);
    if pivots.min() > SINGULAR_PIVOT * pivots.max() {
        return lu.solve(&right).unwrap_or_else(nothing);
    }
    let svd = matrix.svd(true, true);
    let cut = SINGULAR_PIVOT * svd.singular_values.max();
    svd.solve(&right, cut).unwrap_or_else(|_| nothing())
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
                return Err(Error::input(format!(
                    "nothing says how {name} accelerates: it has neither mass nor an ideal contact"
                ))
                .help("give it a moment of inertia under [dynamics], or make its contact ideal"));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Masses;
    use crate::model::Model;

    #[test]
    fn rows_of_other_units_are_no_less_independent() {
        let matrix = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 1e-20, -1e-20]);
        let found = solution(matrix, &DVector::from_vec(vec![3.0, 1e-20]));
        assert!((found[0] - 2.0).abs() < 1e-12 && (found[1] - 1.0).abs() < 1e-12, "{found}");
        // A row of zeros asks for nothing, and the rest is of least size.
        let matrix = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 0.0, 0.0]);
        let found = solution(matrix, &DVector::from_vec(vec![2.0, 0.0]));
        assert!((found[0] - 1.0).abs() < 1e-12 && (found[1] - 1.0).abs() < 1e-12, "{found}");
    }

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
