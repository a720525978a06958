//! The scope of an effect refined: its numbers moved by a coordinate search (Hooke and Jeeves, 1961) and at last by parabolas.

use super::search::{Search, find};
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::estimation::unexplained::{explains_half, explains_most, remains};
use crate::discrepancy::evidence::information_criterion::bic;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::shooting::windows::WINDOW;
use crate::effects::{Applied, Scope};
use crate::error::Result;

/// The effort of a fit by which scopes are compared.
const QUICK: Effort = Effort { passes: 3, begins_near: true, ..Effort::SCREENING };
/// A gain that counts while they are moved, as a share of what the effect explains: its edges are not told any better.
const COUNTS: f64 = 1e-4;
/// The steps by which the numbers of a scope are moved: shares of a window, or of a fifth of their size.
const STEPS: [f64; 3] = [1.0, 0.4, 0.15];
/// Steps of one number one way that change nothing, at most.
const MOST_STEPS: u32 = 12;
/// Steps that are looked at even where the first ones are worse, of scopes with so few numbers.
const ACROSS: u32 = 4;
const FEW: usize = 3;
/// Intervals, and gaps between them, that last no longer are none, s.
const SLIVER: f64 = 0.3;
/// Rounds in which the numbers of a scope are moved while something remains.
const ROUNDS: usize = 2;
/// Moves of one number one way, at most.
const MOST_MOVES: usize = 30;
/// Other valleys of the deviance over a number of a scope are looked for at so many steps to either side, each such a share of a window.
const ACROSS_VALLEYS: i32 = 8;
const VALLEYS: f64 = 0.15;
/// Half the width of the parabola by which a number is moved at last, in the same shares, round by round.
const HALF_WIDTHS: [f64; 3] = [0.1, 0.02, 0.004];

