//! Effects fitted to samples of the motion: rates that are measured at given states and inputs.

use super::bounds::Bounds;
use super::fit::inverse;
use super::rate_sums::Sums;
use crate::error::{Error, Result};
use crate::model::{Equations, Model};
use crate::numerics::levenberg_marquardt::{Damping, LeastSquares, minimise};
use nalgebra::{DMatrix, DVector};

pub use super::rate_sums::RateSamples;

/// Whole steps at first, and again soon after a damped one; more damping than the most leaves no step to speak of.
const DAMPING: Damping =
    Damping { first: 0.0, divisor: 10.0, least: 0.0, factor: 30.0, raised: 1e-4, most: 1e12, remembers: false };
const MOST_STEPS: usize = 1000;
/// Sums of squares that differ by less than this share differ by rounding.
const FLAT: f64 = 1e-12;

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
        let sums = Sums::over(&self.fit.equations, &self.fit.by, self.samples, &self.weights, &p);
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
