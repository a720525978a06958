//! Effects that hold in part only, or move with time, asked for where what holds always does not explain the data.

use super::candidates::{FINALISTS, place, rounded};
use super::effects_within::{InPart, by_evidence, paid};
use super::scope_proposals::{BORNE_OUT, SHORTEST};
use super::scope_screen::{Price, Proposed, class, has_room};
use super::search::{Search, SearchState, find, first_of};
use crate::discrepancy::estimation::bounds::{is_possible, vanishes};
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::estimation::unexplained::{
    explains_half, explains_most, is_wanted, noise_if_explained, remains,
};
use crate::discrepancy::evidence::heterogeneity::{RunValue, spreads};
use crate::discrepancy::evidence::information_criterion::{bic, delta_bic};
use crate::discrepancy::evidence::score_test::{self, ScoreTest, ScoreTests};
use crate::discrepancy::record::run_record::Record;
use crate::effects::{Applied, Effect, Scope};
use crate::error::Result;
use crate::model::effect_equation::is_term;
use crate::progress::{OnProgress, Stage, begin};
use rayon::prelude::*;

/// Effects with a scope or a course at most.
const MOST: usize = 2;
/// Effects that always hold, added beside one in part, at most.
const BESIDE: usize = 2;
/// Scopes as proposed that are fitted, at most: of effects that act at once, and of those with states.
const TRIED: [usize; 2] = [4 * FINALISTS, 2];
/// Of these so many of one kind of scope, and of one effect in that kind.
const OF_A_KIND: usize = 4;
const OF_AN_EFFECT: usize = 2;
/// So many scopes are refined, of effects that act at once and of those with states, and so many of one kind, of different effects.
const REFINED: [usize; 2] = [5, 1];
const OF_A_KIND_REFINED: usize = 2;

/// The search with scopes and courses beside the effects that always hold; `None` unless one of them earns its place.
///
/// A scope is one of many, so it must do more: its ends, centre and bound count as parameters, and what it gains must
/// exceed what the best of all that were tried gains by chance.
pub(crate) fn search(selection: &Search, named: &SearchState, progress: &OnProgress) -> Result<Option<SearchState>> {
    if !is_wanted(&named.fit) {
        return Ok(None);
    }
    begin(progress, Stage::Scopes)?;
    let mut starts = vec![SearchState::from(selection.before)];
    // Where names that always hold leave nothing, one in part may do what several of them did; beside them none is needed.
    if !named.steps.is_empty() && remains(&named.fit) {
        starts.push(SearchState { steps: named.steps.clone(), ..SearchState::from(&named.fit) });
    }
    // Names that explain half of the rest have taken for themselves what it hid.
    let is_hidden = !explains_half(&named.fit, selection.before);
    for (i, start) in starts.into_iter().enumerate() {
        let Some(found) = selection.with_scopes(start, is_hidden && i == 0, progress)? else { continue };
        let n = named.fit.sample_size.max(found.fit.sample_size);
        let gains = delta_bic(&found.fit, &named.fit, n) > 0.0 && explains_most(&found.fit, selection.before);
        if gains && bic(&found.fit, n) < bic(&named.fit, n) - selection.margin() {
            return Ok(Some(SearchState { candidates: named.candidates.clone(), ..found }));
        }
    }
    Ok(None)
}

/// Whether an effect holds in part only, or moves with time.
pub(crate) fn is_partial(effect: &Applied) -> bool {
    effect.effect.scope.is_some() || effect.effect.course.is_some()
}

