//! A model with free effects fitted to all windows at once.

use super::autocorrelation;
use super::bounds::Bounds;
use super::descent::{Descent, Point, Windows};
use super::elimination::ReducedForm;
use super::problem::Problem;
use super::variance_components;
use crate::discrepancy::estimation::noise_model::{Component, NoiseModel};
use crate::discrepancy::record::sensor_noise::Noise;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;
use crate::discrepancy::shooting::windows::WindowStates;
use crate::effects::Scope;
use crate::error::Result;
use crate::model::{Equations, Model};
use nalgebra::{DMatrix, DVector};

pub use super::descent::Effort;

/// A model fitted to a problem.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The model, its effects at the fitted values.
    pub model: Model,
    /// The fitted values, effect by effect.
    pub p: Vec<f64>,
    /// Their covariance, `None` when the data leave a direction open.
    pub covariance: Option<DMatrix<f64>>,
    /// Whether it has in it what the numbers of scopes are uncertain by; they are held where they are in a fit.
    pub scopes_vary: bool,
    /// Their covariance by the spread between runs, `None` with fewer than [`FEWEST_RUNS`].
    pub between_runs: Option<DMatrix<f64>>,
    /// How many runs were fitted.
    pub runs: usize,
    /// Each run's part of the quadratic form in (δp, 1), δp from the fitted values.
    pub of_runs: Vec<DMatrix<f64>>,
    /// Information matrix of the parameters.
    pub information: DMatrix<f64>,
    /// Noise and unexplained motion.
    pub variances: NoiseModel,
    /// Twice the negative log likelihood.
    pub deviance: f64,
    /// Poses at the windows' starts.
    pub window_states: WindowStates,
    /// Effective number of measured values.
    pub sample_size: f64,
    /// By how much the deviance would grow without each component of the process noise: what remains unexplained; zero
    /// where the variances were not estimated.
    pub unexplained: Vec<f64>,
    /// How many windows in a row what remains unexplained is alike, at least 1: see [`super::autocorrelation`].
    pub residual_correlation_time: f64,
    /// The same for each value, by the share that each kind of jump has in its variance.
    pub value_correlation_times: Vec<f64>,
    /// How many rows in a row the noise is alike, at least 1.
    pub noise_correlation_time: f64,
    /// How many numbers the poses were asked for beside the values: how hidden states began.
    pub initial_state_dof: f64,
}

/// Runs that their spread can be told from.
pub const FEWEST_RUNS: usize = 4;

impl Fit {
    /// How many numbers it has taken from the data: values, those of scopes, and how hidden states began.
    pub fn size(&self) -> f64 {
        let of_scopes = self.model.free_effects().filter_map(|e| e.effect.scope.as_ref()).map(Scope::cost);
        (self.p.len() + of_scopes.sum::<usize>()) as f64 + self.initial_state_dof
    }

    /// The noise that was estimated.
    pub fn noise(&self) -> Noise {
        Noise {
            variance: self.variances.measurement().iter().map(|c| c.variance).collect(),
            correlation_time: self.noise_correlation_time,
        }
    }
}

