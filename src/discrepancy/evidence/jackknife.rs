//! The delete-a-group jackknife (Quenouille, 1956; Tukey, 1958): the scatter of fitted values over parts of the data.

use crate::discrepancy::estimation::fit::Effort;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::evidence::regime_stability::FACTOR;
use crate::discrepancy::evidence::wald_test::neutral_at_zero;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::shooting::windows::plan;
use crate::effects::Applied;
use crate::error::Result;
use crate::progress::{Counter, OnProgress, Stage};
use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Parts at least; runs fewer than these are cut into as many pieces.
const FEWEST: usize = 3;

/// Parts at most: each is a fit of its own.
const MOST: usize = 5;

/// Largest probability that a value which scatters as much over the parts lies so far from neutral.
const BY_CHANCE: f64 = 0.05;

/// How the values of a fit scatter over parts of the data.
#[derive(Clone, Debug)]
pub(crate) struct Jackknife {
    /// Standard deviations of the values.
    pub std: Vec<f64>,
    /// Whether all parts have a value in one direction and of one size, by the pseudo-values g·θ − (g − 1)·θ₍ᵢ₎ of Tukey.
    pub alike: Vec<bool>,
    /// Whether all parts have a value in one direction, by the same.
    pub one_way: Vec<bool>,
    /// How many parts there are.
    pub(crate) parts: usize,
}

impl Jackknife {
    /// The jackknife: σ² = (g − 1)/g·Σ (θ₍ᵢ₎ − θ̄)², θ₍ᵢ₎ the values without the i-th of g parts. `None` where the model
    /// cannot be fitted to a part.
    pub(crate) fn of(problem: &Problem, fit: &Fit, progress: &OnProgress) -> Result<Option<Self>> {
        let parts = parts(problem);
        let counter = Counter::begin(progress, Stage::PartsOfData, parts.len())?;
        let of_part = |part: &Problem| -> Result<Option<Vec<f64>>> {
            let starts = part.starts(&fit.model)?;
            let found = part.fit(&fit.model, &starts, &fit.variances, Effort::FULL)?;
            counter.one().map(|()| found.map(|f| f.p))
        };
        let all: Vec<Option<Vec<f64>>> = parts.par_iter().map(of_part).collect::<Result<_>>()?;
        let Some(all) = all.into_iter().collect::<Option<Vec<Vec<f64>>>>() else { return Ok(None) };
        let g = all.len() as f64;
        let of_value = |i: usize| {
            let mean = all.iter().map(|p| p[i]).sum::<f64>() / g;
            ((g - 1.0) / g * all.iter().map(|p| (p[i] - mean).powi(2)).sum::<f64>()).sqrt()
        };
        let extremes = |i: usize| {
            let pseudo = all.iter().map(|p| (g * fit.p[i] - (g - 1.0) * p[i]) * fit.p[i].signum());
            pseudo.fold([f64::INFINITY, 0.0_f64], |[a, b], v| [a.min(v), b.max(v)])
        };
        let each = 0..fit.p.len();
        let extremes: Vec<[f64; 2]> = each.clone().map(extremes).collect();
        let of_extremes = |is_so: fn(f64, f64) -> bool| extremes.iter().map(|[a, b]| is_so(*a, *b)).collect();
        Ok(Some(Self {
            std: each.map(of_value).collect(),
            alike: of_extremes(|least, most| least > 0.0 && most <= FACTOR * least),
            one_way: of_extremes(|least, _| least > 0.0),
            parts: all.len(),
        }))
    }

    /// Whether every value of an effect that is neutral at zero has one direction in all parts.
    pub(crate) fn is_one_way(&self, fit: &Fit, effect: &Applied) -> bool {
        neutral_at_zero(fit, effect).iter().all(|(i, _)| self.one_way[*i])
    }

    /// How far an effect stands out from its scatter, in units of what chance would make of it: its values are the same
    /// in all parts where this is one or more. Of a value that is alike in all parts the other direction is not asked
    /// about.
    pub(crate) fn shows(&self, fit: &Fit, effect: &Applied) -> f64 {
        let own = neutral_at_zero(fit, effect);
        // One value of several may do: each has its share of the chance.
        let share = BY_CHANCE / own.len().max(1) as f64;
        let Ok(student) = StudentsT::new(0.0, 1.0, self.parts as f64 - 1.0) else { return 0.0 };
        let far = |(i, v): &(usize, f64)| {
            let tail = if self.alike[*i] { share } else { 0.5 * share };
            v.abs() / self.std[*i] / student.inverse_cdf(1.0 - tail)
        };
        own.iter().map(far).fold(0.0, f64::max)
    }
}

/// The data without each of their pieces in turn: without one run of three or more (of many: without every fifth), or
/// without a third of each of fewer.
pub(crate) fn parts(problem: &Problem) -> Vec<Problem> {
    let whole = problem.records.len() >= FEWEST;
    let pieces: Vec<Record> =
        if whole { problem.records.clone() } else { problem.records.iter().flat_map(thirds).collect() };
    let folds = if whole { pieces.len().min(MOST) } else { FEWEST };
    let without = |fold: usize| {
        let kept = pieces.iter().enumerate().filter(|(i, _)| i % folds != fold);
        let records: Vec<Record> = kept.map(|(_, r)| r.clone()).collect();
        Problem { plan: plan(&records), records, ..problem.clone() }
    };
    (0..folds).map(without).collect()
}

fn thirds(run: &Record) -> [Record; 3] {
    let (first, rest) = run.split(1.0 / 3.0);
    let (second, third) = rest.split(0.5);
    [first, second, third]
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
            let scatter =
                Jackknife { std: vec![1.0, 0.02, 0.1, 0.01], alike: vec![false; 4], one_way: vec![false; 4], parts };
            let shows = scatter.shows(&fit, creep);
            assert!((shows - 5.0 / one).abs() < 1e-4, "{parts}: {shows}");
            // A length is not neutral at zero; the creep that it builds up is.
            let shows = scatter.shows(&fit, relaxing);
            assert!((shows - 5.0 / one).abs() < 1e-4, "{parts}: {shows}");
        }
        // Alike in all parts: 2.9200 of two degrees of freedom.
        let scatter =
            Jackknife { std: vec![1.0, 0.02, 0.1, 0.01], alike: vec![true; 4], one_way: vec![true; 4], parts: 3 };
        assert!((scatter.shows(&fit, creep) - 5.0 / 2.919_986).abs() < 1e-4);
    }

    /// Of a length, which is positive, the direction says nothing beside that of the creep.
    #[test]
    fn an_effect_has_one_direction_by_its_signed_values() {
        let fit = fit_of(unicycle(&KNOWN));
        let [traction, relaxing, creep] = &fit.model.effects[..] else { panic!() };
        let scatter =
            Jackknife { std: vec![1.0; 4], alike: vec![false; 4], one_way: vec![true, true, false, false], parts: 3 };
        let told = [traction, relaxing, creep].map(|e| scatter.is_one_way(&fit, e));
        assert_eq!(told, [true, true, false]);
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
