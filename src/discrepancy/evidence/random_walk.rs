//! A parameter that walks: the variance of its steps by restricted maximum likelihood, as in a structural time-series model
//! with a local level (Harvey, 1989).
//!
//! The data are cut into blocks, and the parameter differs from its fitted value by b in each. One elimination of the poses
//! gives the gradient g and the information A of b, all else free; a prior b = c·1 + w with a walk w, whose covariance
//! between times t and t' is q·min(t, t'), then has in closed form
//!
//! −2·ln L(q) = ln|I + A·K| + ln(1ᵀ·M·1) − gᵀ·K·(I + A·K)⁻¹·g − (1ᵀ·h)²/(1ᵀ·M·1),
//! h = (I + A·K)⁻¹·g, M = (I + A·K)⁻¹·A
//!
//! | symbol | meaning |
//! |---|---|
//! | K = q·C | covariance of the walk; each run walks by itself |
//! | c | mean, without a prior |
//! | q | variance of its steps a second |
//!
//! What moves from one block to the next by more than a block tells may be a law that is not the effect's: asked block by
//! block it looks like that. Then the increments are asked whether they are those of a walk (`walk_increments`).

use super::cross_validation::Along;
use super::scope_scan::{BlockScores, Blocks};
use super::wald_test::neutral_at_zero;
use super::walk_increments::{are_random, driving};
use crate::discrepancy::estimation::elimination::eliminate;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::estimation::unexplained::remaining;
use crate::discrepancy::estimation::variance_components::deviance;
use crate::discrepancy::record::local_polynomial::median;
use crate::discrepancy::shooting::window_integration::linearise;
use crate::effects::Applied;
use crate::error::Result;
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use std::ops::Range;

/// Shares of the unexplained motion that are tried beside a walk, for a part of it is the walk's.
const SHARES: [f64; 8] = [1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 1e-3];
/// A walk leaves no larger share of the unexplained motion: what leaves more is not all of a walk.
const LEFT: f64 = 0.1;
/// Steps of the search over √q, from a thousandth of the parameter's size over a run to a thousand of them.
const STEPS: usize = 61;
const DECADES: f64 = 3.0;

/// A walk that a parameter was found to make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Walk {
    /// √q and its standard deviation.
    pub per_sqrt_s: f64,
    pub std: f64,
    /// The standard deviation of the mean of the parameter, about which it walks.
    pub std_of_mean: f64,
    /// Deviance without less deviance with it.
    pub gain: f64,
}

/// Twice the negative log likelihood with noise of one size: without a walk, and what a walk adds to it.
///
/// With C = L·Lᵀ and the eigenvalues λ of Lᵀ·A·L all that q changes is a sum over λ.
struct Likelihood {
    without: f64,
    /// The deviation of the value that the middle one of the blocks tells alone.
    told_by_block: Option<f64>,
    /// 1ᵀ·A·1 and 1ᵀ·g.
    weight: f64,
    slope: f64,
    eigenvalues: DVector<f64>,
    /// A·1 and g by the eigenvectors.
    ones: DVector<f64>,
    gradient: DVector<f64>,
    eigenvectors: DMatrix<f64>,
}

impl Likelihood {
    /// Of the information and the gradient of the blocks, L the factor of a walk's covariance at q = 1.
    fn of(without: f64, a: &DMatrix<f64>, g: &DVector<f64>, l: &DMatrix<f64>) -> Self {
        let SymmetricEigen { eigenvalues, eigenvectors } = (l.tr_mul(a) * l).symmetric_eigen();
        let turned = |v: &DVector<f64>| eigenvectors.tr_mul(&l.tr_mul(v));
        let mut told: Vec<f64> = a.diagonal().iter().filter(|a| **a > 0.0).map(|a| a.sqrt().recip()).collect();
        Self {
            without,
            told_by_block: median(&mut told),
            weight: a.sum(),
            slope: g.sum(),
            ones: turned(&a.column_sum()),
            gradient: turned(g),
            // By rounding alone they are less than nothing.
            eigenvalues: eigenvalues.map(|lambda| lambda.max(0.0)),
            eigenvectors,
        }
    }