impl Problem {
    /// Fits the values of a model's free effects by Levenberg–Marquardt with exact Jacobians.
    ///
    /// `None` when the model is undefined along the runs.
    pub fn fit(
        &self,
        model: &Model,
        starts: &WindowStates,
        variances: &NoiseModel,
        effort: Effort,
    ) -> Result<Option<Fit>> {
        let equations = model.free_equations()?.followed(effort.fineness);
        let p = DVector::from_vec(model.free_values());
        let bounds = Bounds::of(model);
        let mut v = variances.clone();
        let Some(mut point) = self.windows_by(&equations, &v).at(p, starts.clone()) else { return Ok(None) };
        let is_near = effort.begins_near;
        point = Descent { windows: self.windows_by(&equations, &v), bounds: &bounds, effort, is_near }.from(point);
        if effort.variances {
            // Better variances show a better way down, and the other way round.
            for first_step in [1.0, 0.3, 0.3, 0.3, 0.3, 0.3] {
                let better = variance_components::improve(&point.linear, v.clone(), point.p.len(), first_step);
                let settled = better.close_to(&v);
                v = better;
                let Some(e) = self.windows_by(&equations, &v).eliminated(&point.linear, &point.p) else {
                    return Ok(None);
                };
                point.eliminated = e;
                point = Descent { windows: self.windows_by(&equations, &v), bounds: &bounds, effort, is_near: true }
                    .from(point);
                if settled {
                    break;
                }
            }
        }
        let at = |v: &NoiseModel| self.windows_by(&equations, v).eliminated(&point.linear, &point.p);
        let unexplained = if effort.variances { unexplained(&point, &v, &at) } else { vec![0.0; v.process().len()] };
        let of_kinds = autocorrelation::of_each_kind(&point.linear, &unexplained);
        let residual_correlation_time = autocorrelation::of_what_remains(&of_kinds, &unexplained);
        let value_correlation_times = value_correlation_times(&point, &v, &of_kinds, &at).unwrap_or_default();
        let noise_correlation_time = if effort.variances { autocorrelation::of_noise(&point.linear) } else { 1.0 };
        let initial_state_dof = point.linear.iter().flatten().map(|w| w.initial_state_dof).sum();
        Ok(Some(Fit {
            unexplained,
            residual_correlation_time,
            value_correlation_times,
            noise_correlation_time,
            initial_state_dof,
            ..self.finished(model, point, v)
        }))
    }

    fn windows_by<'a>(&'a self, equations: &'a Equations, v: &'a NoiseModel) -> Windows<'a> {
        Windows { records: &self.records, plan: &self.plan, equations, v, priors: &self.priors }
    }

    /// H⁻¹·(Σ g gᵀ)·H⁻¹ with the gradient g of each run: what runs of the same kind would scatter by, whatever the
    /// reason.
    fn between_runs(&self, e: &ReducedForm) -> Option<DMatrix<f64>> {
        let runs = self.records.len();
        if runs < FEWEST_RUNS {
            return None;
        }
        let (information, _) = e.normal();
        let p = information.nrows();
        let bread = inverse(&information)?;
        let mut gradients = DMatrix::zeros(p, runs);
        for (segment, part) in self.plan.iter().zip(&e.parts) {
            let mut column = gradients.column_mut(segment.record);
            column += part.view((0, p), (p, 1));
        }
        let meat = &gradients * gradients.transpose() * (runs as f64 / (runs as f64 - 1.0));
        Some(&bread * meat * &bread)
    }

    /// The parts of a form, run by run.
    fn by_run(&self, e: &ReducedForm) -> Vec<DMatrix<f64>> {
        let size = e.form.nrows();
        let mut runs = vec![DMatrix::zeros(size, size); self.records.len()];
        self.plan.iter().zip(&e.parts).for_each(|(segment, part)| runs[segment.record] += part);
        runs
    }

    fn finished(&self, model: &Model, point: Point, variances: NoiseModel) -> Fit {
        let (information, _) = point.eliminated.normal();
        let mut model = model.clone();
        let mut rest = point.p.iter().copied();
        for e in model.effects.iter_mut().filter(|e| e.free) {
            e.values.iter_mut().for_each(|value| *value = rest.next().unwrap_or(*value));
        }
        Fit {
            unexplained: vec![0.0; variances.process().len()],
            deviance: variance_components::deviance(&point.linear, &variances, &point.eliminated),
            scopes_vary: false,
            between_runs: self.between_runs(&point.eliminated),
            runs: self.records.len(),
            of_runs: self.by_run(&point.eliminated),
            covariance: inverse(&information),
            sample_size: sample_size(&point.linear, &point.eliminated),
            p: point.p.as_slice().to_vec(),
            model,
            information,
            variances,
            window_states: point.starts,
            residual_correlation_time: 1.0,
            value_correlation_times: vec![],
            noise_correlation_time: 1.0,
            initial_state_dof: 0.0,
        }
    }
}

