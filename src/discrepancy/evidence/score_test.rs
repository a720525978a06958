//! Candidates proposed: what each effect would gain, to first order, from one linearisation of all.

use crate::discrepancy::estimation::elimination::{InformationFilter, ReducedForm};
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::shooting::window_integration::each_window;
use crate::discrepancy::shooting::windows::{Segment, WindowStates};
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::{Equations, Fineness, Model};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// A candidate with the deviance it promises.
#[derive(Clone, Debug)]
pub struct ScoreTest {
    /// The effect where a fit would begin, its values corrected to first order.
    pub applied: Applied,
    /// Standard deviations its values would have.
    pub std: Vec<f64>,
    /// Twice the negative log likelihood it promises at the noise and jumps of the model without it.
    pub deviance: f64,
}

/// What a model's candidates promise, one at a time and two together.
#[derive(Clone, Debug, Default)]
pub struct ScoreTests {
    /// Each candidate alone, in the order of the library.
    pub single: Vec<ScoreTest>,
    /// Two candidates together, the most promising first; of those that are weighed by one linearisation.
    pub pairs: Vec<[ScoreTest; 2]>,
}

/// How many pairs are looked at further.
const PAIRS: usize = 2;

/// Whether an effect vanishes at zero and can be linearised there together with all others of its kind.
pub(crate) fn is_regular(effect: &Effect, model: &Model, trailer: Option<usize>) -> bool {
    let known = model.effects.iter().any(|e| e.stands_for(effect, trailer));
    // A user's own may be undefined somewhere, or close a circle with another: it must not spoil the pass for others.
    !known && effect.origin.is_none() && effect.states.is_empty() && effect.vanishes_first()
}

/// The candidates for a model by what they promise, best first.
///
/// Effects that vanish at zero are weighed together by one pass over the data, a large library of them by one pass for
/// every few; effects with states, and those a local search reaches from several starts only, by one pass a start.
pub fn promises(problem: &Problem, base: &Fit, model: &Model, open: &[(&Effect, Option<usize>)]) -> Result<ScoreTests> {
    let (regular, others): (Vec<_>, Vec<_>) = open.iter().partition(|(e, t)| is_regular(e, model, *t));
    let applied = |(e, t): &(&Effect, Option<usize>)| {
        e.starts().into_iter().map(|s| Applied::new(e, *t, s).freed()).collect::<Vec<_>>()
    };
    let together: Vec<Applied> = regular.iter().filter_map(|open| applied(open).into_iter().next()).collect();
    let elsewhere = regular.iter().flat_map(|open| applied(open).into_iter().skip(1)).map(|a| vec![a]);
    // An entry of the model file is where the search for a better value begins.
    let alone: Vec<Vec<Applied>> = others
        .iter()
        .flat_map(|(e, t)| match model.effects.iter().find(|a| a.stands_for(e, *t)) {
            Some(given) => vec![given.clone().freed()],
            None => applied(&(*e, *t)),
        })
        .map(|a| vec![a])
        .collect();
    // Two of a whole library of terms are not weighed together: small groups have small Gram matrices.
    let paired = together.len() <= MOST_PAIRED;
    let regular = together.chunks(if paired { MOST_PAIRED } else { UNPAIRED }).map(<[Applied]>::to_vec);
    let groups: Vec<Vec<Applied>> = regular.chain(elsewhere).chain(alone).collect();
    let weighed = groups.par_iter().map(|g| promise(problem, base, model, g, paired));
    let found: Vec<ScoreTests> = weighed.collect::<Result<_>>()?;
    let mut all = ScoreTests::default();
    for group in found {
        all.single.extend(group.single);
        all.pairs.extend(group.pairs);
    }
    keep_best_start(&mut all.single);
    Ok(all)
}

/// Of several starts of one effect the most promising stays.
fn keep_best_start(found: &mut Vec<ScoreTest>) {
    let mut kept: Vec<ScoreTest> = Vec::with_capacity(found.len());
    for promise in found.drain(..) {
        match kept.iter_mut().find(|k| k.applied.same_as(&promise.applied)) {
            Some(k) if promise.deviance < k.deviance => *k = promise,
            Some(_) => {}
            None => kept.push(promise),
        }
    }
    *found = kept;
}

fn promise(problem: &Problem, base: &Fit, model: &Model, group: &[Applied], paired: bool) -> Result<ScoreTests> {
    let joint = group.iter().fold(model.clone(), |m, a| m.with_effect(a.clone()));
    let free = joint.free_parameters();
    let equations = joint.equations(&free)?.followed(Fineness::Screening);
    let turned = turned_starts(problem, &joint, group)?;
    let starts = turned.as_ref().unwrap_or(&base.window_states);
    let Some(e) = joined(problem, base, starts, &equations, &joint.free_values()) else {
        return Ok(ScoreTests::default());
    };
    let constant = e.log_determinant + problem.noise_determinant(&base.variances);
    let position = |s: &crate::formula::Symbol| free.iter().position(|f| f == s);
    let indices = |a: &Applied| a.parameters().iter().filter_map(position).collect::<Vec<usize>>();
    let kept: Vec<usize> =
        model.free_effects().filter(|e| !group.iter().any(|g| g.same_as(e))).flat_map(indices).collect();
    let weigh = |together: &[&Applied]| -> Option<Vec<ScoreTest>> {
        let own: Vec<Vec<usize>> = together.iter().map(|a| indices(a)).collect();
        let all: Vec<usize> = kept.iter().chain(own.iter().flatten()).copied().collect();
        let (gain, step, spread) = restricted_step(&e, &all)?;
        let mut at = kept.len();
        let each = together.iter().zip(&own).map(|(a, own)| {
            let mut applied = (*a).clone();
            let part = at..at + own.len();
            at += own.len();
            applied.values.iter_mut().zip(&step.as_slice()[part.clone()]).for_each(|(v, s)| *v = moved(*v, *s, a));
            ScoreTest { applied, std: spread.as_slice()[part].to_vec(), deviance: e.cost() - gain + constant }
        });
        Some(each.collect())
    };
    let single: Vec<ScoreTest> = group.iter().filter_map(|a| weigh(&[a])).flatten().collect();
    let two = |i: usize| group[i + 1..].iter().map(move |b| [&group[i], b]);
    let mut pairs: Vec<[ScoreTest; 2]> = match paired {
        true => (0..group.len()).flat_map(two).filter_map(|ab| weigh(&ab)?.try_into().ok()).collect(),
        false => vec![],
    };
    pairs.sort_by(|a, b| a[0].deviance.total_cmp(&b[0].deviance));
    pairs.truncate(PAIRS);
    Ok(ScoreTests { single, pairs })
}

