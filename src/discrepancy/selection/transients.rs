//! Effects whose quasi-static limit has been chosen, asked for where that limit does not explain everything.

use super::search::{Search, SearchState, find, without_effect};
use crate::discrepancy::estimation::unexplained::is_wanted;
use crate::discrepancy::evidence::information_criterion::bic;
use crate::effects::{Applied, Effect};
use crate::error::Result;

/// The effects of a library that are asked for from the beginning: those without a limit among the others.
pub(crate) fn without_transients(library: &[Effect]) -> Vec<Effect> {
    library.iter().filter(|e| e.limit.is_none()).cloned().collect()
}

/// What was found with an effect in the place of its limit, where that explains the data better by more than a margin
/// or as well with fewer effects.
pub(crate) fn search(selection: &Search, library: &[Effect], mut named: SearchState) -> Result<SearchState> {
    // Where nothing remains but much was needed, the others may stand for the transients.
    if !is_wanted(&named.fit) {
        return Ok(named);
    }
    for effect in library {
        let is_limit = |a: &&Applied| effect.limit.as_ref() == Some(&a.effect.id);
        let Some(limit) = named.fit.model.free_effects().find(is_limit) else { continue };
        let whole = Applied::new(effect, limit.trailer, limit.values.clone());
        if let Some(better) = in_place_of(selection, &named, limit, &whole)? {
            named = better;
        }
    }
    Ok(named)
}

fn in_place_of(
    selection: &Search,
    named: &SearchState,
    limit: &Applied,
    whole: &Applied,
) -> Result<Option<SearchState>> {
    if !whole.is_in_range() {
        return Ok(None);
    }
    let model = without_effect(&named.fit.model, limit, &selection.before.model).with_effect(whole.clone().freed());
    let Some(fit) = selection.fit_instead(&named.fit, &model)? else { return Ok(None) };
    let fit = selection.eliminate_backward(fit, selection.margin())?;
    if find(&fit.model, whole).is_none() {
        return Ok(None);
    }
    let n = fit.sample_size.max(named.fit.sample_size);
    let gain = bic(&named.fit, n) - bic(&fit, n);
    let fewer = fit.model.free_effects().count() < named.fit.model.free_effects().count();
    let better = match fewer {
        true => gain > 0.0,
        false => gain > selection.margin() && selection.problem.predicts_better(&fit, &named.fit)?,
    };
    if !better {
        return Ok(None);
    }
    let mut steps = named.steps.clone();
    steps.push((whole.label(), fit.model.clone()));
    Ok(Some(SearchState { fit, steps, candidates: named.candidates.clone(), refused: named.refused.clone() }))
}
