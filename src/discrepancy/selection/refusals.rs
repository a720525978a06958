//! Names that were found and do not stand: what a fit asks for is no finding by that alone.

use super::input_noise;
use super::input_sampling::{InputSampling, keep_sampled};
use super::search::{Search, SearchState, find, first_of, forget};
use super::stability::{is_there, visible_places};
use crate::discrepancy::estimation::bounds::is_possible;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::unexplained::{remaining, remains};
use crate::discrepancy::evidence::information_criterion::delta_bic;
use crate::discrepancy::evidence::jackknife::Jackknife;
use crate::discrepancy::evidence::regime_stability::Difference;
use crate::discrepancy::evidence::wald_test::{is_one_way, neutral_at_zero};
use crate::discrepancy::selection::choice::{Refusal, Refused, SelectedEffect, Weighed};
use crate::effects::Applied;
use crate::error::{Error, Result};
use crate::model::effect_equation::is_term;
use crate::model::state::JUMPS;
use crate::progress::OnProgress;

/// Two effects whose values are correlated by this much and more are one effect, or none.
const RIDGE: f64 = 0.97;
/// Unless each is worth so many times its price beside the other, and both together leave nothing.
const TOLD_APART: f64 = 5.0;
/// A value that moves by so large a share of itself when a law without a name is taken out leans on it.
const LEANS: f64 = 0.5;

/// Each of two effects that explains so large a share of what both explain is there for the same.
const MOST_OF_BOTH: f64 = 0.5;

/// What the selection ends with: the effects that stand, and those that do not.
pub(crate) struct Standing {
    pub chosen: Vec<SelectedEffect>,
    pub refused: Vec<Refused>,
    /// What the interpolation of the inputs may make up of each value that stands.
    pub missed: Vec<f64>,
}

