//! The descent of parameters and poses: Levenberg–Marquardt steps of the parameters, the poses following by elimination.

use super::bounds::Bounds;
use super::elimination::{ReducedForm, eliminate};
use super::priors::Priors;
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;
use crate::discrepancy::shooting::window_integration::linearise;
use crate::discrepancy::shooting::windows::{Segment, WindowStates};
use crate::model::{Equations, Fineness};
use crate::numerics::levenberg_marquardt::{Damping, LeastSquares, minimise};
use nalgebra::{DMatrix, DVector};

/// How a fit is carried out.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Linearisations at most.
    pub passes: usize,
    /// A step that promises to gain less deviance than this is not taken.
    pub enough: f64,
    /// Whether the variances are estimated anew.
    pub variances: bool,
    /// Whether it ends where a positive value has sunk to the edge at which its effect vanishes and wants further down.
    pub ends_where_lost: bool,
    /// How finely states that forget are followed.
    pub fineness: Fineness,
    /// Whether it begins so near to a fit that what its first step promises can be believed.
    pub begins_near: bool,
}

impl Effort {
    /// The effort of a fit whose values are reported: variances are estimated with the parameters.
    pub const FULL: Self = Self {
        passes: 15,
        enough: 1e-4,
        variances: true,
        ends_where_lost: false,
        fineness: Fineness::Full,
        begins_near: false,
    };
    /// The effort of a fit by which candidates are compared: at the variances of the fit they begin with.
    pub const SCREENING: Self =
        Self { passes: 5, enough: 0.05, variances: false, fineness: Fineness::Screening, ..Self::FULL };
    /// The same of a candidate that is lost where it vanishes: there states are stiff, and nothing is left to compare.
    pub const CANDIDATE: Self = Self { ends_where_lost: true, ..Self::SCREENING };
}

/// The windows of some runs, and what they are linearised by.
#[derive(Clone, Copy)]
pub(crate) struct Windows<'a> {
    /// The runs.
    pub records: &'a [Record],
    /// Their windows.
    pub plan: &'a [Segment],
    /// The motion.
    pub equations: &'a Equations,
    /// Noise and jumps.
    pub v: &'a NoiseModel,
    /// What is known of the parameters beside the data.
    pub priors: &'a Priors,
}

/// Windows linearised at parameters and at poses of their starts.
pub(crate) struct Point {
    /// The parameters.
    pub p: DVector<f64>,
    /// The poses.
    pub starts: WindowStates,
    /// Every window.
    pub linear: Vec<Vec<LinearisedWindow>>,
    /// What is left of them when the poses are eliminated.
    pub eliminated: ReducedForm,
}

impl Windows<'_> {
    /// The linearisation at parameters and poses; `None` where the motion is undefined.
    pub fn at(&self, p: DVector<f64>, starts: WindowStates) -> Option<Point> {
        let linear = linearise(self.equations, p.as_slice(), self.records, self.plan, &starts)?;
        let eliminated = self.eliminated(&linear, &p)?;
        Some(Point { p, starts, linear, eliminated })
    }

    /// What is left of windows when the poses are eliminated, with what was known before.
    pub fn eliminated(&self, linear: &[Vec<LinearisedWindow>], p: &DVector<f64>) -> Option<ReducedForm> {
        let mut found = eliminate(linear, self.v, p.len())?;
        self.priors.add_to(&mut found, &self.equations.free, p);
        Some(found)
    }
}

impl Point {
    /// The poses moved by a share of what belongs to a step of the parameters.
    pub fn moved(&self, delta: &DVector<f64>, share: f64) -> WindowStates {
        let by = self.eliminated.corrections(&self.linear, delta);
        let add = |(z, d): (&Vec<f64>, &DVector<f64>)| z.iter().zip(d.iter()).map(|(z, d)| z + share * d).collect();
        self.starts.iter().zip(&by).map(|(s, b)| s.iter().zip(b).map(add).collect()).collect()
    }
}

/// A rise of the deviance that counts for none.
const TOLERANCE: f64 = 1e-3;
/// Whoever gains less deviance is near the bottom of the valley, and what a step promises there can be believed.
const NEAR: f64 = 1e-2;