/// What each component of the process noise is needed for.
fn unexplained(point: &Point, v: &NoiseModel, at: &impl Fn(&NoiseModel) -> Option<ReducedForm>) -> Vec<f64> {
    let here = variance_components::deviance(&point.linear, v, &point.eliminated);
    let needed = |(c, jump): (usize, &Component)| {
        let calm = Some(v.clone().without_jump(c)).filter(|calm| jump.is_estimated && calm != v)?;
        let e = at(&calm)?;
        Some(variance_components::deviance(&point.linear, &calm, &e) - here)
    };
    v.process().iter().enumerate().map(|jump| needed(jump).unwrap_or(0.0)).collect()
}

/// By so large a share the variance of jumps is changed to see what it has in the variance of a value.
const VARIED: f64 = 0.1;

/// For each value the mean of the kinds' correlations, each by the share ∂ ln var/∂ ln q that the kind of jumps has in the
/// variance of the value; `None` where no kind has one, or the shares cannot be told.
fn value_correlation_times(
    point: &Point,
    v: &NoiseModel,
    of_kinds: &[f64],
    at: &impl Fn(&NoiseModel) -> Option<ReducedForm>,
) -> Option<Vec<f64>> {
    if of_kinds.iter().all(|tau| *tau <= 1.0) {
        return None;
    }
    let p = point.p.len();
    let here = inverse(&point.eliminated.normal().0)?.diagonal();
    let more = |c: usize| {
        let mut varied = v.clone();
        varied.process_mut()[c].variance *= 1.0 + VARIED;
        Some(inverse(&at(&varied)?.normal().0)?.diagonal() - &here)
    };
    let by_kind: Vec<DVector<f64>> = (0..of_kinds.len()).map(more).collect::<Option<_>>()?;
    let of_value = |i: usize| {
        let shares = || by_kind.iter().map(|more| more[i].max(0.0));
        let all: f64 = shares().sum();
        if all > 0.0 { shares().zip(of_kinds).map(|(share, tau)| share * tau).sum::<f64>() / all } else { 1.0 }
    };
    Some((0..p).map(of_value).collect())
}

/// The number of values that count as independent in a fit.
fn sample_size(linear: &[Vec<LinearisedWindow>], e: &ReducedForm) -> f64 {
    let windows = linear.iter().map(Vec::len).sum::<usize>() as f64;
    let coordinates = linear.iter().flatten().map(|w| w.axes.nrows()).max().unwrap_or(1) as f64;
    let values = linear.iter().flatten().flat_map(|w| &w.count).sum::<usize>() as f64;
    independent(values, windows * coordinates, e.jump_determinant)
}

/// How many of some values count as independent: all of them where noise is white and nothing jumps, one a window and
/// coordinate where jumps dominate.
fn independent(values: f64, jumps: f64, jump_determinant: f64) -> f64 {
    let white = (-jump_determinant / jumps.max(1.0)).exp();
    jumps + (values - jumps).max(0.0) * white
}

/// The inverse of an information matrix, unless a direction is as good as open.
pub(crate) fn inverse(information: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    if information.is_empty() {
        return Some(information.clone());
    }
    let scale = DVector::from_fn(information.nrows(), |i, _| information[(i, i)].sqrt().recip());
    if !scale.iter().all(|s| s.is_finite()) {
        return None;
    }
    let scaled = DMatrix::from_fn(scale.len(), scale.len(), |i, j| information[(i, j)] * scale[i] * scale[j]);
    let eigen = scaled.clone().symmetric_eigenvalues();
    if eigen.iter().any(|e| *e < 1e-7) {
        return None;
    }
    let inverse = scaled.cholesky()?.inverse();
    Some(DMatrix::from_fn(scale.len(), scale.len(), |i, j| inverse[(i, j)] * scale[i] * scale[j]))
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    fn what_jumps_counts_once_a_window() {
        assert_eq!(independent(900.0, 60.0, 0.0), 900.0);
        assert!((independent(900.0, 60.0, 60.0 * 50.0) - 60.0).abs() < 1e-9);
        // Jumps as large as the noise, say: each makes half of what is beyond one a window worthless.
        assert!((independent(900.0, 60.0, 60.0 * 2.0_f64.ln()) - 480.0).abs() < 1e-9);
        // Fewer values than jumps say no less than one each.
        assert_eq!(independent(40.0, 60.0, 0.0), 60.0);
    }
}
