//! Effects screened for scopes: where each would gain if it held in part, from one linearisation of several.
//!
//! What an effect gains block by block is a score test where the effect vanishes.

use super::interval_search::ways_of_more_intervals;
use super::scope_proposals::{BlockRows, Proposal};
use super::search::Search;
use super::vanishing_effect::VanishingEffect;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::evidence::scope_scan::{BlockScores, Blocks};
use crate::discrepancy::evidence::score_test;
use crate::discrepancy::shooting::window_integration::linearise;
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::Fineness;
use rayon::prelude::*;

/// Proposals that are linearised with gates of their own, at most: of effects that act at once, and of those with states.
const SHORTLIST: [usize; 2] = [30, 10];
/// What an effect with states must promise, as a share of the best of all: passes along them are slow.
const FAINT: f64 = 0.5;
/// And of one effect so many, and so many of one kind of scope: intervals of time have many neighbours that promise as much.
const OF_AN_EFFECT: usize = 5;
const OF_A_KIND: usize = 3;
/// Effects of which the blocks are weighed by one linearisation.
const TOGETHER: usize = 8;
/// Scopes that are tried for each block and effect, about.
const TRIED_PER_BLOCK: usize = 10;
/// Runs whose first rows lie within so many seconds of one another have one clock.
const ONE_CLOCK: f64 = 1.0;
/// Times beyond this are stamps, and what moves with time is told from the first row on, s.
const STAMP: f64 = 1e4;

/// What an effect in part is sought among.
pub(super) struct Proposed {
    /// Effects within scopes.
    pub scoped: Vec<(Effect, Option<usize>)>,
    /// Effects with their first parameter moving, with their second one, and so on.
    pub moving: Vec<Vec<(Effect, Option<usize>)>>,
    /// What a choice among so many costs.
    pub price: Price,
}

/// The price of a choice among all scopes that were tried: what the best of them gains by chance.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Price {
    /// How many scopes of one interval and of all other kinds were tried.
    tried: f64,
    /// How many blocks there are between which intervals begin and end.
    blocks: usize,
}

impl Price {
    /// Of an effect within its scope.
    pub fn of(&self, applied: &Applied) -> f64 {
        let more = applied.effect.scope.as_ref().map_or(0.0, |scope| ways_of_more_intervals(scope, self.blocks));
        2.0 * (self.tried.ln() + more)
    }
}

