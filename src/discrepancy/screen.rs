//! Candidates proposed: what each effect would gain, to first order, from one linearisation of all.

use super::chain::{Eliminated, eliminate};
use super::fit::{Effort, Fit, Problem};
use super::windows::linearise;
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::Model;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// A candidate with the deviance it promises.
#[derive(Clone, Debug)]
pub struct Promise {
    /// The effect where a fit would begin, its values corrected to first order.
    pub applied: Applied,
    /// Standard deviations its values would have.
    pub std: Vec<f64>,
    /// Twice the negative log likelihood it promises at the noise and jumps of the model without it.
    pub deviance: f64,
}

/// Whether an effect vanishes at zero and can be linearised there together with all others of its kind.
fn is_regular(effect: &Effect, model: &Model, trailer: Option<usize>) -> bool {
    let known = model.effects.iter().any(|e| e.effect.id == effect.id && e.trailer == trailer);
    !known && effect.states.is_empty() && effect.starts().len() == 1
}

/// The candidates for a model by what they promise, best first.
///
/// Effects that vanish at zero are weighed together by one pass over the data; effects with states, and those a
/// local search reaches from several starts only, by one pass a start.
pub fn promises(
    problem: &Problem,
    base: &Fit,
    model: &Model,
    open: &[(&Effect, Option<usize>)],
) -> Result<Vec<Promise>> {
    let (regular, others): (Vec<_>, Vec<_>) = open.iter().partition(|(e, t)| is_regular(e, model, *t));
    let applied = |(e, t): &(&Effect, Option<usize>)| {
        e.starts().into_iter().map(|s| Applied::new(e, *t, s).freed()).collect::<Vec<_>>()
    };
    let together: Vec<Applied> = regular.iter().flat_map(applied).collect();
    // An entry of the model file is where the search for a better value begins.
    let alone: Vec<Vec<Applied>> = others
        .iter()
        .flat_map(|(e, t)| match model.effects.iter().find(|a| a.effect.id == e.id && a.trailer == *t) {
            Some(given) => vec![given.clone().freed()],
            None => applied(&(*e, *t)),
        })
        .map(|a| vec![a])
        .collect();
    let groups: Vec<Vec<Applied>> = std::iter::once(together).filter(|g| !g.is_empty()).chain(alone).collect();
    let found: Vec<Vec<Promise>> =
        groups.par_iter().map(|g| promise(problem, base, model, g)).collect::<Result<_>>()?;
    let mut found: Vec<Promise> = found.into_iter().flatten().collect();
    keep_best_start(&mut found);
    Ok(found)
}

/// Of several starts of one effect the most promising stays.
fn keep_best_start(found: &mut Vec<Promise>) {
    let mut kept: Vec<Promise> = Vec::with_capacity(found.len());
    for promise in found.drain(..) {
        match kept.iter_mut().find(|k| k.applied.same_as(&promise.applied)) {
            Some(k) if promise.deviance < k.deviance => *k = promise,
            Some(_) => {}
            None => kept.push(promise),
        }
    }
    *found = kept;
}

fn promise(problem: &Problem, base: &Fit, model: &Model, group: &[Applied]) -> Result<Vec<Promise>> {
    let joint = group.iter().fold(model.clone(), |m, a| m.with_effect(a.clone()));
    let free: Vec<_> = joint.effects.iter().filter(|e| e.free).flat_map(|e| e.parameters()).collect();
    let values: Vec<f64> = joint.effects.iter().filter(|e| e.free).flat_map(|e| e.values.iter().copied()).collect();
    let equations = joint.equations(&free)?;
    let Some(linear) = linearise(&equations, &values, &problem.records, &problem.plan, &base.starts) else {
        return Ok(vec![]);
    };
    let Some(e) = eliminate(&linear, &base.variances, free.len()) else { return Ok(vec![]) };
    let constant = e.log_determinant + super::variances::noise_determinant(&linear, &base.variances);
    let position = |s: &crate::formula::Symbol| free.iter().position(|f| f == s);
    let indices = |a: &Applied| a.parameters().iter().filter_map(position).collect::<Vec<usize>>();
    let kept: Vec<usize> =
        model.effects.iter().filter(|e| e.free && !group.iter().any(|g| g.same_as(e))).flat_map(indices).collect();
    let weigh = |a: &Applied| {
        let own = indices(a);
        let all: Vec<usize> = kept.iter().chain(&own).copied().collect();
        let (gain, step, spread) = restricted_step(&e, &all)?;
        let std = spread.as_slice()[kept.len()..].to_vec();
        let mut applied = a.clone();
        applied.values.iter_mut().zip(&step.as_slice()[kept.len()..]).for_each(|(v, s)| *v = moved(*v, *s, a));
        Some(Promise { applied, std, deviance: e.cost() - gain + constant })
    };
    Ok(group.iter().filter_map(weigh).collect())
}

/// A first-order step that stays where the effect has a meaning.
fn moved(value: f64, step: f64, a: &Applied) -> f64 {
    // Nonlinear effects begin where they were linearised: their first step may lead anywhere.
    if a.effect.states.is_empty() && a.effect.starts().len() == 1 { value + step } else { value }
}

/// What the quadratic form gains when only some parameters move, how they move, and how well they are known.
fn restricted_step(e: &Eliminated, indices: &[usize]) -> Option<(f64, DVector<f64>, DVector<f64>)> {
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

/// Fits a candidate at the noise and jumps of the model without it; a wild first step is taken back.
pub fn settled(problem: &Problem, base: &Fit, model: &Model, promise: &Promise, effort: Effort) -> Result<Option<Fit>> {
    let begin =
        |applied: Applied| problem.fit(&model.clone().with_effect(applied), &base.starts, &base.variances, effort);
    let inside = promise.applied.values.iter().zip(promise.applied.effect.parameters.values());
    let mut applied = promise.applied.clone();
    if !inside.into_iter().all(|(v, p)| (p.range[0]..=p.range[1]).contains(v)) {
        applied.values = promise.applied.effect.starts().swap_remove(0);
    }
    begin(applied)
}
