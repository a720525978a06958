//! Effects asked of parts of the data, where a model leaves motion unexplained.
//!
//! A model that misses a law is wrong, and then the formal evidence for whatever stands in for that law is large: each
//! run is imitated by other values of it. What is there has the same value in all runs.

use super::search::{FULL, Grown, Selection};
use super::unnamed_terms;
use super::unnamed_terms::{is_term, remains, still_open};
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::evidence::wald_test::neutral_at_zero;
use crate::discrepancy::record::record::Record;
use crate::discrepancy::shooting::windows::plan;
use crate::effects::Applied;
use crate::error::Result;
use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Parts at least; runs fewer than these are cut into as many pieces.
const FEWEST: usize = 3;
/// Parts at most: each is a fit of its own.
const MOST: usize = 5;
/// Largest probability that a value which scatters as much over the parts lies so far from neutral.
const BY_CHANCE: f64 = 0.05;
/// Searches at most: each is without what the one before could not keep.
const ROUNDS: usize = 3;

/// How the values of a fit scatter over parts of the data.
#[derive(Clone, Debug)]
pub(crate) struct Scatter {
    /// Standard deviations of the values.
    pub std: Vec<f64>,
    /// How many parts there are.
    parts: usize,
}

impl Scatter {
    /// The jackknife: σ² = (g − 1)/g·Σ (θ₍ᵢ₎ − θ̄)², θ₍ᵢ₎ the values without the i-th of g parts. `None` where the model
    /// cannot be fitted to a part.
    fn of(problem: &Problem, fit: &Fit) -> Result<Option<Self>> {
        let of_part = |part: &Problem| -> Result<Option<Vec<f64>>> {
            let starts = part.starts(&fit.model)?;
            Ok(part.fit(&fit.model, &starts, &fit.variances, FULL)?.map(|f| f.p))
        };
        let all: Vec<Option<Vec<f64>>> = parts(problem).par_iter().map(of_part).collect::<Result<_>>()?;
        let Some(all) = all.into_iter().collect::<Option<Vec<Vec<f64>>>>() else { return Ok(None) };
        let g = all.len() as f64;
        let of_value = |i: usize| {
            let mean = all.iter().map(|p| p[i]).sum::<f64>() / g;
            ((g - 1.0) / g * all.iter().map(|p| (p[i] - mean).powi(2)).sum::<f64>()).sqrt()
        };
        Ok(Some(Self { std: (0..fit.p.len()).map(of_value).collect(), parts: all.len() }))
    }

    /// How far an effect stands out from its scatter, in units of what chance would make of it: its values are the same
    /// in all parts where this is one or more.
    fn shows(&self, fit: &Fit, effect: &Applied) -> f64 {
        let own = neutral_at_zero(fit, effect);
        let far = own.iter().map(|(i, v)| v.abs() / self.std[*i]).fold(0.0, f64::max);
        // One value of several may do: each has its share of the chance.
        let tail = 0.5 * BY_CHANCE / own.len().max(1) as f64;
        StudentsT::new(0.0, 1.0, self.parts as f64 - 1.0).map_or(0.0, |t| far / t.inverse_cdf(1.0 - tail))
    }
}

/// The data without each of their pieces in turn: without one run of three or more (of many: without every fifth), or
/// without a third of each of fewer.
fn parts(problem: &Problem) -> Vec<Problem> {
    let whole = problem.records.len() >= FEWEST;
    let pieces: Vec<Record> =
        if whole { problem.records.clone() } else { problem.records.iter().flat_map(thirds).collect() };
    let folds = if whole { pieces.len().min(MOST) } else { FEWEST };
    let without = |fold: usize| {
        let kept = pieces.iter().enumerate().filter(|(i, _)| i % folds != fold);
        let records: Vec<Record> = kept.map(|(_, r)| r.clone()).collect();
        Problem { plan: plan(&records), records, free: problem.free, variances: problem.variances }
    };
    (0..folds).map(without).collect()
}

fn thirds(run: &Record) -> [Record; 3] {
    let (first, rest) = run.split(1.0 / 3.0);
    let (second, third) = rest.split(0.5);
    [first, second, third]
}

/// A search's outcome that all parts of the data share.
pub(crate) struct Stable {
    /// What they share.
    pub grown: Grown,
    /// What the whole data ask for and their parts do not share.
    pub unshared: Vec<Applied>,
    /// How the values scatter, where the parts were asked.
    pub scatter: Option<Scatter>,
}

/// Keeps of what was found what parts of the data share, and looks again without the rest.
///
/// Asked only where motion remains that the fit does not explain: where nothing remains the formal evidence holds.
pub(crate) fn search(selection: &Selection, found: Grown, progress: &dyn Fn(&str)) -> Result<Stable> {
    let mut stable = Stable { grown: found, unshared: vec![], scatter: None };
    for round in 1..=ROUNDS {
        if !stable.keep_shared(selection, progress)? || round == ROUNDS {
            break;
        }
        stable.look_again(selection, progress)?;
    }
    if !stable.unshared.is_empty() && !stable.grown.fit.model.free_effects().any(is_term) {
        let named = Grown::from(&stable.grown.fit);
        if let Some(found) = unnamed_terms::search(selection, &named, &stable.unshared, progress)? {
            stable.go_on_with(found);
        }
        stable.keep_shared(selection, progress)?;
    }
    if stable.unshared.is_empty() && remains(&stable.grown.fit) {
        // Something remains, and what is asked for in its place no part bears out.
        stable.unshared = std::mem::take(&mut stable.grown.refused);
    }
    Ok(stable)
}

