//! Effects added to a model one or two at a time, asked again, exchanged and dropped.

use super::bounds::{is_at_an_end, vanishes};
use super::evidence::{repeats, wald};
use super::fit::{Effort, Fit};
use super::problem::Problem;
use super::screen::{self, Promise, Promises};
use super::summary::listed;
use super::unnamed::is_term;
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::Model;
use rayon::prelude::*;

/// How many of the best candidates are fitted with their own noise and jumps.
pub(super) const FINALISTS: usize = 3;
/// How many of the most promising candidates are fitted at all.
const SHORTLIST: usize = 8;
/// A candidate that promises less than this share of the best one's gain is not fitted.
const FAINT: f64 = 0.1;
/// Most effects that are added.
pub(super) const MOST: usize = 6;

/// A candidate effect and its evidence beside the effects already chosen.
#[derive(Clone, Debug)]
pub struct Scored {
    /// The effect at its fitted values.
    pub applied: Applied,
    /// Standard deviations its values have, to first order.
    pub std: Vec<f64>,
    /// BIC without minus BIC with the effect.
    pub delta_bic: f64,
}

pub(super) const SCREEN: Effort = Effort { passes: 5, enough: 0.05, variances: false };
pub(super) const FULL: Effort = Effort { passes: 15, enough: 1e-4, variances: true };

/// What a search ends with.
pub(super) struct Grown {
    /// The model with what was found.
    pub fit: Fit,
    /// The models on the way, after each addition.
    pub steps: Vec<(String, Model)>,
    /// All candidates as they stood against the model the search began with.
    pub candidates: Vec<Scored>,
    /// What the data asked for at the end, and parts of them did not bear out.
    pub refused: Vec<Applied>,
}

/// Effects that are added together, and the model with them.
type Addition = (Vec<Applied>, Fit);

impl Grown {
    /// Nothing added yet.
    pub fn from(fit: &Fit) -> Self {
        Self { fit: fit.clone(), steps: vec![], candidates: vec![], refused: vec![] }
    }

    /// To a smaller model, which is then the only step.
    pub fn go_back_to(&mut self, smaller: Fit) {
        let step = (listed(smaller.model.free_effects().map(Applied::label)), smaller.model.clone());
        self.steps = if smaller.p.is_empty() { vec![] } else { vec![step] };
        self.fit = smaller;
    }
}

/// Candidates by what they promise, the most promising with a fit; and pairs of them.
struct Screened {
    single: Vec<(Promise, Option<Fit>)>,
    pairs: Vec<[Promise; 2]>,
}

/// Candidates by their evidence, the finalists with a fit; and pairs of them.
struct Ranked {
    single: Vec<(Scored, Option<Fit>)>,
    pairs: Vec<[Promise; 2]>,
}

/// A search over a library.
pub(super) struct Selection<'a> {
    pub problem: &'a Problem,
    /// The model as given, with its noise and jumps.
    pub before: &'a Fit,
    pub library: &'a [Effect],
    /// How many candidates the library has for the vehicle.
    pub size: f64,
    /// Most effects that are added.
    pub most: usize,
    /// Whether others are tried in the place of those chosen.
    pub exchanges: bool,
    /// Whether those the search begins with may be dropped.
    pub drops: bool,
}

/// A model without an effect that was found; one that the model as given has with a value of its own has it again.
pub(super) fn without(model: &Model, effect: &Applied, given: &Model) -> Model {
    let mut smaller = model.clone();
    smaller.effects.retain(|e| !e.same_as(effect));
    let given = given.effects.iter().filter(|e| !e.free && e.same_as(effect));
    smaller.effects.extend(given.cloned());
    smaller
}

pub(super) fn bic(fit: &Fit, sample_size: f64) -> f64 {
    fit.deviance + fit.size() * sample_size.ln()
}

/// ΔBIC of a model against a smaller one, its gain of deviance as far as rows are independent.
pub(super) fn worth(larger: &Fit, smaller: &Fit, sample_size: f64) -> f64 {
    let more = larger.size() - smaller.size();
    (smaller.deviance - larger.deviance) / larger.dependence() - more * sample_size.ln()
}