impl Search<'_> {
    /// From a model on: effects in part, the first of them also at the noise that `is_hidden` says to hide it, and what always
    /// holds beside them.
    fn with_scopes(
        &self,
        mut found: SearchState,
        is_hidden: bool,
        progress: &OnProgress,
    ) -> Result<Option<SearchState>> {
        let steps = found.steps.clone();
        for _ in 0..MOST {
            // Beside a first one a second may only imitate what that one is not: it stands where it leaves nothing.
            let is_second = partial(&found.fit).next().is_some();
            let Some((label, fit)) = self.next_in_part(&found.fit, is_hidden && !is_second)? else { break };
            let mut trail = [&steps[..], &[(label, fit.model.clone())]].concat();
            let fit = self.eliminate_backward(fit, self.margin())?;
            // What is explained to its noise needs nothing beside.
            let few = Search { most: BESIDE, ..*self };
            let more = if remains(&fit) { few.grown(&fit, progress)? } else { SearchState::from(&fit) };
            trail.extend(more.steps);
            if is_second && (remains(&more.fit) || bends_a_course(&more.fit)) {
                break;
            }
            // Where the first leaves most of what was there, no second one leaves nothing.
            let is_all = !remains(&more.fit) || !explains_most(&more.fit, &found.fit);
            found = SearchState { steps: trail, refused: more.refused, fit: more.fit, ..found };
            if is_all {
                break;
            }
        }
        let some = partial(&found.fit).next().is_some();
        Ok(some.then_some(found))
    }

    /// The effect in part that gains most beyond what it costs, and the fit with it; where none explains most of a rest that may
    /// hide it, it is sought again at the noise that there is once it is explained. What a name leaves hides nothing: at so
    /// little noise the little that it is off by shows too. At last all effects are fitted within the scopes that others found.
    fn next_in_part(&self, base: &Fit, is_hidden: bool) -> Result<Option<(String, Fit)>> {
        let seen = self.promising_in_part(base)?;
        let found = self.best_in_part(base, &seen)?;
        if !is_hidden || found.as_ref().is_some_and(|(_, fit)| explains_most(fit, base)) {
            return Ok(found);
        }
        let quiet = noise_if_explained(base);
        let Some(quiet) = self.problem.fit(&base.model, &base.window_states, &quiet, Effort::SCREENING)? else {
            return Ok(found);
        };
        let hidden = self.promising_in_part(&quiet)?;
        let explaining = |found: Option<(String, Fit)>| found.filter(|(_, fit)| explains_most(fit, base));
        if let Some(other) = explaining(self.best_in_part(base, &hidden)?) {
            return Ok(Some(other));
        }
        let within = self.in_full_within(&quiet, [seen, hidden])?;
        Ok(explaining(self.best_in_part(base, &within)?).or(found))
    }

    /// The effects in part that promise most at the noise of a fit, fitted with their scopes as proposed, best first.
    fn promising_in_part(&self, at: &Fit) -> Result<InPart> {
        let Proposed { scoped, moving, price } = self.proposed(at)?;
        let promises = |some: &[(&Effect, Option<usize>)]| score_test::promises(self.problem, at, &at.model, some);
        // Each scope of an effect is a candidate of its own; of a parameter that moves there is one for each effect.
        let alone = scoped.par_iter().map(|(e, t)| promises(&[(e, *t)]));
        let alone: Vec<ScoreTests> = alone.collect::<Result<_>>()?;
        let mut weighed: Vec<ScoreTest> = alone.into_iter().flat_map(|found| found.single).collect();
        for one_each in &moving {
            let open: Vec<(&Effect, Option<usize>)> = one_each.iter().map(|(e, t)| (e, *t)).collect();
            weighed.extend(promises(&open)?.single);
        }
        let n = at.sample_size;
        let cost = |a: &Applied| (a.values.len() + a.effect.scope.as_ref().map_or(0, |s| s.cost())) as f64 * n.ln();
        let worth = |p: &ScoreTest| rounded(p.deviance + cost(&p.applied));
        weighed.sort_by(|a, b| worth(a).total_cmp(&worth(b)).then(place(&a.applied).cmp(&place(&b.applied))));
        let rough = of_each_kind(&weighed).into_par_iter().map(|promise| self.rough(at, promise, &price));
        let fits: Vec<(Applied, Fit)> = rough.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
        Ok(InPart::ordered(fits, price, n))
    }

    /// Of effects in part the one that gains most beyond what it costs where its scope explains most, and the fit with it.
    fn best_in_part(&self, base: &Fit, rough: &InPart) -> Result<Option<(String, Fit)>> {
        let refined = |(own, fit): &(Applied, Fit)| self.refined(base, own.clone(), fit.clone(), rough.price.of(own));
        let finalists = best_of_each_kind(&rough.fits).into_par_iter().map(refined);
        let mut fits: Vec<(Applied, Fit)> = finalists.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
        by_evidence(&mut fits, base.sample_size);
        for (own, fit) in fits {
            if self.problem.predicts_worse(&fit, base)? {
                continue;
            }
            let (own, fit) = self.in_time_instead(base, (own, fit), &rough.price)?;
            return Ok(Some((own.label(), fit)));
        }
        Ok(None)
    }

    /// The fit with an effect in part, its scope as proposed, at the noise and jumps of the model without it; `None` where it
    /// is not worth what it costs.
    fn rough(&self, base: &Fit, promise: &ScoreTest, price: &Price) -> Result<Option<(Applied, Fit)>> {
        let fit = score_test::settled(self.problem, base, &base.model, &[promise], Effort::SCREENING)?;
        Ok(fit.and_then(|fit| paid(base, fit, &promise.applied, price)))
    }

    /// The fit with an effect in part, the numbers of its scope moved to where they explain most, and the effect that
    /// explains most there in its place; `None` where it is not worth what it costs.
    pub(super) fn refined(&self, base: &Fit, own: Applied, fit: Fit, margin: f64) -> Result<Option<(Applied, Fit)>> {
        let Some(fit) = self.refit(&fit)? else { return Ok(None) };
        let mut fit = self.with_scope_at_best(base, fit, &own)?;
        let mut renamed = own;
        // Beside a large rest there is nothing to tell names apart by.
        if explains_most(&fit, base) {
            let named = self.named_in_scope(base, &renamed, &fit)?;
            let Some(other) = partial(&named).last().cloned() else { return Ok(None) };
            fit = if other.same_as(&renamed) { named } else { self.with_scope_at_best(base, named, &other)? };
            renamed = other;
        }
        let Some(own) = find(&fit.model, &renamed) else { return Ok(None) };
        if own.effect.scope.as_ref().is_some_and(|s| !self.lasts(s)) || !moves_alike(&fit, &own) {
            return Ok(None);
        }
        let n = base.sample_size.max(fit.sample_size);
        let gains = delta_bic(&fit, base, n) > margin && bic(&fit, n) + margin < bic(base, n);
        Ok((gains && !vanishes(&own) && is_possible(&own)).then_some((own, fit)))
    }

    /// Whether enough of the data lie within the times of a scope.
    fn lasts(&self, scope: &Scope) -> bool {
        let Scope::Times(intervals) = scope else { return true };
        let runs = self.problem.records.iter().map(Record::span);
        let inside = runs.flat_map(|[a, b]| intervals.iter().map(move |[from, until]| until.min(b) - from.max(a)));
        inside.filter(|s| *s > 0.0).sum::<f64>() >= SHORTEST
    }
}

