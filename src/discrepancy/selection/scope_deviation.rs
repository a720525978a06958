//! What values are uncertain by because the numbers of a scope are: profile likelihood of its ends, its bound or its disk
//! (Venzon and Moolgavkar, 1988).

use super::search::Search;
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::record::angle::wrapped;
use crate::effects::Applied;
use crate::error::Result;
use crate::model::Fineness;
use nalgebra::DVector;

/// The effort of a fit beside the best scope.
const PROFILE: Effort = Effort { passes: 8, enough: 1e-3, fineness: Fineness::Full, ..Effort::SCREENING };
/// The step by which a number is moved first, as a share of its own step.
const FIRST_WIDTH: f64 = 0.1;
/// A rise of the deviance that tells its bend, and how many widths are tried.
const RISE: [f64; 2] = [0.3, 9.0];
const WIDTHS: usize = 5;

impl Search<'_> {
    /// Adds to the covariance of a fit what its values move by with the numbers of its scopes, each within its own deviation:
    /// Σ (∂p/∂t)·(∂p/∂t)ᵀ·var(t), with var(t) = 2/D″ of the profile of the deviance D over the number t.
    pub(super) fn let_scopes_vary(&self, fit: &mut Fit) -> Result<()> {
        let scoped: Vec<Applied> = fit.model.free_effects().filter(|e| e.effect.scope.is_some()).cloned().collect();
        if fit.scopes_vary || fit.covariance.is_none() || scoped.is_empty() {
            return Ok(());
        }
        let Some(settled) = self.problem.fit(&fit.model, &fit.window_states, &fit.variances, PROFILE)? else {
            return Ok(());
        };
        for of in &scoped {
            let numbers = of.effect.scope.as_ref().map_or(0, |s| s.movable().len());
            for k in 0..numbers {
                let Some(by) = self.deviation_with(&settled, of, k)? else { continue };
                if let Some(covariance) = &mut fit.covariance {
                    *covariance += &by * by.transpose();
                }
            }
        }
        fit.scopes_vary = true;
        Ok(())
    }

    /// What the values move by with one number of a scope, where that moves by its own deviation.
    fn deviation_with(&self, fit: &Fit, of: &Applied, k: usize) -> Result<Option<DVector<f64>>> {
        let mut width = FIRST_WIDTH;
        for _ in 0..WIDTHS {
            let beside = |by: f64| self.varied(fit, of, k, by, PROFILE);
            let (Some(less), Some(more)) = (beside(-width)?, beside(width)?) else { return Ok(None) };
            let rise = 0.5 * (less.deviance + more.deviance) - fit.deviance;
            if rise < RISE[0] {
                width *= 3.0;
            } else if rise > RISE[1] {
                width /= 3.0;
            } else {
                let periodic = fit.model.free_effects().flat_map(|e| e.effect.parameters.values()).map(|p| p.periodic);
                let moved = periodic
                    .zip(more.p.iter().zip(&less.p))
                    .map(|(periodic, (a, b))| 0.5 * if periodic { wrapped(a - b) } else { a - b });
                return Ok(Some(DVector::from_iterator(fit.p.len(), moved) / rise.sqrt()));
            }
        }
        Ok(None)
    }
}
