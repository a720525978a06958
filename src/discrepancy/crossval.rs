//! Windows left out in turn: how well a fitted model predicts what it was not fitted to.

use super::chain::{Variances, eliminate};
use super::fit::{FEWEST_RUNS, Fit};
use super::problem::Problem;
use super::variances::noise_determinant;
use super::windows::{Linear, linearise};
use crate::error::Result;
use nalgebra::{DMatrix, DVector};

/// Parts that are left out in turn.
const FOLDS: usize = 5;
/// Deviances this close are the same.
const SAME: f64 = 2.0;
/// Windows that are left out together, at most: neighbours share a pose.
const BLOCK: usize = 10;

/// What is left out together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    /// A whole run: what moves from run to run is no finding.
    Run,
    /// Every fifth block of neighbouring windows.
    Blocks,
}

impl Problem {
    /// Whether a model predicts the parts it was not fitted to better than another: all together, and most of those
    /// in which the two differ at all.
    ///
    /// The parts are runs where there are four or more. Of fewer runs most cannot be asked for: there the parts are
    /// blocks of windows, and the runs must be predicted better all together.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
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

    /// For every part of the data its deviance under the values that the others give, to first order about the fit, so
    /// that no part is fitted anew; its poses are its own. Smaller is better; differences between models of the same data
    /// count. `None` where a part leaves a parameter open.
    fn deviances(&self, fit: &Fit, linear: &Along, part: Part) -> Option<Vec<f64>> {
        let own = self.shares(fit, linear, part)?;
        let shares = own.iter().zip(others(&own, fit.p.len()));
        shares.map(|(own, others)| own.under(&others)).collect()
    }

    /// What each part of the data says of the values: whole runs, or neighbouring windows cut loose from one another.
    fn shares(&self, fit: &Fit, linear: &Along, part: Part) -> Option<Vec<Share>> {
        let blocks = if part == Part::Blocks { loose(linear) } else { vec![] };
        let folded: Vec<(usize, &Vec<Linear>)> = match part {
            Part::Run => self.plan.iter().map(|s| s.record).zip(linear).collect(),
            Part::Blocks => blocks.iter().enumerate().map(|(i, b)| (i % FOLDS, b)).collect(),
        };
        let folds = folded.iter().map(|(fold, _)| fold + 1).max().unwrap_or(0);
        let mut shares = vec![Share::nothing(fit.p.len()); folds];
        for (fold, windows) in folded {
            shares[fold].add(windows, &fit.variances, fit.p.len())?;
        }
        Some(shares)
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

/// What a part of the data says of the values, its poses eliminated: twice the negative log likelihood.
#[derive(Clone)]
struct Share {
    /// The quadratic form in (δp, 1).
    form: DMatrix<f64>,
    /// What does not depend on the values.
    constant: f64,
}

impl Share {
    fn nothing(parameters: usize) -> Self {
        Self { form: DMatrix::zeros(parameters + 1, parameters + 1), constant: 0.0 }
    }

    fn add(&mut self, windows: &Vec<Linear>, v: &Variances, parameters: usize) -> Option<()> {
        let windows = std::slice::from_ref(windows);
        let eliminated = eliminate(windows, v, parameters)?;
        self.form += eliminated.form;
        self.constant += eliminated.log_determinant + noise_determinant(windows, v);
        Some(())
    }

    /// The part's deviance where another part's form is least; `None` where that leaves a value open.
    fn under(&self, others: &DMatrix<f64>) -> Option<f64> {
        let p = others.nrows() - 1;
        let delta = match p {
            0 => DVector::zeros(0),
            _ => -others.view((0, 0), (p, p)).into_owned().cholesky()?.solve(&others.view((0, p), (p, 1)).column(0)),
        };
        let one = delta.push(1.0);
        Some(one.dot(&(&self.form * &one)) + self.constant)
    }
}

/// For each part the form of all others: sums from both ends, so that the cost is linear in the parts and nothing
/// cancels.
fn others(own: &[Share], parameters: usize) -> Vec<DMatrix<f64>> {
    let nothing = DMatrix::zeros(parameters + 1, parameters + 1);
    let mut after = vec![nothing.clone()];
    for share in own.iter().skip(1).rev() {
        after.push(&after[after.len() - 1] + &share.form);
    }
    let mut before = nothing;
    let both = own.iter().zip(after.into_iter().rev()).map(|(share, after)| {
        let sum = &before + after;
        before += &share.form;
        sum
    });
    both.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (a − x)² + (b − y)² + c, times a weight.
    fn share(a: f64, b: f64, c: f64, weight: f64) -> Share {
        let form = DMatrix::from_row_slice(3, 3, &[1.0, 0.0, -a, 0.0, 1.0, -b, -a, -b, a * a + b * b + c]) * weight;
        Share { form, constant: 0.5 }
    }

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-12
    }

    #[test]
    fn each_part_is_judged_where_the_others_are_at_their_best() {
        let parts = [share(1.0, 0.0, 0.0, 1.0), share(3.0, 2.0, 0.0, 1.0), share(6.0, -4.0, 7.0, 2.0)];
        let judged: Vec<f64> = parts.iter().zip(others(&parts, 2)).map(|(p, o)| p.under(&o).expect("told")).collect();
        // The others' means, weighted: (5, -2), (13/3, -8/3), (2, 1).
        assert!(close(judged[0], 16.0 + 4.0 + 0.5), "{judged:?}");
        assert!(close(judged[1], (4.0_f64 / 3.0).powi(2) + (14.0_f64 / 3.0).powi(2) + 0.5), "{judged:?}");
        assert!(close(judged[2], 2.0 * (16.0 + 25.0 + 7.0) + 0.5), "{judged:?}");
    }

    #[test]
    fn one_part_alone_leaves_the_values_open() {
        let alone = [share(1.0, 2.0, 0.0, 1.0)];
        assert_eq!(others(&alone, 2).iter().filter_map(|o| alone[0].under(o)).count(), 0);
        assert!(others(&[], 2).is_empty());
    }

    #[test]
    fn without_values_a_part_is_judged_as_it_is() {
        let part = Share { form: DMatrix::from_element(1, 1, 4.0), constant: -1.0 };
        assert_eq!(part.under(&DMatrix::zeros(1, 1)), Some(3.0));
    }
}
