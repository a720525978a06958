//! Which effects are missing: candidates ranked by evidence on the fitting data alone.

use super::chain::Variances;
use super::fit::{Effort, Fit, Problem};
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::Model;
use rayon::prelude::*;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// A rival whose evidence is this close to the chosen effect's is not told from it.
const CLOSE: f64 = 6.0;
/// How many of the best candidates are fitted with their own noise and jumps.
const FINALISTS: usize = 5;
/// Most effects that are added.
const MOST: usize = 6;

/// A candidate effect and its evidence beside the effects already chosen.
#[derive(Clone, Debug)]
pub struct Scored {
    /// The effect at its fitted values.
    pub applied: Applied,
    /// BIC without minus BIC with the effect.
    pub delta_bic: f64,
}

/// An effect that was chosen.
#[derive(Clone, Debug)]
pub struct Chosen {
    /// The effect at its fitted values.
    pub applied: Applied,
    /// Standard deviations of its values, where the data give them.
    pub std: Vec<Option<f64>>,
    /// BIC without minus BIC with the effect, beside all others.
    pub delta_bic: f64,
    /// Probability of so large an improvement where the effect is not there.
    pub p_value: f64,
    /// Effects that these data do not tell from it.
    pub rivals: Vec<Applied>,
}

/// The outcome of the selection.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The model as given.
    pub before: Fit,
    /// The model with the chosen effects.
    pub after: Fit,
    /// The chosen effects, in the order of the model.
    pub chosen: Vec<Chosen>,
    /// The models on the way, after each addition.
    pub steps: Vec<(String, Model)>,
    /// All candidates as they stood against the model as given.
    pub candidates: Vec<Scored>,
}

const SCREEN: Effort = Effort { passes: 5, variances: false };
const FULL: Effort = Effort { passes: 6, variances: true };

/// Adds effects of the library one at a time until nothing is left above the noise.
///
/// A candidate must beat BIC = deviance + k·ln n by a margin of 2·ln M for a library of M candidates: with
/// nothing hidden the best of M would otherwise pass by chance. After each addition earlier ones are asked
/// again whether they are still needed, and whether another would do better in their place.
pub fn choose(problem: &Problem, model: &Model, library: &[Effect], progress: &dyn Fn(&str)) -> Result<Option<Choice>> {
    progress("fitting the model as it is");
    let starts = problem.starts(model)?;
    let Some(before) = problem.fit(model, &starts, &problem.variances, FULL)? else { return Ok(None) };
    let selection =
        Selection { problem, library, size: model.applicable(library).len().max(1) as f64, given: before.variances };
    let mut current = before.clone();
    let mut steps = Vec::new();
    let mut candidates = Vec::new();
    while steps.len() < MOST {
        progress(&format!("weighing {} candidates, {} chosen", selection.size, steps.len()));
        let ranked = selection.ranked(&current)?;
        if steps.is_empty() {
            candidates = ranked.iter().map(|(s, _)| s.clone()).collect();
        }
        let Some((best, fit)) = ranked.into_iter().next() else { break };
        if best.delta_bic <= selection.margin() {
            break;
        }
        steps.push((best.applied.label(), fit.model.clone()));
        current = selection.pruned(fit)?;
        current = selection.exchanged(current)?;
    }
    let chosen = selection.examined(&current)?;
    Ok(Some(Choice { before, after: current, chosen, steps, candidates }))
}

struct Selection<'a> {
    problem: &'a Problem,
    library: &'a [Effect],
    size: f64,
    given: Variances,
}

fn free_effects(model: &Model) -> Vec<Applied> {
    model.effects.iter().filter(|e| e.free).cloned().collect()
}

fn without(model: &Model, effect: &Applied) -> Model {
    let mut smaller = model.clone();
    smaller.effects.retain(|e| !e.same_as(effect));
    smaller
}

fn bic(fit: &Fit, sample_size: f64) -> f64 {
    fit.deviance + fit.p.len() as f64 * sample_size.ln()
}

