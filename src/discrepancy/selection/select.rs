//! Which effects are missing: candidates ranked by evidence on the fitting data alone.

use super::candidates::FINALISTS;
use super::input_sampling::{InputSampling, keep_sampled};
use super::memo::Memo;
use super::refusals::Standing;
use super::scopes;
use super::search::{Search, SearchState, find};
use super::second_choice::second_choice;
use super::stability;
use super::stability::Stable;
use super::transients;
use super::unnamed_terms;
use super::walks;
use crate::discrepancy::estimation::fit::Effort;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::estimation::unexplained::remains;
use crate::discrepancy::evidence::chi_squared::tail;
use crate::discrepancy::evidence::heterogeneity::spreads;
use crate::discrepancy::evidence::information_criterion::{bic, delta_bic};
use crate::discrepancy::evidence::jackknife::Jackknife;
use crate::discrepancy::evidence::parametric_bootstrap;
use crate::discrepancy::selection::choice::{Refusal, Selected, SelectedEffect, Weighed};
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::Model;
use crate::progress::{OnProgress, Stage, begin, tell};

pub use super::search::Candidate;

/// A rival whose evidence is this close to the chosen effect's is not told from it.
pub(crate) const CLOSE: f64 = 6.0;

/// A gain so large that the exact law of chance gains does not matter.
const BEYOND_DOUBT: f64 = 60.0;
/// Times a law is sought again after names fell beside it, at most.
const LAWS_AGAIN: usize = 2;

/// Adds effects of the library until nothing is left above the noise.
///
/// A candidate must beat BIC = deviance + k·ln n by a margin of 2·ln M for a library of M candidates: with
/// nothing hidden the best of M would otherwise pass by chance. After each addition earlier ones are asked
/// again whether they are still needed, and whether another would do better in their place.
pub fn choose(problem: &Problem, model: &Model, library: &[Effect], progress: &OnProgress) -> Result<Option<Selected>> {
    begin(progress, Stage::ModelFit)?;
    let starts = problem.starts(model)?;
    let Some(before) = problem.fit(model, &starts, &problem.variances, Effort::FULL)? else { return Ok(None) };
    let quick = transients::without_transients(library);
    let memo = Memo::default();
    let selection = Search { memo: Some(&memo), ..Search::over(problem, &before, &quick) };
    let named = transients::search(&selection, library, selection.grown(&before, progress)?)?;
    let grown = match scopes::search(&selection, &named, progress)? {
        Some(partial) if !remains(&partial.fit) && scopes::are_limits_told(&partial.fit) => partial,
        partial => {
            // What holds in part and leaves a rest, or has a limit that the data do not tell, may imitate a law: the one
            // that explains the data better stands.
            let law = unnamed_terms::search(&selection, &named, &[], progress)?;
            let n = named.fit.sample_size;
            let all = [law, partial].into_iter().flatten();
            all.min_by(|a, b| bic(&a.fit, n).total_cmp(&bic(&b.fit, n))).unwrap_or(named)
        }
    };
    let Stable { mut grown, inconsistent, scatter } = stability::search(&selection, grown, progress)?;
    let InputSampling { dropped: mut sampling_sensitive, missed } = keep_sampled(&selection, &mut grown, progress)?;
    walks::let_walk(&selection, &mut grown.fit)?;
    // Where something went, the values no longer stand where they stood.
    let scatter = scatter.filter(|_| sampling_sensitive.is_empty());
    let Standing { mut chosen, mut refused, mut missed } =
        selection.keep_standing(&mut grown, scatter.as_ref(), missed, progress)?;
    for _ in 0..LAWS_AGAIN {
        let fallen = refused.iter().map(|r| &r.applied).chain(&inconsistent).chain(&sampling_sensitive).cloned();
        let fallen: Vec<Applied> = fallen.collect();
        let imitated = refused.iter().any(|r| matches!(r.why, Refusal::Imitation(_)));
        let found = unnamed_terms::without_fallen(&selection, &grown, &fallen, imitated, progress)?;
        let Some(found) = found else { break };
        grown = found;
        let (dropped, again) = selection.keep_sampled_and_standing(&mut grown, None, progress)?;
        sampling_sensitive.extend(dropped);
        refused.extend(again.refused);
        (chosen, missed) = (again.chosen, again.missed);
    }
    let SearchState { fit: after, steps, candidates, .. } = grown;
    let choice =
        Selected { before, after, chosen, steps, candidates, inconsistent, sampling_sensitive, refused, missed };
    let second = second_choice(&Search::over(problem, &choice.before, &quick), &choice, progress)?;
    let choice = second.unwrap_or(choice);
    let walking = walks::in_its_place(&Search::over(problem, &choice.before, &quick), &choice)?;
    Ok(Some(walking.unwrap_or(choice)))
}

