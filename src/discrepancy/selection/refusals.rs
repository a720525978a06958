//! Names that were found and do not stand: what a fit asks for is no finding by that alone.

use super::input_noise;
use super::search::{Search, SearchState, find};
use crate::discrepancy::estimation::bounds::is_possible;
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::evidence::jackknife::Jackknife;
use crate::discrepancy::evidence::regime_stability::Difference;
use crate::discrepancy::evidence::wald_test::neutral_at_zero;
use crate::discrepancy::selection::choice::{Refusal, Refused, SelectedEffect};
use crate::effects::Applied;
use crate::error::Result;
use crate::model::effect_equation::is_term;

/// Two effects whose values are correlated by this much and more are one effect, or none.
const RIDGE: f64 = 0.97;
/// χ² from which on two regimes of driving differ beyond chance: each of a dozen splits has its share of it.
const DIFFERENT: f64 = 20.0;
/// A difference between regimes of so large a share of the value is no constant.
const LARGE: f64 = 0.5;
/// A value that moves by so large a share of itself when a law without a name is taken out leans on it.
const LEANS: f64 = 0.5;

/// What the selection ends with: the effects that stand, and those that do not.
pub(crate) struct Standing {
    pub chosen: Vec<SelectedEffect>,
    pub refused: Vec<Refused>,
}

impl Search<'_> {
    /// Drops what does not stand, one effect after another.
    pub(crate) fn keep_standing(
        &self,
        grown: &mut SearchState,
        scatter: Option<&Jackknife>,
        mut missed: Vec<f64>,
        progress: &dyn Fn(&str),
    ) -> Result<Standing> {
        let mut refused: Vec<Refused> = vec![];
        let mut scatter = scatter;
        loop {
            let chosen = self.examined(&grown.fit, scatter, &missed)?;
            progress("asking whether the names stand");
            let Some((applied, why)) = self.fallen(&grown.fit, &chosen)? else {
                return Ok(Standing { chosen, refused });
            };
            let Some(smaller) = self.without(&grown.fit, &applied)? else {
                return Ok(Standing { chosen, refused });
            };
            super::select::forget(&mut missed, &grown.fit, &applied);
            scatter = None;
            grown.go_back_to(smaller);
            let std = chosen.iter().find(|c| c.applied.same_as(&applied)).map_or_else(Vec::new, |c| c.std.clone());
            refused.push(Refused { applied, std, why });
        }
    }

    /// The next effect that does not stand.
    fn fallen(&self, fit: &Fit, chosen: &[SelectedEffect]) -> Result<Option<(Applied, Refusal)>> {
        let worst = |of: &dyn Fn(&&SelectedEffect) -> bool| {
            let all = chosen.iter().filter(|c| of(c));
            all.min_by(|a, b| a.delta_bic.total_cmp(&b.delta_bic)).map(|c| c.applied.clone())
        };
        if let Some(a) = worst(&|c| !is_possible(&c.applied)) {
            return Ok(Some((a, Refusal::Impossible)));
        }
        if let Some(a) = worst(&|c| c.std.iter().any(Option::is_none)) {
            return Ok(Some((a, Refusal::NoDeviation)));
        }
        if let Some(a) = worst(&|c| c.delta_bic <= self.margin()) {
            return Ok(Some((a, Refusal::BelowBar)));
        }
        if let Some((a, b)) = ridge(fit, chosen) {
            return Ok(Some((a, Refusal::Ridge(b))));
        }
        if let Some(a) = self.leaning(fit, chosen)? {
            return Ok(Some((a, Refusal::LeansOnLaw)));
        }
        let of_regimes = self.problem.differences(fit)?.into_iter().filter(|(a, _)| !is_term(a));
        let differs = of_regimes.filter_map(|(a, each)| Some((a, differing(each)?)));
        if let Some((a, d)) = differs.max_by(|a, b| a.1.chi_squared.total_cmp(&b.1.chi_squared)) {
            return Ok(Some((a, Refusal::Regime(d.name))));
        }
        Ok(input_noise::made_up(self, fit)?.map(|a| (a, Refusal::InputNoise)))
    }

    /// The name that moves most when the laws without a name are taken out.
    fn leaning(&self, fit: &Fit, chosen: &[SelectedEffect]) -> Result<Option<Applied>> {
        if !fit.model.free_effects().any(is_term) || fit.model.free_effects().all(is_term) {
            return Ok(None);
        }
        let mut bare = fit.model.clone();
        bare.effects.retain(|e| !is_term(e));
        let Some(bare) = self.problem.fit(&bare, &fit.window_states, &self.before.variances, Effort::FULL)? else {
            return Ok(None);
        };
        let moved = |c: &SelectedEffect| {
            let other = find(&bare.model, &c.applied)?;
            let own = neutral_at_zero(fit, &c.applied).into_iter().map(|(_, v)| v);
            let others = neutral_at_zero(&bare, &other).into_iter().map(|(_, v)| v);
            let (far, by) = own.zip(others).fold((0.0, 0.0), |(f, b), (v, o)| (f + v * v, b + (o - v) * (o - v)));
            if far > 0.0 { Some((c.applied.clone(), f64::sqrt(by / far))) } else { None }
        };
        let most = chosen.iter().filter(|c| !is_term(&c.applied)).filter_map(moved);
        Ok(most.filter(|(_, by)| *by > LEANS).max_by(|a, b| a.1.total_cmp(&b.1)).map(|(a, _)| a))
    }
}

/// The difference between regimes that is beyond chance and as large as the value.
fn differing(each: Vec<Difference>) -> Option<Difference> {
    let large = each.into_iter().filter(|d| d.chi_squared > DIFFERENT && d.share > LARGE);
    large.max_by(|a, b| a.chi_squared.total_cmp(&b.chi_squared))
}

/// Of two effects on a ridge the one that is worth less, and the other's name.
fn ridge(fit: &Fit, chosen: &[SelectedEffect]) -> Option<(Applied, String)> {
    let covariance = fit.covariance.as_ref()?;
    let correlation = |i: usize, j: usize| covariance[(i, j)] / (covariance[(i, i)] * covariance[(j, j)]).sqrt();
    let places: Vec<Vec<usize>> =
        chosen.iter().map(|c| neutral_at_zero(fit, &c.applied).into_iter().map(|(i, _)| i).collect()).collect();
    for (k, a) in places.iter().enumerate() {
        for (l, b) in places.iter().enumerate().skip(k + 1) {
            if !(is_term(&chosen[k].applied) && is_term(&chosen[l].applied)) && a.iter().any(|i| b.iter().any(|j| correlation(*i, *j).abs() > RIDGE)) {
                let (less, more) = if chosen[k].delta_bic < chosen[l].delta_bic { (k, l) } else { (l, k) };
                return Some((chosen[less].applied.clone(), chosen[more].applied.label()));
            }
        }
    }
    None
}