    /// The information on the mean with a walk of that variance a second.
    fn weight_at(&self, q: f64) -> f64 {
        let taken = self.eigenvalues.iter().zip(&self.ones).map(|(lambda, one)| q / (1.0 + q * lambda) * one * one);
        self.weight - taken.sum::<f64>()
    }

    /// What the parameter is beside its value, block by block, with a walk of that variance a second.
    fn course(&self, q: f64, factor: &DMatrix<f64>) -> DVector<f64> {
        let parts = self.eigenvalues.zip_map(&self.gradient, |lambda, g| -q / (1.0 + q * lambda) * g);
        factor * (&self.eigenvectors * parts)
    }

    /// With a walk of that variance a second.
    fn at(&self, q: f64) -> f64 {
        let (mut determinant, mut walked) = (0.0, 0.0);
        let (mut weight, mut slope) = (self.weight, self.slope);
        for ((lambda, one), g) in self.eigenvalues.iter().zip(&self.ones).zip(&self.gradient) {
            let share = q / (1.0 + q * lambda);
            determinant += (q * lambda).ln_1p();
            walked += share * g * g;
            weight -= share * one * one;
            slope -= share * one * g;
        }
        let mean = slope * slope / weight - self.slope * self.slope / self.weight;
        let added = determinant + (weight / self.weight).ln() - walked - mean;
        if added.is_finite() { self.without + added } else { f64::INFINITY }
    }
}

/// What the search over the steps of a walk has reached.
struct Reached {
    deviance: f64,
    share: f64,
    likelihood: Likelihood,
    /// The place of the step, and the deviance at all of them.
    at: usize,
    each: Vec<f64>,
}

impl Problem {
    /// The walk of an effect's one parameter, where the fit leaves motion that a walk explains.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub(crate) fn walk(&self, fit: &Fit, effect: &Applied) -> Result<Option<Walk>> {
        let left: Vec<usize> = remaining(fit).collect();
        if effect.values.len() != 1 || left.is_empty() {
            return Ok(None);
        }
        let equations = fit.model.free_equations()?;
        let linear = linearise(&equations, &fit.p, &self.records, &self.plan, &fit.window_states);
        let Some(linear) = linear else { return Ok(None) };
        let blocks = Blocks::of_plan(&self.plan);
        let covariance = self.covariance_of_walk(&blocks);
        let duration = covariance.diagonal().max().max(1.0);
        let Some(factor) = covariance.cholesky().map(|c| c.unpack()) else { return Ok(None) };
        let size = effect.effect.parameters.values().next().map_or(1.0, |p| p.size);
        let step =
            |k: usize| size / duration.sqrt() * 10f64.powf(DECADES * (2.0 * k as f64 / (STEPS - 1) as f64 - 1.0));
        let mut best: Option<Reached> = None;
        let mut told = None;
        for share in SHARES {
            let v = with_share(&fit.variances, &left, share);
            let Some(likelihood) = self.likelihood(fit, effect, &linear, &blocks, &v, &factor) else { continue };
            if share == 1.0 {
                told = likelihood.told_by_block;
            }
            let each: Vec<f64> = (0..STEPS).map(|k| likelihood.at(step(k).powi(2))).collect();
            let Some(at) = (0..STEPS).min_by(|a, b| each[*a].total_cmp(&each[*b])) else { continue };
            if best.as_ref().is_none_or(|b| each[at] < b.deviance) {
                best = Some(Reached { deviance: each[at], share, likelihood, at, each });
            }
        }
        let Some(Reached { deviance, share, likelihood, at: k, each }) = best else { return Ok(None) };
        let is_slow = |told: f64| step(k) * (duration / blocks.count as f64).sqrt() < told;
        let q = step(k).powi(2);
        let is_walk = || told.is_some_and(is_slow) || self.steps_at_random(&blocks, &likelihood.course(q, &factor));
        if share > LEFT || k == 0 || k + 1 == STEPS || !is_walk() {
            return Ok(None);
        }
        // The curvature in ln √q at the lowest of the points.
        let width = 2.0 * DECADES * 10f64.ln() / (STEPS - 1) as f64;
        let curvature = (each[k - 1] - 2.0 * each[k] + each[k + 1]) / (width * width);
        let std = step(k) * (2.0 / curvature).sqrt();
        let std_of_mean = likelihood.weight_at(q).sqrt().recip();
        let found = Walk { per_sqrt_s: step(k), std, std_of_mean, gain: fit.deviance - deviance };
        Ok((curvature > 0.0 && std_of_mean.is_finite()).then_some(found))
    }

    fn likelihood(
        &self,
        fit: &Fit,
        effect: &Applied,
        linear: &Along,
        blocks: &Blocks,
        v: &NoiseModel,
        factor: &DMatrix<f64>,
    ) -> Option<Likelihood> {
        let (own, _) = *neutral_at_zero(fit, effect).first()?;
        let kept: Vec<usize> = (0..fit.p.len()).filter(|i| *i != own).collect();
        let scores = BlockScores::of(linear, blocks, v, fit.p.len(), &kept, &[own])?;
        let all = eliminate(linear, v, fit.p.len())?;
        Some(Likelihood::of(deviance(linear, v, &all), &scores.information, &scores.gradient, factor))
    }

    /// Whether the increments of a course over the blocks may be those of a walk.
    fn steps_at_random(&self, blocks: &Blocks, course: &DVector<f64>) -> bool {
        let rows = blocks.rows(&self.plan);
        let asked: Vec<Vec<f64>> = rows.iter().map(|(run, rows)| driving(&self.records[*run], rows)).collect();
        let within = (1..rows.len()).filter(|k| rows[k - 1].0 == rows[*k].0);
        let change = |k: usize| asked[k].iter().zip(&asked[k - 1]).map(|(a, b)| a - b).collect();
        let (increments, beside): (Vec<f64>, Vec<Vec<f64>>) =
            within.map(|k| (course[k] - course[k - 1], change(k))).unzip();
        are_random(&increments, &beside)
    }

    /// min(t, t') from the beginning of each run on, between the blocks.
    fn covariance_of_walk(&self, blocks: &Blocks) -> DMatrix<f64> {
        let middle = |(run, rows): &(usize, Range<usize>)| {
            let record = &self.records[*run];
            let last = rows.end.min(record.time.len() - 1);
            (*run, 0.5 * (record.time[rows.start] + record.time[last]) - record.time[record.rows.start])
        };
        let times: Vec<(usize, f64)> = blocks.rows(&self.plan).iter().map(middle).collect();
        let between = |a: (usize, f64), b: (usize, f64)| if a.0 == b.0 { a.1.min(b.1) } else { 0.0 };
        DMatrix::from_fn(times.len(), times.len(), |i, j| between(times[i], times[j]))
    }
}

