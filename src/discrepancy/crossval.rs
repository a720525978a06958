//! Windows left out in turn: how well a fitted model predicts what it was not fitted to.

use super::chain::{Variances, eliminate};
use super::fit::{FEWEST_RUNS, Fit};
use super::problem::Problem;
use super::variances::noise_determinant;
use super::windows::{Linear, linearise};
use crate::error::Result;
use nalgebra::DVector;

/// Parts that are left out in turn.
const FOLDS: usize = 5;
/// Deviances this close are the same.
const SAME: f64 = 2.0;
/// Windows that are left out together, at most: neighbours share a pose.
const BLOCK: usize = 10;

impl Problem {
    /// For every part of the data its deviance under the values that the others give.
    ///
    /// | symbol | meaning |
    /// |---|---|
    /// | part | a run where there are four or more, else every fifth block of windows; its poses are its own |
    /// | values | to first order about the fit, so that no part is fitted anew |
    ///
    /// Smaller is better; differences between models of the same data count. `None` where a part leaves a parameter open.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn left_out(&self, fit: &Fit) -> Result<Option<Vec<f64>>> {
        let equations = fit.model.free_equations()?;
        let Some(linear) = linearise(&equations, &fit.p, &self.records, &self.plan, &fit.starts) else {
            return Ok(None);
        };
        let blocks = self.blocks(linear);
        let folds = blocks.iter().map(|b| b.fold + 1).max().unwrap_or(0);
        let parts = (0..folds).map(|fold| of_fold(&blocks, fold, &fit.variances, fit.p.len()));
        Ok(parts.collect())
    }
}

impl Problem {
    /// Whether a model predicts the parts it was not fitted to better than another: all together, and most of those
    /// in which the two differ at all.
    ///
    /// # Errors
    /// As [`Problem::left_out`].
    pub fn predicts_better(&self, fit: &Fit, than: &Fit) -> Result<bool> {
        // Parameters that are open without a part of the data are no finding.
        let Some(new) = self.left_out(fit)? else { return Ok(false) };
        let Some(old) = self.left_out(than)? else { return Ok(true) };
        let gains: Vec<f64> = old.iter().zip(&new).map(|(old, new)| old - new).collect();
        let (better, worse): (Vec<&f64>, Vec<&f64>) = gains.iter().filter(|g| g.abs() > SAME).partition(|g| **g > 0.0);
        Ok(gains.iter().sum::<f64>() > 0.0 && better.len() > 2 * worse.len())
    }
}

/// Windows that stay together, and the part they belong to.
struct Block {
    fold: usize,
    windows: Vec<Linear>,
}

impl Problem {
    /// Whole runs where there are enough of them: what moves from run to run is no finding. Else runs of neighbouring
    /// windows, cut loose from one another.
    fn blocks(&self, linear: Vec<Vec<Linear>>) -> Vec<Block> {
        if self.records.len() >= FEWEST_RUNS {
            let whole = self.plan.iter().zip(linear);
            return whole.map(|(s, windows)| Block { fold: s.record, windows }).collect();
        }
        let windows: usize = linear.iter().map(Vec::len).sum();
        let size = (windows / (2 * FOLDS)).clamp(1, BLOCK);
        let loose = |block: &[Linear]| {
            let mut block = block.to_vec();
            if let Some(last) = block.last_mut() {
                last.back = None;
            }
            block
        };
        let pieces = linear.iter().flat_map(|windows| windows.chunks(size).map(loose));
        pieces.enumerate().map(|(i, windows)| Block { fold: i % FOLDS, windows }).collect()
    }
}

fn of_fold(blocks: &[Block], fold: usize, v: &Variances, parameters: usize) -> Option<f64> {
    let pick = |out: bool| -> Vec<Vec<Linear>> {
        let chosen = blocks.iter().filter(|b| (b.fold == fold) == out);
        chosen.map(|b| b.windows.clone()).collect()
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