/// Whether more than one run bears out that a parameter moves, and none that it moves the other way, where there are
/// several.
fn moves_alike(fit: &Fit, effect: &Applied) -> bool {
    let Some(course) = &effect.effect.course else { return true };
    let Some(rate) = effect.effect.parameters.keys().position(|name| *name == course.rate()) else { return true };
    let each = &spreads(fit)[first_of(fit, effect) + rate];
    let Some(each) = each.as_ref().filter(|_| fit.runs > 1) else { return fit.runs < 2 };
    let bears_out = |v: &&RunValue| v.value * v.value / v.variance > BORNE_OUT;
    each.values.iter().filter(bears_out).count() > 1 && each.is_along(effect.values[rate])
}

/// Whether an effect stands in part at the place of a parameter that moves with time: what a line leaves there is how else
/// that parameter moves.
fn bends_a_course(fit: &Fit) -> bool {
    let courses = || partial(fit).filter(|e| e.effect.course.is_some());
    partial(fit).any(|e| courses().any(|other| !other.same_as(e) && other.effect.place == e.effect.place))
}

/// The most promising candidates, a few of each kind of scope, and of each effect.
fn of_each_kind(weighed: &[ScoreTest]) -> Vec<&ScoreTest> {
    let mut found: Vec<&ScoreTest> = vec![];
    for promise in weighed {
        let alike = |a: &&&ScoreTest| is_like(&a.applied, &promise.applied);
        // Two names of one law explain the same in one scope: the one to be named is found among all in that scope.
        let is_same = |a: &&ScoreTest| {
            a.applied.effect.scope == promise.applied.effect.scope && rounded(a.deviance) == rounded(promise.deviance)
        };
        let own = |a: &&&ScoreTest| alike(a) && a.applied.same_as(&promise.applied);
        let few = found.iter().filter(alike).count() < OF_A_KIND && found.iter().filter(own).count() < OF_AN_EFFECT;
        let is_open = has_room(found.iter().map(|a| &a.applied), &promise.applied, TRIED);
        if is_open && few && !found.iter().any(is_same) {
            found.push(promise);
        }
    }
    found
}

