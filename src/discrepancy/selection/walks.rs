//! Effects whose parameter walks at random, told where that explains most of what a constant leaves.

use super::choice::{Selected, SelectedEffect};
use super::scopes::is_partial;
use super::search::{Search, find};
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::estimation::unexplained::remains;
use crate::discrepancy::evidence::chi_squared::tail;
use crate::discrepancy::evidence::information_criterion::bic;
use crate::discrepancy::evidence::random_walk::Walk;
use crate::discrepancy::evidence::score_test::is_regular;
use crate::effects::{Applied, Effect, RandomWalk};
use crate::error::Result;
use crate::model::Model;
use crate::model::effect_equation::is_term;
use rayon::prelude::*;

/// The walk of an effect's parameter, where it pays, and what it gains.
fn walking(search: &Search, fit: &Fit, effect: &Applied) -> Result<Option<(RandomWalk, f64)>> {
    if is_term(effect) || is_partial(effect) || effect.effect.parameters.len() != 1 || !effect.effect.vanishes_first() {
        return Ok(None);
    }
    let walk = search.problem.walk(fit, effect)?.filter(|w| w.gain / fit.noise_correlation_time > search.price(fit));
    Ok(walk.map(|w| (course(effect, &w), w.gain)))
}

/// The walk of the one parameter of an effect.
fn course(effect: &Applied, walk: &Walk) -> RandomWalk {
    let parameter = effect.effect.parameters.keys().next().cloned().unwrap_or_default();
    RandomWalk { parameter, per_sqrt_s: walk.per_sqrt_s, std: Some(walk.std) }
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
        give_walk(fit, &effect, &walk);
    }
    Ok(())
}

fn give_walk(fit: &mut Fit, effect: &Applied, walk: &RandomWalk) {
    let own = fit.model.effects.iter_mut().filter(|e| e.free && e.same_as(effect));
    own.for_each(|e| e.effect.walk = Some(walk.clone()));
}

/// The choice with an effect that walks in the place of what leaves a rest; `None` where it does not explain the data better.
///
/// A parameter that walks about zero has no mean to be found by: the effect is asked for with its walk. Its price is that of
/// two parameters, once more than that of any other way to explain the data.
pub(crate) fn in_its_place(search: &Search, choice: &Selected) -> Result<Option<Selected>> {
    let base = search.before;
    // Beside a name that always holds a walk may be no more than what that name is not.
    let lasts = |c: &SelectedEffect| !is_term(&c.applied) && !is_partial(&c.applied);
    // Of several runs each may have a value of its own, which looks like a walk from one to the other.
    if !remains(&choice.after) || base.runs > 1 || choice.chosen.iter().any(lasts) {
        return Ok(None);
    }
    let all = base.model.applicable(search.library).into_iter();
    let open: Vec<(&Effect, Option<usize>)> = all.filter(|(e, t)| may_walk(e, &base.model, *t)).collect();
    let beside = |(effect, trailer): (&Effect, Option<usize>)| -> Result<Option<(Applied, Fit, Walk)>> {
        let applied = Applied::new(effect, trailer, effect.starts().swap_remove(0)).freed();
        let model = base.model.clone().with_effect(applied.clone());
        let fit = search.problem.fit(&model, &base.window_states, &base.variances, Effort::FULL)?;
        let Some(fit) = fit else { return Ok(None) };
        let walk = search.problem.walk(&fit, &applied)?;
        Ok(walk.and_then(|walk| Some((find(&fit.model, &applied)?, fit, walk))))
    };
    let found: Vec<Option<(Applied, Fit, Walk)>> = open.into_par_iter().map(beside).collect::<Result<_>>()?;
    let deviance = |fit: &Fit, walk: &Walk| fit.deviance - walk.gain;
    let best = found.into_iter().flatten().min_by(|a, b| deviance(&a.1, &a.2).total_cmp(&deviance(&b.1, &b.2)));
    let Some((applied, fit, walk)) = best else { return Ok(None) };
    let n = fit.sample_size.max(choice.after.sample_size);
    let with_walk = deviance(&fit, &walk) + (fit.p.len() + 1) as f64 * n.ln();
    let worth = (bic(&choice.after, n) - with_walk) / fit.noise_correlation_time;
    if worth <= 2.0 * search.margin() {
        return Ok(None);
    }
    let gain = base.deviance - deviance(&fit, &walk);
    Ok(Some(walked(choice, gain, &applied, fit, &walk)))
}

/// Whether an effect is known to walk, and has one value, which may be zero.
fn may_walk(effect: &Effect, model: &Model, trailer: Option<usize>) -> bool {
    effect.walks && effect.parameters.len() == 1 && effect.scope.is_none() && is_regular(effect, model, trailer)
}

/// The choice of an effect that walks.
fn walked(choice: &Selected, gain: f64, applied: &Applied, mut fit: Fit, walk: &Walk) -> Selected {
    give_walk(&mut fit, applied, &course(applied, walk));
    let chosen = SelectedEffect {
        applied: find(&fit.model, applied).unwrap_or_else(|| applied.clone()),
        std: vec![Some(walk.std_of_mean)],
        delta_bic: gain - 2.0 * fit.sample_size.ln(),
        p_value: tail(gain / fit.noise_correlation_time, 2),
        rivals: vec![],
    };
    let steps = vec![(chosen.applied.label(), fit.model.clone())];
    Selected { missed: vec![0.0; fit.p.len()], after: fit, chosen: vec![chosen], steps, ..choice.clone() }
}
