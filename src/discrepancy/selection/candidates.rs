//! Candidates of a search, screened by what they promise and ranked by their evidence.

use super::search::{Addition, Candidate, Search, find};
use crate::discrepancy::estimation::bounds::{is_possible, vanishes};
use crate::discrepancy::estimation::fit::Effort;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::evidence::information_criterion::{bic, delta_bic};
use crate::discrepancy::evidence::score_test;
use crate::discrepancy::evidence::score_test::{ScoreTest, ScoreTests};
use crate::discrepancy::evidence::wald_test::repeats;
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::Model;
use crate::progress::{Counter, OnProgress, Stage};
use rayon::prelude::*;

/// How many of the best candidates are fitted with their own noise and jumps.
pub(crate) const FINALISTS: usize = 3;
/// How many of the most promising candidates are fitted at all.
const SHORTLIST: usize = 8;
/// A candidate that promises less than this share of the best one's gain is not fitted.
const FAINT: f64 = 0.1;

/// Candidates by what they promise, the most promising with a fit; and pairs of them.
pub(crate) struct Shortlist {
    pub single: Vec<(ScoreTest, Option<Fit>)>,
    pub pairs: Vec<[ScoreTest; 2]>,
}

/// Candidates by their evidence, the finalists with a fit; and pairs of them.
pub(crate) struct Ranking {
    pub single: Vec<(Candidate, Option<Fit>)>,
    pub pairs: Vec<[ScoreTest; 2]>,
}

