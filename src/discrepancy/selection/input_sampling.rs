//! Effects asked of inputs of which every second row is left out.
//!
//! Between rows the inputs are taken to be smooth. Where they change faster than they are logged, what the interpolation
//! misses looks like an effect. It grows at least with the square of the time between rows; what is there keeps its value.
//! So of what a value moves by when the time between rows is doubled, a third is missed at most before.

use super::search::{Search, SearchState};
use crate::discrepancy::estimation::fit::Effort;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::evidence::wald_test::distance_of;
use crate::discrepancy::record::run_record::Record;
use crate::effects::Applied;
use crate::error::Result;
use crate::motion::Signals;
use crate::progress::{OnProgress, Stage, begin};

/// An effect of which more than this share may be what the interpolation misses is none.
const MOST: f64 = 0.5;

/// What is missed at twice the time between rows, less what is missed at the time itself, in units of the latter.
const GROWTH: f64 = 3.0;

/// A delay below so large a share of the time between rows may be what the interpolation makes up: no row shows it.
const OF_A_ROW: f64 = 0.025;

/// What a fit is worth where its inputs are logged half as often.
#[derive(Default)]
pub(crate) struct InputSampling {
    /// What came and went with how often the inputs are logged, worst first, and was dropped.
    pub dropped: Vec<Applied>,
    /// What the interpolation may make up of each value that stays; nothing where that could not be asked.
    pub missed: Vec<f64>,
}

/// Drops what comes and goes with how often the inputs are logged, and says how far the rest may be off for it.
pub(crate) fn keep_sampled(
    selection: &Search,
    grown: &mut SearchState,
    progress: &OnProgress,
) -> Result<InputSampling> {
    let mut found = InputSampling::default();
    if grown.fit.p.is_empty() {
        return Ok(found);
    }
    let Some(coarse) = with_half_the_inputs(selection.problem) else { return Ok(found) };
    let rows = selection.problem.records.iter().map(Record::step).fold(0.0, f64::max);
    while !grown.fit.p.is_empty() {
        begin(progress, Stage::InputSampling)?;
        let Some(half) = coarse.fit(&grown.fit.model, &grown.fit.window_states, &grown.fit.variances, Effort::FULL)?
        else {
            break;
        };
        let moved = grown
            .fit
            .model
            .free_effects()
            .map(|e| (share_missed(&grown.fit, &half, e).max(share_of_a_row(e, rows)), e));
        let Some((share, worst)) = moved.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        if share <= MOST {
            found.missed = grown.fit.p.iter().zip(&half.p).map(|(all, half)| (half - all).abs() / GROWTH).collect();
            break;
        }
        let worst = worst.clone();
        let Some(smaller) = selection.without(&grown.fit, &worst)? else { break };
        grown.go_back_to(smaller);
        found.dropped.push(worst);
    }
    Ok(found)
}

/// The same poses with inputs logged half as often, but for runs that are too short to leave any out; `None` where all
/// are.
fn with_half_the_inputs(problem: &Problem) -> Option<Problem> {
    let thinned: Vec<Option<Signals>> = problem.records.iter().map(|r| r.signals.thinned()).collect();
    if thinned.iter().all(Option::is_none) {
        return None;
    }
    let of = |(r, thin): (&Record, Option<Signals>)| {
        let signals = thin.unwrap_or_else(|| r.signals.clone());
        Record { signals, ..r.clone() }
    };
    Some(Problem { records: problem.records.iter().zip(thinned).map(of).collect(), ..problem.clone() })
}

/// How much of a delay may be made up between rows that are so many seconds apart; nothing of another effect.
fn share_of_a_row(effect: &Applied, rows: f64) -> f64 {
    let far = effect.values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    if effect.effect.delays_inputs() && far > 0.0 && effect.effect.scope.is_none() {
        OF_A_ROW * rows / far
    } else {
        0.0
    }
}

/// How much of the distance of an effect's values from neutral the interpolation may make up.
fn share_missed(fit: &Fit, half: &Fit, effect: &Applied) -> f64 {
    let by = |p: &dyn Fn(usize, f64) -> f64| distance_of(fit, fit.covariance.as_ref(), effect, p);
    let far = by(&|_, v| v);
    if far > 0.0 { (by(&|i, v| half.p[i] - v) / far).sqrt() / GROWTH } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::applied;

    #[test]
    fn a_delay_of_a_small_share_of_a_row_is_none() {
        let share = |id: &str, value: f64| share_of_a_row(&Applied { values: vec![value], ..applied(id) }, 0.02);
        assert!(share("input-delay", -0.0006) > MOST && share("input-delay", 0.0012) < MOST);
        assert_eq!([share("input-delay", 0.0), share("yaw-rate-bias", 0.0006)], [0.0; 2]);
    }
}
