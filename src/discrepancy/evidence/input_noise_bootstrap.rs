//! The parametric bootstrap (Efron, 1979) with errors in the inputs: how much an effect seems to gain of noisy inputs alone.
//!
//! Ticks and steps are errors that hang together in time, and a model of white jumps between windows weighs them wrongly: an
//! effect that averages the inputs, or shifts them, gains by that where nothing is hidden. How much is asked of poses that
//! the smoothed inputs lead to, and of inputs with noise of the same kind drawn anew.
//!
//! | symbol | meaning |
//! |---|---|
//! | G | what the effect improves the deviance by |
//! | s = mean of G over the draws / k | one where χ² of the effect's k values holds |
//! | G/s | the gain in units of what is gained of nothing |

use super::parametric_bootstrap::{NullDistribution, gains_on};
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::record::input_noise::PHASES;
use crate::effects::Applied;
use crate::error::Result;
use crate::progress::OnProgress;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use std::ops::Range;

/// Data sets that are drawn, a few, and more where these do not decide: enough for the size of the gains, not for their tail.
const DRAWS: [usize; 2] = [PHASES as usize, 2 * PHASES as usize];
/// A gain so many times as large as its price, or as small, is decided by few draws.
const DECIDED: f64 = 3.0;

impl Problem {
    /// What an effect gains over its price, in units of what it gains of the noise of the inputs alone; `None` where no draw can be
    /// fitted.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub(crate) fn gain_beyond_input_noise(
        &self,
        without: &Fit,
        effect: &Applied,
        price: f64,
        progress: &OnProgress,
    ) -> Result<Option<f64>> {
        let Some(smooth) = self.with_smoothed_inputs() else { return Ok(None) };
        let gain = self.gain(&without.model, effect, &without.window_states, &without.variances)?;
        let Some(gain) = gain else { return Ok(None) };
        let [few, all] = DRAWS;
        let mut chance = NullDistribution::of(effect.values.len(), vec![]);
        let mut beyond = None;
        for draws in [0..few, few..all] {
            chance.gains.extend(self.gains_of_input_noise(&smooth, without, effect, draws, progress)?);
            if chance.gains.is_empty() {
                break;
            }
            let found = gain / chance.scale().max(1.0) / price;
            beyond = Some(found);
            if !(DECIDED.recip()..=DECIDED).contains(&found) {
                break;
            }
        }
        Ok(beyond)
    }

    /// The gains on poses that the smoothed inputs lead to, and inputs with noise drawn anew.
    fn gains_of_input_noise(
        &self,
        smooth: &Problem,
        without: &Fit,
        effect: &Applied,
        draws: Range<usize>,
        progress: &OnProgress,
    ) -> Result<Vec<f64>> {
        let equations = without.model.equations(&[])?;
        let quiet = Fit { variances: beside_known(&without.variances), ..without.clone() };
        let noisy = |draw: usize| {
            let mut random = ChaCha8Rng::seed_from_u64(draw as u64);
            let (drawn, starts) = smooth.drawn(&equations, &quiet, &mut random)?;
            Some((drawn.with_noisier_inputs(draw as u64), starts))
        };
        gains_on(noisy, without, effect, draws, progress)
    }
}

/// The jumps that are there beside what the noise of the inputs is known to make.
fn beside_known(variances: &NoiseModel) -> NoiseModel {
    let mut beside = variances.clone();
    beside.process_mut().iter_mut().for_each(|c| c.variance = c.beyond_known());
    beside
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::estimation::fit::Effort;
    use crate::discrepancy::fixtures::{WEAVING, equations, logged, unicycle};
    use crate::discrepancy::record::run_record::Record;
    use crate::effects::named;
    use crate::motion::Timing;
    use crate::progress::unheard;

    /// The poses of exact inputs, and the counts of a coarse encoder.
    fn counted(hidden: &[(&str, &[f64])]) -> Problem {
        let (equations, p) = equations(hidden);
        let time: Vec<f64> = (0..400).map(|i| 0.05 * f64::from(i)).collect();
        let exact = logged((&equations, &p), time.clone(), WEAVING, &[0.0; 3], 1e-3);
        // The angle of the wheel in ticks of 0.09 rad, of which a row has one or two.
        let ticks = |t: f64| ((2.0 * t - (0.7 * t).cos() / 0.7) / 0.09).floor() * 0.09;
        let counts: Vec<f64> = time.iter().map(|t| (ticks(*t) - ticks(t - 0.05)) / 0.05).collect();
        let turning: Vec<f64> = time.iter().map(|t| WEAVING[1](*t)).collect();
        let run = Record::new("run", time, exact.columns, true, &[counts, turning], Timing::IntervalMean);
        let problem = Problem::new(vec![run], Some(1e-3), Some(1e-3));
        problem.knowing_its_inputs(&unicycle(&[])).unwrap()
    }

    /// Beyond a price of 10: of an effect that is there, and of one that averages the counts.
    #[test]
    fn what_averages_noisy_inputs_gains_of_nothing() {
        let beyond = |hidden: &[(&str, &[f64])], id: &str, values: &[f64]| {
            let problem = counted(hidden);
            let model = unicycle(&[]);
            let starts = problem.starts(&model).unwrap();
            let without = problem.fit(&model, &starts, &problem.variances, Effort::FULL).unwrap().unwrap();
            let effect = Applied::new(named(id).unwrap(), None, values.to_vec());
            let gain = problem.gain(&model, &effect, &without.window_states, &without.variances).unwrap().unwrap();
            let beyond = problem.gain_beyond_input_noise(&without, &effect, 10.0, &unheard).unwrap().unwrap();
            (gain, beyond)
        };
        let (gain, of_nothing) = beyond(&[], "traction-creep", &[0.1]);
        assert!(gain > 30.0 && of_nothing < 1.0, "{gain} {of_nothing}");
        let (gain, there) = beyond(&[("traverse-creep", &[0.05])], "traverse-creep", &[0.05]);
        assert!(gain > 30.0 && there > 1.0, "{gain} {there}");
    }
}
