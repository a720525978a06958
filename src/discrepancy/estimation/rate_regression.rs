//! Effects fitted to samples of the motion: rates that are measured at given states and inputs.

use super::bounds::Bounds;
use super::fit::inverse;
use crate::error::{Error, Result};
use crate::formula::{Isa, Kernel};
use crate::model::{Equations, Model, Workspace};
use crate::numerics::levenberg_marquardt::{Damping, LeastSquares, minimise};
use nalgebra::{DMatrix, DVector};

/// Samples that are looked at side by side: four vectors of AVX-512.
const LANES: usize = 32;
type Lane = [f64; LANES];

/// A change of all residuals together by less than this share of the rates is rounding.
const SETTLED: f64 = 1e-12;
/// Whole steps at first, and again soon after a damped one; more damping than the most leaves no step to speak of.
const DAMPING: Damping =
    Damping { first: 0.0, divisor: 10.0, least: 0.0, factor: 30.0, raised: 1e-4, most: 1e12, remembers: false };
const MOST_STEPS: usize = 1000;
/// Sums of squares that differ by less than this share differ by rounding.
const FLAT: f64 = 1e-12;

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

/// A model whose free effects can be fitted to rates, compiled once.
///
/// | symbol | meaning |
/// |---|---|
/// | p | values of the free effects |
/// | r | (f(z, u, p) − z′)/deviation, sample by sample and rate by rate |
/// | J | ∂r/∂p, exact, from the model's formulas |
///
/// Minimises Σr² by steps of Gauss and Newton, damped where one would lead uphill (Marquardt), until a step changes the
/// residuals by rounding alone: ‖J·δ‖ ≤ 1e-12·‖z′/deviation‖. Values stay in the range of their effect.
///
/// Validity: states and inputs are known much better than the rates. Where they are logged and the rates are not,
/// fit trajectories instead ([`Problem::fit`](super::problem::Problem::fit)).
///
/// Source: equations (22)–(25) for f; J. Nocedal, S. J. Wright, *Numerical Optimization*, 10.3.
///
/// ```
/// use creepage::discrepancy::estimation::rate_regression::{RateFit, RateSamples};
/// use creepage::effects::{self, Applied};
/// use creepage::model::Model;
/// let creep = Applied::new(effects::named("rotation-creep").unwrap(), None, vec![0.0]).freed();
/// let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().with_effect(creep);
/// // Driven straight ahead at 2 rad/s it goes 0.9 m/s, not 1 m/s.
/// let samples = RateSamples {
///     states: vec![vec![0.0; 3]; 3],
///     inputs: vec![vec![2.0; 3], vec![0.0; 3]],
///     rates: vec![vec![0.89, 0.9, 0.91], vec![0.0; 3], vec![0.0; 3]],
///     deviations: vec![0.01; 3],
/// };
/// let found = RateFit::of(&model).unwrap().to(&samples).unwrap();
/// assert!((found.p[0] - 0.1).abs() < 1e-12);
/// ```
pub struct RateFit {
    equations: Equations,
    start: Vec<f64>,
    bounds: Bounds,
    /// The parameters that each rate depends on.
    by: Vec<Vec<usize>>,
}

/// Fitted values.
#[derive(Clone, Debug, PartialEq)]
pub struct RatesFitted {
    /// Effect by effect, as [`Model::free_parameters`] names them.
    pub p: Vec<f64>,
    /// (JᵀJ)⁻¹, the covariance of p where the deviations are right; `None` when the samples leave a direction open.
    pub covariance: Option<DMatrix<f64>>,
    /// Σr² at p.
    pub squares: f64,
    /// Evaluations of all samples.
    pub evaluations: usize,
}

impl RateFit {
    /// Compiles rates and exact derivatives of a model's free effects; the fit begins at their values.
    ///
    /// # Errors
    /// When no effect is free, or the formulas do not determine the motion.
    pub fn of(model: &Model) -> Result<Self> {
        let free = model.free_parameters();
        if free.is_empty() {
            return Err(Error::input("no effect of the model is free").help("leave one free to be fitted"));
        }
        let equations = model.equations_by(&free)?;
        let by = equations.live_by_rate();
        Ok(Self { equations, start: model.free_values(), bounds: Bounds::of(model), by })
    }

