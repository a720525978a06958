//! Effects that are no more than their limits: where what builds up does so at once, the rest of the effect has a name of its own;
//! where a scope or a course is not worth its price, the effect holds always.

use super::scopes::is_partial;
use super::search::{Search, without_effect};
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::evidence::information_criterion::bic;
use crate::discrepancy::selection::choice::SelectedEffect;
use crate::effects::{Applied, Effect};
use crate::error::Result;

/// A length or time of fewer deviations than these is none.
const DEVIATIONS: f64 = 2.0;

impl Search<'_> {
    /// The first effect whose length or time is zero within its deviation, or whose scope or course the data do not pay for, and
    /// the fit with its limit in its place.
    pub(crate) fn at_limit(&self, fit: &Fit, chosen: &[SelectedEffect]) -> Result<Option<(Applied, Fit)>> {
        for c in chosen.iter().filter(|c| is_at_once(c)) {
            let Some(limit) = limit(&c.applied, self.library) else { continue };
            let model = without_effect(&fit.model, &c.applied, &self.before.model).with_effect(limit.freed());
            if let Some(there) = self.fit_instead(fit, &model)? {
                return Ok(Some((c.applied.clone(), there)));
            }
        }
        for c in chosen.iter().filter(|c| is_partial(&c.applied)) {
            let Some(always) = always(&c.applied, self.library) else { continue };
            let model = without_effect(&fit.model, &c.applied, &self.before.model).with_effect(always.freed());
            let Some(there) = self.fit_instead(fit, &model)? else { continue };
            let n = fit.sample_size.max(there.sample_size);
            if bic(&there, n) < bic(fit, n) + self.margin() {
                return Ok(Some((c.applied.clone(), there)));
            }
        }
        Ok(None)
    }
}

/// The same effect without its scope and its course.
fn always(partial: &Applied, library: &[Effect]) -> Option<Applied> {
    let is_same = |e: &&Effect| e.id == partial.effect.id && e.on == partial.effect.on && e.scope.is_none();
    let effect = library.iter().find(is_same)?;
    let value = |name: &String| partial.effect.parameters.keys().position(|n| n == name).map(|k| partial.values[k]);
    let values: Option<Vec<f64>> = effect.parameters.keys().map(value).collect();
    Some(Applied::new(effect, partial.trailer, values?))
}

/// Whether every value of an effect that is never negative is zero within its deviation. Of one in part that builds up
/// nothing the simpler one was asked in the same scope already.
fn is_at_once(c: &SelectedEffect) -> bool {
    if c.applied.effect.states.is_empty() && c.applied.effect.scope.is_some() {
        return false;
    }
    let parameters = c.applied.effect.parameters.values().zip(c.applied.values.iter().zip(&c.std));
    let mut lengths = parameters.filter(|(p, _)| p.positive).map(|(_, of)| of).peekable();
    lengths.peek().is_some() && lengths.all(|(value, std)| std.is_some_and(|std| *value < DEVIATIONS * std))
}

/// The effect at the same place that has all other values of an effect, and no others.
fn limit(whole: &Applied, library: &[Effect]) -> Option<Applied> {
    let parameters = || whole.effect.parameters.iter().zip(&whole.values).filter(|((_, p), _)| !p.positive);
    let names: Vec<&String> = parameters().map(|((name, _), _)| name).collect();
    let is_limit = |e: &&Effect| {
        !names.is_empty() && e.place == whole.effect.place && e.parameters.keys().collect::<Vec<_>>() == names
    };
    let effect = library.iter().find(is_limit)?;
    let effect = Effect { scope: whole.effect.scope.clone(), ..effect.clone() };
    Some(Applied::new(&effect, whole.trailer, parameters().map(|(_, value)| *value).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::applied;
    use crate::effects::{Scope, all};

    #[test]
    fn a_creep_that_builds_up_over_no_length_is_a_creep() {
        let whole = Applied { values: vec![0.05, 0.02], ..applied("relaxation-length") };
        let names: Vec<&String> = whole.effect.parameters.keys().collect();
        let creep = whole.values[names.iter().position(|n| *n == "e_tc").unwrap()];
        let limit = limit(&whole, all()).unwrap();
        assert_eq!((limit.effect.id.as_str(), &limit.values[..]), ("traverse-creep", &[creep][..]));
        assert!(super::limit(&applied("traverse-creep"), all()).is_none_or(|a| a.effect.id == "traverse-creep"));
        let of = |std: f64, applied: Applied| {
            let std = vec![Some(std); applied.values.len()];
            is_at_once(&SelectedEffect { applied, std, delta_bic: 9.0, p_value: 0.0, rivals: vec![] })
        };
        assert!(of(0.117, whole.clone()) && !of(0.001, whole) && !of(9.0, applied("traverse-creep")));
        // Where a limit is not told the creep without one is asked in its place; in a scope that was asked before.
        let limited = Applied { values: vec![0.1, 0.05], ..applied("saturating-creep") };
        let within = limited.effect.within(Scope::Above(1.0));
        assert!(of(9.0, limited.clone()) && !of(9.0, Applied { effect: within, ..limited }));
    }
    /// What is left of an effect in part is the effect of the library with its values.
    #[test]
    fn an_effect_without_its_scope_and_course_has_its_own_values() {
        let moving = crate::effects::named("yaw-rate-bias").unwrap().drifting("bias", 3.0).unwrap();
        let course = Applied::new(&moving, None, vec![0.01, 0.002]);
        let rate = course.effect.parameters.keys().position(|n| n == "bias").unwrap();
        let whole = always(&course, all()).unwrap();
        assert_eq!((whole.effect.course.is_none(), &whole.values[..]), (true, &[course.values[rate]][..]));
        let within = Applied { effect: whole.effect.within(Scope::Above(1.0)), ..whole.clone() };
        assert_eq!(always(&within, all()), Some(whole));
        assert_eq!(always(&within, &[]), None);
    }
}