impl Search<'_> {
    /// The effects that may hold in part and are not in the model yet.
    fn scopable(&self, base: &Fit) -> Vec<(&Effect, Option<usize>)> {
        let known = |e: &Effect, t: Option<usize>| base.model.effects.iter().any(|a| a.stands_for(e, t));
        let all = base.model.applicable(self.library).into_iter();
        all.filter(|(e, t)| may_hold_in_part(e) && !known(e, *t)).collect()
    }

    /// Effects with the scopes and courses by which they promise most.
    pub(super) fn proposed(&self, base: &Fit) -> Result<Proposed> {
        let open = self.scopable(base);
        let blocks = Blocks::of_plan(&self.problem.plan);
        let scoped = self.shortlisted(base, &open, &blocks)?;
        let tried = (open.len() * blocks.count * TRIED_PER_BLOCK).max(1) as f64;
        let is_regular = |(e, t): &(&Effect, Option<usize>)| score_test::is_regular(e, &base.model, *t);
        let regular: Vec<(&Effect, Option<usize>)> = open.into_iter().filter(is_regular).collect();
        Ok(Proposed { scoped, moving: self.moving(&regular), price: Price { tried, blocks: blocks.count } })
    }

    /// Effects within the scopes by which they promise most, a few of each effect.
    fn shortlisted(
        &self,
        base: &Fit,
        open: &[(&Effect, Option<usize>)],
        blocks: &Blocks,
    ) -> Result<Vec<(Effect, Option<usize>)>> {
        let rows = BlockRows::of(self.problem, &base.model, blocks)?;
        let groups = in_groups(open.iter().map(|(e, t)| VanishingEffect::all_of(e, *t)));
        let of_group = |group: &Vec<VanishingEffect>| self.scopes_of(base, group, blocks, &rows);
        let all: Vec<Vec<(Applied, Proposal)>> = groups.par_iter().map(of_group).collect::<Result<_>>()?;
        let mut all: Vec<(Applied, Proposal)> = all.into_iter().flatten().collect();
        let n = base.sample_size;
        let worth = |(a, p): &(Applied, Proposal)| {
            let tried = (p.of as f64).ln() + ways_of_more_intervals(&p.scope, blocks.count);
            p.gain - (a.values.len() + p.scope.cost()) as f64 * n.ln() - 2.0 * tried
        };
        all.retain(|one| worth(one) > 0.0);
        all.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
        let best = all.first().map_or(0.0, worth);
        all.retain(|one| one.0.effect.states.is_empty() || worth(one) >= FAINT * best);
        let mut kept: Vec<(Applied, Proposal)> = vec![];
        for (a, p) in all {
            let own = || kept.iter().filter(|(k, _)| k.same_as(&a));
            let is_new = !own().any(|(_, q)| q.scope == p.scope);
            let few =
                own().count() < OF_AN_EFFECT && own().filter(|(_, q)| q.scope.is_like(&p.scope)).count() < OF_A_KIND;
            if is_new && few && has_room(kept.iter().map(|(k, _)| k), &a, SHORTLIST) {
                kept.push((a, p));
            }
        }
        Ok(kept.into_iter().map(|(a, p)| (a.effect.within(p.scope), a.trailer)).collect())
    }

    /// Effects with their first parameter moving, with their second one, and so on; none where runs begin at several times,
    /// for a course is one of a single clock.
    fn moving(&self, regular: &[(&Effect, Option<usize>)]) -> Vec<Vec<(Effect, Option<usize>)>> {
        let first = self.problem.records.first().map_or(0.0, |r| r.time[0]);
        let since = if first.abs() > STAMP { first } else { 0.0 };
        let is_one_clock = self.problem.records.iter().all(|r| (r.time[0] - first).abs() < ONE_CLOCK);
        let most = regular.iter().filter(|_| is_one_clock).map(|(e, _)| e.parameters.len()).max().unwrap_or(0);
        let nth = |i: usize| {
            let one = |(e, t): &(&Effect, Option<usize>)| Some((e.drifting(e.parameters.keys().nth(i)?, since)?, *t));
            regular.iter().filter_map(one).collect()
        };
        (0..most).map(nth).collect()
    }

    /// The scopes of some effects, from one linearisation of all.
    fn scopes_of(
        &self,
        base: &Fit,
        group: &[VanishingEffect],
        blocks: &Blocks,
        rows: &BlockRows,
    ) -> Result<Vec<(Applied, Proposal)>> {
        let added = group.iter().map(|v| v.applied.clone());
        let joint = added.fold(base.model.clone(), crate::model::Model::with_effect);
        let free = joint.free_parameters();
        let equations = joint.equations(&free)?.followed(Fineness::Screening);
        let problem = self.problem;
        let linear = linearise(&equations, &joint.free_values(), &problem.records, &problem.plan, &base.window_states);
        let Some(linear) = linear else {
            // What is undefined somewhere does not take the others with it.
            let each = group.chunks(1).filter(|_| group.len() > 1).map(|one| self.scopes_of(base, one, blocks, rows));
            return Ok(each.collect::<Result<Vec<_>>>()?.concat());
        };
        let position = |s: &crate::formula::Symbol| free.iter().position(|f| f == s);
        let columns = |a: &Applied| a.parameters().iter().filter_map(position).collect::<Vec<usize>>();
        let kept: Vec<usize> = base.model.free_effects().flat_map(columns).collect();
        let mut found = vec![];
        for VanishingEffect { applied, weighed, whole } in group {
            let all = columns(applied);
            let own: Vec<usize> = weighed.iter().filter_map(|i| all.get(*i).copied()).collect();
            let scores = BlockScores::of(&linear, blocks, &base.variances, free.len(), &kept, &own);
            let Some(scores) = scores else { continue };
            found.extend(rows.proposals(&scores).into_iter().map(|p| (whole.clone(), p)));
        }
        Ok(found)
    }
}

/// Whether an effect may hold in part: how late inputs are is one for a run.
fn may_hold_in_part(effect: &Effect) -> bool {
    effect.scope.is_none() && !effect.delays_inputs()
}

/// In groups that share a linearisation, each effect at one value, those with states together: a user's own by itself, for it may
/// be undefined somewhere.
fn in_groups(all: impl Iterator<Item = Vec<VanishingEffect>>) -> Vec<Vec<VanishingEffect>> {
    let mut by_start: Vec<Vec<VanishingEffect>> = vec![];
    let (mut alone, mut with_states) = (vec![], vec![]);
    for (start, one) in all.flat_map(|of_effect| of_effect.into_iter().enumerate()) {
        if one.applied.effect.origin.is_some() {
            alone.push(vec![one]);
            continue;
        }
        if !one.applied.effect.states.is_empty() {
            with_states.push(one);
            continue;
        }
        by_start.resize(by_start.len().max(start + 1), vec![]);
        by_start[start].push(one);
    }
    let together = by_start.iter().chain([&with_states]).flat_map(|some| some.chunks(TOGETHER)).map(<[_]>::to_vec);
    together.chain(alone).collect()
}

/// Effects that act at once, and those with states: the one class does not take the places of the other.
pub(super) fn class(a: &Applied) -> usize {
    usize::from(!a.effect.states.is_empty())
}

/// Whether one more effect has room beside others, of each class so many at most.
pub(super) fn has_room<'a>(others: impl Iterator<Item = &'a Applied>, one: &Applied, most: [usize; 2]) -> bool {
    others.filter(|a| class(a) == class(one)).count() < most[class(one)]
}