impl Search<'_> {
    /// Effects that could be added to a model.
    fn open(&self, model: &Model) -> Vec<(&Effect, Option<usize>)> {
        let is_taken = |e: &Effect, t: Option<usize>| model.free_effects().any(|a| a.stands_for(e, t));
        model.applicable(self.library).into_iter().filter(|(e, t)| !is_taken(e, *t)).collect()
    }

    /// The candidates for a model by what they promise; the most promising with a fit.
    ///
    /// `from` is the deviance without the candidate, `floor` the least gain that is of interest; `counter` counts them.
    pub(crate) fn screen(
        &self,
        base: &Fit,
        model: &Model,
        [from, floor]: [f64; 2],
        counter: Option<&Counter>,
    ) -> Result<Shortlist> {
        let ScoreTests { single: mut promises, pairs } =
            score_test::promises(self.problem, base, model, &self.open(model))?;
        let n = base.sample_size;
        let worth = |p: &ScoreTest| rounded(p.deviance + p.applied.values.len() as f64 * n.ln());
        promises.sort_by(|a, b| worth(a).total_cmp(&worth(b)));
        // What promises next to nothing beside the best is listed, not fitted.
        let gain = |p: &ScoreTest| from - p.deviance;
        let wanted = promises.iter().map(gain).fold(floor, |m, g| m.max(FAINT * g));
        let settled = |(i, p): (usize, ScoreTest)| -> Result<_> {
            let worthwhile = i < SHORTLIST && gain(&p) >= wanted;
            let fit = if worthwhile {
                score_test::settled(self.problem, base, model, &[&p], Effort::CANDIDATE)?
            } else {
                None
            };
            counter.map_or(Ok(()), Counter::one)?;
            Ok((p, fit))
        };
        let mut found: Vec<(ScoreTest, Option<Fit>)> =
            promises.into_par_iter().enumerate().map(settled).collect::<Result<_>>()?;
        // A stable sort: of identical effects the first of the library is named.
        let rank = |(p, fit): &(ScoreTest, Option<Fit>)| match fit {
            Some(fit) => (false, rounded(bic(fit, n)), place(&p.applied)),
            None => (true, worth(p), place(&p.applied)),
        };
        found.sort_by(|a, b| {
            let ((a0, a1, a2), (b0, b1, b2)) = (rank(a), rank(b));
            a0.cmp(&b0).then(a1.total_cmp(&b1)).then(a2.cmp(&b2))
        });
        Ok(Shortlist { single: found, pairs })
    }

    /// The candidates by ΔBIC against a fit, the finalists with noise and jumps of their own; the others are listed
    /// by what they promise, and have no fit.
    pub(crate) fn ranked(&self, base: &Fit, chosen: usize, progress: &OnProgress) -> Result<Ranking> {
        let finish = |(i, (promise, fit)): (usize, (ScoreTest, Option<Fit>))| -> Result<_> {
            // At the edge where it vanishes an effect is not chosen, and is stiff to integrate.
            let gone = |fit: &Fit| find(&fit.model, &promise.applied).is_some_and(|a| vanishes(&a));
            let full = match &fit {
                Some(fit) if i < FINALISTS && !gone(fit) => self.refit(fit)?,
                _ => None,
            };
            let n = base.sample_size.max(full.as_ref().map_or(0.0, |f| f.sample_size));
            let deviance = full.as_ref().or(fit.as_ref()).map_or(promise.deviance, |f| f.deviance);
            let begun = full.as_ref().map_or(0.0, |f| f.initial_state_dof - base.initial_state_dof);
            let k = promise.applied.values.len() as f64 + begun;
            let delta_bic = base.deviance - deviance - k * n.ln();
            let fitted = full.as_ref().or(fit.as_ref()).and_then(|f| find(&f.model, &promise.applied));
            let applied = fitted.unwrap_or(promise.applied);
            Ok((Candidate { applied, std: promise.std, delta_bic }, full))
        };
        let counter = Counter::begin(progress, Stage::Candidates { chosen }, self.open(&base.model).len())?;
        let screened = self.screen(base, &base.model, [base.deviance, 0.5 * self.margin()], Some(&counter))?;
        let mut scored: Vec<(Candidate, Option<Fit>)> =
            screened.single.into_par_iter().enumerate().map(finish).collect::<Result<_>>()?;
        scored.sort_by(|a, b| {
            let rank = |s: &(Candidate, Option<Fit>)| rounded(-s.0.delta_bic);
            rank(a).total_cmp(&rank(b)).then(place(&a.0.applied).cmp(&place(&b.0.applied)))
        });
        Ok(Ranking { single: scored, pairs: screened.pairs })
    }

    /// The best two effects together, where they promise and keep more than the best one by what a second one costs.
    pub(crate) fn pair(&self, base: &Fit, pairs: &[[ScoreTest; 2]], single: Option<&Fit>) -> Result<Option<Addition>> {
        let reached = single.unwrap_or(base);
        let mut best: Option<Addition> = None;
        for [a, b] in pairs {
            let n = base.sample_size.max(reached.sample_size);
            let k = base.p.len() + a.applied.values.len() + b.applied.values.len();
            let bar = bic(reached, n) - self.margin() * if single.is_some() { 1.0 } else { 2.0 };
            if a.deviance + k as f64 * n.ln() > bar {
                continue;
            }
            let Some(rough) = score_test::settled(self.problem, base, &base.model, &[a, b], Effort::CANDIDATE)? else {
                continue;
            };
            if rough.model.free_effects().any(vanishes) {
                continue;
            }
            let Some(fit) = self.refit(&rough)? else { continue };
            if !fit.model.free_effects().all(is_possible) || ![a, b].iter().all(|p| repeats(&fit, &p.applied)) {
                continue;
            }
            let n = n.max(fit.sample_size);
            let bar = self.margin() * if single.is_some() { 1.0 } else { 2.0 };
            if delta_bic(&fit, reached, n) > bar && best.as_ref().is_none_or(|(_, f)| bic(&fit, n) < bic(f, n)) {
                best = Some((vec![a.applied.clone(), b.applied.clone()], fit));
            }
        }
        Ok(best)
    }
}

/// The place of an effect in the library.
pub(crate) fn place(a: &Applied) -> (usize, Option<usize>) {
    (a.effect.order, a.trailer)
}

/// Deviances of identical effects differ by rounding alone.
pub(crate) fn rounded(x: f64) -> f64 {
    (x * 20.0).round() / 20.0
}
