//! What an effect would leave in records, and what would be gained by naming it where unexplained motion is the other
//! explanation.
//!
//! An effect that nobody named looks like jumps at the windows' ends. So its gain is not the misfit λ against noise, but
//! the deviance of noise and effect with the jumps that suit it best, minus the deviance of the noise alone:
//!
//! gain(s) = min over jumps of D(noise + J·s) − D(noise),
//!
//! in expectation over the noise. Along a run a constant creep is half imitated by a random walk, and gains far less than
//! λ; and as `discover` names only what predicts blocks of windows (or runs) that were left out, it is counted block by block.

use super::fisher_information::Driven;
use crate::discrepancy::estimation::elimination::eliminate;
use crate::discrepancy::estimation::fit::FEWEST_RUNS;
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::estimation::variance_components;
use crate::discrepancy::evidence::cross_validation::loose;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;
use crate::discrepancy::shooting::window_integration::linearise;
use crate::effects::Applied;
use crate::error::Result;
use crate::model::Model;
use nalgebra::DMatrix;

/// Rounds in the search for the smallest size that is seen.
const ROUNDS: usize = 8;
/// It is found to this share.
const CLOSE: f64 = 0.04;

/// The response of windows to effects.
pub(crate) struct EffectSignature {
    windows: Vec<Vec<LinearisedWindow>>,
    columns: Vec<Vec<usize>>,
    /// How many parameters there are in all.
    parameters: usize,
}

/// The statistics that a mark is held against.
#[derive(Clone)]
pub(crate) struct Background {
    /// The noise, without jumps.
    pub calm: NoiseModel,
    /// Rows in a row that are alike.
    pub alike: f64,
}

impl Driven {
    /// The marks of effects; `None` where the motion is undefined.
    pub fn marks(&self, model: &Model, effects: &[&Applied]) -> Result<Option<EffectSignature>> {
        let joint = effects.iter().fold(model.fixed(), |m, e| m.with_effect((*e).clone().freed()));
        let free = joint.free_parameters();
        let equations = joint.equations(&free)?;
        let linear = linearise(&equations, &joint.free_values(), &self.records, &self.plan, &self.starts);
        let position = |e: &&Applied| -> Vec<usize> {
            e.parameters().iter().filter_map(|s| free.iter().position(|f| f == s)).collect()
        };
        let columns = effects.iter().map(position).collect();
        // Of fewer runs blocks of windows must be predicted better: what shows over a whole run only is not named.
        let cut = |linear| if self.records.len() < FEWEST_RUNS { loose(&linear) } else { linear };
        Ok(linear.map(|linear| EffectSignature { windows: cut(linear), columns, parameters: free.len() }))
    }
}

impl EffectSignature {
    /// The expected gain of naming effect `of` of size s, the parameters of another one being fitted in its place.
    pub fn gain(&self, of: usize, s: &[f64], beside: Option<usize>, ground: &Background) -> f64 {
        let fitted: &[usize] = beside.map_or(&[], |b| &self.columns[b]);
        let with = self.response(of, s, fitted, &ground.calm);
        let without = self.response(of, &vec![0.0; s.len()], fitted, &ground.calm);
        let deviance = |windows: &[Vec<LinearisedWindow>], v: &NoiseModel| {
            eliminate(windows, v, fitted.len()).map_or(f64::INFINITY, |e| variance_components::deviance(windows, v, &e))
        };
        // From no jumps at all the likelihood is flat.
        let lively = ground.calm.clone().with_jumps_of_noise();
        let best = variance_components::improve(&with, lively, fitted.len(), 1.0);
        let explained = deviance(&with, &best).min(deviance(&with, &ground.calm));
        let gain = (explained - deviance(&without, &ground.calm)) / ground.alike;
        if gain.is_finite() { gain.max(0.0) } else { 0.0 }
    }

    /// The factor of a size at which the gain's root is so large; `None` where it never is.
    pub fn smallest(&self, of: usize, s: &[f64], root: f64, ground: &Background) -> Option<f64> {
        let mut factor = 1.0;
        for _ in 0..ROUNDS {
            let scaled: Vec<f64> = s.iter().map(|s| s * factor).collect();
            let step = root / self.gain(of, &scaled, None, ground).sqrt();
            if !step.is_finite() {
                return None;
            }
            factor *= step.clamp(0.02, 50.0);
            if (step - 1.0).abs() < CLOSE {
                return Some(factor);
            }
        }
        Some(factor)
    }

    /// Windows whose residual is the effect's mark and, in expectation, the noise.
    fn response(&self, of: usize, s: &[f64], fitted: &[usize], v: &NoiseModel) -> Vec<Vec<LinearisedWindow>> {
        let one = |w: &LinearisedWindow| {
            let m = w.gram[0].nrows() - 1 - self.parameters;
            let mut turn = DMatrix::zeros(w.gram[0].nrows(), m + fitted.len() + 1);
            (0..m).for_each(|i| turn[(i, i)] = 1.0);
            fitted.iter().enumerate().for_each(|(k, c)| turn[(m + c, m + k)] = 1.0);
            let last = m + fitted.len();
            self.columns[of].iter().zip(s).for_each(|(c, s)| turn[(m + c, last)] += s);
            let mut gram: Vec<DMatrix<f64>> = w.gram.iter().map(|gram| turn.tr_mul(gram) * &turn).collect();
            let noise = w.count.iter().zip(v.measurement()).map(|(count, noise)| *count as f64 * noise.variance);
            gram.iter_mut().zip(noise).for_each(|(gram, noise)| gram[(last, last)] += noise);
            LinearisedWindow { gram, back: w.back.as_ref().map(|b| b * &turn), ..w.clone() }
        };
        self.windows.iter().map(|segment| segment.iter().map(one).collect()).collect()
    }
}
