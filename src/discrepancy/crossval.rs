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

/// What is left out together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// A whole run: what moves from run to run is no finding.
    Run,
    /// Every fifth block of neighbouring windows.
    Blocks,
}

impl Problem {
    /// For every part of the data its deviance under the values that the others give.
    ///
    /// | symbol | meaning |
    /// |---|---|
    /// | part | a run, or every fifth block of windows; its poses are its own |
    /// | values | to first order about the fit, so that no part is fitted anew |
    ///
    /// Smaller is better; differences between models of the same data count. `None` where a part leaves a parameter open.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn left_out(&self, fit: &Fit, part: Part) -> Result<Option<Vec<f64>>> {
        let equations = fit.model.free_equations()?;
        let Some(linear) = linearise(&equations, &fit.p, &self.records, &self.plan, &fit.starts) else {
            return Ok(None);
        };
        let blocks = self.blocks(linear, part);
        let folds = blocks.iter().map(|b| b.fold + 1).max().unwrap_or(0);
        let parts = (0..folds).map(|fold| of_fold(&blocks, fold, &fit.variances, fit.p.len()));
        Ok(parts.collect())
    }
}

impl Problem {
    /// Whether a model predicts the parts it was not fitted to better than another: all together, and most of those
    /// in which the two differ at all.
    ///
    /// The parts are runs where there are four or more. Of fewer runs most cannot be asked for: there the parts are
    /// blocks of windows, and the runs must be predicted better all together.
    ///
    /// # Errors
    /// As [`Problem::left_out`].
    pub fn predicts_better(&self, fit: &Fit, than: &Fit) -> Result<bool> {
        let runs = self.records.len();
        let part = if runs >= FEWEST_RUNS { Part::Run } else { Part::Blocks };
        // Parameters that are open without a part of the data are no finding.
        let Some(gains) = self.gains(fit, than, part)? else { return Ok(false) };
        let (better, worse): (Vec<&f64>, Vec<&f64>) = gains.iter().filter(|g| g.abs() > SAME).partition(|g| **g > 0.0);
        if total(&gains) <= 0.0 || better.len() <= 2 * worse.len() {
            return Ok(false);
        }
        // A parameter that only one run shows cannot be asked of the others.
        let between = if (2..FEWEST_RUNS).contains(&runs) { self.gains(fit, than, Part::Run)? } else { None };
        Ok(between.is_none_or(|gains| total(&gains) > 0.0))
    }

    /// By how much each part is predicted better; `None` where a part leaves a parameter of the model open.
    fn gains(&self, fit: &Fit, than: &Fit, part: Part) -> Result<Option<Vec<f64>>> {
        let Some(new) = self.left_out(fit, part)? else { return Ok(None) };
        let Some(old) = self.left_out(than, part)? else { return Ok(Some(vec![f64::INFINITY; new.len()])) };
        Ok(Some(old.iter().zip(&new).map(|(old, new)| old - new).collect()))
    }
}

fn total(gains: &[f64]) -> f64 {
    gains.iter().sum()
}

/// Windows that stay together, and the part they belong to.
struct Block {
    fold: usize,
    windows: Vec<Linear>,
}

impl Problem {
    /// Whole runs, or neighbouring windows cut loose from one another.
    fn blocks(&self, linear: Vec<Vec<Linear>>, part: Part) -> Vec<Block> {
        if part == Part::Run {
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