impl Selection<'_> {
    /// What a candidate must gain beyond BIC because the library is large.
    fn margin(&self) -> f64 {
        2.0 * self.size.ln()
    }

    /// Effects that could be added to a model.
    fn open(&self, model: &Model) -> Vec<(&Effect, Option<usize>)> {
        let taken = free_effects(model);
        let is_taken = |e: &Effect, t: Option<usize>| taken.iter().any(|a| a.effect.id == e.id && a.trailer == t);
        model.applicable(self.library).into_iter().filter(|(e, t)| !is_taken(e, *t)).collect()
    }

    /// A model with one more effect fitted at the noise and jumps it had; the best of the effect's starts.
    fn screened(&self, base: &Fit, model: &Model, effect: &Effect, trailer: Option<usize>) -> Result<Option<Fit>> {
        let mut best: Option<Fit> = None;
        // An entry of the model file is where the search for a better value begins.
        let given = model.effects.iter().find(|e| e.effect.id == effect.id && e.trailer == trailer);
        let starts = given.map_or_else(|| effect.starts(), |e| vec![e.values.clone()]);
        for start in starts {
            let larger = model.clone().with_effect(Applied::new(effect, trailer, start).freed());
            let fit = self.problem.fit(&larger, &base.starts, &base.variances, SCREEN)?;
            let better = |f: &Fit| best.as_ref().is_none_or(|b| f.deviance < b.deviance);
            if let Some(fit) = fit.filter(|f| f.deviance.is_finite() && better(f)) {
                best = Some(fit);
            }
        }
        Ok(best)
    }

    /// All fits with one more effect, best first by what they gain.
    fn screen(&self, base: &Fit, model: &Model) -> Result<Vec<(Applied, Fit)>> {
        let open = self.open(model);
        let fits: Vec<_> = open.par_iter().map(|(e, t)| self.screened(base, model, e, *t)).collect::<Result<_>>()?;
        let mut found: Vec<(Applied, Fit)> = open
            .iter()
            .zip(fits)
            .filter_map(|((e, t), fit)| {
                let fit = fit?;
                let applied = fit.model.effects.iter().find(|a| a.effect.id == e.id && a.trailer == *t)?.clone();
                Some((applied, fit))
            })
            .collect();
        // A stable sort: of identical effects the first of the library is named.
        found.sort_by(|a, b| rounded(bic(&a.1, base.sample_size)).total_cmp(&rounded(bic(&b.1, base.sample_size))));
        Ok(found)
    }

    /// The candidates by ΔBIC against a fit; the finalists with noise and jumps of their own.
    fn ranked(&self, base: &Fit) -> Result<Vec<(Scored, Fit)>> {
        let screened = self.screen(base, &base.model)?;
        let finished: Vec<(Applied, Fit)> = screened
            .into_par_iter()
            .enumerate()
            .map(|(i, (applied, fit))| -> Result<_> {
                let full = if i < FINALISTS { self.refined(&fit)? } else { None };
                Ok((applied, full.unwrap_or(fit)))
            })
            .collect::<Result<_>>()?;
        let mut scored: Vec<(Scored, Fit)> = finished
            .into_iter()
            .map(|(applied, fit)| {
                let n = base.sample_size.max(fit.sample_size);
                let applied = fit.model.effects.iter().find(|a| a.same_as(&applied)).cloned().unwrap_or(applied);
                (Scored { applied, delta_bic: bic(base, n) - bic(&fit, n) }, fit)
            })
            .collect();
        scored.sort_by(|a, b| rounded(b.0.delta_bic).total_cmp(&rounded(a.0.delta_bic)));
        Ok(scored)
    }

    fn refined(&self, fit: &Fit) -> Result<Option<Fit>> {
        self.problem.fit(&fit.model, &fit.starts, &fit.variances, FULL)
    }

    /// The fit without an effect.
    fn reduced(&self, fit: &Fit, effect: &Applied) -> Result<Option<Fit>> {
        // From the jumps of the model as given: what an effect leaves unexplained is not found from zero jumps,
        // where the likelihood is flat.
        self.problem.fit(&without(&fit.model, effect), &fit.starts, &self.given, FULL)
    }

    /// Drops what is no longer needed.
    fn pruned(&self, mut fit: Fit) -> Result<Fit> {
        loop {
            let mut best: Option<(f64, Fit)> = None;
            let effects = free_effects(&fit.model);
            if effects.len() < 2 {
                return Ok(fit);
            }
            for effect in effects {
                let Some(smaller) = self.reduced(&fit, &effect)? else { continue };
                let n = fit.sample_size.max(smaller.sample_size);
                let worth = bic(&smaller, n) - bic(&fit, n);
                if worth <= self.margin() && best.as_ref().is_none_or(|(w, _)| worth < *w) {
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
    fn exchanged(&self, mut fit: Fit) -> Result<Fit> {
        for effect in free_effects(&fit.model) {
            if free_effects(&fit.model).len() < 2 {
                break;
            }
            let smaller = without(&fit.model, &effect);
            let Some((_, rival)) = self.screen(&fit, &smaller)?.into_iter().find(|(a, _)| !a.same_as(&effect)) else {
                continue;
            };
            let Some(rival) = self.refined(&rival)? else { continue };
            let n = fit.sample_size.max(rival.sample_size);
            if bic(&rival, n) < bic(&fit, n) - 0.5 {
                fit = rival;
            }
        }
        Ok(fit)
    }

    /// Evidence, deviations and rivals of every chosen effect.
    fn examined(&self, fit: &Fit) -> Result<Vec<Chosen>> {
        let mut at = 0;
        let mut found = Vec::new();
        for applied in free_effects(&fit.model) {
            let k = applied.values.len();
            let spread = |i: usize| fit.covariance.as_ref().map(|c| c[(i, i)].sqrt());
            let std = (at..at + k).map(spread).collect();
            at += k;
            let Some(smaller) = self.reduced(fit, &applied)? else { continue };
            let n = fit.sample_size.max(smaller.sample_size);
            let gain = (smaller.deviance - fit.deviance).max(0.0);
            let rivals = self.rivals(fit, &applied)?;
            let delta_bic = bic(&smaller, n) - bic(fit, n);
            found.push(Chosen { applied, std, delta_bic, p_value: tail(gain, k), rivals });
        }
        Ok(found)
    }

    /// Effects that explain the data as well in the place of a chosen one.
    fn rivals(&self, fit: &Fit, chosen: &Applied) -> Result<Vec<Applied>> {
        let n = fit.sample_size;
        let own = bic(fit, n);
        let candidates = self.screen(fit, &without(&fit.model, chosen))?;
        let near = candidates.into_iter().filter(|(a, f)| !a.same_as(chosen) && bic(f, n) - own < 4.0 * CLOSE);
        let mut found = Vec::new();
        for (applied, rough) in near.take(FINALISTS) {
            let full = self.refined(&rough)?.unwrap_or(rough);
            if bic(&full, n) - own < CLOSE {
                found.push(applied);
            }
        }
        Ok(found)
    }
}

/// Deviances of identical effects differ by rounding alone.
fn rounded(x: f64) -> f64 {
    (x * 20.0).round() / 20.0
}

/// Probability that χ² with k degrees of freedom exceeds x.
fn tail(x: f64, k: usize) -> f64 {
    ChiSquared::new(k as f64).map_or(f64::NAN, |d| d.sf(x))
}
