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
        Ok(self.linear(fit)?.and_then(|linear| self.deviances(fit, &linear, part)))
    }

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
        let [new, old] = [self.linear(fit)?, self.linear(than)?];
        let of = |fit: &Fit, linear: &Option<Along>, part: Part| self.deviances(fit, linear.as_ref()?, part);
        // By how much each part is predicted better; `None` where a part leaves a parameter of the model open.
        let gains = |part: Part| -> Option<Vec<f64>> {
            let new = of(fit, &new, part)?;
            let old = of(than, &old, part).unwrap_or_else(|| vec![f64::INFINITY; new.len()]);
            Some(old.iter().zip(&new).map(|(old, new)| old - new).collect())
        };
        // Parameters that are open without a part of the data are no finding.
        let Some(gained) = gains(part) else { return Ok(false) };
        let (better, worse): (Vec<&f64>, Vec<&f64>) = gained.iter().filter(|g| g.abs() > SAME).partition(|g| **g > 0.0);
        if total(&gained) <= 0.0 || better.len() <= 2 * worse.len() {
            return Ok(false);
        }
        // A parameter that only one run shows cannot be asked of the others.
        let between = if (2..FEWEST_RUNS).contains(&runs) { gains(Part::Run) } else { None };
        Ok(between.is_none_or(|gained| total(&gained) > 0.0))
    }

    /// A fit's model along all windows, where it is defined.
    fn linear(&self, fit: &Fit) -> Result<Option<Along>> {
        let equations = fit.model.free_equations()?;
        Ok(linearise(&equations, &fit.p, &self.records, &self.plan, &fit.starts))
    }

    fn deviances(&self, fit: &Fit, linear: &Along, part: Part) -> Option<Vec<f64>> {
        let blocks = self.blocks(linear, part);
        let folds = blocks.iter().map(|b| b.fold + 1).max().unwrap_or(0);
        (0..folds).map(|fold| of_fold(&blocks, fold, &fit.variances, fit.p.len())).collect()
    }

    /// Whole runs, or neighbouring windows cut loose from one another.
    fn blocks(&self, linear: &Along, part: Part) -> Vec<Block> {
        if part == Part::Run {
            let whole = self.plan.iter().zip(linear);
            return whole.map(|(s, windows)| Block { fold: s.record, windows: windows.clone() }).collect();
        }
        loose(linear).into_iter().enumerate().map(|(i, windows)| Block { fold: i % FOLDS, windows }).collect()
    }
}

/// Windows, segment by segment.
pub(super) type Along = Vec<Vec<Linear>>;

/// Blocks of neighbouring windows, cut loose from one another.
pub(super) fn loose(linear: &Along) -> Along {
    let windows: usize = linear.iter().map(Vec::len).sum();
    let size = (windows / (2 * FOLDS)).clamp(1, BLOCK);
    let cut = |block: &[Linear]| {
        let mut block = block.to_vec();
        if let Some(last) = block.last_mut() {
            last.back = None;
        }
        block
    };
    linear.iter().flat_map(|windows| windows.chunks(size).map(cut)).collect()
}

fn total(gains: &[f64]) -> f64 {
    gains.iter().sum()
}

/// Windows that stay together, and the part they belong to.
struct Block {
    fold: usize,
    windows: Vec<Linear>,
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
