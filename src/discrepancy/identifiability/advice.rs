//! The manoeuvre that would mend most of what the runs leave open.

use super::confusable_pairs::{separating, told_apart};
use super::detection_power::{Candidate, DetectionThreshold, ExpectedDetection, gain};
use super::expected_gain::Background;
use super::fisher_information::Driven;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::problem::{Problem, starts};
use crate::discrepancy::experiment::design::{ALIKE, PredictedExperiment};
use crate::discrepancy::experiment::manoeuvre::{Manoeuvre, library};
use crate::discrepancy::experiment::next_step::{Mended, NextStep};
use crate::discrepancy::shooting::windows::plan;
use crate::error::Result;
use rayon::prelude::*;

/// Things that are looked at, of either kind.
const MOST: usize = 6;

/// What is to be mended.
pub(crate) struct Open<'a> {
    pub all: &'a [Candidate],
    pub shown: &'a [ExpectedDetection],
    pub ground: Background,
    /// Candidates that would be missed.
    pub missed: Vec<usize>,
    /// Pairs that would not be told apart, though they differ.
    /// And by what they are told apart now.
    pub pairs: Vec<([usize; 2], f64)>,
    pub bar: DetectionThreshold,
}

/// How far a manoeuvre mends each thing, one for what is mended.
struct Tried {
    manoeuvre: &'static Manoeuvre,
    shares: Vec<f64>,
}

impl Tried {
    fn worth(&self) -> f64 {
        // What is mended counts far more than what is nearly so.
        self.shares.iter().map(|s| if *s >= 1.0 { 1.0 } else { 0.1 * s }).sum()
    }
}

impl Open<'_> {
    /// What to drive; `None` with nothing open or for inputs that cannot be planned.
    pub fn advice(&self, problem: &Problem, fit: &Fit) -> Result<Option<NextStep>> {
        if self.missed.is_empty() && self.pairs.is_empty() {
            return Ok(None);
        }
        let Some(thought) = PredictedExperiment::of(problem, fit) else { return Ok(None) };
        let mend = |m: &'static Manoeuvre| -> Result<Option<Tried>> {
            let Some(driven) = self.driven(&thought, fit, m)? else { return Ok(None) };
            Ok(Some(Tried { manoeuvre: m, shares: self.shares(&driven, &thought, fit)? }))
        };
        let all: Vec<&'static Manoeuvre> = library(&thought.envelope).collect();
        let tried: Vec<Tried> =
            all.into_par_iter().map(mend).collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
        let most = tried.iter().map(Tried::worth).fold(0.0, f64::max);
        let best = tried.iter().find(|m| m.worth() >= ALIKE * most && most > 0.0);
        let step =
            |best: &Tried| NextStep::Mend { mends: self.mended(best), manoeuvre: thought.planned(best.manoeuvre) };
        Ok(best.map(step))
    }

    fn driven(&self, thought: &PredictedExperiment, fit: &Fit, m: &Manoeuvre) -> Result<Option<Driven>> {
        let Some(record) = thought.driven(m, &fit.model) else { return Ok(None) };
        let records = vec![record];
        let plan = plan(&records);
        let starts = starts(&fit.model, &records, &plan)?;
        Ok(Some(Driven { records, plan, starts }))
    }

    /// By how much the runs and the manoeuvre together mend each thing, at most one.
    fn shares(&self, driven: &Driven, thought: &PredictedExperiment, fit: &Fit) -> Result<Vec<f64>> {
        let ground = Background { calm: thought.scaled(self.ground.calm.clone()), ..self.ground };
        let seen = |c: &usize| -> Result<f64> {
            let marks = driven.marks(&fit.model, &[&self.all[*c].applied])?;
            let new = marks.map_or(0.0, |m| gain(&m, &self.all[*c], &ground));
            let both = ExpectedDetection { gain: self.shown[*c].gain + new, smallest: vec![] };
            Ok(both.strength(self.all, *c, &self.bar).min(1.0))
        };
        let told = |([a, b], before): &([usize; 2], f64)| -> Result<f64> {
            let new = told_apart(&fit.model, driven, self.all, *a, *b, &ground)?;
            Ok(((before + new) / separating()).min(1.0))
        };
        let seen = self.missed.iter().take(MOST).map(seen);
        seen.chain(self.pairs.iter().take(MOST).map(told)).collect()
    }

    /// What a manoeuvre mends by itself.
    fn mended(&self, best: &Tried) -> Vec<Mended> {
        let effect = |c: usize| self.all[c].applied.clone();
        let shown = self.missed.iter().take(MOST).map(|c| Mended::Shown(Box::new(effect(*c))));
        let told =
            self.pairs.iter().take(MOST).map(|([a, b], _)| Mended::Separated(Box::new([effect(*a), effect(*b)])));
        let mended = shown.chain(told).zip(&best.shares).filter(|(_, share)| **share >= 1.0);
        mended.map(|(what, _)| what).collect()
    }
}
