//! Windows left out in turn: how well a fitted model predicts what it was not fitted to.

use super::chain::{Variances, eliminate};
use super::fit::{Fit, Problem};
use super::variances::noise_determinant;
use super::windows::{Linear, linearise};
use crate::error::Result;
use nalgebra::DVector;

/// Parts that are left out in turn.
const FOLDS: usize = 5;
/// Windows that are left out together, at most: neighbours share a pose.
const BLOCK: usize = 10;

impl Problem {
    /// Σ over parts of the data of the deviance of a part under the values that the others give.
    ///
    /// | symbol | meaning |
    /// |---|---|
    /// | part | every fifth block of windows; its poses are its own |
    /// | values | to first order about the fit, so that no part is fitted anew |
    ///
    /// Smaller is better; differences between models of the same data count. `None` where the model is undefined.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn left_out(&self, fit: &Fit) -> Result<Option<f64>> {
        let free: Vec<_> = fit.model.effects.iter().filter(|e| e.free).flat_map(|e| e.parameters()).collect();
        let equations = fit.model.equations(&free)?;
        let Some(linear) = linearise(&equations, &fit.p, &self.records, &self.plan, &fit.starts) else {
            return Ok(None);
        };
        let blocks = blocks(&linear);
        let parts = (0..FOLDS.min(blocks.len())).map(|fold| of_fold(&blocks, fold, &fit.variances, free.len()));
        Ok(parts.sum())
    }
}

/// Runs of neighbouring windows, cut loose from one another.
fn blocks(linear: &[Vec<Linear>]) -> Vec<Vec<Linear>> {
    let windows: usize = linear.iter().map(Vec::len).sum();
    let size = (windows / (2 * FOLDS)).clamp(1, BLOCK);
    let loose = |block: &[Linear]| {
        let mut block = block.to_vec();
        if let Some(last) = block.last_mut() {
            last.back = None;
        }
        block
    };
    linear.iter().flat_map(|windows| windows.chunks(size).map(loose)).collect()
}

fn of_fold(blocks: &[Vec<Linear>], fold: usize, v: &Variances, parameters: usize) -> Option<f64> {
    let pick = |out: bool| -> Vec<Vec<Linear>> {
        let chosen = blocks.iter().enumerate().filter(|(i, _)| (i % FOLDS == fold) == out);
        chosen.map(|(_, b)| b.clone()).collect()
    };
    let (fitted, judged) = (eliminate(&pick(false), v, parameters)?, pick(true));
    let (information, gradient) = fitted.normal();
    let delta = match parameters {
        0 => DVector::zeros(0),
        _ => -information.cholesky()?.solve(&gradient),
    };
    let left_out = eliminate(&judged, v, parameters)?;
    let one = delta.push(1.0);
    let cost = one.dot(&(&left_out.form * &one));
    Some(cost + left_out.log_determinant + noise_determinant(&judged, v))
}
