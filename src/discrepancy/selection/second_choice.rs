//! The search repeated without names that were contradicted.
//!
//! Two names at odds may share one cause between them: the false one is chosen first, since it has more values, and beside
//! it the right one is not alike in all runs. When the false one is contradicted, the right one is asked again.

use super::choice::{Refusal, Refused, Selected};
use super::refusals::Standing;
use super::search::{Search, SearchState, still_open};
use super::stability::{self, Stable};
use super::stepwise::same_effects;
use crate::discrepancy::estimation::unexplained::remains;
use crate::discrepancy::evidence::information_criterion::delta_bic;
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::effect_equation::is_term;
use crate::progress::OnProgress;

/// Searches at most: each is without the names that were contradicted before.
const ROUNDS: usize = 3;

/// The choice with the names that take the place of contradicted ones; `None` where there are none.
///
/// Asked only where something remains; what is found passes the tests that every name passes. Once the whole library was
/// asked, only what every vehicle has is asked again: of the others one after another would do for a rest.
pub(crate) fn second_choice(selection: &Search, choice: &Selected, progress: &OnProgress) -> Result<Option<Selected>> {
    if !remains(&choice.after) || choice.after.model.free_effects().any(is_term) {
        return Ok(None);
    }
    let mut refused = choice.refused.clone();
    let mut asked: Vec<Effect> = selection.library.to_vec();
    let mut is_contradicted_anew = refused.iter().any(is_contradicted);
    for _ in 0..ROUNDS {
        if !is_contradicted_anew {
            break;
        }
        let open = still_open(&asked, &contradicted(&refused));
        match without_contradicted(&Search { library: &open, ..*selection }, choice, &refused, progress)? {
            Ok(found) => return Ok(Some(found)),
            Err(more) => {
                is_contradicted_anew = more.iter().any(is_contradicted);
                refused.extend(more);
            }
        }
        asked.retain(|e| e.basic);
    }
    Ok(None)
}

/// More than was chosen before, or what was refused instead.
fn without_contradicted(
    selection: &Search,
    choice: &Selected,
    before: &[Refused],
    progress: &OnProgress,
) -> Result<std::result::Result<Selected, Vec<Refused>>> {
    let Selected { before: bare, after, candidates, .. } = choice;
    let found = selection.grown(after, progress)?;
    let found = SearchState { steps: [&choice.steps[..], &found.steps].concat(), ..found };
    if same_effects(&found.fit.model, &after.model) {
        return Ok(Err(vec![]));
    }
    let Stable { mut grown, inconsistent, scatter } = stability::shared(selection, found, progress)?;
    let (dropped, standing) = selection.keep_sampled_and_standing(&mut grown, scatter, progress)?;
    let Standing { chosen, refused, missed } = standing;
    let n = grown.fit.sample_size.max(after.sample_size);
    if chosen.len() <= choice.chosen.len() || delta_bic(&grown.fit, after, n) <= selection.margin() {
        return Ok(Err(refused));
    }
    let is_chosen = |a: &Applied| chosen.iter().any(|c| c.applied.same_as(a));
    let fallen = choice.inconsistent.iter().cloned().chain(inconsistent).filter(|a| !is_chosen(a));
    Ok(Ok(Selected {
        before: bare.clone(),
        inconsistent: fallen.collect(),
        sampling_sensitive: [&choice.sampling_sensitive[..], &dropped].concat(),
        refused: before.iter().cloned().chain(refused).filter(|r| !is_chosen(&r.applied)).collect(),
        after: grown.fit,
        chosen,
        steps: grown.steps,
        candidates: candidates.clone(),
        missed,
    }))
}

/// The names that have another value in a regime of driving, or that the very runs they were fitted to refute.
fn contradicted(refused: &[Refused]) -> Vec<Applied> {
    refused.iter().filter(|r| is_contradicted(r)).map(|r| r.applied.clone()).collect()
}

fn is_contradicted(refused: &Refused) -> bool {
    matches!(refused.why, Refusal::Regime { .. } | Refusal::FittedRuns(_)) && !is_term(&refused.applied)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::evidence::regime_stability::Regime;
    use crate::discrepancy::fixtures::applied;
    use crate::discrepancy::selection::choice::Growth;

    /// What another part of the data, or the very runs, contradict; not what was worth too little, or held-out runs refute.
    #[test]
    fn names_that_the_fitted_data_contradict_are_not_asked_again() {
        let growth = Growth { horizon_s: 5.0, of_heading: false, gap: [0.1, 0.2], floor: 0.01 };
        let of = |id: &str, why: Refusal| Refused { applied: applied(id), std: vec![], why };
        let regime = Refusal::Regime { regime: Regime::Late, values: [0.1, -0.1] };
        let refused = [
            of("traverse-creep", regime),
            of("lever-arm", Refusal::FittedRuns(growth)),
            of("side-slope", Refusal::HeldOut(growth)),
            of("heading-misalignment", Refusal::BelowBar),
        ];
        let ids: Vec<String> = contradicted(&refused).into_iter().map(|a| a.effect.id).collect();
        assert_eq!(ids, ["traverse-creep", "lever-arm"]);
    }
}