impl Selection<'_> {
    /// Adds effects until nothing is left above the noise.
    pub fn grown(&self, before: &Fit, progress: &dyn Fn(&str)) -> Result<Grown> {
        let mut found = Grown::from(before);
        while found.steps.len() < self.most {
            progress(&format!("weighing {} candidates, {} chosen", self.size, found.steps.len()));
            let ranked = self.ranked(&found.fit)?;
            if found.steps.is_empty() {
                found.candidates = ranked.single.iter().map(|(s, _)| s.clone()).collect();
            }
            let (next, refused) = self.next(&found.fit, ranked)?;
            let Some((added, fit)) = next else {
                found.refused = refused;
                break;
            };
            let model = fit.model.clone();
            let mut next = if self.drops { self.pruned(fit, self.margin())? } else { fit };
            if self.exchanges {
                next = self.exchanged(next)?;
            }
            if same_effects(&next.model, &found.fit.model) {
                // Added only to be dropped: round and round would lead nowhere.
                break;
            }
            found.steps.push((listed(added.iter().map(Applied::label)), model));
            found.fit = next;
        }
        Ok(found)
    }

    /// The next effect to add, or two of them that are needed together; and what was refused before it.
    fn next(&self, base: &Fit, ranked: Ranked) -> Result<(Option<Addition>, Vec<Applied>)> {
        let fitted = ranked.single.into_iter().filter_map(|(s, fit)| Some((s, fit?)));
        let bar = |s: &Scored| if is_term(&s.applied) { 2.0 * self.margin() } else { self.margin() };
        // A gain must be large, and large still when what hangs together counts once.
        let independent = |fit: &Fit| worth(fit, base, base.sample_size.max(fit.sample_size)) > self.margin();
        let counts = |s: &Scored, fit: &Fit| s.delta_bic > bar(s) && independent(fit);
        let inside = |s: &Scored| !vanishes(&s.applied) && !is_at_an_end(&s.applied);
        let good = fitted.filter(|(s, fit)| counts(s, fit) && inside(s) && repeats(fit, &s.applied));
        let singles: Vec<(Scored, Fit)> = good.collect();
        let pair = self.pair(base, &ranked.pairs, singles.first().map(|(_, f)| f))?;
        let singles = singles.into_iter().map(|(s, fit)| (vec![s.applied], fit));
        self.predicting(base, pair.into_iter().chain(singles))
    }

    /// The first candidate that predicts the data it was not fitted to: what does not is no finding. Of terms the one
    /// that misses them least: each stands for a law that it is not, and which of them comes closest along all the data
    /// says little of other data.
    fn predicting(
        &self,
        base: &Fit,
        candidates: impl Iterator<Item = Addition>,
    ) -> Result<(Option<Addition>, Vec<Applied>)> {
        let mut best: Option<(f64, Addition)> = None;
        let mut refused = Vec::new();
        for (added, fit) in candidates {
            let is_term = matches!(&added[..], [one] if is_term(one));
            if best.is_some() && !is_term {
                continue;
            }
            if !self.problem.predicts_better(&fit, base)? {
                refused.extend(added);
                continue;
            }
            if !is_term {
                return Ok((Some((added, fit)), refused));
            }
            let gain = self.problem.missed_less(&fit, base)?;
            if best.as_ref().is_none_or(|(most, _)| gain > *most) {
                best = Some((gain, (added, fit)));
            }
        }
        Ok((best.map(|(_, found)| found), refused))
    }

    /// What a candidate must gain beyond BIC because the library is large.
    pub fn margin(&self) -> f64 {
        2.0 * self.size.ln()
    }

    /// Effects that could be added to a model.
    fn open(&self, model: &Model) -> Vec<(&Effect, Option<usize>)> {
        let is_taken =
            |e: &Effect, t: Option<usize>| model.free_effects().any(|a| a.effect.id == e.id && a.trailer == t);
        model.applicable(self.library).into_iter().filter(|(e, t)| !is_taken(e, *t)).collect()
    }

    /// The candidates for a model by what they promise; the most promising with a fit.
    ///
    /// `from` is the deviance without the candidate, `floor` the least gain that is of interest.
    fn screen(&self, base: &Fit, model: &Model, from: f64, floor: f64) -> Result<Screened> {
        let Promises { single: mut promises, pairs } = screen::promises(self.problem, base, model, &self.open(model))?;
        let n = base.sample_size;
        let worth = |p: &Promise| rounded(p.deviance + p.applied.values.len() as f64 * n.ln());
        promises.sort_by(|a, b| worth(a).total_cmp(&worth(b)));
        // What promises next to nothing beside the best is listed, not fitted.
        let gain = |p: &Promise| from - p.deviance;
        let wanted = promises.iter().map(gain).fold(floor, |m, g| m.max(FAINT * g));
        let settled = |(i, p): (usize, Promise)| -> Result<_> {
            let worthwhile = i < SHORTLIST && gain(&p) >= wanted;
            let fit = if worthwhile { screen::settled(self.problem, base, model, &[&p], SCREEN)? } else { None };
            Ok((p, fit))
        };
        let mut found: Vec<(Promise, Option<Fit>)> =
            promises.into_par_iter().enumerate().map(settled).collect::<Result<_>>()?;
        // A stable sort: of identical effects the first of the library is named.
        let rank = |(p, fit): &(Promise, Option<Fit>)| match fit {
            Some(fit) => (false, rounded(bic(fit, n)), place(&p.applied)),
            None => (true, worth(p), place(&p.applied)),
        };
        found.sort_by(|a, b| {
            let ((a0, a1, a2), (b0, b1, b2)) = (rank(a), rank(b));
            a0.cmp(&b0).then(a1.total_cmp(&b1)).then(a2.cmp(&b2))
        });
        Ok(Screened { single: found, pairs })
    }

    /// The candidates by ΔBIC against a fit, the finalists with noise and jumps of their own; the others are listed
    /// by what they promise, and have no fit.
    fn ranked(&self, base: &Fit) -> Result<Ranked> {
        let finish = |(i, (promise, fit)): (usize, (Promise, Option<Fit>))| -> Result<_> {
            // At the edge where it vanishes an effect is not chosen, and is stiff to integrate.
            let gone = |fit: &Fit| find(&fit.model, &promise.applied).is_some_and(|a| vanishes(&a));
            let full = match &fit {
                Some(fit) if i < FINALISTS && !gone(fit) => self.refined(fit)?,
                _ => None,
            };
            let n = base.sample_size.max(full.as_ref().map_or(0.0, |f| f.sample_size));
            let deviance = full.as_ref().or(fit.as_ref()).map_or(promise.deviance, |f| f.deviance);
            let begun = full.as_ref().map_or(0.0, |f| f.begun - base.begun);
            let k = promise.applied.values.len() as f64 + begun;
            let delta_bic = base.deviance - deviance - k * n.ln();
            let fitted = full.as_ref().or(fit.as_ref()).and_then(|f| find(&f.model, &promise.applied));
            let applied = fitted.unwrap_or(promise.applied);
            Ok((Scored { applied, std: promise.std, delta_bic }, full))
        };
        let screened = self.screen(base, &base.model, base.deviance, 0.5 * self.margin())?;
        let mut scored: Vec<(Scored, Option<Fit>)> =
            screened.single.into_par_iter().enumerate().map(finish).collect::<Result<_>>()?;
        scored.sort_by(|a, b| {
            let rank = |s: &(Scored, Option<Fit>)| rounded(-s.0.delta_bic);
            rank(a).total_cmp(&rank(b)).then(place(&a.0.applied).cmp(&place(&b.0.applied)))
        });
        Ok(Ranked { single: scored, pairs: screened.pairs })
    }

    /// The best two effects together, where they promise and keep more than the best one by what a second one costs.
    fn pair(&self, base: &Fit, pairs: &[[Promise; 2]], single: Option<&Fit>) -> Result<Option<Addition>> {
        let reached = single.unwrap_or(base);
        let mut best: Option<Addition> = None;
        for [a, b] in pairs {
            let n = base.sample_size.max(reached.sample_size);
            let k = base.p.len() + a.applied.values.len() + b.applied.values.len();
            let bar = bic(reached, n) - self.margin() * if single.is_some() { 1.0 } else { 2.0 };
            if a.deviance + k as f64 * n.ln() > bar {
                continue;
            }
            let Some(rough) = screen::settled(self.problem, base, &base.model, &[a, b], SCREEN)? else { continue };
            if rough.model.free_effects().any(vanishes) {
                continue;
            }
            let Some(fit) = self.refined(&rough)? else { continue };
            if fit.model.free_effects().any(is_at_an_end) || ![a, b].iter().all(|p| repeats(&fit, &p.applied)) {
                continue;
            }
            let n = n.max(fit.sample_size);
            let bar = self.margin() * if single.is_some() { 1.0 } else { 2.0 };
            if worth(&fit, reached, n) > bar && best.as_ref().is_none_or(|(_, f)| bic(&fit, n) < bic(f, n)) {
                best = Some((vec![a.applied.clone(), b.applied.clone()], fit));
            }
        }
        Ok(best)
    }

    pub fn refined(&self, fit: &Fit) -> Result<Option<Fit>> {
        self.problem.fit(&fit.model, &fit.starts, &fit.variances, FULL)
    }

    /// The fit without an effect.
    pub fn reduced(&self, fit: &Fit, effect: &Applied) -> Result<Option<Fit>> {
        // From the jumps of the model as given: what an effect leaves unexplained is not found from zero jumps,
        // where the likelihood is flat.
        let smaller = without(&fit.model, effect, &self.before.model);
        self.problem.fit(&smaller, &fit.starts, &self.before.variances, FULL)
    }

    /// Drops what is no longer needed: what is worth no more than a bar beyond BIC.
    pub fn pruned(&self, mut fit: Fit, bar: f64) -> Result<Fit> {
        loop {
            let mut best: Option<(f64, Fit)> = None;
            let effects: Vec<Applied> = fit.model.free_effects().cloned().collect();
            // At the edge where it vanishes an effect explains nothing, whatever the numbers say of its neighbourhood.
            if let Some(gone) = effects.iter().find(|e| vanishes(e)) {
                let Some(smaller) = self.reduced(&fit, gone)? else { return Ok(fit) };
                fit = smaller;
                continue;
            }
            for effect in effects {
                // Far from its neutral value by its own deviation, an effect is needed beyond doubt.
                if wald(&fit, &effect) > 4.0 * self.margin() {
                    continue;
                }
                let Some(smaller) = self.reduced(&fit, &effect)? else { continue };
                let n = fit.sample_size.max(smaller.sample_size);
                let worth = worth(&fit, &smaller, n);
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
    fn exchanged(&self, mut fit: Fit) -> Result<Fit> {
        let chosen: Vec<Applied> = fit.model.free_effects().cloned().collect();
        for effect in &chosen {
            if fit.model.free_effects().count() < 2 {
                break;
            }
            let rivals = self.in_place_of(&fit, effect)?;
            let Some((other, rival)) = rivals.into_iter().next() else { continue };
            let Some(rival) = self.refined(&rival)? else { continue };
            if find(&rival.model, &other).is_some_and(|a| vanishes(&a)) {
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
        let smaller = without(&fit.model, effect, &self.before.model);
        let Some(bare) = self.problem.fit(&smaller, &fit.starts, &fit.variances, SCREEN)? else { return Ok(vec![]) };
        let lost = bare.deviance - fit.deviance;
        let found =
            self.screen(&Fit { variances: fit.variances, ..bare.clone() }, &smaller, bare.deviance, 0.3 * lost)?;
        let fitted = found.single.into_iter().filter_map(|(p, fit)| Some((p.applied, fit?)));
        Ok(fitted.filter(|(a, _)| !a.same_as(effect)).collect())
    }
}

/// An effect of a model.
pub(super) fn find(model: &Model, like: &Applied) -> Option<Applied> {
    model.effects.iter().find(|e| e.same_as(like)).cloned()
}

/// Whether two models have the same effects free, whatever their values.
fn same_effects(a: &Model, b: &Model) -> bool {
    let within = |a: &Model, b: &Model| a.free_effects().all(|e| b.free_effects().any(|o| o.same_as(e)));
    within(a, b) && within(b, a)
}

/// The place of an effect in the library.
fn place(a: &Applied) -> (usize, Option<usize>) {
    (a.effect.order, a.trailer)
}

/// Deviances of identical effects differ by rounding alone.
fn rounded(x: f64) -> f64 {
    (x * 20.0).round() / 20.0
}
