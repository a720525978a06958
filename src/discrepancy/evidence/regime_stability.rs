//! The test of Chow (1960): whether an effect has the same value in two regimes of driving.
//!
//! What is there has one value. What imitates something else, a saturation, a dead band, a law of the load, takes
//! another value wherever the imitated thing is larger. The windows of one regime get a value of their own beside the
//! common one, and the difference d is judged by its deviation:
//!
//! χ² = dᵀ·(τ·C + T)⁻¹·d, with the covariance C of d, all else free, τ values that say what one independent value would,
//! and T what values that differ from run to run make of a regime that runs are driven in one by one.

use super::cross_validation::Along;
use super::heterogeneity::{spreads, variance_between_runs};
use crate::discrepancy::estimation::elimination::eliminate;
use crate::discrepancy::estimation::fit::{Fit, inverse};
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::record::local_polynomial::median;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;
use crate::discrepancy::shooting::window_integration::linearise;
use crate::effects::Applied;
use crate::error::Result;
use crate::model::effect_equation::is_term;
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// Windows that a regime and the rest need at least.
const FEWEST: usize = 8;
/// χ² from which on two regimes differ beyond chance, whichever of a dozen is the worst.
const BEYOND_CHANCE: f64 = 20.0;
/// A difference of so large a share of the value is that of no constant.
const LARGE: f64 = 0.5;
/// Values of one sign that are no further apart than by this factor are those of one effect whose law is not quite right.
pub(crate) const FACTOR: f64 = 2.0;

/// A regime of driving, told by the inputs' means over windows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// An input is larger than its median size.
    Large(usize),
    /// An input is positive.
    Positive(usize),
    /// An input grows in size.
    Growing(usize),
    /// The second half of all data.
    Late,
}

/// An effect's values outside and inside of a regime.
#[derive(Clone, Debug)]
pub(crate) struct Difference {
    pub regime: Regime,
    /// Of the difference.
    pub chi_squared: f64,
    /// Of the value of which the difference stands out most: its share of the value.
    pub share: f64,
    /// That value outside and inside.
    pub values: [f64; 2],
    /// Whether a law without a name stands beside the effect, which is then known not to be all there is.
    pub beside_law: bool,
}

impl Difference {
    /// Whether both values have one direction.
    pub fn is_one_way(&self) -> bool {
        self.values[0] * self.values[1] > 0.0
    }

    /// Whether the effect has two values.
    pub fn is_real(&self) -> bool {
        let [outside, inside] = self.values;
        let is_one = self.is_one_way() && outside.abs().max(inside.abs()) <= FACTOR * outside.abs().min(inside.abs());
        self.chi_squared > BEYOND_CHANCE && self.share > LARGE && (self.beside_law || !is_one)
    }
}

impl Problem {
    /// The differences of every free effect of a fit with a name between all regimes.
    pub(crate) fn differences(&self, fit: &Fit) -> Result<Vec<(Applied, Vec<Difference>)>> {
        let equations = fit.model.free_equations()?;
        let linear = linearise(&equations, &fit.p, &self.records, &self.plan, &fit.window_states);
        let Some(linear) = linear else { return Ok(vec![]) };
        let regimes = self.regimes();
        let apart: Vec<f64> = spreads(fit).iter().map(variance_between_runs).collect();
        let runs: Vec<usize> = self.plan.iter().map(|s| s.record).collect();
        let mut at = 0;
        let of_effect = |effect: &Applied| {
            let own = at..at + effect.values.len();
            at = own.end;
            // What holds in part has its regime, and what walks has many values.
            if is_term(effect) || effect.effect.scope.is_some() || effect.effect.walk.is_some() {
                return None;
            }
            let of_regime = |(r, inside): &(Regime, Inside)| {
                let of_runs = imbalance(&runs, inside);
                let apart: Vec<f64> = apart[own.clone()].iter().map(|variance| variance * of_runs).collect();
                difference(fit, &linear, *r, inside, own.clone(), &apart)
            };
            let each = regimes.iter().filter_map(of_regime);
            Some((effect.clone(), each.collect()))
        };
        Ok(fit.model.free_effects().filter_map(of_effect).collect())
    }

    /// The regimes in which some windows are and some are not.
    fn regimes(&self) -> Vec<(Regime, Inside)> {
        let inputs: Vec<Vec<Vec<f64>>> = self.plan.iter().map(|s| self.inputs_of(s.record, &s.windows)).collect();
        let channels = inputs.iter().flatten().map(Vec::len).min().unwrap_or(0);
        let kinds = [Regime::Large, Regime::Positive, Regime::Growing];
        let all = (0..channels).flat_map(|c| kinds.map(|k| k(c))).chain([Regime::Late]);
        let told = all.map(|r| (r, inside(r, &inputs)));
        told.filter(|(_, inside)| {
            let some = inside.iter().flatten().filter(|i| **i).count();
            some >= FEWEST && inside.iter().map(Vec::len).sum::<usize>() - some >= FEWEST
        })
        .collect()
    }

