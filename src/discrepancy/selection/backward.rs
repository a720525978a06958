//! Effects of a search that are dropped again, or put in the place of others.

use super::memo::Question;
use super::search::{Search, find, without_effect};
use crate::discrepancy::estimation::bounds::{is_possible, vanishes};
use crate::discrepancy::estimation::fit::Effort;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::evidence::information_criterion::{bic, delta_bic};
use crate::discrepancy::evidence::wald_test::wald;
use crate::effects::Applied;
use crate::error::Result;
use crate::model::effect_equation::is_term;

impl Search<'_> {
    /// The fit without an effect.
    pub fn without(&self, fit: &Fit, effect: &Applied) -> Result<Option<Fit>> {
        self.fit_instead(fit, &without_effect(&fit.model, effect, &self.before.model))
    }

    /// The fit without its terms.
    pub fn without_terms(&self, fit: &Fit) -> Result<Option<Fit>> {
        let mut bare = fit.model.clone();
        bare.effects.retain(|e| !is_term(e));
        self.fit_instead(fit, &bare)
    }

    /// Drops what is no longer needed: what is worth no more than a bar beyond BIC.
    pub fn eliminate_backward(&self, mut fit: Fit, bar: f64) -> Result<Fit> {
        loop {
            let mut best: Option<(f64, Fit)> = None;
            let effects: Vec<Applied> = fit.model.free_effects().cloned().collect();
            // At the edge where it vanishes an effect explains nothing, whatever the numbers say of its neighbourhood.
            if let Some(gone) = effects.iter().find(|e| vanishes(e)) {
                let Some(smaller) = self.without(&fit, gone)? else { return Ok(fit) };
                fit = smaller;
                continue;
            }
            for effect in effects {
                // Far from its neutral value by its own deviation, an effect is needed beyond doubt.
                if wald(&fit, &effect) > 4.0 * self.margin() {
                    continue;
                }
                let Some(smaller) = self.without(&fit, &effect)? else { continue };
                let n = fit.sample_size.max(smaller.sample_size);
                let worth = delta_bic(&fit, &smaller, n);
                if worth <= bar && best.as_ref().is_none_or(|(w, _)| worth < *w) {
                    best = Some((worth, smaller));
                }
            }
            match best {
                Some((_, smaller)) => fit = smaller,
                None => return Ok(fit),
            }
        }
    }

    /// Puts another effect in the place of a chosen one where that explains the data better.
    pub(crate) fn swap(&self, mut fit: Fit) -> Result<Fit> {
        let chosen: Vec<Applied> = fit.model.free_effects().cloned().collect();
        for effect in &chosen {
            if fit.model.free_effects().count() < 2 {
                break;
            }
            let rivals = self.in_place_of(&fit, effect)?;
            let Some((other, rival)) = rivals.into_iter().next() else { continue };
            let Some(rival) = self.refit(&rival)? else { continue };
            if find(&rival.model, &other).is_some_and(|a| vanishes(&a) || !is_possible(&a)) {
                // What it says there, another effect says with fewer parameters.
                continue;
            }
            let n = fit.sample_size.max(rival.sample_size);
            if bic(&rival, n) < bic(&fit, n) - 0.5 {
                fit = rival;
            }
        }
        Ok(fit)
    }

    /// Fits with another effect in the place of a chosen one, best first, at the noise and jumps of the fit: those
    /// that promise a good part of what the chosen one gives.
    pub fn in_place_of(&self, fit: &Fit, effect: &Applied) -> Result<Vec<(Applied, Fit)>> {
        let find = || self.found_in_place_of(fit, effect);
        let Some(memo) = self.memo else { return find() };
        memo.answer(Question::of(fit, effect, (self.library, &self.before.model.effects)), find)
    }

    fn found_in_place_of(&self, fit: &Fit, effect: &Applied) -> Result<Vec<(Applied, Fit)>> {
        let smaller = without_effect(&fit.model, effect, &self.before.model);
        let Some(bare) = self.problem.fit(&smaller, &fit.window_states, &fit.variances, Effort::SCREENING)? else {
            return Ok(vec![]);
        };
        let lost = bare.deviance - fit.deviance;
        let found = self.screen(
            &Fit { variances: fit.variances.clone(), ..bare.clone() },
            &smaller,
            [bare.deviance, 0.3 * lost],
            None,
        )?;
        let fitted = found.single.into_iter().filter_map(|(p, fit)| Some((p.applied, fit?)));
        let possible = |a: &Applied, f: &Fit| find(&f.model, a).is_some_and(|a| is_possible(&a));
        Ok(fitted.filter(|(a, f)| !a.same_as(effect) && possible(a, f)).collect())
    }
}