impl Stable {
    /// Drops what the parts do not share, one after another, what has no name first; whether anything went.
    fn keep_shared(&mut self, selection: &Selection, progress: &dyn Fn(&str)) -> Result<bool> {
        let known = self.unshared.len();
        while remains(&self.grown.fit) && !self.grown.fit.p.is_empty() {
            progress("asking parts of the data for the same effects");
            self.scatter = Scatter::of(selection.problem, &self.grown.fit)?;
            let worst = self.scatter.as_ref().and_then(|s| least_shared(&self.grown.fit, s));
            let Some(worst) = worst else { break };
            let Some(smaller) = selection.reduced(&self.grown.fit, &worst)? else { break };
            self.unshared.push(worst);
            self.grown.go_back_to(smaller);
            self.scatter = None;
        }
        Ok(self.unshared.len() > known)
    }

    /// The search for names from what is shared on, without what is not.
    fn look_again(&mut self, selection: &Selection, progress: &dyn Fn(&str)) -> Result<()> {
        let library = still_open(selection.library, &self.unshared);
        let found = Selection { library: &library, ..*selection }.grown(&self.grown.fit, progress)?;
        self.go_on_with(found);
        Ok(())
    }

    fn go_on_with(&mut self, found: Grown) {
        self.grown.steps.extend(found.steps);
        self.grown.fit = found.fit;
        self.grown.refused = found.refused;
        self.scatter = None;
    }
}

/// The effect that stands out least, of those that do not stand out; one without a name before one that has one.
fn least_shared(fit: &Fit, scatter: &Scatter) -> Option<Applied> {
    let ranked = fit.model.free_effects().map(|e| (!is_term(e), scatter.shows(fit, e), e));
    let unshared = ranked.filter(|(_, shows, _)| *shows < 1.0);
    unshared.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))).map(|(_, _, e)| e.clone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{KNOWN, equations, fit_of, logged, unicycle};

    /// By Student's distribution of two and of four degrees of freedom: 4.3027 and 2.7764 for one value, 6.2053 and 3.4954
    /// for the half of it that each of two has.
    #[test]
    fn what_stands_out_does_so_by_student() {
        let fit = fit_of(unicycle(&KNOWN));
        let [_, relaxing, creep] = &fit.model.effects[..] else { panic!() };
        for (parts, one) in [(3, 4.302_653), (5, 2.776_445)] {
            let scatter = Scatter { std: vec![1.0, 0.02, 0.1, 0.01], parts };
            let shows = scatter.shows(&fit, creep);
            assert!((shows - 5.0 / one).abs() < 1e-4, "{parts}: {shows}");
            // A length is not neutral at zero; the creep that it builds up is.
            let shows = scatter.shows(&fit, relaxing);
            assert!((shows - 5.0 / one).abs() < 1e-4, "{parts}: {shows}");
        }
    }

    /// The one that stands out least of those that do not.
    #[test]
    fn what_is_least_shared_goes_first() {
        let fit = fit_of(unicycle(&[("traction-creep", &[0.3]), ("traverse-creep", &[-0.05])]));
        let gone =
            |std: [f64; 2]| least_shared(&fit, &Scatter { std: std.to_vec(), parts: 3 }).map(|e| e.effect.id.clone());
        assert_eq!(gone([0.3 / 4.31, 0.05 / 4.31]), None);
        assert_eq!(gone([0.3 / 4.29, 0.05 / 4.31]).as_deref(), Some("traction-creep"));
        assert_eq!(gone([0.3 / 4.31, 0.05 / 4.29]).as_deref(), Some("traverse-creep"));
        assert_eq!(gone([0.3, 0.05 / 2.0]).as_deref(), Some("traction-creep"));
        assert_eq!(gone([0.3 / 2.0, 0.05]).as_deref(), Some("traverse-creep"));
    }

    /// Of fewer than three runs the thirds, of more the runs, of many every fifth.
    #[test]
    fn parts_are_without_a_piece_each() {
        let (equations, p) = equations(&[]);
        let run = || {
            let time = (0..300).map(|i| 0.1 * f64::from(i)).collect();
            logged((&equations, &p), time, [&|_| 2.0, &|_| 0.3], &[0.0; 3], 1e-3)
        };
        let kept = |runs: usize| {
            let problem = Problem::new(vec![run(); runs], None, None);
            parts(&problem).iter().map(|part| part.records.len()).collect::<Vec<_>>()
        };
        assert_eq!(kept(1), [2; 3]);
        assert_eq!(kept(2), [4; 3]);
        assert_eq!(kept(3), [2; 3]);
        assert_eq!(kept(5), [4; 5]);
        assert_eq!(kept(7), [5, 5, 6, 6, 6]);
        let problem = Problem::new(vec![run()], None, None);
        let rows = |part: &Problem| part.records.iter().map(|r| r.rows.len()).collect::<Vec<_>>();
        assert_eq!(parts(&problem).iter().map(rows).collect::<Vec<_>>(), [[100, 100]; 3]);
    }
}
