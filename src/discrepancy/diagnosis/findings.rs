//! What was found, as the report lists it.

use super::equivalents::EquivalentEffect;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::evidence::heterogeneity::{RunValue, Spread};
use crate::discrepancy::localisation::constraint_residuals::{ConstraintResiduals, reduction};
use crate::discrepancy::preprocessing::dataset::Data;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::report::{
    AboveSpeed, CourseFound, Covariance, Estimate, Evidence, Named, PerRun, Rival, RunEstimate, ScopeFound, Unnamed,
};
use crate::discrepancy::selection::choice::SelectedEffect;
use crate::effects::{Applied, Scope};
use crate::error::Result;
use crate::model::Model;
use crate::model::effect_equation::{equation, is_term, term_equation};
use std::collections::BTreeMap;

/// The values of an effect with their deviations, and its trailer.
pub(crate) fn estimates(a: &Applied, std: &[Option<f64>]) -> BTreeMap<String, Estimate> {
    let std = |i: usize| std.get(i).copied().flatten();
    let values = a.effect.parameters.iter().zip(&a.values).enumerate();
    let mut parameters: BTreeMap<String, Estimate> = values
        .map(|(i, ((name, p), value))| {
            (name.clone(), Estimate { value: *value, std: std(i), unit: p.unit.clone(), course: None })
        })
        .collect();
    if let Some(course) = &a.effect.course {
        let moving = parameters.remove(&course.rate());
        let moving = moving.map(|m| CourseFound {
            kind: LINEAR.into(),
            per_s: Some(m.value),
            std: m.std,
            since: Some(course.since),
            ..CourseFound::default()
        });
        parameters.entry(course.parameter.clone()).and_modify(|p| p.course = moving);
    }
    if let Some(walk) = &a.effect.walk {
        let walking = CourseFound {
            kind: RANDOM_WALK.into(),
            per_sqrt_s: Some(walk.per_sqrt_s),
            std: walk.std,
            ..CourseFound::default()
        };
        parameters.entry(walk.parameter.clone()).and_modify(|p| p.course = Some(walking));
    }
    if let Some(i) = a.trailer {
        parameters.insert("trailer".into(), Estimate { value: i as f64, std: None, unit: "1".into(), course: None });
    }
    parameters
}

/// The kind of a course at a constant rate.
const LINEAR: &str = "linear";
/// The kind of a course at random.
const RANDOM_WALK: &str = "random-walk";

/// A scope as the report lists it.
fn scope(scope: &Scope) -> ScopeFound {
    let finite = |t: f64| t.is_finite().then_some(t);
    let found = ScopeFound { says: scope.to_string(), ..ScopeFound::default() };
    match scope {
        Scope::Times(intervals) => match &intervals[..] {
            [[from, until]] => ScopeFound { from: finite(*from), until: finite(*until), ..found },
            several => ScopeFound { intervals: several.to_vec(), ..found },
        },
        Scope::Regime(regime) => ScopeFound { regime: Some(regime.name().into()), ..found },
        Scope::Above(speed) => ScopeFound { above: Some(AboveSpeed { speed: *speed }), ..found },
        Scope::Disk(disk) => ScopeFound { disk: Some(*disk), ..found },
        Scope::Where(formula) => ScopeFound { positive: Some(format!("{formula} > 0")), ..found },
    }
}

/// A chosen effect as the report lists it.
pub(crate) fn named(chosen: &SelectedEffect, relatives: &[EquivalentEffect], model: &Model) -> Named {
    let a = &chosen.applied;
    let rival = |r: &EquivalentEffect| Rival { id: r.applied.effect.id.clone(), why: r.why.into() };
    Named {
        id: a.effect.id.clone(),
        says: a.effect.says.clone(),
        plain: String::new(),
        place: a.effect.place.clone(),
        on: a.effect.on.clone(),
        scope: a.effect.scope.as_ref().map(scope),
        parameters: estimates(a, &chosen.std),
        evidence: Evidence { delta_bic: chosen.delta_bic, p_value: chosen.p_value },
        indistinguishable_from: relatives.iter().map(rival).collect(),
        equation: equation(a, model),
        per_run: BTreeMap::new(),
    }
}

/// The values of an effect run by run, where there are several; `spreads` are those of all values, `first` where its own
/// begin.
pub(crate) fn per_run(
    a: &Applied,
    spreads: &[Option<Spread>],
    first: usize,
    runs: &[Record],
) -> BTreeMap<String, PerRun> {
    let told = |v: &RunValue| RunEstimate { run: runs[v.run].name.clone(), value: v.value, std: v.variance.sqrt() };
    let of = |(k, name): (usize, &String)| {
        let s = spreads.get(first + k)?.as_ref()?;
        let runs = s.values.iter().map(told).collect();
        Some((name.clone(), PerRun { runs, tau: s.tau, q: s.q, p_value: s.p_value }))
    };
    a.effect.parameters.keys().enumerate().filter_map(of).collect()
}

/// The covariance of all fitted values, as far as rows and windows are independent.
pub(crate) fn covariance(fit: &Fit) -> Option<Covariance> {
    let c = fit.covariance.as_ref().filter(|c| !c.is_empty())?;
    let of = |a: &Applied| a.effect.parameters.keys().map(|p| format!("{} {p}", a.label())).collect::<Vec<_>>();
    let row = |i: usize| (0..c.ncols()).filter_map(|j| fit.covariance_of(i, j)).collect();
    let rows = (0..c.nrows()).map(row);
    Some(Covariance { names: fit.model.free_effects().flat_map(of).collect(), matrix: rows.collect() })
}

/// Chosen terms as the report lists them, judged on the held-out data.
pub(crate) fn without_name(terms: &[&SelectedEffect], data: &Data, after: &Fit, model: &Model) -> Result<Vec<Unnamed>> {
    if terms.is_empty() {
        return Ok(vec![]);
    }
    let judged = if data.held_out.is_empty() { &data.fitted } else { &data.held_out };
    let mut bare = after.model.clone();
    bare.effects.retain(|e| !is_term(e));
    let violations = |m: &Model| -> Result<Vec<_>> {
        judged.iter().map(|r| ConstraintResiduals::of(m, r, &after.noise())).collect()
    };
    let (without, with) = (violations(&bare)?, violations(&after.model)?);
    let one = |c: &&SelectedEffect| Unnamed {
        place: c.applied.effect.place.clone(),
        equation: term_equation(&c.applied, model),
        held_out_reduction: reduction(&c.applied.effect.place, &without, &with),
        parameters: named(c, &[], model).parameters,
    };
    Ok(terms.iter().map(one).collect())
}