/// A fit on its way down.
pub(crate) struct Descent<'a> {
    /// What is fitted to.
    pub windows: Windows<'a>,
    /// What values the parameters may take.
    pub bounds: &'a Bounds,
    /// How far it goes.
    pub effort: Effort,
    /// Whether the promise of the first step can be believed: the model has been followed down to where it begins.
    pub is_near: bool,
}

impl Descent<'_> {
    /// What a point costs as it is.
    fn cost(&self, here: &Point) -> f64 {
        misfit(&here.linear, self.windows.v) + self.windows.priors.cost(&self.windows.equations.free, &here.p)
    }

    /// The point at which a descent ends.
    pub fn from(&self, here: Point) -> Point {
        minimise(self, here, &Damping::USUAL, self.effort.passes).here
    }
}

impl LeastSquares for Descent<'_> {
    type Point = Point;

    fn normal(&self, here: &Point) -> (DMatrix<f64>, DVector<f64>) {
        here.eliminated.normal()
    }

    fn next(&self, here: &Point, step: &DVector<f64>, share: f64) -> Option<Point> {
        let delta = self.bounds.step(&here.p, step);
        let starts = here.moved(&delta, share);
        self.windows.at(self.bounds.within(&here.p, &(delta * share)), starts)
    }

    /// A whole step gains what is promised once the poses have followed, a shortened one what is there.
    fn gain(&self, here: &Point, next: &Point, share: f64) -> f64 {
        match share < 1.0 {
            true => self.cost(here) - self.cost(next),
            false => here.eliminated.cost() - next.eliminated.cost(),
        }
    }

    fn tolerance(&self, _: &Point) -> f64 {
        TOLERANCE
    }

    fn is_small(&self, here: &Point, step: &DVector<f64>, last_gain: Option<f64>) -> bool {
        if self.effort.ends_where_lost && self.bounds.has_sunk(&here.p, step) {
            return true;
        }
        let is_near = last_gain.map_or(self.is_near, |gain| gain < self.effort.enough.max(NEAR));
        // What lies beyond a bound promises nothing.
        is_near && promised(&here.eliminated, &self.bounds.step(&here.p, step)) < self.effort.enough
    }
}

/// What the poses and values of a point cost as they are: squared residuals over the noise and squared jumps over
/// theirs. The cost that is left when the poses are eliminated is a promise of the linearisation, and where that is far
/// from the truth no step would be seen to lead down.
fn misfit(linear: &[Vec<LinearisedWindow>], v: &NoiseModel) -> f64 {
    let of_window = |w: &LinearisedWindow| {
        let noise: f64 =
            v.measurement().iter().enumerate().map(|(channel, noise)| w.square(channel) / noise.variance).sum();
        let jump = w.mismatch.iter().enumerate().map(|(c, m)| m * m / (v.jump(c) * w.duration));
        noise + jump.sum::<f64>()
    };
    linear.iter().flatten().map(of_window).sum()
}

/// What a step gains in deviance if the model is as linear as it looks.
fn promised(e: &ReducedForm, delta: &DVector<f64>) -> f64 {
    let (information, gradient) = e.normal();
    -(delta.dot(&(information * delta)) + 2.0 * gradient.dot(delta))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::noise_of;
    use crate::discrepancy::shooting::block_sums::Blocks;

    /// A window with two trailers, and others without a jump behind them.
    #[test]
    fn a_misfit_counts_noise_and_jumps_in_their_variances() {
        let window = |squares: [f64; 3], duration: f64, mismatch: &[f64]| LinearisedWindow {
            gram: squares.map(|square| DMatrix::from_element(1, 1, square)).to_vec(),
            count: vec![1; 3],
            blocks: vec![Blocks::default(); 3],
            back: None,
            axes: DMatrix::zeros(0, 0),
            duration,
            mismatch: mismatch.to_vec(),
            initial_state_dof: 0.0,
        };
        let v = noise_of(2, [2.0, 4.0, 8.0], &[1.0, 2.0, 4.0, 8.0]);
        let first = window([2.0, 8.0, 24.0], 0.5, &[1.0, 2.0, 4.0, 8.0, 16.0]);
        // 1 + 2 + 3, and 2 + 4 + 8 + 16 + 64.
        assert_eq!(misfit(&[vec![first.clone()]], &v), 6.0 + 94.0);
        let second = window([20.0, 0.0, 0.0], 3.0, &[]);
        assert_eq!(misfit(&[vec![first.clone(), second.clone()], vec![second]], &v), 100.0 + 20.0);
    }
}
