//! One run that differs from all others: each run in turn is asked what it has that the others have not.
//!
//! The others are fitted without the run, and the run is searched for one effect beside their values. It is odd where that
//! effect explains it, predicts it, and has another value in the others, by more than they scatter:
//!
//! (θ_k − θ)ᵀ·(C_k + C + τ²)⁻¹·(θ_k − θ) > 2·ln K + 2·ln M + ln n
//!
//! with K runs, M effects of the library and n independent values: a price for the many that are asked.

use super::search::{Search, find, first_of};
use super::transients::without_transients;
use crate::discrepancy::estimation::bounds::{is_possible, vanishes};
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::estimation::unexplained::remains;
use crate::discrepancy::evidence::heterogeneity::{RunValue, Spread, spreads, variance_between_runs};
use crate::discrepancy::evidence::wald_test::neutral_at_zero;
use crate::discrepancy::localisation::constraint_residuals::ConstraintResiduals;
use crate::discrepancy::selection::choice::Selected;
use crate::discrepancy::shooting::windows::plan;
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::Model;
use crate::progress::OnProgress;
use nalgebra::{DMatrix, DVector};

/// Runs of which one may be odd.
const FEWEST: usize = 3;
/// An odd run is so many times as far from the others as any of them.
const FARTHER: f64 = 4.0;
/// Share of what the run violates that its effect takes away at least.
const EXPLAINS: f64 = 0.5;

/// A run that differs from all others.
#[derive(Clone, Debug, PartialEq)]
pub struct OddRun {
    /// Name of the run.
    pub run: String,
    /// What it has, at its values.
    pub applied: Applied,
    /// Their standard deviations.
    pub std: Vec<Option<f64>>,
    /// The values in the others, with their standard deviations.
    pub others: Vec<(f64, Option<f64>)>,
}

/// Whether a choice leaves something that one run may have alone.
pub(crate) fn is_sought(choice: &Selected) -> bool {
    let differ = || spreads(&choice.after).iter().flatten().any(Spread::is_real);
    choice.after.runs >= FEWEST && (remains(&choice.after) || !choice.inconsistent.is_empty() || differ())
}

/// The runs of a problem that differ from the others, one after another; fewer than half of all.
///
/// `model` has the effects that all runs may have; its free ones are fitted to the others anew.
pub(crate) fn odd_runs(
    problem: &Problem,
    model: &Model,
    library: &[Effect],
    progress: &OnProgress,
) -> Result<Vec<OddRun>> {
    let quick = without_transients(library);
    let mut found: Vec<OddRun> = vec![];
    let mut kept = problem.clone();
    while kept.records.len() >= FEWEST && 2 * (found.len() + 1) < problem.records.len() {
        let Some(odd) = oddest(&kept, model, &quick, progress)? else { break };
        kept = kept.of_records(|r| r != odd.run);
        found.push(odd);
    }
    Ok(found)
}

/// The run that is farthest from the others, where one is beyond its price.
fn oddest(problem: &Problem, model: &Model, library: &[Effect], progress: &OnProgress) -> Result<Option<OddRun>> {
    let mut worst: Option<(f64, OddRun)> = None;
    for record in &problem.records {
        let name = record.name.as_str();
        let (alone, rest) = (problem.of_records(|r| r == name), problem.of_records(|r| r != name));
        if alone.records.len() != 1 {
            continue;
        }
        let differs = Asked { alone, rest, model, library }.differing(progress)?;
        if let Some((far, odd)) = differs.filter(|(far, _)| worst.as_ref().is_none_or(|(most, _)| far > most)) {
            worst = Some((far, odd));
        }
    }
    Ok(worst.map(|(_, odd)| odd))
}

impl Problem {
    /// The same of the runs with some names.
    fn of_records(&self, is_kept: impl Fn(&str) -> bool) -> Self {
        let records: Vec<_> = self.records.iter().filter(|r| is_kept(&r.name)).cloned().collect();
        Self { plan: plan(&records), records, ..self.clone() }
    }
}

