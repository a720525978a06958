//! Curvature that JᵀJ lacks along the way gone, told by the secant of the gradient: the structured secant method of Dennis, Gay
//! and Welsch (NL2SOL, ACM TOMS 7, 1981), of rank one.

use nalgebra::{DMatrix, DVector};

/// Below so much curvature, in units of JᵀJ, whole steps of Gauss and Newton halve the distance at least.
const ENOUGH: f64 = 1.5;
/// More than this is no curvature: the gradient has changed by something else.
const MOST: f64 = 4.0;
/// Two directions with this cosine squared, in the metric of JᵀJ, are one.
const ALIKE: f64 = 0.5;

/// A direction s, and κ there: along it the Hessian of half the sum of squares is κ·sᵀJᵀJs.
///
/// Where residuals are bent, as along the ridge of two effects that nearly cancel, JᵀJ is too small by Σ r·∇²r, and steps go
/// beyond the bottom by nearly as much as they were off, time and again.
#[derive(Debug, Default)]
pub(super) struct SecantCurvature {
    along: Option<(DVector<f64>, f64)>,
    /// The last step, and the gradient where it began; until the gradient at its end has been looked at.
    step: Option<(DVector<f64>, DVector<f64>)>,
}

impl SecantCurvature {
    /// A whole step was taken from a point with this gradient.
    pub fn step_taken(&mut self, step: DVector<f64>, gradient: DVector<f64>) {
        self.step = Some((step, gradient));
    }

    /// The Hessian H + (κ − 1)·(Hs)(Hs)ᵀ/(sᵀHs) with H = JᵀJ, at the point where the last step has led to.
    ///
    /// | symbol | meaning |
    /// |---|---|
    /// | s | the step along which the gradient was seen to change by more than H·s |
    /// | κ | sᵀ(g − g₀)/(sᵀHs), g₀ and g the gradients before and behind it |
    pub fn corrected(&mut self, information: DMatrix<f64>, gradient: &DVector<f64>) -> DMatrix<f64> {
        if let Some((step, before)) = self.step.take() {
            let kappa = step.dot(&(gradient - before)) / step.dot(&(&information * &step));
            if kappa > ENOUGH {
                self.along = Some((step, kappa.min(MOST)));
            } else if self.along.as_ref().is_some_and(|(s, _)| are_alike(s, &step, &information)) {
                self.along = None;
            }
        }
        let Some((s, kappa)) = &self.along else { return information };
        let turned = &information * s;
        let own = s.dot(&turned);
        if own > 0.0 { &information + (kappa - 1.0) / own * &turned * turned.transpose() } else { information }
    }
}

/// Whether two directions are as good as one.
fn are_alike(a: &DVector<f64>, b: &DVector<f64>, metric: &DMatrix<f64>) -> bool {
    let turned = metric * b;
    a.dot(&turned).powi(2) > ALIKE * a.dot(&(metric * a)) * b.dot(&turned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    /// Along (1, −1) the gradient changes by 1.9 times what JᵀJ says, across it by as much as it says.
    #[test]
    fn curvature_is_told_along_the_step_alone() {
        let information = || dmatrix![101.0, 99.0; 99.0, 101.0];
        let ridge = dvector![0.5, -0.5];
        let mut told = SecantCurvature::default();
        assert_eq!(told.corrected(information(), &dvector![1.0, 2.0]), information());
        told.step_taken(ridge.clone(), dvector![0.0, 0.0]);
        let corrected = told.corrected(information(), &(1.9 * information() * &ridge));
        let times = |v: DVector<f64>, kappa: f64| (&corrected * &v - kappa * information() * &v).amax() < 1e-12;
        assert!(times(ridge.clone(), 1.9) && times(dvector![1.0, 1.0], 1.0));
        // A step across it says nothing of it, one along it that finds less takes it back.
        told.step_taken(dvector![1.0, 1.0], dvector![0.0, 0.0]);
        assert_eq!(told.corrected(information(), &(information() * dvector![1.0, 1.0])), corrected);
        told.step_taken(ridge.clone(), dvector![0.0, 0.0]);
        assert_eq!(told.corrected(information(), &(1.1 * information() * &ridge)), information());
    }

    /// What would be a wall stays a slope, and a gradient that is undefined is none.
    #[test]
    fn curvature_is_bounded() {
        let one = |change: f64| {
            let mut told = SecantCurvature::default();
            told.step_taken(dvector![1.0], dvector![0.0]);
            told.corrected(dmatrix![2.0], &dvector![change])[(0, 0)]
        };
        assert_eq!([one(2.0 * 1e6), one(2.0), one(-2.0), one(f64::NAN)], [2.0 * MOST, 2.0, 2.0, 2.0]);
    }
}
