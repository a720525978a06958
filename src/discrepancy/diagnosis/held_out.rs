//! What held-out runs say of a model: whether they are predicted worse with what was found.

use super::before_after::Rollouts;
use super::warning::Warning;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::record::sensor_noise::Noise;
use crate::discrepancy::selection::choice::{Growth, Refusal, Selected};
use crate::discrepancy::selection::refute::HeldOut;
use crate::discrepancy::shooting::rollout::PredictionError;
use crate::error::Result;
use crate::model::Model;

/// Windows of a horizon at least: what fewer show is chance.
const FEWEST: usize = 2;

/// What the report warns of first: the effects that held-out runs do not bear out.
pub(crate) fn refuted(selected: &Selected) -> impl Iterator<Item = Warning> {
    let of = selected.refused.iter().filter(|r| matches!(r.why, Refusal::HeldOut(_)));
    of.cloned().map(|r| Warning::Refuted(Box::new(r)))
}

/// Held-out runs that judge models.
pub(crate) struct Judge<'a> {
    pub records: &'a [Record],
    pub horizons: &'a [f64],
    pub noise: Noise,
    pub seed: u64,
}

impl HeldOut for Judge<'_> {
    fn gaps(&self, with: &Model, without: &Model) -> Result<Vec<Growth>> {
        // Without a heading each window's start is fitted to it by either model, and the gaps are not of one start.
        if self.records.iter().any(|r| !r.has_heading) {
            return Ok(vec![]);
        }
        let [with, without] = [Rollouts::new(with, self.records)?, Rollouts::new(without, self.records)?];
        let mut found = vec![];
        for &horizon_s in self.horizons.iter().filter(|h| with.windows(**h) >= FEWEST) {
            let floor = with.floors(&[horizon_s], &self.noise, self.seed)[0];
            let errors = [without.errors(horizon_s), with.errors(horizon_s), floor];
            let [before, after, floor] = errors.each_ref().map(PredictionError::position_rms);
            found.push(Growth { horizon_s, of_heading: false, gap: [before, after], floor });
            if let [Some(before), Some(after), Some(floor)] = errors.each_ref().map(PredictionError::heading_rms) {
                found.push(Growth { horizon_s, of_heading: true, gap: [before, after], floor });
            }
        }
        Ok(found)
    }
}