    /// Fits the values to samples.
    ///
    /// # Errors
    /// When columns do not fit the model or each other, a state, an input or a deviation is not a number, or the rates are
    /// undefined at the first values.
    pub fn to(&self, samples: &RateSamples) -> Result<RatesFitted> {
        let descent = RateDescent { fit: self, samples, weights: self.weights(samples)? };
        let first = descent.at(DVector::from_column_slice(&self.start));
        if !first.1.is_defined() {
            return Err(Error::run("the rates are undefined at the first values of the effects"));
        }
        let found = minimise(&descent, first, &DAMPING, MOST_STEPS);
        let (p, sums) = found.here;
        let p = found.step.filter(|_| found.is_settled).map_or(p.clone(), |step| self.bounds.within(&p, &step));
        let (covariance, evaluations) = (inverse(&sums.information()), 1 + found.evaluations);
        Ok(RatesFitted { p: p.as_slice().to_vec(), covariance, squares: sums.squares, evaluations })
    }

    /// One over the deviations.
    fn weights(&self, samples: &RateSamples) -> Result<Vec<f64>> {
        let rows = samples.rates.first().map_or(0, Vec::len);
        let (n, m) = (self.equations.n(), self.equations.inputs.len());
        let RateSamples { states, inputs, rates, deviations } = samples;
        let sizes = [states.len(), inputs.len(), rates.len(), deviations.len()] == [n, m, n, n];
        if !sizes || rows == 0 || states.iter().chain(inputs).chain(rates).any(|column| column.len() != rows) {
            let message = format!("samples need {n} states, {m} inputs and {n} rates with a value in every row");
            return Err(Error::input(message));
        }
        let known = states.iter().chain(inputs).flatten().all(|v| v.is_finite());
        if !known || rates.iter().flatten().any(|v| v.is_infinite()) || !deviations.iter().all(|d| *d > 0.0) {
            return Err(Error::input("samples need finite states and inputs, and deviations above zero"));
        }
        Ok(deviations.iter().map(|d| d.recip()).collect())
    }
}

/// A fit to samples on its way down.
struct RateDescent<'a> {
    fit: &'a RateFit,
    samples: &'a RateSamples,
    weights: Vec<f64>,
}

impl RateDescent<'_> {
    fn at(&self, p: DVector<f64>) -> (DVector<f64>, Sums) {
        let mut sums = Sums::new(p.len());
        let workspace = self.fit.equations.side_by_side([p.as_slice(); LANES]);
        let Self { fit, samples, weights } = self;
        Isa::best().dispatch(Pass { fit, samples, weights, workspace, sums: &mut sums });
        sums.total();
        (p, sums)
    }
}

impl LeastSquares for RateDescent<'_> {
    type Point = (DVector<f64>, Sums);

    fn normal(&self, (_, sums): &Self::Point) -> (DMatrix<f64>, DVector<f64>) {
        (sums.information(), sums.gradient())
    }

    fn next(&self, (p, _): &Self::Point, step: &DVector<f64>, _: f64) -> Option<Self::Point> {
        Some(self.at(self.fit.bounds.within(p, step)))
    }

    fn gain(&self, (_, here): &Self::Point, (_, next): &Self::Point, _: f64) -> f64 {
        here.squares - next.squares
    }

    fn tolerance(&self, (_, here): &Self::Point) -> f64 {
        here.squares * FLAT
    }

    fn is_small(&self, (p, sums): &Self::Point, step: &DVector<f64>, _: Option<f64>) -> bool {
        sums.is_rounding(&(self.fit.bounds.within(p, step) - p))
    }
}

/// Sums over samples, lane by lane.
struct Sums {
    lanes: Vec<Lane>,
    parameters: usize,
    squares: f64,
    /// Σ(z′/deviation)²
    measured: f64,
    totals: Vec<f64>,
}

impl Sums {
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

    fn is_defined(&self) -> bool {
        self.totals.iter().all(|v| v.is_finite())
    }

    fn gradient(&self) -> DVector<f64> {
        DVector::from_column_slice(&self.totals[2..2 + self.parameters])
    }

    fn information(&self) -> DMatrix<f64> {
        let n = self.parameters;
        DMatrix::from_fn(n, n, |i, j| self.totals[self.place(i.max(j), i.min(j))])
    }

    /// Whether a step changes the residuals by rounding alone.
    fn is_rounding(&self, step: &DVector<f64>) -> bool {
        step.dot(&(self.information() * step)) <= SETTLED * SETTLED * self.measured
    }
}

/// Rates and derivatives at all samples, summed.
struct Pass<'a> {
    fit: &'a RateFit,
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
            let slopes = self.fit.equations.jacobian_here(&mut self.workspace, &z, &u);
            for (i, by) in self.fit.by.iter().enumerate() {
                let mut measured = [f64::NAN; LANES];
                let there = LANES.min(rows - first);
                measured[..there].copy_from_slice(&rates[i][first..first + there]);
                let derivatives = &slopes[states.len() + i * self.fit.start.len()..];
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
