//! Motion of a generated vehicle by its constraints alone: at every instant the linear system A(q, e)·q̇ = 0 is solved for the
//! rates that are not measured, and the rates are integrated by the crate `ode_solvers` (Dormand and Prince, order 5).
//!
//! It shares no code with the compiled models that fits and simulations use: neither their equations nor their steps.

use super::Generated;
use crate::error::{Error, Result};
use crate::formula::{Graph, Program, Symbol};
use crate::mechanism::{Mechanism, Point};
use crate::motion::{Integrator, Method};
use nalgebra::{DMatrix, DVector};

/// A row whose share outside of the rows before it is less than this adds no condition.
const INDEPENDENT: f64 = 1e-6;
/// Rates beyond this many times what is measured belong to a configuration in which the vehicle locks.
const LOCKED: f64 = 1e3;

/// The rows of a vehicle that tell its rates from the measured ones. The other rows are passive: their coefficients follow.
#[derive(Debug)]
pub struct ConstrainedMotion {
    /// q.
    coordinates: Vec<Symbol>,
    /// Places of the measured rates among the coordinates.
    measured: Vec<usize>,
    /// Places of the others.
    unknown: Vec<usize>,
    /// Constraints that are kept, in their order.
    rows: Vec<usize>,
    /// Coefficients of all rows, row by row, at q, the coefficients of creep, and the fixed lengths and angles.
    matrix: Program,
    /// Lengths, and angles at which wheels are mounted.
    fixed: Vec<f64>,
    constraints: usize,
    start: Vec<f64>,
}

impl ConstrainedMotion {
    /// The motion of a vehicle from its configuration by what its drive measures; `None` where its constraints do not tell all rates there.
    pub fn of(vehicle: &Generated) -> Option<Self> {
        let (mechanism, at) = (vehicle.mechanism(), vehicle.point());
        let coordinates = mechanism.coordinates.clone();
        let rates = vehicle.measured(false);
        let is_measured = |i: &usize| rates.contains(&coordinates[*i].rate());
        let (measured, unknown): (Vec<usize>, Vec<usize>) = (0..coordinates.len()).partition(is_measured);
        let (matrix, fixed) = compiled(&mechanism, &at)?;
        let start = coordinates.iter().map(|q| value_at(&at, q).unwrap_or(0.0)).collect();
        let constraints = mechanism.constraints.len();
        let mut motion = Self { coordinates, measured, unknown, rows: vec![], matrix, fixed, constraints, start };
        let whole = motion.all_rows(&motion.start, &vec![0.0; constraints])?;
        motion.rows = independent(&whole, &motion.unknown);
        (motion.rows.len() == motion.unknown.len()).then_some(motion)
    }

    /// How many coefficients of creep the rows have that tell the motion.
    pub fn coefficients(&self) -> usize {
        self.rows.len()
    }

    /// The configuration to begin with.
    pub fn start(&self) -> &[f64] {
        &self.start
    }

    /// The places of coordinates among q.
    pub fn place(&self, name: &str) -> Option<usize> {
        self.coordinates.iter().position(|q| q.as_str() == name)
    }

    /// Names of the coordinates whose rates are measured.
    pub fn measured(&self) -> impl Iterator<Item = &str> {
        self.measured.iter().map(|i| self.coordinates[*i].as_str())
    }

    /// q̇ at a configuration, measured rates and coefficients of the rows that are kept; `None` where the vehicle locks.
    pub fn rates(&self, q: &[f64], measured: &[f64], creeps: &[f64]) -> Option<Vec<f64>> {
        let mut e = vec![0.0; self.constraints];
        self.rows.iter().zip(creeps).for_each(|(row, creep)| e[*row] = *creep);
        let whole = self.all_rows(q, &e)?;
        let of = |columns: &[usize]| {
            DMatrix::from_fn(self.rows.len(), columns.len(), |i, j| whole[(self.rows[i], columns[j])])
        };
        let known = DVector::from_column_slice(measured);
        let found = of(&self.unknown).lu().solve(&-(of(&self.measured) * &known))?;
        let mut rates = vec![0.0; q.len()];
        self.measured.iter().zip(measured).for_each(|(i, rate)| rates[*i] = *rate);
        self.unknown.iter().zip(found.iter()).for_each(|(i, rate)| rates[*i] = *rate);
        let bound = LOCKED * (1.0 + known.amax());
        rates.iter().all(|r| r.abs() < bound).then_some(rates)
    }