/// Whether two effects of one class have scopes of one kind, or none.
fn is_like(a: &Applied, b: &Applied) -> bool {
    let is_kind = match (&a.effect.scope, &b.effect.scope) {
        (Some(a), Some(b)) => a.is_like(b),
        (a, b) => a.is_none() == b.is_none(),
    };
    is_kind && class(a) == class(b)
}

/// Whether the data tell what an effect in part is held by, as a limit is: one of fewer deviations than these is not told.
const TOLD: f64 = 3.0;

/// Whether every positive parameter of an effect in part that is not its size stands out of its deviation.
pub(crate) fn are_limits_told(fit: &Fit) -> bool {
    partial(fit).all(|effect| {
        let (first, size) = (first_of(fit, effect), effect.effect.amplitude());
        let parameters = effect.effect.parameters.values().zip(&effect.values).enumerate();
        let mut limits = parameters.filter(|(i, (p, _))| p.positive && size.is_some_and(|s| s != *i));
        limits.all(|(i, (_, value))| fit.variance(first + i).is_some_and(|v| *value > TOLD * v.sqrt()))
    })
}

/// Of ordered fits the first of each kind of scope, with the first of another effect.
fn best_of_each_kind(fits: &[(Applied, Fit)]) -> Vec<&(Applied, Fit)> {
    let mut found: Vec<&(Applied, Fit)> = vec![];
    for one in fits {
        let (own, _) = one;
        let alike = |(a, _): &&&(Applied, Fit)| is_like(a, own);
        let is_other = !found.iter().filter(alike).any(|(a, _)| a.same_as(own));
        let is_open = has_room(found.iter().map(|(a, _)| a), own, REFINED);
        if is_open && found.iter().filter(alike).count() < OF_A_KIND_REFINED && is_other {
            found.push(one);
        }
    }
    found
}

/// The effects of a fit that hold in part, and have a name.
pub(crate) fn partial(fit: &Fit) -> impl Iterator<Item = &Applied> {
    fit.model.free_effects().filter(|e| is_partial(e) && !is_term(e))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{fit_of, unicycle};
    use crate::effects::named;

    /// Beside a bias that moves another effect of the yaw input in part is how else it moves; one across the vehicle is not.
    #[test]
    fn what_a_line_leaves_is_no_effect_of_its_own() {
        let moving = named("yaw-rate-bias").unwrap().drifting("bias", 0.0).unwrap();
        let course = Applied { values: vec![0.01, 0.002], ..Applied::new(&moving, None, vec![0.0; 2]) }.freed();
        let bends = |id: &str| {
            let within = named(id).unwrap().within(Scope::Times(vec![[f64::NEG_INFINITY, 9.8]]));
            let model = unicycle(&[]).with_effect(course.clone());
            bends_a_course(&fit_of(model.with_effect(Applied::new(&within, None, vec![0.01]).freed())))
        };
        assert!(bends("odometry-yaw-per-speed") && bends("yaw-rate-scale") && !bends("traverse-creep"));
        assert!(!bends_a_course(&fit_of(unicycle(&[]).with_effect(course.clone()))));
    }
}
