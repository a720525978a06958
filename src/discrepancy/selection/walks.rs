//! Effects whose parameter walks at random, told where that explains most of what a constant leaves.

use super::scopes::is_partial;
use super::search::Search;
use crate::discrepancy::estimation::fit::Fit;
use crate::effects::{Applied, RandomWalk};
use crate::error::Result;
use crate::model::effect_equation::is_term;

/// The walk of an effect's parameter, where it pays, and what it gains.
fn walking(search: &Search, fit: &Fit, effect: &Applied) -> Result<Option<(RandomWalk, f64)>> {
    if is_term(effect) || is_partial(effect) {
        return Ok(None);
    }
    let price = search.margin() + fit.sample_size.ln();
    let walk = search.problem.walk(fit, effect)?.filter(|w| w.gain / fit.noise_correlation_time > price);
    let parameter = effect.effect.parameters.keys().next().cloned().unwrap_or_default();
    Ok(walk.map(|w| (RandomWalk { parameter, per_sqrt_s: w.per_sqrt_s, std: Some(w.std) }, w.gain)))
}

/// Lets the one effect of a fit walk whose walk gains most.
pub(crate) fn let_walk(search: &Search, fit: &mut Fit) -> Result<()> {
    if fit.model.free_effects().any(|e| e.effect.walk.is_some()) {
        return Ok(());
    }
    let mut best: Option<(Applied, RandomWalk, f64)> = None;
    for effect in fit.model.free_effects() {
        let Some((walk, gain)) = walking(search, fit, effect)? else { continue };
        if best.as_ref().is_none_or(|(.., most)| gain > *most) {
            best = Some((effect.clone(), walk, gain));
        }
    }
    if let Some((effect, walk, _)) = best {
        let own = fit.model.effects.iter_mut().filter(|e| e.free && e.same_as(&effect));
        own.for_each(|e| e.effect.walk = Some(walk.clone()));
    }
    Ok(())
}
