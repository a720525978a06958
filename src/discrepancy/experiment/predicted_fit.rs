//! A model fitted to a manoeuvre that is driven by another, beside what the runs at hand say of it.

use crate::discrepancy::estimation::descent::{Point, Windows};
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::shooting::windows::WindowStates;
use crate::model::Model;
use crate::numerics::levenberg_marquardt::{Damping, LeastSquares, Minimum, minimise};
use nalgebra::{DMatrix, DVector};

/// Steps of the fit to a manoeuvre that are evaluated; one more is foreseen.
const MOST_STEPS: usize = 2;
/// The share of the largest information that every direction has.
const WEAK: f64 = 1e-12;

/// A model, and what the runs at hand say of its free parameters.
pub(super) struct PriorInformation {
    pub model: Model,
    pub p: DVector<f64>,
    pub information: DMatrix<f64>,
}

impl PriorInformation {
    pub fn of(fit: &Fit) -> Self {
        let p = DVector::from_column_slice(&fit.p);
        Self { model: fit.model.clone(), p, information: fit.information.clone() }
    }

    /// A step that keeps a positive value positive: it is at most divided or multiplied by five.
    fn held(&self, p: &DVector<f64>, step: &DVector<f64>) -> DVector<f64> {
        let positive: Vec<bool> =
            self.model.free_effects().flat_map(|e| e.effect.parameters.values()).map(|p| p.positive).collect();
        DVector::from_fn(p.len(), |i, _| match positive[i] {
            true => (p[i] + step[i]).max(p[i] / 5.0).min(p[i] * 5.0) - p[i],
            false => step[i],
        })
    }

    /// The BIC's charge for its parameters.
    pub fn charge(&self, sample_size: f64) -> f64 {
        self.p.len() as f64 * sample_size.ln()
    }
}

/// A model fitted to a manoeuvre and to what is known of its parameters.
pub(super) struct PredictedFit<'a> {
    pub windows: Windows<'a>,
    pub other: &'a PriorInformation,
}

impl PredictedFit<'_> {
    /// How far parameters are away from what is known of them, and the gradient of that.
    fn away(&self, here: &Point) -> [DVector<f64>; 2] {
        let away = &here.p - &self.other.p;
        let held = &self.other.information * &away;
        [away, held]
    }

    /// What is left of the misfit from some poses on; `None` where the model is undefined along the manoeuvre.
    pub fn left(&self, starts: WindowStates) -> Option<f64> {
        let first = self.windows.at(self.other.p.clone(), starts)?;
        let Minimum { here, step, .. } = minimise(self, first, &Damping::NONE, MOST_STEPS);
        let [away, held] = self.away(&here);
        // After the last step, were the model as linear as it looks.
        Some(here.eliminated.cost() + away.dot(&held) + self.normal(&here).1.dot(&step?))
    }
}

impl LeastSquares for PredictedFit<'_> {
    type Point = Point;

    /// A direction of which nothing is known is held weakly.
    fn normal(&self, here: &Point) -> (DMatrix<f64>, DVector<f64>) {
        let (information, gradient) = here.eliminated.normal();
        let information = information + &self.other.information;
        let (k, scale) = (here.p.len(), information.diagonal().iter().copied().fold(0.0, f64::max));
        (information + DMatrix::identity(k, k) * (WEAK * scale), gradient + &self.away(here)[1])
    }

    fn next(&self, here: &Point, step: &DVector<f64>, share: f64) -> Option<Point> {
        let delta = self.other.held(&here.p, step);
        self.windows.at(&here.p + &delta, here.moved(&delta, share))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{KNOWN, fit_of, unicycle};

    /// A value with a sign goes to a fifth or to five times itself at most, another as far as the step leads.
    #[test]
    fn a_positive_value_stays_positive() {
        let known = PriorInformation::of(&fit_of(unicycle(&KNOWN)));
        assert_eq!(known.p.as_slice(), [0.3, 0.1, 0.8, -0.05]);
        for (step, goes) in [
            (0.05, [0.05, 0.05, 0.05, 0.05]),
            (-0.05, [-0.05, -0.05, -0.05, -0.05]),
            (2.0, [1.2, 2.0, 2.0, 2.0]),
            (10.0, [1.2, 10.0, 3.2, 10.0]),
            (-0.5, [-0.24, -0.5, -0.5, -0.5]),
            (-10.0, [-0.24, -10.0, -0.64, -10.0]),
        ] {
            let held = known.held(&known.p, &DVector::from_element(4, step));
            held.iter().zip(goes).for_each(|(a, b)| assert!((a - b).abs() < 1e-12, "{step}: {held}"));
        }
    }
}