/// The variances with a share of some components of the process noise.
fn with_share(variances: &NoiseModel, components: &[usize], share: f64) -> NoiseModel {
    let mut v = variances.clone();
    components.iter().for_each(|c| v.process_mut()[*c].variance *= share);
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values that are measured block by block with a deviation of one: the closed form against the density of the measured
    /// values themselves, whose covariance is 1 + K, the mean integrated out.
    #[test]
    fn the_likelihood_is_that_of_measured_values_with_a_covariance() {
        let n = 6;
        let measured = DVector::from_vec(vec![0.3, -0.2, 0.9, 1.4, 1.1, 2.0]);
        let walk = |i: usize, j: usize| i.min(j) as f64 + 0.5;
        let factor = DMatrix::from_fn(n, n, walk).cholesky().unwrap().unpack();
        let likelihood = Likelihood::of(0.0, &DMatrix::identity(n, n), &measured, &factor);
        let direct = |k: &DMatrix<f64>| {
            let inverse = (DMatrix::identity(n, n) + k).try_inverse().unwrap();
            let ones = DVector::from_element(n, 1.0);
            let weight = ones.dot(&(&inverse * &ones));
            let mean = ones.dot(&(&inverse * &measured)) / weight;
            let rest = measured.add_scalar(-mean);
            weight.ln() - inverse.determinant().ln() + rest.dot(&(&inverse * &rest))
        };
        let k = |q: f64| DMatrix::from_fn(n, n, |i, j| q * walk(i, j));
        let none = k(0.0);
        for q in [0.01, 0.1, 1.0] {
            let by_direct = direct(&k(q)) - direct(&none);
            assert!((likelihood.at(q) - likelihood.at(0.0) - by_direct).abs() < 1e-9, "{q}");
        }
        assert!(likelihood.at(0.0).abs() < 1e-12);
    }
}
