//! The normal equations of rates: residuals and derivatives at all samples, summed in vector lanes.

use crate::formula::{Isa, Kernel};
use crate::model::{Equations, Workspace};
use nalgebra::{DMatrix, DVector};

/// Samples that are looked at side by side: four vectors of AVX-512.
const LANES: usize = 32;
type Lane = [f64; LANES];

/// A change of all residuals together by less than this share of the rates is rounding.
const SETTLED: f64 = 1e-12;

/// Rates of a motion, each column with a value for every sample.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | states | m, rad | z in the order of [`Equations::states`] |
/// | inputs | SI | u in the order of [`Equations::inputs`], as they act at the sample |
/// | rates | m/s, rad/s | measured z′; NaN where it is not measured |
/// | deviations | as rates | standard deviation of each rate; infinite for one that does not count |
#[derive(Clone, Debug, Default)]
pub struct RateSamples {
    /// Columns of z.
    pub states: Vec<Vec<f64>>,
    /// Columns of u.
    pub inputs: Vec<Vec<f64>>,
    /// Columns of z′.
    pub rates: Vec<Vec<f64>>,
    /// A standard deviation for each column of z′.
    pub deviations: Vec<f64>,
}

/// Sums over samples, lane by lane.
pub(super) struct Sums {
    lanes: Vec<Lane>,
    parameters: usize,
    pub squares: f64,
    /// Σ(z′/deviation)²
    measured: f64,
    totals: Vec<f64>,
}

impl Sums {
    /// Of all samples at parameters, each rate by those parameters that it depends on.
    pub fn over(
        equations: &Equations,
        by: &[Vec<usize>],
        samples: &RateSamples,
        weights: &[f64],
        p: &DVector<f64>,
    ) -> Self {
        let mut sums = Self::new(p.len());
        let workspace = equations.side_by_side([p.as_slice(); LANES]);
        Isa::best().dispatch(Pass { equations, by, samples, weights, workspace, sums: &mut sums });
        sums.total();
        sums
    }

    /// Places of the squares and of the measured rates, then of the gradient, then of the lower triangle of JᵀJ.
    fn new(parameters: usize) -> Self {
        let count = 2 + parameters + parameters * (parameters + 1) / 2;
        Self { lanes: vec![[0.0; LANES]; count], parameters, squares: 0.0, measured: 0.0, totals: vec![] }
    }

    #[inline(always)]
    fn place(&self, a: usize, b: usize) -> usize {
        2 + self.parameters + a * (a + 1) / 2 + b
    }

    /// Lanes are added in their order.
    fn total(&mut self) {
        self.totals = self.lanes.iter().map(|lane| lane.iter().sum()).collect();
        (self.squares, self.measured) = (self.totals[0], self.totals[1]);
    }

    pub fn is_defined(&self) -> bool {
        self.totals.iter().all(|v| v.is_finite())
    }

    pub fn gradient(&self) -> DVector<f64> {
        DVector::from_column_slice(&self.totals[2..2 + self.parameters])
    }

    pub fn information(&self) -> DMatrix<f64> {
        let n = self.parameters;
        DMatrix::from_fn(n, n, |i, j| self.totals[self.place(i.max(j), i.min(j))])
    }

    /// Whether a step changes the residuals by rounding alone.
    pub fn is_rounding(&self, step: &DVector<f64>) -> bool {
        step.dot(&(self.information() * step)) <= SETTLED * SETTLED * self.measured
    }
}

/// Rates and derivatives at all samples, summed.
struct Pass<'a> {
    equations: &'a Equations,
    by: &'a [Vec<usize>],
    samples: &'a RateSamples,
    weights: &'a [f64],
    workspace: Workspace<LANES>,
    sums: &'a mut Sums,
}

impl Kernel for Pass<'_> {
    #[inline(always)]
    fn run(mut self) {
        let RateSamples { states, inputs, rates, .. } = self.samples;
        let (mut z, mut u) = (vec![[0.0; LANES]; states.len()], vec![[0.0; LANES]; inputs.len()]);
        let rows = rates[0].len();
        for first in (0..rows).step_by(LANES) {
            z.iter_mut().zip(states).for_each(|(lane, column)| take(lane, column, first));
            u.iter_mut().zip(inputs).for_each(|(lane, column)| take(lane, column, first));
            let slopes = self.equations.jacobian_here(&mut self.workspace, &z, &u);
            for (i, by) in self.by.iter().enumerate() {
                let mut measured = [f64::NAN; LANES];
                let there = LANES.min(rows - first);
                measured[..there].copy_from_slice(&rates[i][first..first + there]);
                let derivatives = &slopes[states.len() + i * self.sums.parameters..];
                add(self.sums, &slopes[i], &measured, self.weights[i], by, derivatives);
            }
        }
    }
}

/// A block of a column; the last value stands for those that are not there.
#[inline(always)]
fn take(lane: &mut Lane, column: &[f64], first: usize) {
    match column[first..].first_chunk() {
        Some(block) => *lane = *block,
        None => (0..LANES).for_each(|l| lane[l] = column[(first + l).min(column.len() - 1)]),
    }
}

/// Adds the residuals of a rate; where it is not measured nothing.
#[inline(always)]
fn add(sums: &mut Sums, rate: &Lane, measured: &Lane, weight: f64, by: &[usize], derivatives: &[Lane]) {
    let (mut r, mut w, mut size) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    for l in 0..LANES {
        let there = if measured[l].is_nan() { 0.0 } else { measured[l] };
        w[l] = if measured[l].is_nan() { 0.0 } else { weight };
        r[l] = (rate[l] - there) * w[l];
        size[l] = there * w[l];
    }
    add_product(&mut sums.lanes[0], &r, &r);
    add_product(&mut sums.lanes[1], &size, &size);
    for (n, a) in by.iter().enumerate() {
        let slope = product(&derivatives[*a], &w);
        add_product(&mut sums.lanes[2 + a], &slope, &r);
        for b in &by[..=n] {
            let place = sums.place(*a, *b);
            add_product(&mut sums.lanes[place], &slope, &product(&derivatives[*b], &w));
        }
    }
}

#[inline(always)]
fn product(a: &Lane, b: &Lane) -> Lane {
    let mut out = [0.0; LANES];
    for l in 0..LANES {
        out[l] = a[l] * b[l];
    }
    out
}

#[inline(always)]
fn add_product(sum: &mut Lane, a: &Lane, b: &Lane) {
    let mut total = *sum;
    for l in 0..LANES {
        total[l] += a[l] * b[l];
    }
    *sum = total;
}