impl Search<'_> {
    /// Drops what comes and goes with how often the inputs are logged, which is told first, and then what does not stand.
    pub(crate) fn keep_sampled_and_standing(
        &self,
        grown: &mut SearchState,
        scatter: Option<Jackknife>,
        progress: &OnProgress,
    ) -> Result<(Vec<Applied>, Standing)> {
        let InputSampling { dropped, missed } = keep_sampled(self, grown, progress)?;
        // Where something went, the values no longer stand where they stood.
        let scatter = scatter.filter(|_| dropped.is_empty());
        let standing = self.keep_standing(grown, scatter.as_ref(), missed, progress)?;
        Ok((dropped, standing))
    }

    /// Drops what does not stand, one effect after another.
    ///
    /// `missed` is what the interpolation of the inputs may make up of each value.
    pub(crate) fn keep_standing(
        &self,
        grown: &mut SearchState,
        mut scatter: Option<&Jackknife>,
        mut missed: Vec<f64>,
        progress: &OnProgress,
    ) -> Result<Standing> {
        let mut refused: Vec<Refused> = vec![];
        loop {
            self.let_scopes_vary(&mut grown.fit)?;
            let weighed = self.weighed(&grown.fit, scatter, &missed, progress)?;
            let chosen: Vec<SelectedEffect> = weighed.iter().map(|w| w.effect.clone()).collect();
            if let Some((whole, smaller)) = self.at_limit(&grown.fit, &chosen)? {
                forget(&mut missed, &grown.fit, &whole);
                scatter = None;
                grown.go_back_to(smaller);
                continue;
            }
            let fallen = match companion(&refused, &chosen) {
                Some(fallen) => Some(fallen),
                None => self.fallen(&grown.fit, &weighed, &chosen, progress)?,
            };
            let without = |(applied, why): (Applied, Refusal)| {
                let smaller = self.without(&grown.fit, &applied)?;
                Ok::<_, Error>(smaller.map(|smaller| (applied, why, smaller)))
            };
            let Some((applied, why, smaller)) = fallen.map(without).transpose()?.flatten() else {
                return Ok(Standing { chosen: self.examined(&grown.fit, weighed, progress)?, refused, missed });
            };
            forget(&mut missed, &grown.fit, &applied);
            scatter = None;
            grown.go_back_to(smaller);
            refused.push(Refused::of(&chosen, applied, why));
        }
    }

    /// The next effect that does not stand, the cheapest question first.
    fn fallen(
        &self,
        fit: &Fit,
        weighed: &[Weighed],
        chosen: &[SelectedEffect],
        progress: &OnProgress,
    ) -> Result<Option<(Applied, Refusal)>> {
        if let Some(fallen) = self.fallen_by_value(fit, chosen) {
            return Ok(Some(fallen));
        }
        if let Some([less, more]) = self.imitating(fit, weighed)? {
            return Ok(Some((less, Refusal::Imitation(Box::new(more)))));
        }
        if let Some(applied) = self.leaning(fit, chosen)? {
            return Ok(Some((applied, Refusal::LeansOnLaw)));
        }
        if let Some(fallen) = self.changing(fit, weighed)? {
            return Ok(Some(fallen));
        }
        if let Some(applied) = input_noise::taken_back(self.problem, fit) {
            return Ok(Some((applied, Refusal::InputNoise)));
        }
        if let Some(applied) = self.smoothed_away(fit, progress)? {
            return Ok(Some((applied, Refusal::InputNoise)));
        }
        if let Some(applied) = input_noise::made_up(self, fit)? {
            return Ok(Some((applied, Refusal::InputNoise)));
        }
        Ok(input_noise::gained_of_nothing(self, fit, weighed, progress)?.map(|applied| (applied, Refusal::InputNoise)))
    }

    /// What falls by the values, deviations and evidence that are known: of several the one that is worth least.
    pub(super) fn fallen_by_value(&self, fit: &Fit, chosen: &[SelectedEffect]) -> Option<(Applied, Refusal)> {
        let worst = |of: &dyn Fn(&SelectedEffect) -> bool| {
            let all = chosen.iter().filter(|c| of(c));
            all.min_by(|a, b| a.delta_bic.total_cmp(&b.delta_bic)).map(|c| c.applied.clone())
        };
        let is_open = |c: &SelectedEffect| c.std.iter().any(Option::is_none);
        let is_cheap = |c: &SelectedEffect| c.delta_bic <= self.margin() || self.is_faint(fit, c);
        worst(&|c| !is_possible(&c.applied))
            .map(|a| (a, Refusal::Impossible))
            .or_else(|| worst(&is_open).map(|a| (a, Refusal::NoDeviation)))
            .or_else(|| worst(&is_cheap).map(|a| (a, Refusal::BelowBar)))
            .or_else(|| {
                ridge(fit, chosen, self.tells_apart(fit)).map(|(a, other)| (a, Refusal::Ridge(Box::new(other))))
            })
    }

    /// Whether two effects with names lie on a ridge and are one: a law without a name may be about to take the place of a name.
    pub(super) fn has_two_that_are_one(&self, fit: &Fit) -> Result<bool> {
        let (pairs, told_apart) = (all_on_ridge(fit, |pair| !pair.iter().any(|e| is_term(e))), self.tells_apart(fit));
        if pairs.is_empty() || told_apart.is_infinite() {
            return Ok(!pairs.is_empty());
        }
        for pair in pairs {
            for effect in pair {
                let Some(smaller) = self.without(fit, effect)? else { return Ok(true) };
                if delta_bic(fit, &smaller, fit.sample_size.max(smaller.sample_size)) < told_apart {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// The evidence at which both of a pair stand though they pull against each other: many times what a parameter costs, where both
    /// together leave nothing. Beside a rest no evidence is enough, for it may be that of the rest.
    fn tells_apart(&self, fit: &Fit) -> f64 {
        if remains(fit) { f64::INFINITY } else { TOLD_APART * self.price(fit) }
    }

    /// Whether an effect's values stand out of their own deviations by less than what a parameter costs.
    ///
    /// What every vehicle has, each run in one direction, may differ between runs by more than their noise: there the noise
    /// alone is asked, and the spread is told in the deviation.
    fn is_faint(&self, fit: &Fit, c: &SelectedEffect) -> bool {
        let own = neutral_at_zero(fit, &c.applied);
        let first = first_of(fit, &c.applied);
        let varies = c.applied.effect.basic && is_one_way(fit, &c.applied);
        let std = |i: usize| if varies { fit.variance(i).map(f64::sqrt) } else { c.std[i - first] };
        let ratio = |(i, v): &(usize, f64)| std(*i).map_or(0.0, |std| (v / std).powi(2));
        !own.is_empty() && own.iter().map(ratio).fold(0.0, f64::max) <= self.price(fit)
    }

    /// Two effects at a place where something remains, neither of which every vehicle has, and each of which alone explains
    /// most of what both do: the one that is worth less, and the other.
    fn imitating(&self, fit: &Fit, weighed: &[Weighed]) -> Result<Option<[Applied; 2]>> {
        let places: Vec<&str> = remaining(fit).map(|c| JUMPS[c].place).collect();
        let is_law = |w: &&Weighed| {
            let applied = &w.effect.applied;
            !applied.effect.basic && !is_term(applied) && places.contains(&applied.effect.place.as_str())
        };
        let laws: Vec<&Weighed> = weighed.iter().filter(is_law).collect();
        for (i, a) in laws.iter().enumerate() {
            for b in laws[..i].iter().filter(|b| b.effect.applied.effect.place == a.effect.applied.effect.place) {
                let Some(neither) = self.without(&a.without, &b.effect.applied)? else { continue };
                let both = neither.deviance - fit.deviance;
                let alone = [&a.without, &b.without].map(|with_other| neither.deviance - with_other.deviance);
                if alone.iter().all(|gain| *gain > MOST_OF_BOTH * both) {
                    let ordered = if a.effect.delta_bic < b.effect.delta_bic { [a, b] } else { [b, a] };
                    return Ok(Some(ordered.map(|w| w.effect.applied.clone())));
                }
            }
        }
        Ok(None)
    }

    /// The effect that has another value in a regime of driving, the one whose difference is largest beyond chance.
    fn changing(&self, fit: &Fit, weighed: &[Weighed]) -> Result<Option<(Applied, Refusal)>> {
        let each = self.problem.differences(fit)?.into_iter();
        let mut real: Vec<(Applied, Difference)> = each
            .flat_map(|(a, each)| each.into_iter().filter(Difference::is_real).map(move |d| (a.clone(), d)))
            .collect();
        real.sort_by(|a, b| b.1.chi_squared.total_cmp(&a.1.chi_squared));
        for (a, d) in real {
            if !(d.is_one_way() && self.is_there_anyway(fit, weighed, &a)?) {
                return Ok(Some((a, Refusal::Regime { regime: d.regime, values: d.values })));
            }
        }
        Ok(None)
    }

    /// Whether an effect is there though it has two values, where something remains that makes them two.
    fn is_there_anyway(&self, fit: &Fit, weighed: &[Weighed], effect: &Applied) -> Result<bool> {
        let own = weighed.iter().find(|w| w.effect.applied.same_as(effect));
        let Some(own) = own.filter(|_| effect.effect.basic && remains(fit)) else { return Ok(false) };
        let gains = self.problem.gains_by_parts(fit, &own.without)?;
        Ok(is_there(effect, &visible_places(self, fit)?, false, gains))
    }

    /// The name that moves most when the laws without a name are taken out.
    fn leaning(&self, fit: &Fit, chosen: &[SelectedEffect]) -> Result<Option<Applied>> {
        if !fit.model.free_effects().any(is_term) || fit.model.free_effects().all(is_term) {
            return Ok(None);
        }
        let Some(bare) = self.without_terms(fit)? else { return Ok(None) };
        let names = chosen.iter().filter(|c| !is_term(&c.applied));
        let moved = names.filter_map(|c| Some((moved(fit, &bare, &c.applied)?, &c.applied)));
        let most = moved.filter(|(by, _)| *by > LEANS).max_by(|a, b| a.0.total_cmp(&b.0));
        Ok(most.map(|(_, a)| a.clone()))
    }
}

/// The one that was to imitate a law together with another that fell for it: it falls, too.
fn companion(refused: &[Refused], chosen: &[SelectedEffect]) -> Option<(Applied, Refusal)> {
    let left = |r: &Refused| match &r.why {
        Refusal::Imitation(other) => {
            let stands = chosen.iter().find(|c| c.applied.same_as(other))?;
            Some((stands.applied.clone(), Refusal::Imitation(Box::new(r.applied.clone()))))
        }
        _ => None,
    };
    refused.iter().find_map(left)
}

/// By what share of themselves the values of an effect move from one fit to another.
fn moved(fit: &Fit, other: &Fit, effect: &Applied) -> Option<f64> {
    let there = find(&other.model, effect)?;
    let pairs = neutral_at_zero(fit, effect).into_iter().zip(neutral_at_zero(other, &there));
    let (far, by) = pairs.fold((0.0, 0.0), |(far, by), ((_, a), (_, b))| (far + a * a, by + (b - a) * (b - a)));
    (far > 0.0).then(|| f64::sqrt(by / far))
}

/// The pairs of effects on a ridge, of the pairs that are asked for.
fn all_on_ridge(fit: &Fit, is_asked: impl Fn(&[&Applied; 2]) -> bool) -> Vec<[&Applied; 2]> {
    let Some(covariance) = fit.covariance.as_ref() else { return vec![] };
    let correlation = |i: usize, j: usize| covariance[(i, j)] / (covariance[(i, i)] * covariance[(j, j)]).sqrt();
    let along = |[a, b]: &[&Applied; 2]| {
        let [a, b] = [a, b].map(|e| neutral_at_zero(fit, e));
        a.iter().any(|(i, _)| b.iter().any(|(j, _)| correlation(*i, *j).abs() > RIDGE))
    };
    let effects: Vec<&Applied> = fit.model.free_effects().collect();
    let pairs = effects.iter().enumerate().flat_map(|(k, a)| effects[k + 1..].iter().map(move |b| [*a, *b]));
    pairs.filter(|pair| is_asked(pair) && along(pair)).collect()
}

/// Of two effects on a ridge, not both of them terms, the one that is worth less, and the other; a pair of which each is worth
/// more than some evidence beside the other is told apart.
fn ridge(fit: &Fit, chosen: &[SelectedEffect], told_apart: f64) -> Option<(Applied, Applied)> {
    let worth = |e: &Applied| chosen.iter().find(|c| c.applied.same_as(e)).map_or(f64::INFINITY, |c| c.delta_bic);
    let is_asked =
        |pair: &[&Applied; 2]| !pair.iter().all(|e| is_term(e)) && pair.iter().any(|e| worth(e) < told_apart);
    let [a, b] = all_on_ridge(fit, is_asked).into_iter().next()?;
    let (less, more) = if worth(a) < worth(b) { (a, b) } else { (b, a) };
    Some((less.clone(), more.clone()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{KNOWN, applied, fit_of, unicycle};
    use nalgebra::DMatrix;

    fn chosen(fit: &Fit) -> Vec<SelectedEffect> {
        let of = |(k, applied): (usize, &Applied)| SelectedEffect {
            applied: applied.clone(),
            std: vec![Some(0.01); applied.values.len()],
            delta_bic: 50.0 + k as f64,
            p_value: 0.0,
            rivals: vec![],
        };
        fit.model.free_effects().enumerate().map(of).collect()
    }

    /// Of the four values the first belongs to the first effect, two to the second, the last to the third.
    #[test]
    fn two_on_a_ridge_are_one() {
        let mut fit = fit_of(unicycle(&KNOWN));
        let chosen = chosen(&fit);
        let mut within = |rho: f64, told_apart: f64| {
            let mut c = DMatrix::identity(4, 4);
            (c[(0, 3)], c[(3, 0)]) = (rho, rho);
            fit.covariance = Some(c);
            ridge(&fit, &chosen, told_apart).map(|(less, more)| [less.effect.id, more.effect.id])
        };
        // The lesser of the two is worth 50.
        assert!(within(0.98, 49.0).is_none() && within(0.98, 51.0).is_some());
        let mut at = |rho: f64| within(rho, f64::INFINITY);
        assert_eq!(at(0.96), None);
        let both = Some(["traction-creep".to_string(), "traverse-creep".to_string()]);
        assert_eq!((at(0.98), at(-0.98)), (both.clone(), both));
    }

    /// Names on a ridge are asked for, a name and a law without one are not.
    #[test]
    fn a_law_may_take_the_place_of_a_name_on_its_ridge() {
        let bare = unicycle(&[]);
        let term = Applied::new(&bare.terms().unwrap()[0], None, vec![0.1]).freed();
        let name = Applied { values: vec![0.1], ..applied("traverse-creep") }.freed();
        let other = Applied { values: vec![0.1], ..applied("load-dependent-creep") }.freed();
        let are_on_ridge = |pair: [&Applied; 2], rho: f64| {
            let model = pair.into_iter().cloned().fold(bare.clone(), crate::model::Model::with_effect);
            let covariance = Some(DMatrix::from_row_slice(2, 2, &[1.0, rho, rho, 1.0]));
            let fit = Fit { covariance, ..fit_of(model) };
            !all_on_ridge(&fit, |pair| !pair.iter().any(|e| is_term(e))).is_empty()
        };
        assert!(are_on_ridge([&name, &other], 0.98) && !are_on_ridge([&name, &other], 0.96));
        assert!(!are_on_ridge([&name, &term], 0.98));
    }

    #[test]
    fn a_value_that_moves_with_a_law_is_told_by_its_share() {
        let of = |creep: f64| fit_of(unicycle(&[("traction-creep", &[0.3]), ("traverse-creep", &[creep])]));
        let by = |other: f64| moved(&of(-0.05), &of(other), &applied("traverse-creep")).unwrap();
        for (other, share) in [(-0.05, 0.0), (-0.04, 0.2), (0.05, 2.0)] {
            assert!((by(other) - share).abs() < 1e-12, "{other}: {}", by(other));
        }
        assert_eq!(moved(&of(0.1), &of(0.1), &applied("lever-arm")), None);
    }
}