    /// The configuration at a time, from the start at t = 0.
    ///
    /// # Errors
    /// When the vehicle locks on the way.
    pub fn travelled(&self, inputs: impl Fn(f64) -> Vec<f64>, creeps: &[f64], until: f64) -> Result<Vec<f64>> {
        let by = Integrator { method: Method::Dopri5, rtol: 1e-11, atol: 1e-12, max_steps: 20_000 };
        let rhs = |t: f64, q: &[f64], rates: &mut [f64]| match self.rates(q, &inputs(t), creeps) {
            Some(found) => rates.copy_from_slice(&found),
            None => rates.fill(f64::NAN),
        };
        by.solve(rhs, 0.0, &self.start, &[until])?.pop().ok_or_else(|| Error::run("no time was asked for"))
    }

    /// A(q, e) with a column for each coordinate.
    fn all_rows(&self, q: &[f64], creeps: &[f64]) -> Option<DMatrix<f64>> {
        let mut entries = vec![0.0; self.matrix.outputs()];
        self.matrix.run(&[q, creeps, &self.fixed].concat(), &mut self.matrix.registers(), &mut entries);
        let whole = DMatrix::from_row_slice(self.constraints, q.len(), &entries);
        whole.iter().all(|v| v.is_finite()).then_some(whole)
    }
}

/// The coefficients of all rows as a program of q, e and the symbols that stay what they are, and the values of these.
fn compiled(mechanism: &Mechanism, at: &Point) -> Option<(Program, Vec<f64>)> {
    let creeps: Vec<Symbol> = mechanism.constraints.iter().map(|c| c.creep.clone()).collect();
    let rows = mechanism.rows();
    let entries: Vec<_> =
        rows.iter().flat_map(|row| mechanism.coordinates.iter().map(|q| row.coefficient(&q.rate()))).collect();
    let moves = |s: &Symbol| mechanism.coordinates.contains(s) || creeps.contains(s);
    let fixed: std::collections::BTreeSet<Symbol> =
        entries.iter().flat_map(|e| e.symbols()).filter(|s| !moves(s)).collect();
    let values: Option<Vec<f64>> = fixed.iter().map(|s| value_at(at, s)).collect();
    let mut graph = Graph::default();
    let nodes: Vec<_> = entries.iter().map(|e| graph.insert(e)).collect();
    let slots: Vec<Symbol> = mechanism.coordinates.iter().chain(&creeps).chain(&fixed).cloned().collect();
    Some((Program::compile(&graph, &slots, &nodes).ok()?, values?))
}

fn value_at(at: &Point, name: &Symbol) -> Option<f64> {
    Some(at.value(name).to_f64()).filter(|v| v.is_finite())
}

/// The first rows that are independent in some columns, by Gram and Schmidt.
fn independent(matrix: &DMatrix<f64>, columns: &[usize]) -> Vec<usize> {
    let mut basis: Vec<DVector<f64>> = Vec::new();
    let mut kept = Vec::new();
    for i in 0..matrix.nrows() {
        let row = DVector::from_iterator(columns.len(), columns.iter().map(|j| matrix[(i, *j)]));
        let rest = basis.iter().fold(row.clone(), |rest, b| &rest - b * b.dot(&rest));
        if rest.norm() > INDEPENDENT * row.norm() {
            basis.push(rest.normalize());
            kept.push(i);
        }
    }
    kept
}
