//! The search repeated without names that were contradicted.
//!
//! Two names at odds may share one cause between them: the false one is chosen first, since it has more values, and beside
//! it the right one is not alike in all runs. When the false one is contradicted, the right one is asked again.

use super::choice::{Refusal, Selected};
use super::refusals::Standing;
use super::search::{Search, SearchState, still_open};
use super::stability::{self, Stable};
use super::stepwise::same_effects;
use crate::discrepancy::estimation::unexplained::remains;
use crate::discrepancy::evidence::information_criterion::delta_bic;
use crate::effects::Applied;
use crate::error::Result;
use crate::model::effect_equation::is_term;
use crate::progress::OnProgress;

/// The choice with the names that take the place of contradicted ones; `None` where there are none.
///
/// Asked only where something remains; what is found passes the tests that every name passes.
pub(crate) fn second_choice(selection: &Search, choice: &Selected, progress: &OnProgress) -> Result<Option<Selected>> {
    let contradicted = contradicted(choice);
    if contradicted.is_empty() || !remains(&choice.after) || choice.after.model.free_effects().any(is_term) {
        return Ok(None);
    }
    let open = still_open(selection.library, &contradicted);
    let selection = Search { library: &open, ..*selection };
    let Selected { before, after, candidates, .. } = choice;
    let found = selection.grown(after, progress)?;
    let found = SearchState { steps: [&choice.steps[..], &found.steps].concat(), ..found };
    if same_effects(&found.fit.model, &after.model) {
        return Ok(None);
    }
    let Stable { mut grown, inconsistent, scatter } = stability::shared(&selection, found, progress)?;
    let (dropped, standing) = selection.keep_sampled_and_standing(&mut grown, scatter, progress)?;
    let Standing { chosen, refused, missed } = standing;
    let n = grown.fit.sample_size.max(after.sample_size);
    if chosen.len() <= choice.chosen.len() || delta_bic(&grown.fit, after, n) <= selection.margin() {
        return Ok(None);
    }
    let is_chosen = |a: &Applied| chosen.iter().any(|c| c.applied.same_as(a));
    let fallen = choice.inconsistent.iter().cloned().chain(inconsistent).filter(|a| !is_chosen(a));
    Ok(Some(Selected {
        before: before.clone(),
        inconsistent: fallen.collect(),
        sampling_sensitive: [&choice.sampling_sensitive[..], &dropped].concat(),
        refused: choice.refused.iter().cloned().chain(refused).filter(|r| !is_chosen(&r.applied)).collect(),
        after: grown.fit,
        chosen,
        steps: grown.steps,
        candidates: candidates.clone(),
        missed,
    }))
}

/// The names that have another value in a regime of driving: what is there has one.
fn contradicted(choice: &Selected) -> Vec<Applied> {
    let is_contradicted = |why: &Refusal| matches!(why, Refusal::Regime { .. });
    let names = choice.refused.iter().filter(|r| is_contradicted(&r.why) && !is_term(&r.applied));
    names.map(|r| r.applied.clone()).collect()
}
