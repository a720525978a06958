//! The model before and after along the fitted and the held-out runs, and how far each strays.

use super::warning::Warning;
use crate::discrepancy::preprocessing::dataset::Data;
use crate::discrepancy::record::input_noise::PHASES;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::record::sensor_noise::Noise;
use crate::discrepancy::report;
use crate::discrepancy::report::{BeforeAfter, Floor, Gap, GapCurve, Step};
use crate::discrepancy::selection::choice::{Growth, Selected};
use crate::discrepancy::shooting::rollout::{PredictionError, Rollout};
use crate::error::Result;
use crate::model::Model;
use rayon::prelude::*;

/// Horizons of the curve, s.
const CURVE: [f64; 12] = [0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0, 45.0];
/// Windows a point of the curve needs.
pub(crate) const FEWEST_WINDOWS: usize = 2;

/// A model along all runs of a kind.
pub struct Rollouts<'a>(Vec<Rollout<'a>>);

impl<'a> Rollouts<'a> {
    /// A model along some runs.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn new(model: &Model, records: &'a [Record]) -> Result<Self> {
        Ok(Self(records.par_iter().map(|r| Rollout::new(model, r)).collect::<Result<_>>()?))
    }

    /// The predictor of each run.
    pub fn each(&self) -> &[Rollout<'a>] {
        &self.0
    }

    /// How many windows of a horizon there are in all runs.
    pub(crate) fn windows(&self, horizon: f64) -> usize {
        self.0.iter().map(|p| p.windows(horizon).len()).sum()
    }

    /// Errors after a horizon, over all runs.
    pub(crate) fn errors(&self, horizon: f64) -> PredictionError {
        let each: Vec<PredictionError> = self.0.par_iter().map(|p| p.errors(horizon)).collect();
        each.into_iter().fold(PredictionError::default(), PredictionError::joined)
    }

    /// The noise floor at some horizons, over all runs.
    pub(crate) fn floors(&self, horizons: &[f64], noise: &Noise, seed: u64) -> Vec<PredictionError> {
        // As often for every run, so that a window weighs in the floor what it weighs in the gap.
        let often = |h: &f64| (2000 / self.windows(*h).max(1)).clamp(4, 200);
        let draws: Vec<usize> = horizons.iter().map(often).collect();
        let of = |(i, p): (usize, &Rollout)| p.floors(horizons, &draws, noise, seed.wrapping_add(i as u64));
        let each: Vec<Vec<PredictionError>> = self.0.par_iter().enumerate().map(of).collect();
        let zero = vec![PredictionError::default(); horizons.len()];
        let floors: Vec<PredictionError> =
            each.iter().fold(zero, |sum, floors| sum.into_iter().zip(floors).map(|(s, f)| s.joined(*f)).collect());
        let of_inputs = |h: &f64| -> PredictionError {
            let drawn = |draw: u64| (0..).zip(&self.0).map(move |(run, p)| p.moved_by_inputs(*h, run, draw));
            (0..PHASES).flat_map(drawn).fold(PredictionError::default(), PredictionError::joined)
        };
        floors.into_iter().zip(horizons).map(|(floor, h)| floor.beside(of_inputs(h))).collect()
    }
}