impl Search<'_> {
    /// Deviations of every chosen effect, and what it is worth; its probability and its rivals are not asked for.
    ///
    /// `missed` is what the interpolation of the inputs may make up of each value; an offset no rows average out.
    pub(crate) fn weighed(
        &self,
        fit: &Fit,
        scatter: Option<&Jackknife>,
        missed: &[f64],
        progress: &OnProgress,
    ) -> Result<Vec<Weighed>> {
        let mut at = 0;
        let mut found = Vec::new();
        let apart = spreads(fit);
        let chosen: Vec<Applied> = fit.model.free_effects().cloned().collect();
        let of = chosen.len();
        for (done, applied) in chosen.into_iter().enumerate() {
            tell(progress, Stage::Evidence, done, of)?;
            let k = applied.values.len();
            // What runs scatter by counts where it is more than their noise, and what hangs together in it, explains.
            let runs = |i: usize| fit.between_runs.as_ref().map_or(0.0, |c| c[(i, i)].sqrt());
            let random = |i: usize| apart[i].as_ref().filter(|s| s.is_real()).map_or(0.0, |s| s.std);
            let between = |i: usize| scatter.map_or(0.0, |s| s.std[i]).max(runs(i)).max(random(i));
            let chance = |i: usize| fit.variance(i).map(|v| v.sqrt().max(between(i)));
            let spread = |i: usize| chance(i).map(|std| missed.get(i).map_or(std, |e| std.hypot(*e)));
            let std = (at..at + k).map(spread).collect();
            at += k;
            let Some(smaller) = self.without(fit, &applied)? else { continue };
            let n = fit.sample_size.max(smaller.sample_size);
            let delta_bic = delta_bic(fit, &smaller, n);
            let effect = SelectedEffect { applied, std, delta_bic, p_value: f64::NAN, rivals: vec![] };
            found.push(Weighed { effect, without: smaller });
        }
        Ok(found)
    }

    /// The same with the probability and the rivals of each: asked once, of what stands. Where χ² does not hold the
    /// probability is that of data drawn without the effect.
    pub(crate) fn examined(
        &self,
        fit: &Fit,
        weighed: Vec<Weighed>,
        progress: &OnProgress,
    ) -> Result<Vec<SelectedEffect>> {
        let one = |Weighed { effect, without }: Weighed| {
            let gain = (without.deviance - fit.deviance).max(0.0) / fit.inflation_beside(&without);
            // Beside a rest draws would be of a model that is known to be wrong.
            let is_drawn = !parametric_bootstrap::is_regular(&effect.applied) && gain <= BEYOND_DOUBT && !remains(fit);
            let p_value = match is_drawn {
                true => self.problem.chance_p_value(&without, &effect.applied, gain, progress)?,
                false => tail(gain, effect.applied.values.len()),
            };
            let rivals = self.rivals(fit, &effect.applied)?;
            Ok(SelectedEffect { p_value, rivals, ..effect })
        };
        weighed.into_iter().map(one).collect()
    }

    /// Effects that explain the data as well in the place of a chosen one, where and when that holds.
    fn rivals(&self, fit: &Fit, chosen: &Applied) -> Result<Vec<Applied>> {
        let within = self.library_within(chosen);
        let search = Search { library: within.as_deref().unwrap_or(self.library), ..*self };
        let n = fit.sample_size;
        let behind = |f: &Fit| (bic(f, n) - bic(fit, n)) / fit.variance_inflation();
        let near = search.in_place_of(fit, chosen)?.into_iter().filter(|(_, f)| behind(f) < 4.0 * CLOSE);
        let mut found = Vec::new();
        for (applied, rough) in near.take(4 * FINALISTS) {
            let full = self.refit(&rough)?.unwrap_or(rough);
            if behind(&full) < CLOSE {
                found.extend(find(&full.model, &applied));
            }
        }
        Ok(found)
    }
}
