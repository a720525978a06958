//! Whether the clocks of inputs and measurements match: a delay that drifts along a run says they do not.

use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::shooting::windows;
use crate::effects::{Applied, of_clock};
use crate::error::Result;
use crate::model::Model;
use rayon::prelude::*;

/// Shortest run whose clocks are compared, s.
const SHORTEST: f64 = 30.0;
/// The drift over a run that a search begins with, s.
const TRIED: f64 = 0.05;
/// The drift over a run that no sensor's changing lag explains, s; and in times between rows.
const MUCH: [f64; 2] = [0.1, 1.5];
/// Deviance that a drift must be worth: far beyond chance and beyond what another small misfit imitates.
const WORTH: f64 = 40.0;
/// A clock is blamed where it explains more than this share of what remains: a law that grows along a run, as speed
/// does on a ramp, is imitated by a drift, which leaves most of it.
const MOST_OF_IT: f64 = 0.5;
/// Runs that are asked, the first ones: each costs some fits.
const MOST_RUNS: usize = 6;
/// How often the drift is doubled: up to some seconds.
const MOST_DOUBLINGS: usize = 7;
const EFFORT: Effort = Effort { passes: 6, enough: 0.1, ..Effort::FULL };

/// How the clock of the inputs runs against the clock of the measurements.
#[derive(Clone, Debug)]
pub struct Drift {
    /// Name of the run.
    pub run: String,
    /// By how much the delay changes from the first row to the last, s.
    pub total: f64,
    /// The deviance that this is worth, as far as it is independent.
    pub gain: f64,
    /// The share of what remains unexplained that goes with it.
    pub explained: f64,
    /// Time between rows, s.
    pub step: f64,
}

impl Drift {
    /// Whether clocks that match could not do this.
    pub fn is_mismatch(&self) -> bool {
        self.total.abs() > MUCH[0].max(MUCH[1] * self.step) && self.gain > WORTH && self.explained > MOST_OF_IT
    }
}

impl Problem {
    /// The drift of the clocks in every run that is long enough, beside a fit.
    ///
    /// Each run is fitted again with its inputs stretched in time by a small rate, the delay being free.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn drifts(&self, fit: &Fit) -> Result<Vec<Drift>> {
        let long = |r: &&Record| duration(r) >= SHORTEST;
        let runs: Vec<usize> = (0..self.records.len()).filter(|i| long(&&self.records[*i])).take(MOST_RUNS).collect();
        let found: Vec<Option<Drift>> = runs.into_par_iter().map(|i| self.drift(fit, i)).collect::<Result<_>>()?;
        Ok(found.into_iter().flatten().collect())
    }

    fn drift(&self, fit: &Fit, run: usize) -> Result<Option<Drift>> {
        let record = &self.records[run];
        let model = with_delay(&fit.model);
        let own = || self.plan.iter().zip(&fit.window_states).filter(|(s, _)| s.record == run);
        let starts: windows::WindowStates = own().map(|(_, s)| s.clone()).collect();
        let plan = own().map(|(s, _)| windows::Segment { record: 0, ..s.clone() }).collect();
        let alone = Problem { records: vec![record.clone()], plan, ..self.clone() };
        let fitted = |rate: f64| -> Result<At> {
            let mut stretched = alone.clone();
            stretched.records[0].signals = record.signals.stretched(rate);
            Ok(stretched.fit(&model, &starts, &fit.variances, EFFORT)?.map_or(At::NOWHERE, |f| At::of(&f)))
        };
        let tried = TRIED / duration(record);
        let here = fitted(0.0)?;
        let mut best = (0.0, here);
        for direction in [-tried, tried] {
            let mut rate = direction;
            // Far from where the clocks agree the deviance is flat: so long as it falls, twice as far.
            for _ in 0..MOST_DOUBLINGS {
                let there = fitted(rate)?;
                if there.deviance >= best.1.deviance {
                    break;
                }
                best = (rate, there);
                rate *= 2.0;
            }
        }
        let (rate, there) = best;
        let gain = (here.deviance - there.deviance) / there.variance_inflation;
        let (run, total, step) = (record.name.clone(), rate * duration(record), record.step());
        let explained = 1.0 - there.unexplained / here.unexplained.max(f64::MIN_POSITIVE);
        Ok(gain.is_finite().then_some(Drift { run, total, gain, explained, step }))
    }
}

/// A run at some drift of its clocks.
#[derive(Clone, Copy)]
struct At {
    deviance: f64,
    variance_inflation: f64,
    /// What remains, by the deviance it is worth.
    unexplained: f64,
}

impl At {
    const NOWHERE: At = At { deviance: f64::INFINITY, variance_inflation: 1.0, unexplained: f64::INFINITY };

    fn of(fit: &Fit) -> Self {
        let unexplained = fit.unexplained.iter().sum();
        Self { deviance: fit.deviance, variance_inflation: fit.variance_inflation(), unexplained }
    }
}

fn duration(record: &Record) -> f64 {
    let [first, last] = record.span();
    last - first
}

/// The model with a delay that a fit may change.
fn with_delay(model: &Model) -> Model {
    let Some(effect) = of_clock() else { return model.clone() };
    let known = model.effects.iter().find(|e| e.effect.is_of_clock()).map_or(0.0, |e| e.values[0]);
    model.clone().with_effect(Applied::new(effect, None, vec![known]).freed())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_lasts_as_long_whenever_its_clock_begins() {
        let time: Vec<f64> = (0..8).map(|i| 1.7e9 + f64::from(i)).collect();
        let columns = vec![vec![0.0; 8]; 3];
        let timing = crate::motion::Timing::Sample;
        let mut record = Record::new("run.csv", time, columns, true, &[vec![1.0; 8]], timing);
        assert_eq!(duration(&record), 7.0);
        record.rows = 2..6;
        assert_eq!(duration(&record), 3.0);
    }

    #[test]
    fn clocks_are_blamed_for_long_drifts_that_explain_what_remains() {
        let drift = |total, gain, explained| Drift { run: "run.csv".into(), total, gain, explained, step: 0.02 };
        assert!(drift(0.3, 90.0, 0.9).is_mismatch());
        assert!(drift(-0.3, 90.0, 0.9).is_mismatch());
        // As a law that grows along a run would have it.
        assert!(!drift(0.3, 90.0, 0.1).is_mismatch());
        assert!(!drift(0.05, 90.0, 0.9).is_mismatch());
        assert!(!drift(0.3, 30.0, 0.9).is_mismatch());
    }
}
