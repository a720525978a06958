//! How much an effect seems to gain where it is not there, for effects of which χ² does not hold.
//!
//! Twice the gain of log likelihood of k parameters is χ²ₖ by chance, unless a parameter cannot change its sign (then
//! some of the chance gains are zero) or the effect's other parameters say nothing where it vanishes (then the best of
//! many is taken and gains are larger). How often and how much is asked of data drawn from the model without the effect.

use super::chi_squared::tail;
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::initial_state::hidden_states;
use crate::discrepancy::shooting::windows::WindowStates;
use crate::effects::Applied;
use crate::error::Result;
use crate::model::{Equations, Model, state};
use crate::motion::{StateSensitivity, Stepper};
use crate::progress::{Counter, OnProgress, Stage, unheard};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use rayon::prelude::*;
use std::ops::Range;

/// Gains smaller than this are none.
const NONE: f64 = 0.02;
const EFFORT: Effort = Effort { passes: 12, variances: false, ..Effort::FULL };

/// Data sets that are drawn: a few, and more where these do not decide and are fitted quickly (Besag & Clifford, 1991).
const DRAWS: [usize; 2] = [19, 99];
/// A probability that few draws decide: a gain so far beyond their largest is not reached by more of them.
const DECIDED: f64 = 1e-6;
/// Rows beyond which the few must do: of more data more draws would take minutes.
const QUICK_ROWS: usize = 5000;
/// A model with states of its own is fitted so many times as slowly.
const OF_STATES: usize = 10;

/// What chance gains look like.
#[derive(Clone, Debug)]
pub struct NullDistribution {
    /// Number of parameters.
    k: usize,
    /// The gains, one for each draw.
    pub gains: Vec<f64>,
}

impl NullDistribution {
    /// Of gains of so many parameters.
    pub(crate) fn of(k: usize, gains: Vec<f64>) -> Self {
        Self { k, gains }
    }

    /// Share of draws with any gain at all: less than one at an edge.
    pub fn share(&self) -> f64 {
        self.some().count() as f64 / self.gains.len().max(1) as f64
    }

    /// Mean of the gains that are not zero, over that of χ²ₖ: one where χ² holds.
    pub fn scale(&self) -> f64 {
        let count = self.some().count();
        if count == 0 { 1.0 } else { self.some().sum::<f64>() / (count * self.k) as f64 }
    }

    fn some(&self) -> impl Iterator<Item = f64> + '_ {
        self.gains.iter().copied().filter(|g| *g > NONE)
    }

    /// Probability of at least such a gain by chance: counted among the draws, and beyond the largest by χ² of the
    /// share and scale that the draws show.
    pub fn p_value(&self, gain: f64) -> f64 {
        let reached = self.gains.iter().filter(|g| **g >= gain).count();
        let rarest = 1.0 / (self.gains.len() + 1) as f64;
        match reached {
            // Where no draw gains anything at all, or none could be made, the share is not known to be zero.
            0 => (self.share().max(rarest) * tail(gain / self.scale(), self.k)).min(rarest),
            n => (n + 1) as f64 * rarest,
        }
    }
}

/// Whether χ² holds for an effect: no parameter is at an edge where it is neutral, or loses its meaning there.
pub fn is_regular(effect: &Applied) -> bool {
    effect.effect.parameters.values().all(|p| !p.positive && !p.periodic)
}

