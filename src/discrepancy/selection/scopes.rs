//! Effects that hold in part only, or move with time, asked for where what holds always does not explain the data.

use super::candidates::{FINALISTS, place, rounded};
use super::scope_proposals::{BORNE_OUT, BlockRows, Proposal, SHORTEST};
use super::search::{Search, SearchState, find, first_of};
use crate::discrepancy::estimation::bounds::{is_possible, vanishes};
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::estimation::unexplained::{is_wanted, remains};
use crate::discrepancy::evidence::heterogeneity::{RunValue, spreads};
use crate::discrepancy::evidence::information_criterion::{bic, delta_bic};
use crate::discrepancy::evidence::scope_scan::{BlockScores, Blocks};
use crate::discrepancy::evidence::score_test::{self, ScoreTest, ScoreTests};
use crate::discrepancy::shooting::window_integration::linearise;
use crate::effects::{Applied, Effect, Scope};
use crate::error::Result;
use crate::model::effect_equation::is_term;
use crate::progress::{OnProgress, Stage, begin};
use rayon::prelude::*;

/// Effects with a scope or a course at most.
const MOST: usize = 2;
/// What an effect in part leaves of the variance of what is unexplained, at most, where it leaves anything.
const LEFT: f64 = 0.04;
/// Effects that always hold, added beside one in part, at most.
const BESIDE: usize = 2;
/// Proposals that are linearised with gates of their own, at most.
const SHORTLIST: usize = 16;
/// Effects of which the blocks are weighed by one linearisation.
const TOGETHER: usize = 8;
/// Scopes that are tried for each block and effect, about.
const TRIED_PER_BLOCK: usize = 10;
/// Of these so many are fitted.
const TRIED: usize = 2 * FINALISTS;
/// And of one kind of scope so many.
const OF_A_KIND: usize = 2;
/// Runs whose first rows lie within so many seconds of one another have one clock.
const ONE_CLOCK: f64 = 1.0;
/// Times beyond this are stamps, and what moves with time is told from the first row on, s.
const STAMP: f64 = 1e4;

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
    for start in starts {
        let Some(found) = selection.with_scopes(start, progress)? else { continue };
        let n = named.fit.sample_size.max(found.fit.sample_size);
        let gains = delta_bic(&found.fit, &named.fit, n) > 0.0 && explains(&found.fit, selection.before);
        if gains && bic(&found.fit, n) < bic(&named.fit, n) - selection.margin() {
            return Ok(Some(SearchState { candidates: named.candidates.clone(), ..found }));
        }
    }
    Ok(None)
}

/// Whether a fit leaves nothing, or far less than another: beside a large rest a scope may imitate whatever is there.
fn explains(fit: &Fit, than: &Fit) -> bool {
    let left = |fit: &Fit| fit.variances.process().iter().map(|c| c.variance).collect::<Vec<f64>>();
    let (now, before) = (left(fit), left(than));
    let worst = |c: usize| before[c] * than.unexplained[c];
    let most = (0..before.len()).max_by(|a, b| worst(*a).total_cmp(&worst(*b)));
    !remains(fit) || most.is_some_and(|c| now[c] < LEFT * before[c])
}

/// Whether an effect holds in part only, or moves with time.
pub(crate) fn is_partial(effect: &Applied) -> bool {
    effect.effect.scope.is_some() || effect.effect.course.is_some()
}

/// What an effect in part is sought among.
struct Proposed {
    /// Effects within scopes.
    scoped: Vec<(Effect, Option<usize>)>,
    /// Effects with their first parameter moving, with their second one, and so on.
    moving: Vec<Vec<(Effect, Option<usize>)>>,
    /// How many scopes were tried.
    tried: f64,
}