/// A model along all windows, which are eliminated as they come: of a large library none could be kept.
fn joined(
    problem: &Problem,
    base: &Fit,
    starts: &WindowStates,
    equations: &Equations,
    p: &[f64],
) -> Option<ReducedForm> {
    let along = |(segment, starts): (&Segment, &Vec<Vec<f64>>)| {
        let mut chain = InformationFilter::new(&base.variances, p.len(), false);
        let record = &problem.records[segment.record];
        each_window(equations, p, record, segment, starts, |window| chain.push(&window))?;
        Some(chain)
    };
    let chains: Vec<InformationFilter> = problem.plan.par_iter().zip(starts).map(along).collect::<Option<_>>()?;
    let mut total = ReducedForm::nothing(p.len());
    chains.into_iter().try_for_each(|c| total.add(c))?;
    Some(total)
}

/// Of more candidates than these, pairs are not looked for: a library of terms.
const MOST_PAIRED: usize = 40;

/// So many of them share one linearisation.
const UNPAIRED: usize = 8;

/// A first-order step that stays where the effect has a meaning.
fn moved(value: f64, step: f64, a: &Applied) -> f64 {
    // Nonlinear effects begin where they were linearised: their first step may lead anywhere.
    if a.effect.states.is_empty() && a.effect.vanishes_first() { value + step } else { value }
}

/// What the quadratic form gains when only some parameters move, how they move, and how well they are known.
fn restricted_step(e: &ReducedForm, indices: &[usize]) -> Option<(f64, DVector<f64>, DVector<f64>)> {
    let (information, gradient) = e.normal();
    let k = indices.len();
    let mut h = DMatrix::from_fn(k, k, |i, j| information[(indices[i], indices[j])]);
    (0..k).for_each(|i| h[(i, i)] = if h[(i, i)] > 0.0 { h[(i, i)] * (1.0 + 1e-9) } else { 1.0 });
    let g = DVector::from_fn(k, |i, _| gradient[indices[i]]);
    let h = h.cholesky()?;
    let step = h.solve(&g);
    let gain = g.dot(&step);
    let spread = h.inverse().diagonal().map(f64::sqrt);
    gain.is_finite().then_some((gain, -step, spread))
}

/// Fits candidates at the noise and jumps of the model without them; a wild first step is taken back.
pub fn settled(
    problem: &Problem,
    base: &Fit,
    model: &Model,
    promises: &[&ScoreTest],
    effort: Effort,
) -> Result<Option<Fit>> {
    let added: Vec<Applied> = promises.iter().map(|p| tamed(p)).collect();
    let begin = added.iter().cloned().fold(model.clone(), Model::with_effect);
    let turned = turned_starts(problem, &begin, &added)?;
    problem.fit(&begin, turned.as_ref().unwrap_or(&base.window_states), &base.variances, effort)
}

/// The definition by which the measured heading is turned against the body.
const OFFSET: &str = "heading_offset";

/// Poses at the windows' starts where an effect turns the body by more than a quarter against the measured heading: from
/// the poses of the model without it no local search leads there.
fn turned_starts(problem: &Problem, model: &Model, added: &[Applied]) -> Result<Option<WindowStates>> {
    let turns = |a: &Applied| a.effect.changes.contains_key(OFFSET) && a.values.iter().any(|v| v.abs() > FRAC_PI_2);
    if added.iter().any(turns) { problem.starts(model).map(Some) } else { Ok(None) }
}

/// The effect as promised, or where its fit would begin when that lies outside its range.
fn tamed(promise: &ScoreTest) -> Applied {
    let mut applied = promise.applied.clone();
    if !applied.is_in_range() {
        applied.values = promise.applied.effect.starts().swap_remove(0);
    }
    applied
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{applied, unicycle};
    use crate::effects::named;
    use crate::provenance::Origin;

    #[test]
    fn an_effect_with_states_or_values_of_its_own_is_asked_alone() {
        let bare = unicycle(&[]);
        let creep = named("traverse-creep").unwrap();
        let known = bare.clone().with_effect(applied("traverse-creep"));
        assert!(is_regular(creep, &bare, None) && !is_regular(creep, &known, None));
        // Of another place it is another effect.
        assert!(is_regular(creep, &known, Some(1)));
        assert!(!is_regular(named("relaxation-length").unwrap(), &bare, None));
        let origin = Origin { path: "own.toml".into(), sha256: String::new(), text: String::new() };
        let own = Effect { origin: Some(origin.into()), ..creep.clone() };
        assert!(!is_regular(&own, &bare, None));
    }
}
