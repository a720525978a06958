//! Effects added to a model one or two at a time, each asked whether it predicts.

use super::candidates::Ranked;
use super::unnamed_terms::is_term;
use crate::discrepancy::estimation::bounds::{is_at_an_end, vanishes};
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::evidence::wald_test::repeats;
use crate::discrepancy::rendering::summary::listed;
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::Model;

/// Most effects that are added.
pub(crate) const MOST: usize = 6;

/// A candidate effect and its evidence beside the effects already chosen.
#[derive(Clone, Debug)]
pub struct Scored {
    /// The effect at its fitted values.
    pub applied: Applied,
    /// Standard deviations its values have, to first order.
    pub std: Vec<f64>,
    /// BIC without minus BIC with the effect.
    pub delta_bic: f64,
}

pub(crate) const SCREEN: Effort = Effort { passes: 5, enough: 0.05, variances: false };
pub(crate) const FULL: Effort = Effort { passes: 15, enough: 1e-4, variances: true };

/// What a search ends with.
pub(crate) struct Grown {
    /// The model with what was found.
    pub fit: Fit,
    /// The models on the way, after each addition.
    pub steps: Vec<(String, Model)>,
    /// All candidates as they stood against the model the search began with.
    pub candidates: Vec<Scored>,
    /// What the data asked for at the end, and parts of them did not bear out.
    pub refused: Vec<Applied>,
}

/// Effects that are added together, and the model with them.
pub(crate) type Addition = (Vec<Applied>, Fit);

impl Grown {
    /// Nothing added yet.
    pub fn from(fit: &Fit) -> Self {
        Self { fit: fit.clone(), steps: vec![], candidates: vec![], refused: vec![] }
    }

    /// To a smaller model, which is then the only step.
    pub fn go_back_to(&mut self, smaller: Fit) {
        let step = (listed(smaller.model.free_effects().map(Applied::label)), smaller.model.clone());
        self.steps = if smaller.p.is_empty() { vec![] } else { vec![step] };
        self.fit = smaller;
    }
}

/// A search over a library.
pub(crate) struct Selection<'a> {
    pub problem: &'a Problem,
    /// The model as given, with its noise and jumps.
    pub before: &'a Fit,
    pub library: &'a [Effect],
    /// How many candidates the library has for the vehicle.
    pub size: f64,
    /// Most effects that are added.
    pub most: usize,
    /// Whether others are tried in the place of those chosen.
    pub exchanges: bool,
    /// Whether those the search begins with may be dropped.
    pub drops: bool,
}

/// A model without an effect that was found; one that the model as given has with a value of its own has it again.
pub(crate) fn without(model: &Model, effect: &Applied, given: &Model) -> Model {
    let mut smaller = model.clone();
    smaller.effects.retain(|e| !e.same_as(effect));
    let given = given.effects.iter().filter(|e| !e.free && e.same_as(effect));
    smaller.effects.extend(given.cloned());
    smaller
}

pub(crate) fn bic(fit: &Fit, sample_size: f64) -> f64 {
    fit.deviance + fit.size() * sample_size.ln()
}

/// ΔBIC of a model against a smaller one, its gain of deviance as far as rows are independent.
pub(crate) fn worth(larger: &Fit, smaller: &Fit, sample_size: f64) -> f64 {
    let more = larger.size() - smaller.size();
    (smaller.deviance - larger.deviance) / larger.dependence() - more * sample_size.ln()
}

impl Selection<'_> {
    /// Adds effects until nothing is left above the noise.
    pub fn grown(&self, before: &Fit, progress: &dyn Fn(&str)) -> Result<Grown> {
        let mut found = Grown::from(before);
        while found.steps.len() < self.most {
            progress(&format!("weighing {} candidates, {} chosen", self.size, found.steps.len()));
            let ranked = self.ranked(&found.fit)?;
            if found.steps.is_empty() {
                found.candidates = ranked.single.iter().map(|(s, _)| s.clone()).collect();
            }
            let (next, refused) = self.next(&found.fit, ranked)?;
            let Some((added, fit)) = next else {
                found.refused = refused;
                break;
            };
            let model = fit.model.clone();
            let mut next = if self.drops { self.pruned(fit, self.margin())? } else { fit };
            if self.exchanges {
                next = self.exchanged(next)?;
            }
            if same_effects(&next.model, &found.fit.model) {
                // Added only to be dropped: round and round would lead nowhere.
                break;
            }
            found.steps.push((listed(added.iter().map(Applied::label)), model));
            found.fit = next;
        }
        Ok(found)
    }

    /// The next effect to add, or two of them that are needed together; and what was refused before it.
    fn next(&self, base: &Fit, ranked: Ranked) -> Result<(Option<Addition>, Vec<Applied>)> {
        let fitted = ranked.single.into_iter().filter_map(|(s, fit)| Some((s, fit?)));
        let bar = |s: &Scored| if is_term(&s.applied) { 2.0 * self.margin() } else { self.margin() };
        // A gain must be large, and large still when what hangs together counts once.
        let independent = |fit: &Fit| worth(fit, base, base.sample_size.max(fit.sample_size)) > self.margin();
        let counts = |s: &Scored, fit: &Fit| s.delta_bic > bar(s) && independent(fit);
        let inside = |s: &Scored| !vanishes(&s.applied) && !is_at_an_end(&s.applied);
        let good = fitted.filter(|(s, fit)| counts(s, fit) && inside(s) && repeats(fit, &s.applied));
        let singles: Vec<(Scored, Fit)> = good.collect();
        let pair = self.pair(base, &ranked.pairs, singles.first().map(|(_, f)| f))?;
        let singles = singles.into_iter().map(|(s, fit)| (vec![s.applied], fit));
        self.predicting(base, pair.into_iter().chain(singles))
    }

    /// The first candidate that predicts the data it was not fitted to: what does not is no finding. Of terms the one
    /// that misses them least: each stands for a law that it is not, and which of them comes closest along all the data
    /// says little of other data.
    fn predicting(
        &self,
        base: &Fit,
        candidates: impl Iterator<Item = Addition>,
    ) -> Result<(Option<Addition>, Vec<Applied>)> {
        let mut best: Option<(f64, Addition)> = None;
        let mut refused = Vec::new();
        for (added, fit) in candidates {
            let is_term = matches!(&added[..], [one] if is_term(one));
            if best.is_some() && !is_term {
                continue;
            }
            if !self.problem.predicts_better(&fit, base)? {
                refused.extend(added);
                continue;
            }
            if !is_term {
                return Ok((Some((added, fit)), refused));
            }
            let gain = self.problem.missed_less(&fit, base)?;
            if best.as_ref().is_none_or(|(most, _)| gain > *most) {
                best = Some((gain, (added, fit)));
            }
        }
        Ok((best.map(|(_, found)| found), refused))
    }

    /// What a candidate must gain beyond BIC because the library is large.
    pub fn margin(&self) -> f64 {
        2.0 * self.size.ln()
    }

    /// A fit with noise and jumps of its own.
    pub fn refined(&self, fit: &Fit) -> Result<Option<Fit>> {
        self.problem.fit(&fit.model, &fit.starts, &fit.variances, FULL)
    }
}

/// An effect of a model.
pub(crate) fn find(model: &Model, like: &Applied) -> Option<Applied> {
    model.effects.iter().find(|e| e.same_as(like)).cloned()
}

/// Whether two models have the same effects free, whatever their values.
fn same_effects(a: &Model, b: &Model) -> bool {
    let within = |a: &Model, b: &Model| a.free_effects().all(|e| b.free_effects().any(|o| o.same_as(e)));
    within(a, b) && within(b, a)
}