impl Search<'_> {
    /// From a model on: effects in part, and what always holds beside them.
    fn with_scopes(&self, mut found: SearchState, progress: &OnProgress) -> Result<Option<SearchState>> {
        let steps = found.steps.clone();
        for _ in 0..MOST {
            let Some((label, fit)) = self.next_in_part(&found.fit)? else { break };
            // Beside a first one a second may only imitate what that one is not: it stands where it leaves nothing.
            let is_second = partial(&found.fit).next().is_some();
            let mut trail = [&steps[..], &[(label, fit.model.clone())]].concat();
            let fit = self.eliminate_backward(fit, self.margin())?;
            // What is explained to its noise needs nothing beside.
            let few = Search { most: BESIDE, ..*self };
            let more = if remains(&fit) { few.grown(&fit, progress)? } else { SearchState::from(&fit) };
            trail.extend(more.steps);
            if is_second && remains(&more.fit) {
                break;
            }
            found = SearchState { steps: trail, refused: more.refused, fit: more.fit, ..found };
            if !remains(&found.fit) {
                break;
            }
        }
        let some = partial(&found.fit).next().is_some();
        Ok(some.then_some(found))
    }

    /// The effect in part that gains most beyond what it costs, and the fit with it.
    fn next_in_part(&self, base: &Fit) -> Result<Option<(String, Fit)>> {
        let Proposed { scoped, moving, tried } = self.proposed(base)?;
        let margin = 2.0 * tried.ln();
        let promises = |some: &[(&Effect, Option<usize>)]| score_test::promises(self.problem, base, &base.model, some);
        // Each scope of an effect is a candidate of its own; of a parameter that moves there is one for each effect.
        let alone = scoped.par_iter().map(|(e, t)| promises(&[(e, *t)]));
        let alone: Vec<ScoreTests> = alone.collect::<Result<_>>()?;
        let mut weighed: Vec<ScoreTest> = alone.into_iter().flat_map(|found| found.single).collect();
        for one_each in &moving {
            let open: Vec<(&Effect, Option<usize>)> = one_each.iter().map(|(e, t)| (e, *t)).collect();
            weighed.extend(promises(&open)?.single);
        }
        let n = base.sample_size;
        let cost = |a: &Applied| (a.values.len() + a.effect.scope.as_ref().map_or(0, |s| s.cost())) as f64 * n.ln();
        let worth = |p: &ScoreTest| rounded(p.deviance + cost(&p.applied));
        weighed.sort_by(|a, b| worth(a).total_cmp(&worth(b)).then(place(&a.applied).cmp(&place(&b.applied))));
        let fits = of_each_kind(&weighed)
            .into_par_iter()
            .map(|promise| self.in_part(base, promise, margin))
            .collect::<Result<Vec<_>>>()?;
        let mut fits: Vec<(Applied, Fit)> = fits.into_iter().flatten().collect();
        let n = fits.iter().map(|(_, f)| f.sample_size).fold(n, f64::max);
        fits.sort_by(|(a, f), (b, g)| rounded(bic(f, n)).total_cmp(&rounded(bic(g, n))).then(place(a).cmp(&place(b))));
        let worse = |fit: &Fit| self.problem.predicts_worse(fit, base);
        for (own, fit) in fits {
            if !worse(&fit)? {
                let fit = self.named_first(base, &own, fit, &weighed)?;
                let label = partial(&fit).last().map_or_else(|| own.label(), Applied::label);
                return Ok(Some((label, fit)));
            }
        }
        Ok(None)
    }

    /// The fit with an effect in part, the numbers of its scope moved to where they explain most; `None` where it is not
    /// worth what it costs.
    fn in_part(&self, base: &Fit, promise: &ScoreTest, margin: f64) -> Result<Option<(Applied, Fit)>> {
        let rough = score_test::settled(self.problem, base, &base.model, &[promise], Effort::SCREENING)?;
        let Some(mut fit) = rough.map(|rough| self.refit(&rough)).transpose()?.flatten() else { return Ok(None) };
        let n = base.sample_size.max(fit.sample_size);
        if bic(&fit, n) + margin >= bic(base, n) {
            return Ok(None);
        }
        if promise.applied.effect.scope.as_ref().is_some_and(|s| !s.movable().is_empty()) {
            let moved = self.with_scope_moved(&fit, &promise.applied)?;
            fit = self.refit(&moved)?.unwrap_or(moved);
        }
        let Some(own) = find(&fit.model, &promise.applied) else { return Ok(None) };
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
        let records = self.problem.records.iter().map(|r| [r.time[r.rows.start], r.time[r.rows.end - 1]]);
        let inside = records.flat_map(|[a, b]| intervals.iter().map(move |[from, until]| until.min(b) - from.max(a)));
        inside.filter(|s| *s > 0.0).sum::<f64>() >= SHORTEST
    }

    /// Effects with the scopes and courses by which they promise most.
    fn proposed(&self, base: &Fit) -> Result<Proposed> {
        let model = &base.model;
        let open: Vec<(&Effect, Option<usize>)> = model
            .applicable(self.library)
            .into_iter()
            .filter(|(e, t)| score_test::is_regular(e, model, *t) && e.scope.is_none())
            .collect();
        let blocks = Blocks::of_plan(&self.problem.plan);
        let rows = BlockRows::of(self.problem, model, &blocks)?;
        let groups: Vec<&[(&Effect, Option<usize>)]> = open.chunks(TOGETHER).collect();
        let of_group = |group: &&[(&Effect, Option<usize>)]| self.scopes_of(base, group, &blocks, &rows);
        let all: Vec<Vec<(Effect, Option<usize>, Proposal)>> =
            groups.par_iter().map(of_group).collect::<Result<_>>()?;
        let mut all: Vec<(Effect, Option<usize>, Proposal)> = all.into_iter().flatten().collect();
        let n = base.sample_size;
        let worth = |(e, _, p): &(Effect, Option<usize>, Proposal)| {
            p.gain - (e.parameters.len() + p.scope.cost()) as f64 * n.ln() - 2.0 * (p.of as f64).ln()
        };
        all.retain(|one| worth(one) > 0.0);
        all.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
        let tried = (open.len() * blocks.count * TRIED_PER_BLOCK).max(1) as f64;
        let scoped = all.into_iter().take(SHORTLIST).map(|(e, t, p)| (e.within(p.scope), t)).collect();
        let first = self.problem.records.first().map_or(0.0, |r| r.time[0]);
        let since = if first.abs() > STAMP { first } else { 0.0 };
        // A course is one of a single clock: runs have one where they begin at one time.
        let begin = self.problem.records.iter().map(|r| r.time[0]);
        let is_one_clock = begin.into_iter().all(|t| (t - first).abs() < ONE_CLOCK);
        let most = open.iter().filter(|_| is_one_clock).map(|(e, _)| e.parameters.len()).max().unwrap_or(0);
        let nth = |i: usize| {
            let one = |(e, t): &(&Effect, Option<usize>)| Some((e.drifting(e.parameters.keys().nth(i)?, since)?, *t));
            open.iter().filter_map(one).collect()
        };
        Ok(Proposed { scoped, moving: (0..most).map(nth).collect(), tried })
    }

    /// The scopes of some effects, from one linearisation of all.
    fn scopes_of(
        &self,
        base: &Fit,
        group: &[(&Effect, Option<usize>)],
        blocks: &Blocks,
        rows: &BlockRows,
    ) -> Result<Vec<(Effect, Option<usize>, Proposal)>> {
        let begun = |(e, t): &(&Effect, Option<usize>)| {
            let start = e.starts().swap_remove(0);
            Applied::new(e, *t, start).freed()
        };
        let added: Vec<Applied> = group.iter().map(begun).collect();
        let joint = added.iter().cloned().fold(base.model.clone(), crate::model::Model::with_effect);
        let free = joint.free_parameters();
        let equations = joint.equations(&free)?;
        let problem = self.problem;
        let linear = linearise(&equations, &joint.free_values(), &problem.records, &problem.plan, &base.window_states);
        let Some(linear) = linear else { return Ok(vec![]) };
        let position = |s: &crate::formula::Symbol| free.iter().position(|f| f == s);
        let columns = |a: &Applied| a.parameters().iter().filter_map(position).collect::<Vec<usize>>();
        let kept: Vec<usize> = base.model.free_effects().flat_map(columns).collect();
        let mut found = vec![];
        for ((effect, trailer), applied) in group.iter().zip(&added) {
            let own = columns(applied);
            let scores = BlockScores::of(&linear, blocks, &base.variances, free.len(), &kept, &own);
            let Some(scores) = scores else { continue };
            let proposals = rows.proposals(&scores).into_iter();
            found.extend(proposals.map(|p| ((*effect).clone(), *trailer, p)));
        }
        Ok(found)
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

/// The most promising candidates, a few of each kind of scope.
fn of_each_kind(weighed: &[ScoreTest]) -> Vec<&ScoreTest> {
    let mut found: Vec<&ScoreTest> = vec![];
    for promise in weighed {
        let alike = |a: &&&ScoreTest| match (&a.applied.effect.scope, &promise.applied.effect.scope) {
            (Some(a), Some(b)) => a.is_like(b),
            (a, b) => a.is_none() == b.is_none(),
        };
        if found.len() < TRIED && found.iter().filter(alike).count() < OF_A_KIND {
            found.push(promise);
        }
    }
    found
}

/// The effects of a fit that hold in part, and have a name.
pub(crate) fn partial(fit: &Fit) -> impl Iterator<Item = &Applied> {
    fit.model.free_effects().filter(|e| is_partial(e) && !is_term(e))
}
