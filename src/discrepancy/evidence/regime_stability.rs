//! The test of Chow (1960): whether an effect has the same value in two regimes of driving.
//!
//! What is there has one value. What imitates something else, a saturation, a dead band, a law of the load, takes
//! another value wherever the imitated thing is larger. The windows of one regime get a value of their own, beside the
//! common one, and the difference is judged by its deviation.

use crate::discrepancy::estimation::elimination::eliminate;
use crate::discrepancy::estimation::fit::{Fit, inverse};
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::evidence::cross_validation::Along;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;
use crate::discrepancy::shooting::window_integration::linearise;
use crate::effects::Applied;
use crate::error::Result;
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// Windows that either regime needs at least.
const FEWEST: usize = 8;

/// Two regimes: which windows belong to the second, segment by segment.
pub(crate) struct Split {
    pub name: String,
    pub inside: Vec<Vec<bool>>,
}

/// The difference of an effect's values between two regimes.
pub(crate) struct Difference {
    pub name: String,
    /// χ² of the difference by the noise, as far as rows and windows are independent.
    pub chi_squared: f64,
    /// Its largest share of the value.
    pub share: f64,
    pub values: [Vec<f64>; 2],
}

impl Problem {
    /// The differences of an effect of a fit between regimes.
    pub(crate) fn differences(&self, fit: &Fit) -> Result<Vec<(Applied, Vec<Difference>)>> {
        let equations = fit.model.free_equations()?;
        let Some(linear) = linearise(&equations, &fit.p, &self.records, &self.plan, &fit.window_states) else {
            return Ok(vec![]);
        };
        let splits = self.splits();
        let mut at = 0;
        let mut found = vec![];
        for effect in fit.model.free_effects() {
            let own = at..at + effect.values.len();
            at = own.end;
            let each = splits.iter().filter_map(|s| difference(fit, &linear, s, own.clone()));
            found.push((effect.clone(), each.collect()));
        }
        Ok(found)
    }

    fn splits(&self) -> Vec<Split> {
        let channels = self.records.first().map_or(0, |r| r.signals.channels());
        let mean: Vec<Vec<Vec<f64>>> = self
            .plan
            .iter()
            .map(|s| s.windows.iter().map(|w| means(&self.records[s.record], w)).collect())
            .collect();
        let mut found = vec![];
        let mut add = |name: String, of: &dyn Fn(usize, usize) -> bool| {
            let inside: Vec<Vec<bool>> =
                mean.iter().enumerate().map(|(s, w)| (0..w.len()).map(|k| of(s, k)).collect()).collect();
            let all = inside.iter().flatten().count();
            let some = inside.iter().flatten().filter(|i| **i).count();
            if some >= FEWEST && all - some >= FEWEST {
                found.push(Split { name, inside });
            }
        };
        for c in 0..channels {
            let mut sizes: Vec<f64> = mean.iter().flatten().map(|m| m[c].abs()).collect();
            sizes.sort_by(f64::total_cmp);
            let median = sizes[sizes.len() / 2];
            add(format!("large {c}"), &|s, k| mean[s][k][c].abs() > median);
            add(format!("positive {c}"), &|s, k| mean[s][k][c] > 0.0);
            add(format!("growing {c}"), &|s, k| k > 0 && mean[s][k][c].abs() > mean[s][k - 1][c].abs());
        }
        let half: usize = mean.iter().map(Vec::len).sum::<usize>() / 2;
        let before: Vec<usize> = mean.iter().scan(0, |n, w| { let b = *n; *n += w.len(); Some(b) }).collect();
        add("late".into(), &|s, k| before[s] + k >= half);
        found
    }
}

fn means(record: &Record, rows: &Range<usize>) -> Vec<f64> {
    let channels = record.signals.channels();
    let (mut value, mut slope) = (vec![0.0; channels], vec![0.0; channels]);
    let mut sum = vec![0.0; channels];
    for i in rows.clone() {
        record.signals.at(record.time[i], &mut value, &mut slope);
        sum.iter_mut().zip(&value).for_each(|(s, v)| *s += v / rows.len() as f64);
    }
    sum
}

fn difference(fit: &Fit, linear: &Along, split: &Split, own: Range<usize>) -> Option<Difference> {
    let (p, k) = (fit.p.len(), own.len());
    let wider: Along = linear
        .iter()
        .zip(&split.inside)
        .map(|(w, inside)| w.iter().zip(inside).map(|(w, i)| widened(w, p, own.clone(), *i)).collect())
        .collect();
    let e = eliminate(&wider, &fit.variances, p + k)?;
    let (information, gradient) = e.normal();
    let covariance = inverse(&information)?;
    let step = -(&covariance * gradient);
    let delta = DVector::from_fn(k, |i, _| step[p + i]);
    let block = DMatrix::from_fn(k, k, |i, j| covariance[(p + i, p + j)]) * fit.variance_inflation();
    let chi_squared = delta.dot(&block.cholesky()?.solve(&delta));
    let outside: Vec<f64> = own.clone().map(|i| fit.p[i] + step[i]).collect();
    let inside: Vec<f64> = outside.iter().zip(delta.iter()).map(|(v, d)| v + d).collect();
    let share = own.clone().zip(delta.iter()).map(|(i, d)| (d / fit.p[i]).abs()).fold(0.0, f64::max);
    Some(Difference { name: split.name.clone(), chi_squared, share, values: [outside, inside] })
}

/// A window with columns of its own for some values: copies where it is inside of the regime, zero elsewhere.
fn widened(window: &LinearisedWindow, p: usize, own: Range<usize>, inside: bool) -> LinearisedWindow {
    let m = window.gram[0].nrows() - 1 - p;
    let k = own.len();
    // Column of the wider form → column of the window's own.
    let from = |j: usize| match j {
        j if j < m + p => Some(j),
        j if j < m + p + k => inside.then_some(m + own.start + (j - m - p)),
        _ => Some(m + p),
    };
    let n = m + p + k + 1;
    let gram = window.gram.each_ref().map(|g| {
        DMatrix::from_fn(n, n, |i, j| match (from(i), from(j)) {
            (Some(i), Some(j)) => g[(i, j)],
            _ => 0.0,
        })
    });
    let back = window.back.as_ref().map(|b| DMatrix::from_fn(m, n, |i, j| from(j).map_or(0.0, |j| b[(i, j)])));
    LinearisedWindow { gram, back, ..window.clone() }
}