impl Problem {
    /// The probability that an effect gains so much by chance.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub(crate) fn chance_p_value(
        &self,
        without: &Fit,
        effect: &Applied,
        gain: f64,
        progress: &OnProgress,
    ) -> Result<f64> {
        let [few, many] = DRAWS;
        let gains = self.gains_of_draws(without, effect, 0..few, 0, progress)?;
        let mut chance = NullDistribution { k: effect.values.len(), gains };
        let has_states = without.model.effects.iter().chain([effect]).any(|e| !e.effect.states.is_empty());
        let work = self.records.iter().map(|r| r.rows.len()).sum::<usize>() * if has_states { OF_STATES } else { 1 };
        if chance.p_value(gain) >= DECIDED && work <= QUICK_ROWS {
            chance.gains.extend(self.gains_of_draws(without, effect, few..many, 0, progress)?);
        }
        Ok(chance.p_value(gain))
    }

    /// What an effect gains on so many data sets drawn from a fit without it.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn chance_gains(&self, without: &Fit, effect: &Applied, draws: usize, seed: u64) -> Result<NullDistribution> {
        let gains = self.gains_of_draws(without, effect, 0..draws, seed, &unheard)?;
        Ok(NullDistribution { k: effect.values.len(), gains })
    }

    /// The gains on some of the data sets that a seed draws, each by a stream of its own.
    fn gains_of_draws(
        &self,
        without: &Fit,
        effect: &Applied,
        draws: Range<usize>,
        seed: u64,
        progress: &OnProgress,
    ) -> Result<Vec<f64>> {
        let equations = without.model.equations(&[])?;
        let drawn = |i: usize| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            random.set_stream(i as u64);
            self.drawn(&equations, without, &mut random)
        };
        gains_on(drawn, without, effect, draws, progress)
    }

    /// By how much an effect improves the deviance, from wherever a fit of it may begin.
    pub(super) fn gain(
        &self,
        model: &Model,
        effect: &Applied,
        starts: &WindowStates,
        v: &NoiseModel,
    ) -> Result<Option<f64>> {
        let Some(bare) = self.fit(model, starts, v, EFFORT)? else { return Ok(None) };
        let begin = effect.effect.separate_starts().into_iter().chain([effect.values.clone()]);
        let mut best: f64 = 0.0;
        for values in begin {
            let with = model.clone().with_effect(Applied::new(&effect.effect, effect.trailer, values).freed());
            let Some(fit) = self.fit(&with, &bare.window_states, v, EFFORT)? else { continue };
            // What the poses alone gain on the way is not the effect's.
            let again = self.fit(model, &fit.window_states, v, EFFORT)?;
            let least = again.map_or(bare.deviance, |a| a.deviance.min(bare.deviance));
            best = best.max(least - fit.deviance);
        }
        Ok(Some(best))
    }

    /// Measurements as a model with its jumps and its noise would give them, and the poses at the windows' starts.
    pub(super) fn drawn(
        &self,
        equations: &Equations,
        fit: &Fit,
        random: &mut ChaCha8Rng,
    ) -> Option<(Problem, WindowStates)> {
        let mut drawn = self.clone();
        let mut starts = Vec::with_capacity(self.plan.len());
        let v = &fit.variances;
        for (segment, poses) in self.plan.iter().zip(&fit.window_states) {
            let record = &mut drawn.records[segment.record];
            let (signals, channels) = (record.signals.clone(), record.channels());
            let mut stepper = Stepper::new(equations, &signals, &[]);
            let first = segment.windows[0].start;
            let hidden = hidden_states::carried(equations, &[], record, first, &poses[0]);
            let mut arc = StateSensitivity { z: [&poses[0][..], &hidden.z].concat(), s: vec![] };
            let mut of_segment = Vec::with_capacity(poses.len());
            for (k, rows) in segment.windows.iter().enumerate() {
                of_segment.push(arc.z[..equations.visible].to_vec());
                for i in rows.clone() {
                    let y = stepper.outputs(&arc.z);
                    for channel in &channels {
                        let sigma = v.measurement()[channel.noise].variance.sqrt();
                        let noise = sigma * record.weights.deviation(channel.column, i) * normal(random);
                        record.columns[channel.column][i] = y[channel.output] + noise;
                    }
                    let quantities = record.quantities.len();
                    if quantities > 0 {
                        let there = stepper.quantities(&arc, record.time[i]);
                        for ((column, (value, _)), noise) in
                            record.quantities.iter_mut().zip(there).zip(v.of_quantities(quantities))
                        {
                            column[i] = value + noise.variance.sqrt() * normal(random);
                        }
                    }
                    if i + 1 < record.time.len() {
                        stepper.advance(&mut arc, record.time[i], record.time[i + 1]);
                    }
                }
                if k + 1 < segment.windows.len() {
                    let duration = record.time[rows.end] - record.time[rows.start];
                    jump(&mut arc.z[..equations.visible], v, duration, random);
                }
            }
            starts.push(of_segment);
        }
        drawn.records.iter().flat_map(|r| &r.columns).flatten().all(|x| x.is_finite()).then_some((drawn, starts))
    }
}