/// A run, and the others.
struct Asked<'a> {
    alone: Problem,
    rest: Problem,
    model: &'a Model,
    library: &'a [Effect],
}

impl Asked<'_> {
    /// What explains the run best of that which the others have not, and how far it is from them.
    fn differing(&self, progress: &OnProgress) -> Result<Option<(f64, OddRun)>> {
        let Asked { alone, rest, model, library } = self;
        let start = |p: &Problem, m: &Model| p.fit(m, &p.starts(m)?, &p.variances, Effort::FULL);
        let Some(others) = start(rest, model)? else { return Ok(None) };
        let Some(before) = start(alone, &others.model.fixed())? else { return Ok(None) };
        if !remains(&before) {
            return Ok(None);
        }
        let search = Search { most: 1, exchanges: false, drops: false, ..Search::over(alone, &before, library) };
        let price = search.margin() + 2.0 * (rest.records.len() as f64 + 1.0).ln();
        for (candidate, fit) in search.ranked(&before, 0, progress)?.single {
            let (Some(fit), true) = (fit, candidate.delta_bic > price) else { continue };
            let explains = self.rest_of(&fit)? <= (1.0 - EXPLAINS) * self.rest_of(&before)?;
            let applied = find(&fit.model, &candidate.applied).unwrap_or(candidate.applied);
            let counts = is_possible(&applied) && !vanishes(&applied) && explains;
            if !counts || !alone.predicts_better(&fit, &before)? {
                continue;
            }
            let Some(others) = self.others_with(&others, &applied)? else { continue };
            let bar = price + fit.sample_size.ln();
            if let Some(far) = distance(&fit, &others, &applied).filter(|far| *far > bar) {
                return Ok(Some((far, self.odd(&fit, &others, applied))));
            }
        }
        Ok(None)
    }

    /// What a model leaves of the run, in units of its noise.
    fn rest_of(&self, fit: &Fit) -> Result<f64> {
        let residuals = self.alone.violations(&fit.model, &fit.noise())?;
        let beyond =
            |v: &ConstraintResiduals| (0..v.constraints()).filter(|c| v.has(*c)).map(|c| v.chi_squared(c)).sum::<f64>();
        Ok(residuals.iter().map(beyond).sum())
    }

    /// The others with an effect that is free in them as well.
    fn others_with(&self, others: &Fit, effect: &Applied) -> Result<Option<Fit>> {
        if others.model.free_effects().any(|e| e.same_as(effect)) {
            return Ok(Some(others.clone()));
        }
        let Some(start) = effect.effect.starts().into_iter().next() else { return Ok(None) };
        let model = others.model.clone().with_effect(Applied::new(&effect.effect, effect.trailer, start).freed());
        self.rest.fit(&model, &others.window_states, &self.rest.variances, Effort::FULL)
    }

    fn odd(&self, fit: &Fit, others: &Fit, applied: Applied) -> OddRun {
        let deviation = |fit: &Fit, i: usize| fit.variance(i).map(f64::sqrt);
        let (own, there) = (first_of(fit, &applied), first_of(others, &applied));
        let each = 0..applied.values.len();
        let of_others = |k: usize| {
            let spread = spreads(others).into_iter().nth(there + k).flatten().filter(Spread::is_real);
            let std = deviation(others, there + k).map(|std| spread.map_or(std, |s| std.max(s.std)));
            (others.p[there + k], std)
        };
        OddRun {
            run: self.alone.records[0].name.clone(),
            std: each.clone().map(|k| deviation(fit, own + k)).collect(),
            others: each.map(of_others).collect(),
            applied,
        }
    }
}