impl Search<'_> {
    /// The fit with the numbers of an effect's scope moved to where they explain most. What an edge in the wrong place leaves
    /// is taken for noise, and hides the right one: while something remains they are moved again, unless the rest is large
    /// and has another cause.
    pub(super) fn with_scope_at_best(&self, base: &Fit, fit: Fit, own: &Applied) -> Result<Fit> {
        if own.effect.scope.as_ref().is_none_or(|s| s.movable().is_empty()) {
            return Ok(fit);
        }
        let mut best = fit;
        // An edge in the wrong place hides a part of what a scope explains, and not most of it.
        let rounds = if explains_half(&best, base) { ROUNDS } else { 0 };
        for _ in 0..rounds {
            let moved = self.with_scope_moved(base, &best, own)?;
            best = self.refit(&moved)?.unwrap_or(moved);
            // At noise that a wrong edge makes, the steps of the search end beside the right one, and the values with them.
            if explains_half(&best, base) {
                best = self.with_scope_settled(best, own)?;
            }
            if !remains(&best) || !explains_most(&best, base) {
                break;
            }
        }
        if remains(&best) && explains_most(&best, base) {
            best = self.in_other_valley(best, own)?;
        }
        self.simplified(best, own)
    }

    /// The fit with the numbers of a simple scope in valleys of the deviance beside their own, where those are deeper: where what
    /// an effect does comes and goes, an edge at another time does as much in all.
    fn in_other_valley(&self, mut best: Fit, of: &Applied) -> Result<Fit> {
        let numbers = find(&best.model, of).and_then(|a| a.effect.scope).map_or(0, |s| s.movable().len());
        if numbers > FEW {
            return Ok(best);
        }
        for k in 0..numbers {
            let Some(here) = self.problem.fit(&best.model, &best.window_states, &best.variances, QUICK)? else { break };
            let at = |i: i32| -> Result<Option<(i32, Fit)>> {
                let fit =
                    if i == 0 { Some(here.clone()) } else { self.varied(&here, of, k, f64::from(i) * VALLEYS, QUICK)? };
                Ok(fit.map(|fit| (i, fit)))
            };
            let along: Vec<Option<(i32, Fit)>> = (-ACROSS_VALLEYS..=ACROSS_VALLEYS).map(at).collect::<Result<_>>()?;
            let along: Vec<(i32, Fit)> = along.into_iter().flatten().collect();
            let bottom = |w: &[(i32, Fit)]| w[0].1.deviance > w[1].1.deviance && w[2].1.deviance > w[1].1.deviance;
            let others = along.windows(3).filter(|w| w[1].0 != 0 && bottom(w)).map(|w| &w[1].1);
            let Some(other) = others.min_by(|a, b| a.deviance.total_cmp(&b.deviance)) else { continue };
            let Some(there) = self.refit(other)? else { continue };
            let there = self.with_scope_settled(there, of)?;
            let n = best.sample_size.max(there.sample_size);
            if bic(&there, n) < bic(&best, n) {
                best = there;
            }
        }
        Ok(best)
    }

    /// The fit with intervals of a scope that touch made one, those of no length left out, and edges beyond the data, or where
    /// the vehicle does nothing that tells them, left open, where that explains as much.
    fn simplified(&self, fit: Fit, own: &Applied) -> Result<Fit> {
        let Some(scope) = find(&fit.model, own).and_then(|a| a.effect.scope) else { return Ok(fit) };
        let spans = self.problem.records.iter().map(Record::span);
        let widest = |[a, b]: [f64; 2], [from, until]: [f64; 2]| [a.min(from), b.max(until)];
        let [first, last] = spans.fold([f64::INFINITY, f64::NEG_INFINITY], widest);
        let few =
            scope.without_slivers(SLIVER).unwrap_or_else(|| scope.clone()).open_beyond(first + SLIVER, last - SLIVER);
        let mut fit = self.at_simpler(fit, own, few)?;
        for end in [0, 1] {
            let scope = find(&fit.model, own).and_then(|a| a.effect.scope);
            let Some(open) = scope.and_then(|scope| scope.left_open(end)) else { continue };
            fit = self.at_simpler(fit, own, open)?;
        }
        Ok(fit)
    }

    /// The fit at a simpler scope where that explains as much, and the fit as it is elsewhere.
    fn at_simpler(&self, fit: Fit, own: &Applied, scope: Scope) -> Result<Fit> {
        let Some(mut simpler) = find(&fit.model, own) else { return Ok(fit) };
        if simpler.effect.scope.as_ref() == Some(&scope) || scope.movable().is_empty() {
            return Ok(fit);
        }
        simpler.effect.scope = Some(scope);
        let model = fit.model.clone().with_effect(simpler);
        let n = fit.sample_size;
        let quick = self.problem.fit(&model, &fit.window_states, &fit.variances, QUICK)?;
        if quick.is_none_or(|quick| bic(&quick, n) > bic(&fit, n)) {
            return Ok(fit);
        }
        let Some(other) = self.fit_instead(&fit, &model)? else { return Ok(fit) };
        let n = n.max(other.sample_size);
        Ok(if bic(&other, n) < bic(&fit, n) { other } else { fit })
    }

    /// The fit with the numbers of an effect's scope moved one after another, by ever smaller steps, at its variances.
    fn with_scope_moved(&self, base: &Fit, fit: &Fit, of: &Applied) -> Result<Fit> {
        let enough = QUICK.enough.max(COUNTS * (base.deviance - fit.deviance));
        let effort = Effort { passes: 1, enough, ..QUICK };
        let begun = self.problem.fit(&fit.model, &fit.window_states, &fit.variances, Effort::SCREENING)?;
        let Some(mut best) = begun else { return Ok(fit.clone()) };
        let Some(scope) = find(&best.model, of).and_then(|a| a.effect.scope) else { return Ok(best) };
        // The deviance has valleys beside one another: the few numbers of a simple scope are moved across.
        let across = if scope.movable().len() <= FEW { ACROSS } else { 1 };
        for share in STEPS {
            for k in 0..scope.movable().len() {
                for sign in [1.0, -1.0] {
                    for _ in 0..MOST_MOVES {
                        let Some(better) = self.further(&best, of, (k, sign * share), across, effort)? else { break };
                        best = better;
                    }
                }
            }
        }
        Ok(best)
    }

    /// The fit with one number of a scope some steps further, where that is better. Where a vehicle stands still, or hardly
    /// does what the effect acts on, steps change little or nothing, and what is better lies `across`.
    fn further(
        &self,
        best: &Fit,
        of: &Applied,
        (k, step): (usize, f64),
        across: u32,
        effort: Effort,
    ) -> Result<Option<Fit>> {
        for steps in 1..=MOST_STEPS {
            let Some(there) = self.varied(best, of, k, f64::from(steps) * step, effort)? else { break };
            if there.deviance < best.deviance - effort.enough {
                return Ok(Some(there));
            }
            if steps >= across && there.deviance > best.deviance + effort.enough {
                break;
            }
        }
        Ok(None)
    }

    /// The fit with every number of a scope moved to the vertex of a parabola through three deviances, and noise and jumps
    /// of its own: an edge that is off by less than a row leaves jumps that a precise sensor sees.
    fn with_scope_settled(&self, mut fit: Fit, of: &Applied) -> Result<Fit> {
        for width in HALF_WIDTHS {
            let Some(begin) = self.problem.fit(&fit.model, &fit.window_states, &fit.variances, QUICK)? else { break };
            let numbers = find(&begin.model, of).and_then(|a| a.effect.scope).map_or(0, |s| s.movable().len());
            let mut best = begin.clone();
            for k in 0..numbers {
                let beside = |by: f64| self.varied(&best, of, k, by, QUICK);
                let (Some(less), Some(more)) = (beside(-width)?, beside(width)?) else { continue };
                let (slope, bend) =
                    (more.deviance - less.deviance, more.deviance + less.deviance - 2.0 * best.deviance);
                let vertex = (-0.5 * slope / bend).clamp(-1.0, 1.0);
                let there = if bend > 0.0 { beside(vertex * width)? } else { None };
                for fit in [less, more].into_iter().chain(there) {
                    if fit.deviance < best.deviance {
                        best = fit;
                    }
                }
            }
            let gained = begin.deviance - best.deviance;
            if gained <= 0.0 {
                continue;
            }
            match self.refit(&best)? {
                Some(better) => fit = better,
                None => break,
            }
        }
        Ok(fit)
    }

    /// The fit with one number of a scope moved by a share of its own step, at the same variances.
    pub(super) fn varied(&self, fit: &Fit, of: &Applied, k: usize, by: f64, effort: Effort) -> Result<Option<Fit>> {
        let Some(mut own) = find(&fit.model, of) else { return Ok(None) };
        let Some(scope) = own.effect.scope.clone() else { return Ok(None) };
        let mut numbers = scope.movable();
        let step = match &scope {
            Scope::Times(_) => WINDOW,
            Scope::Disk([.., radius]) => 0.2 * radius,
            _ => 0.2 * numbers[k].abs(),
        };
        numbers[k] = ((numbers[k] + by * step) * 1e5).round() / 1e5;
        let Some(scope) = scope.moved(&numbers) else { return Ok(None) };
        own.effect.scope = Some(scope);
        let model = fit.model.clone().with_effect(own);
        self.problem.fit(&model, &fit.window_states, &fit.variances, effort)
    }
}
