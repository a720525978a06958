//! What held-out runs say of a model: whether they are predicted worse with what was found.

use super::before_after::{FEWEST_WINDOWS, Rollouts};
use super::warning::Warning;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::record::sensor_noise::Noise;
use crate::discrepancy::selection::choice::{GREW, Growth, Selected};
use crate::discrepancy::selection::refute::{Judging, JudgingRuns};
use crate::discrepancy::shooting::rollout::PredictionError;
use crate::error::Result;
use crate::model::Model;

/// What the report warns of first: the effects that held-out runs do not bear out.
pub(crate) fn refuted(selected: &Selected) -> impl Iterator<Item = Warning> {
    let of = selected.refused.iter().filter(|r| r.why.is_held_out());
    of.cloned().map(|r| Warning::Refuted(Box::new(r)))
}

/// Runs that judge models.
pub(crate) struct Judge<'a> {
    pub records: &'a [Record],
    pub which: Judging,
    pub horizons: &'a [f64],
    pub seed: u64,
}

impl JudgingRuns for Judge<'_> {
    fn which(&self) -> Judging {
        self.which
    }

    /// Without a heading each window's start is fitted to it by either model, and the gaps are not of one start.
    fn can_judge(&self) -> bool {
        !self.records.is_empty() && self.records.iter().all(|r| r.has_heading())
    }

    fn gaps(&self, [with, without]: [&Model; 2], noise: &Noise) -> Result<Vec<Growth>> {
        let [with, without] = [Rollouts::new(with, self.records)?, Rollouts::new(without, self.records)?];
        let mut found = vec![];
        for &horizon_s in self.horizons.iter().filter(|h| with.windows(**h) >= FEWEST_WINDOWS) {
            let errors = [without.errors(horizon_s), with.errors(horizon_s)];
            let position = errors.each_ref().map(PredictionError::position_rms);
            let heading = match errors.each_ref().map(PredictionError::heading_rms) {
                [Some(before), Some(after)] => Some([before, after]),
                _ => None,
            };
            // The floor is asked where something grows; no gap is beyond one that is not a number.
            let grows = [Some(position), heading].into_iter().flatten().any(|[before, after]| after > GREW * before);
            let floor = if grows { with.floors(&[horizon_s], noise, self.seed)[0] } else { PredictionError::default() };
            found.push(Growth { horizon_s, of_heading: false, gap: position, floor: floor.position_rms() });
            found.extend(heading.map(|gap| {
                let floor = floor.heading_rms().unwrap_or(f64::NAN);
                Growth { horizon_s, of_heading: true, gap, floor }
            }));
        }
        Ok(found)
    }
}
