//! What held-out runs say of a model: whether they are predicted worse with what was found.

use super::before_after::Rollouts;
use super::warning::Warning;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::record::sensor_noise::Noise;
use crate::discrepancy::selection::choice::{Growth, Refusal, Selected};
use crate::error::Result;
use crate::model::Model;

/// A gap that is so many times as large with what was found, and as the noise floor, has grown.
const GREW: f64 = 1.25;
/// A growth over so few windows is chance.
const FEWEST: usize = 2;

/// What the report warns of first: the effects that held-out runs do not bear out.
pub(crate) fn refuted(selected: &Selected) -> impl Iterator<Item = Warning> {
    let of = selected.refused.iter().filter(|r| matches!(r.why, Refusal::HeldOut(_)));
    of.cloned().map(Warning::Refuted)
}

/// Held-out runs that judge models.
pub(crate) struct Judge<'a> {
    pub records: &'a [Record],
    pub horizons: &'a [f64],
    pub noise: Noise,
    pub seed: u64,
}

impl Judge<'_> {
    /// The held-out gap that grows most with the first of two models in the place of the second: of the position or of
    /// the heading, beyond the noise floor.
    pub fn growth(&self, with: &Model, without: &Model) -> Result<Option<Growth>> {
        let [with, without] = [Rollouts::new(with, self.records)?, Rollouts::new(without, self.records)?];
        let mut worst: Option<Growth> = None;
        for &horizon_s in self.horizons.iter().filter(|h| with.windows(**h) >= FEWEST) {
            let [after, before] = [with.errors(horizon_s), without.errors(horizon_s)];
            let floor = with.floors(&[horizon_s], &self.noise, self.seed)[0];
            let position = [before.position_rms(), after.position_rms(), floor.position_rms()];
            let heading = [&before, &after, &floor].map(|e| e.heading_rms().unwrap_or(0.0));
            for (of_heading, [before, after, floor]) in [(false, position), (true, heading)] {
                let growth = Growth { horizon_s, of_heading, gap: [before, after] };
                let grew = after > GREW * before && after > GREW * floor;
                if grew && worst.is_none_or(|w| growth.factor() > w.factor()) {
                    worst = Some(growth);
                }
            }
        }
        Ok(worst)
    }
}