/// How far an effect's values in a run are from those in the others, squared and in units of what both are known to and the
/// others scatter by; `None` where one of the others is as far.
fn distance(fit: &Fit, others: &Fit, effect: &Applied) -> Option<f64> {
    let there = find(&others.model, effect)?;
    let pairs: Vec<(usize, usize)> = neutral_at_zero(fit, effect)
        .iter()
        .zip(neutral_at_zero(others, &there))
        .map(|((i, _), (j, _))| (*i, j))
        .collect();
    if [fit, others].iter().any(|f| f.covariance.is_none()) {
        return None;
    }
    let of = |fit: &Fit, (i, j): (usize, usize)| fit.covariance_of(i, j).unwrap_or(0.0);
    let spread = spreads(others);
    let n = pairs.len();
    let d = DVector::from_iterator(n, pairs.iter().map(|(i, j)| fit.p[*i] - others.p[*j]));
    let c = DMatrix::from_fn(n, n, |a, b| {
        let (i, j) = ((pairs[a].0, pairs[b].0), (pairs[a].1, pairs[b].1));
        let apart = if a == b { variance_between_runs(&spread[j.0]) } else { 0.0 };
        of(fit, i) + of(others, j) + apart
    });
    let widest = (0..n).max_by(|a, b| {
        let far = |k: usize| d[k] * d[k] / c[(k, k)];
        far(*a).total_cmp(&far(*b))
    })?;
    let j = pairs[widest].1;
    let off = d[widest].abs();
    // What hardly tells the value says nothing of how the others stray.
    let tells = |v: &&RunValue| v.variance.sqrt() < 0.5 * off;
    let strays = |s: &Spread| {
        let told = s.values.iter().filter(tells);
        told.map(|v| (v.value - others.p[j]).abs()).collect::<Vec<f64>>()
    };
    let strays = spread[j].as_ref().map_or_else(Vec::new, strays);
    // What no two of the others tell cannot be said of them.
    let is_alone = strays.len() > 1 && strays.iter().all(|stray| FARTHER * stray < off);
    let far = d.dot(&c.cholesky()?.solve(&d));
    is_alone.then_some(far)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{equations, logged, unicycle};
    use crate::effects::all;
    use crate::progress::unheard;

    /// Runs of a unicycle, each driven in its own way, with a creep of its own.
    fn runs(creeps: &[f64]) -> Problem {
        let run = |(k, creep): (usize, &f64)| {
            let (equations, p) = equations(&[("traverse-creep", &[*creep])]);
            let own = 0.1 * k as f64;
            let inputs: [&dyn Fn(f64) -> f64; 2] =
                [&|t| 2.0 + ((0.7 + own) * t).sin(), &|t| 0.6 * ((0.4 + own) * t).cos()];
            let mut record =
                logged((&equations, &p), (0..600).map(|i| 0.05 * f64::from(i)).collect(), inputs, &[0.0; 3], 1e-3);
            record.name = format!("run_{k}.csv");
            record
        };
        Problem::new(creeps.iter().enumerate().map(run).collect(), None, None)
    }

    fn told(creeps: &[f64]) -> Vec<OddRun> {
        odd_runs(&runs(creeps), &unicycle(&[]), all(), &unheard).unwrap()
    }

    #[test]
    fn the_run_that_differs_is_told_with_what_it_has() {
        let [odd] = &told(&[0.02, 0.02, 0.06, 0.02])[..] else { panic!("one run is odd") };
        assert_eq!((odd.run.as_str(), odd.applied.effect.id.as_str()), ("run_2.csv", "traverse-creep"));
        assert!((odd.applied.values[0] - 0.06).abs() < 2e-3 && (odd.others[0].0 - 0.02).abs() < 2e-3, "{odd:?}");
    }

    /// Runs that have the same, and runs that each have another value of it, have no odd one among them.
    #[test]
    fn runs_that_agree_and_runs_that_scatter_have_no_odd_one() {
        assert_eq!(told(&[0.05; 4]), []);
        assert_eq!(told(&[0.0; 4]), []);
        assert_eq!(told(&[0.02, 0.06, 0.03, 0.05]), []);
    }
}
