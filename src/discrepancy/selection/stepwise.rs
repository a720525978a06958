//! Forward stepwise selection: effects added one or two at a time, each asked whether it predicts.

use super::candidates::Ranking;
use super::input_noise;
use super::search::{Addition, Candidate, Search, SearchState};
use crate::discrepancy::estimation::bounds::{is_possible, vanishes};
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::evidence::information_criterion::delta_bic;
use crate::discrepancy::evidence::wald_test::{reaches_an_end, repeats};
use crate::effects::Applied;
use crate::error::Result;
use crate::model::Model;
use crate::model::effect_equation::is_term;
use crate::progress::OnProgress;
use crate::wording::listed;

impl Search<'_> {
    /// Adds effects until nothing is left above the noise.
    pub fn grown(&self, before: &Fit, progress: &OnProgress) -> Result<SearchState> {
        let mut found = SearchState::from(before);
        while found.steps.len() < self.most {
            let ranked = self.ranked(&found.fit, found.steps.len(), progress)?;
            if found.steps.is_empty() {
                found.candidates = ranked.single.iter().map(|(s, _)| s.clone()).collect();
            }
            let (next, refused) = self.next(&found.fit, ranked)?;
            let Some((added, fit)) = next else {
                found.refused = refused;
                break;
            };
            let model = fit.model.clone();
            let mut next = if self.drops { self.eliminate_backward(fit, self.margin())? } else { fit };
            if self.exchanges {
                next = self.swap(next)?;
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
    fn next(&self, base: &Fit, ranked: Ranking) -> Result<(Option<Addition>, Vec<Applied>)> {
        let fitted = ranked.single.into_iter().filter_map(|(s, fit)| Some((s, fit?)));
        let bar = |s: &Candidate| if is_term(&s.applied) { 2.0 * self.margin() } else { self.margin() };
        // A gain must be large, and large still when what hangs together counts once.
        let independent = |fit: &Fit| delta_bic(fit, base, base.sample_size.max(fit.sample_size)) > self.margin();
        let counts = |s: &Candidate, fit: &Fit| s.delta_bic > bar(s) && independent(fit);
        let inside = |s: &Candidate| !vanishes(&s.applied) && is_possible(&s.applied);
        // What noise of the inputs asks for is not built upon, nor two effects that are one.
        let is_sound =
            |fit: &Fit| Ok(input_noise::taken_back(self.problem, fit).is_none() && !self.has_two_that_are_one(fit)?);
        let tells = |s: &Candidate, fit: &Fit| repeats(fit, &s.applied) && !reaches_an_end(fit, &s.applied);
        let good = fitted.filter(|(s, fit)| counts(s, fit) && inside(s) && tells(s, fit));
        let sound = |of: Addition| Ok(is_sound(&of.1)?.then_some(of));
        let singles = good.map(|(s, fit)| sound((vec![s.applied], fit)));
        let singles: Vec<Addition> = singles.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
        let pair = self.pair(base, &ranked.pairs, singles.first().map(|(_, f)| f))?.map(sound).transpose()?.flatten();
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
}

/// Whether two models have the same effects free, whatever their values.
pub(super) fn same_effects(a: &Model, b: &Model) -> bool {
    let within = |a: &Model, b: &Model| a.free_effects().all(|e| b.free_effects().any(|o| o.same_as(e)));
    within(a, b) && within(b, a)
}
