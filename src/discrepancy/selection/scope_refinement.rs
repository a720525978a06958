//! The scope of an effect refined: its numbers moved by a coordinate search, its name the first that says the same.

use super::candidates::{place, rounded};
use super::search::{Search, find};
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::evidence::information_criterion::bic;
use crate::discrepancy::evidence::score_test::ScoreTest;
use crate::discrepancy::shooting::windows::WINDOW;
use crate::effects::{Applied, Scope};
use crate::error::Result;

/// Two fits whose criteria differ by no more say the same.
const SAME: f64 = 1.0;
/// The effort of a fit by which scopes are compared.
const QUICK: Effort = Effort { passes: 3, ..Effort::SCREENING };
/// The steps by which the numbers of a scope are moved: shares of a window, or of a fifth of their size.
const STEPS: [f64; 4] = [1.0, 0.4, 0.15, 0.05];
/// Steps of one number one way, at most.
const MOST_STEPS: usize = 12;

impl Search<'_> {
    /// The fit with the first effect of the library that says the same in the same scope.
    pub(super) fn named_first(&self, base: &Fit, own: &Applied, fit: Fit, weighed: &[ScoreTest]) -> Result<Fit> {
        let Some(scope) = &own.effect.scope else { return Ok(fit) };
        let mut rivals: Vec<Applied> = vec![];
        for promise in weighed.iter().map(|p| &p.applied).filter(|a| place(a) < place(own)) {
            if promise.values.len() == own.values.len() && !rivals.iter().any(|r| r.same_as(promise)) {
                rivals.push(Applied { effect: promise.effect.within(scope.clone()), ..promise.clone() });
            }
        }
        rivals.sort_by_key(place);
        for rival in rivals {
            let model = base.model.clone().with_effect(rival);
            let other = self.problem.fit(&model, &fit.window_states, &fit.variances, Effort::FULL)?;
            let n = fit.sample_size;
            if let Some(other) = other.filter(|o| rounded(bic(o, n)) <= rounded(bic(&fit, n)) + SAME) {
                return Ok(other);
            }
        }
        Ok(fit)
    }

    /// The fit with the numbers of an effect's scope moved one after another, by ever smaller steps, at its variances.
    pub(super) fn with_scope_moved(&self, fit: &Fit, of: &Applied) -> Result<Fit> {
        let mut best = self.problem.fit(&fit.model, &fit.window_states, &fit.variances, Effort::SCREENING)?;
        for share in STEPS {
            let Some(scope) = best.as_ref().and_then(|b| find(&b.model, of)).and_then(|a| a.effect.scope) else {
                break;
            };
            for k in 0..scope.movable().len() {
                for sign in [1.0, -1.0] {
                    for _ in 0..MOST_STEPS {
                        let Some(better) = self.moved(best.as_ref(), of, k, sign * share)? else { break };
                        best = Some(better);
                    }
                }
            }
        }
        Ok(best.unwrap_or_else(|| fit.clone()))
    }

    /// The fit with one number of a scope moved by a share of its own step, where that is better.
    fn moved(&self, best: Option<&Fit>, of: &Applied, k: usize, by: f64) -> Result<Option<Fit>> {
        let Some((best, mut own)) = best.and_then(|b| Some((b, find(&b.model, of)?))) else { return Ok(None) };
        let Some(scope) = own.effect.scope.clone() else { return Ok(None) };
        let mut numbers = scope.movable();
        let step = match &scope {
            Scope::Times(_) => WINDOW,
            Scope::Disk([.., radius]) => 0.2 * radius,
            _ => 0.2 * numbers[k].abs(),
        };
        numbers[k] = ((numbers[k] + by * step) * 1e4).round() / 1e4;
        let Some(scope) = scope.moved(&numbers) else { return Ok(None) };
        own.effect.scope = Some(scope);
        let model = best.model.clone().with_effect(own);
        let fit = self.problem.fit(&model, &best.window_states, &best.variances, QUICK)?;
        Ok(fit.filter(|fit| fit.deviance < best.deviance - QUICK.enough))
    }
}