    fn inputs_of(&self, record: usize, windows: &[Range<usize>]) -> Vec<Vec<f64>> {
        windows.iter().map(|w| mean_inputs(&self.records[record], w)).collect()
    }
}

/// Which windows are in a regime, segment by segment.
type Inside = Vec<Vec<bool>>;

fn inside(regime: Regime, inputs: &[Vec<Vec<f64>>]) -> Inside {
    let sizes = |c: usize| inputs.iter().flatten().map(|u| u[c].abs()).collect::<Vec<f64>>();
    let of = |holds: &dyn Fn(&[Vec<f64>], usize) -> bool| {
        inputs.iter().map(|s| (0..s.len()).map(|k| holds(s, k)).collect()).collect()
    };
    match regime {
        Regime::Large(c) => {
            let typical = median(&mut sizes(c)).unwrap_or(0.0);
            of(&|s, k| s[k][c].abs() > typical)
        }
        Regime::Positive(c) => of(&|s, k| s[k][c] > 0.0),
        Regime::Growing(c) => of(&|s, k| k > 0 && s[k][c].abs() > s[k - 1][c].abs()),
        Regime::Late => {
            let half = inputs.iter().map(Vec::len).sum::<usize>() / 2;
            let all: Vec<bool> = (0..2 * half + 1).map(|k| k >= half).collect();
            let mut rest = &all[..];
            let mut take = |s: &Vec<Vec<f64>>| {
                let (first, others) = rest.split_at(s.len());
                rest = others;
                first.to_vec()
            };
            inputs.iter().map(&mut take).collect()
        }
    }
}

fn mean_inputs(record: &Record, rows: &Range<usize>) -> Vec<f64> {
    let channels = record.signals.channels();
    let (mut value, mut slope) = (vec![0.0; channels], vec![0.0; channels]);
    let mut sum = vec![0.0; channels];
    for i in rows.clone() {
        record.signals.at(record.time[i], &mut value, &mut slope);
        sum.iter_mut().zip(&value).for_each(|(s, v)| *s += v / rows.len() as f64);
    }
    sum
}

/// By how much of its variance between runs a value differs between a regime and the rest: Σ (w − w′)² over the runs, with
/// the shares of the regime's windows and of the others that lie in each; zero where every run has both alike.
fn imbalance(runs: &[usize], inside: &Inside) -> f64 {
    let mut counts = vec![[0.0; 2]; runs.iter().max().map_or(0, |last| last + 1)];
    for (run, windows) in runs.iter().zip(inside) {
        windows.iter().for_each(|is_inside| counts[*run][usize::from(*is_inside)] += 1.0);
    }
    let all = [0, 1].map(|side| counts.iter().map(|c: &[f64; 2]| c[side]).sum::<f64>());
    counts.iter().map(|[out, within]| (within / all[1] - out / all[0]).powi(2)).sum()
}

/// The difference of an effect's values between a regime and the rest; `apart` is the variance that the runs alone make of it.
fn difference(
    fit: &Fit,
    linear: &Along,
    regime: Regime,
    inside: &Inside,
    own: Range<usize>,
    apart: &[f64],
) -> Option<Difference> {
    let (p, k) = (fit.p.len(), own.len());
    let segment = |(windows, inside): (&Vec<LinearisedWindow>, &Vec<bool>)| {
        windows.iter().zip(inside).map(|(w, i)| widened(w, p, own.clone(), *i)).collect()
    };
    let wider: Along = linear.iter().zip(inside).map(segment).collect();
    let (information, gradient) = eliminate(&wider, &fit.variances, p + k)?.normal();
    let covariance = inverse(&information)?;
    let step = -(&covariance * gradient);
    let d = DVector::from_fn(k, |i, _| step[p + i]);
    let spread = DMatrix::from_fn(k, k, |i, j| {
        let of_runs = if i == j { apart[i] } else { 0.0 };
        covariance[(p + i, p + j)] * fit.joint_inflation(own.start + i, own.start + j) + of_runs
    });
    let far = |i: usize| d[i] * d[i] / spread[(i, i)];
    let most = (0..k).max_by(|a, b| far(*a).total_cmp(&far(*b)))?;
    let outside = fit.p[own.start + most] + step[own.start + most];
    let chi_squared = d.dot(&spread.cholesky()?.solve(&d));
    let share = (d[most] / fit.p[own.start + most]).abs();
    let beside_law = fit.model.free_effects().any(is_term);
    Some(Difference { regime, chi_squared, share, values: [outside, outside + d[most]], beside_law })
}