/// What an effect gains beside a fit without it on data sets that are drawn one by one, with the poses at their windows' starts.
pub(super) fn gains_on(
    drawn: impl Fn(usize) -> Option<(Problem, WindowStates)> + Sync,
    without: &Fit,
    effect: &Applied,
    draws: Range<usize>,
    progress: &OnProgress,
) -> Result<Vec<f64>> {
    let counter = Counter::begin(progress, Stage::Draws, draws.len())?;
    let one = |i: usize| -> Result<Option<f64>> {
        let Some((drawn, starts)) = drawn(i) else { return Ok(None) };
        let gain = drawn.gain(&without.model, effect, &starts, &without.variances)?;
        counter.one()?;
        Ok(gain)
    };
    let gains: Vec<Option<f64>> = draws.into_par_iter().map(one).collect::<Result<_>>()?;
    Ok(gains.into_iter().flatten().collect())
}

/// Moves a pose by what no effect explains: along the body, across it, in yaw, and the trailers'.
fn jump(pose: &mut [f64], v: &NoiseModel, duration: f64, random: &mut ChaCha8Rng) {
    let by: Vec<f64> = (0..pose.len()).map(|c| (v.jump(c) * duration).sqrt() * normal(random)).collect();
    let ([x, y], (sin, cos)) = (state::PLACE, pose[state::DIRECTION].sin_cos());
    pose[x] += cos * by[x] - sin * by[y];
    pose[y] += sin * by[x] + cos * by[y];
    pose.iter_mut().zip(&by).skip(state::PLACE.len()).for_each(|(z, by)| *z += by);
}

fn normal(random: &mut ChaCha8Rng) -> f64 {
    random.sample(StandardNormal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::noise_of;

    /// Half of the draws gain nothing, the others as χ²₂ with a mean of 4.
    #[test]
    fn beyond_the_largest_gain_chi_squared_goes_on() {
        let chance = NullDistribution { k: 2, gains: vec![0.0, 0.0, 0.0, 2.0, 6.0, 4.0] };
        assert_eq!((chance.share(), chance.scale()), (0.5, 2.0));
        assert_eq!((chance.p_value(5.0), chance.p_value(3.0)), (2.0 / 7.0, 3.0 / 7.0));
        // χ²₂ exceeds x with probability exp(-x/2).
        assert!((chance.p_value(20.0) - 0.5 * (-5.0_f64).exp()).abs() < 1e-12);
        // None of the draws gains: that is no proof that none ever does.
        let none = NullDistribution { k: 2, gains: vec![0.0; 9] }.p_value(6.0);
        assert!((none - 0.1 * (-3.0_f64).exp()).abs() < 1e-12, "{none}");
        // What no draw has reached is rarer than what one has.
        assert_eq!(NullDistribution { k: 2, gains: vec![6.0; 6] }.p_value(6.1), 1.0 / 7.0);
    }

    /// Forward, to the left and in yaw, each by its own variance, whatever the heading.
    #[test]
    fn a_jump_is_along_the_axes_of_the_body() {
        let jumps = |variances: [f64; 4], heading: f64| -> Vec<[f64; 4]> {
            let mut random = ChaCha8Rng::seed_from_u64(1);
            let v = noise_of(1, [0.0; 3], &variances);
            let mut draw = || {
                let mut pose = [3.0, -2.0, heading, heading];
                jump(&mut pose, &v, 0.5, &mut random);
                let (dx, dy, (sin, cos)) = (pose[0] - 3.0, pose[1] + 2.0, heading.sin_cos());
                [dx * cos + dy * sin, dy * cos - dx * sin, pose[2] - heading, pose[3] - heading]
            };
            (0..4000).map(|_| draw()).collect()
        };
        for heading in [0.0, 0.9, 2.5, -1.7] {
            let drawn = jumps([0.04, 0.09, 0.01, 0.16], heading);
            for (c, std) in [0.2, 0.3, 0.1, 0.4].into_iter().enumerate() {
                // Half a second of a variance per second.
                let rms = (drawn.iter().map(|d| d[c] * d[c]).sum::<f64>() / 4000.0 / 0.5).sqrt();
                assert!((rms / std - 1.0).abs() < 0.05, "{heading}: {c}: {rms} for {std}");
            }
            let alone = jumps([0.04, 0.0, 0.0, 0.0], heading);
            assert!(alone.iter().all(|d| d[1].abs() < 1e-12 && d[2] == 0.0 && d[3] == 0.0));
        }
    }
}