/// The model as it was and with what was found, along the runs that were fitted and those that were held out.
pub struct ModelComparison<'a> {
    data: &'a Data,
    /// Along the fitted runs, before and after.
    pub fitted: [Rollouts<'a>; 2],
    /// Along the held-out runs, before and after.
    pub held_out: [Rollouts<'a>; 2],
    noise: Noise,
    seed: u64,
}

impl<'a> ModelComparison<'a> {
    /// Both models along all data.
    ///
    /// # Errors
    /// When a model's formulas are malformed.
    pub fn of(data: &'a Data, model: &Model, choice: &Selected, seed: u64) -> Result<Self> {
        let both = |records: &'a [Record]| -> Result<[Rollouts<'a>; 2]> {
            Ok([Rollouts::new(model, records)?, Rollouts::new(&choice.after.model, records)?])
        };
        let noise = choice.after.noise();
        Ok(Self { data, fitted: both(&data.fitted)?, held_out: both(&data.held_out)?, noise, seed })
    }

    /// The gap at each horizon that fits the data.
    pub fn gaps(&self, horizons: &[f64]) -> Vec<Gap> {
        let gap = |&horizon: &f64| {
            let compare = |[before, after]: &[Rollouts; 2]| {
                let (before, after) = (before.errors(horizon), after.errors(horizon));
                (before.windows() > 0).then(|| BeforeAfter {
                    position_rms_before: before.position_rms(),
                    position_rms_after: after.position_rms(),
                    heading_rms_before: before.heading_rms(),
                    heading_rms_after: after.heading_rms(),
                })
            };
            let (fit, held_out) = (compare(&self.fitted), compare(&self.held_out));
            if fit.is_none() && held_out.is_none() {
                return None;
            }
            let judged = if held_out.is_some() { &self.held_out } else { &self.fitted };
            let floor = judged[1].floors(&[horizon], &self.noise, self.seed)[0];
            let noise_floor = Floor { position_rms: floor.position_rms(), heading_rms: floor.heading_rms() };
            Some(Gap { horizon_s: horizon, fit, held_out, noise_floor })
        };
        horizons.iter().filter_map(gap).collect()
    }

    /// The gap over horizons as a curve: of the held-out runs where they are long enough.
    pub fn curve(&self) -> GapCurve {
        let enough = |[before, _]: &[Rollouts; 2], h: f64| before.windows(h) >= FEWEST_WINDOWS;
        let judged = if enough(&self.held_out, 1.0) { &self.held_out } else { &self.fitted };
        let horizon: Vec<f64> = CURVE.into_iter().filter(|h| enough(judged, *h)).collect();
        let along = |p: &Rollouts| horizon.iter().map(|h| p.errors(*h).position_rms()).collect();
        let floor = judged[1].floors(&horizon, &self.noise, self.seed);
        GapCurve {
            before: along(&judged[0]),
            after: along(&judged[1]),
            floor: floor.iter().map(PredictionError::position_rms).collect(),
            horizon,
        }
    }

    /// The fitting data's gap after each addition.
    ///
    /// # Errors
    /// When a model's formulas are malformed.
    pub fn steps(&self, choice: &Selected, gaps: &[Gap]) -> Result<Vec<Step>> {
        let fitted: Vec<Gap> = gaps.iter().filter(|g| g.fit.is_some()).cloned().collect();
        let Some(horizon) = report::middle(&fitted).map(|g| g.horizon_s) else { return Ok(vec![]) };
        let step = |(added, model): &(String, Model)| {
            let gap_after = Rollouts::new(model, &self.data.fitted)?.errors(horizon).position_rms();
            Ok(Step { added: added.clone(), gap_after })
        };
        choice.steps.iter().map(step).collect()
    }
}

/// Held-out runs that are predicted worse with what was found, at the horizon at which they are worst, with the windows of
/// that horizon there are.
pub(crate) fn grown(gaps: &[Gap], windows: impl Fn(f64) -> usize) -> Option<Warning> {
    let of = |g: &Gap| {
        let held_out = g.held_out.as_ref()?;
        let gap = [held_out.position_rms_before, held_out.position_rms_after];
        Some(Growth { horizon_s: g.horizon_s, of_heading: false, gap, floor: g.noise_floor.position_rms })
    };
    let real = gaps.iter().filter_map(of).filter(Growth::is_real);
    let worst = real.max_by(|a, b| a.factor().total_cmp(&b.factor()))?;
    Some(Warning::HeldOutGapGrew { growth: worst, is_judged: windows(worst.horizon_s) >= FEWEST_WINDOWS })
}

/// The horizons asked for that no run is long enough for.
pub(crate) fn too_long(asked: &[f64], gaps: &[Gap]) -> Vec<Warning> {
    let is_missing = |h: &&f64| gaps.iter().all(|g| g.horizon_s != **h);
    asked.iter().filter(is_missing).map(|h| Warning::HorizonTooLong(*h)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_held_out_gap_that_grows_is_told_at_its_worst() {
        let gap = |horizon_s: f64, before: f64, after: f64| Gap {
            horizon_s,
            fit: None,
            held_out: Some(BeforeAfter {
                position_rms_before: before,
                position_rms_after: after,
                heading_rms_before: None,
                heading_rms_after: None,
            }),
            noise_floor: Floor { position_rms: 0.1, heading_rms: None },
        };
        for windows in [1, 2] {
            let told = grown(&[gap(1.0, 0.2, 0.3), gap(5.0, 0.2, 0.5), gap(30.0, 1.0, 0.4)], |_| windows);
            let Some(Warning::HeldOutGapGrew { growth, is_judged }) = told else { panic!("{told:?}") };
            assert_eq!((growth.horizon_s, growth.gap, is_judged), (5.0, [0.2, 0.5], windows == 2));
        }
        // Within the noise, and by a little, a gap does not grow.
        assert!(grown(&[gap(1.0, 0.05, 0.12), gap(5.0, 1.0, 1.2)], |_| 2).is_none());
    }
}