/// A window with columns of their own for some of p values: copies where it is inside of a regime, zero elsewhere.
fn widened(window: &LinearisedWindow, p: usize, own: Range<usize>, inside: bool) -> LinearisedWindow {
    let poses = window.gram[0].nrows() - 1 - p;
    let last = poses + p;
    // The column of the window that a column of the wider one is.
    let from = |j: usize| match j {
        j if j < last => Some(j),
        j if j < last + own.len() => inside.then_some(poses + own.start + j - last),
        _ => Some(last),
    };
    let n = last + own.len() + 1;
    let entry = |g: &DMatrix<f64>, i: usize, j: usize| from(i).zip(from(j)).map_or(0.0, |at| g[at]);
    LinearisedWindow {
        gram: window.gram.iter().map(|g| DMatrix::from_fn(n, n, |i, j| entry(g, i, j))).collect(),
        back: window.back.as_ref().map(|b| DMatrix::from_fn(poses, n, |i, j| from(j).map_or(0.0, |j| b[(i, j)]))),
        ..window.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::estimation::fit::Effort;
    use crate::discrepancy::fixtures::{equations, logged, unicycle};

    #[test]
    fn windows_are_told_by_their_inputs() {
        let inputs = vec![vec![vec![1.0], vec![-3.0]], vec![vec![2.0], vec![0.5], vec![-4.0]]];
        assert_eq!(inside(Regime::Large(0), &inputs), [vec![false, true], vec![false, false, true]]);
        assert_eq!(inside(Regime::Positive(0), &inputs), [vec![true, false], vec![true, true, false]]);
        assert_eq!(inside(Regime::Growing(0), &inputs), [vec![false, true], vec![false, false, true]]);
        assert_eq!(inside(Regime::Late, &inputs), [vec![false, false], vec![true, true, true]]);
    }

    /// A creep that is there has one value; fitted to one that grows with the speed it has two.
    #[test]
    fn a_constant_has_one_value_and_what_imitates_a_law_has_two() {
        let speed = |t: f64| 2.0 + 1.5 * (0.7 * t).sin();
        let time = || (0..900).map(|i| 0.05 * f64::from(i)).collect::<Vec<f64>>();
        let worst = |law: f64| {
            let (equations, p) = equations(&[("traverse-creep", &[0.05])]);
            let mut record = logged((&equations, &p), time(), [&speed, &|t| 0.3 * (0.5 * t).cos()], &[0.0; 3], 1e-3);
            // What a law of the speed adds sideways.
            let mut off = [0.0; 2];
            for i in 1..record.time.len() {
                let (v, heading) = (0.5 * speed(record.time[i]), record.columns[2][i]);
                let across = 0.05 * 0.05 * law * (v - 1.0) * v;
                off = [off[0] - across * heading.sin(), off[1] + across * heading.cos()];
                record.columns[0][i] += off[0];
                record.columns[1][i] += off[1];
            }
            let problem = Problem::new(vec![record], None, None);
            let model = unicycle(&[("traverse-creep", &[0.01])]);
            let starts = problem.starts(&model).unwrap();
            let fit = problem.fit(&model, &starts, &problem.variances, Effort::FULL).unwrap().unwrap();
            let (_, each) = problem.differences(&fit).unwrap().remove(0);
            assert!(each.iter().any(|d| d.regime == Regime::Large(0)));
            each.into_iter().max_by(|a, b| a.chi_squared.total_cmp(&b.chi_squared)).unwrap()
        };
        assert!(!worst(0.0).is_real(), "{:?}", worst(0.0));
        let told = worst(1.0);
        assert!(told.is_real() && told.regime == Regime::Large(0), "{told:?}");
    }

    /// Two runs, the one in the regime and the other not, differ by what both scatter; runs that are half in it by nothing.
    #[test]
    fn a_regime_of_its_own_runs_differs_by_what_runs_do() {
        let (all, none, half) = (vec![true; 4], vec![false; 4], vec![true, false, true, false]);
        assert!((imbalance(&[0, 1], &vec![all.clone(), none.clone()]) - 2.0).abs() < 1e-12);
        assert!(imbalance(&[0, 1], &vec![half.clone(), half.clone()]) < 1e-12);
        assert!(
            (imbalance(&[0, 1, 2, 3], &vec![all.clone(), all.clone(), none.clone(), none.clone()]) - 1.0).abs() < 1e-12
        );
        // A run that was cut is one run.
        assert!(imbalance(&[0, 0, 1], &vec![all, none, half]) < 1e-12);
    }

    /// Values of one sign within a factor of two are one effect by a law that is not quite right.
    #[test]
    fn two_values_are_two_where_they_differ_in_sign_or_by_more_than_twice() {
        let beside = |chi_squared: f64, values: [f64; 2], beside_law: bool| {
            let share = 2.0 * (values[0] - values[1]).abs() / (values[0].abs() + values[1].abs());
            Difference { regime: Regime::Late, chi_squared, share, values, beside_law }.is_real()
        };
        let is_real = |chi_squared, values| beside(chi_squared, values, false);
        assert!(!is_real(400.0, [-0.00032, -0.00059]) && !is_real(400.0, [0.2, 0.1]));
        assert!(is_real(400.0, [0.1, 0.21]) && is_real(400.0, [0.1, -0.1]) && is_real(400.0, [0.0, 0.1]));
        // Beside a law without a name it is not the effect's law alone that is not right.
        assert!(beside(400.0, [0.099, 0.18], true) && !beside(400.0, [0.1, 0.13], true));
        assert!(!is_real(19.0, [0.1, -0.1]));
    }
}
