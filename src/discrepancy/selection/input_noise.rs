//! Effects asked of inputs with less noise and with more.
//!
//! Less: a Rauch–Tung–Striebel smoother takes the noise away. An effect that is a low-pass filter of the inputs, or two
//! that are one together, explains noisy inputs better although nothing is hidden; of smoothed ones it explains nothing.
//!
//! More: simulation and extrapolation (Cook & Stefanski, 1994). Noise of the inputs moves the values of a fit by a bias
//! that grows with its variance, and scatters them. With noise of the same kind added once more the bias is twice as large;
//! what a value grows by then is what the noise makes of nothing, and what it moves by is its deviation. Times are chosen
//! where the noise happens to be of one sign: a value in intervals must be worth the choice of their edges as well.
//!
//! A lag and a negative delay of nearly its size are together no lag but a mean over the time around: the filter that
//! noise asks for.

use super::search::Search;
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::evidence::wald_test::neutral_at_zero;
use crate::discrepancy::record::input_noise::PHASES;
use crate::discrepancy::selection::choice::Weighed;
use crate::effects::Applied;
use crate::error::Result;
use crate::progress::OnProgress;

/// An effect of which more than this share may be what noise makes of nothing is none.
const MOST: f64 = 0.5;
/// A lag that a delay takes back to less than this share of itself is none.
const TAKEN_BACK: f64 = 0.5;

impl Search<'_> {
    /// The effect that does not stand where the noise of the inputs is smoothed away; of several the one worth least.
    pub(crate) fn smoothed_away(&self, fit: &Fit, progress: &OnProgress) -> Result<Option<Applied>> {
        if fit.p.is_empty() {
            return Ok(None);
        }
        let Some(smooth) = self.problem.with_smoothed_inputs() else { return Ok(None) };
        let Some(again) = smooth.fit(&fit.model, &fit.window_states, &fit.variances, Effort::FULL)? else {
            return Ok(None);
        };
        let weighed = Search { problem: &smooth, memo: None, ..*self }.weighed(&again, None, &[], progress)?;
        let chosen: Vec<_> = weighed.into_iter().map(|w| w.effect).collect();
        Ok(self.fallen_by_value(&again, &chosen).map(|(applied, _)| applied))
    }
}

/// A lag of noisy inputs that a delay takes back.
pub(crate) fn taken_back(problem: &Problem, fit: &Fit) -> Option<Applied> {
    let in_seconds = |e: &Applied, positive: bool| {
        let parameters = e.effect.parameters.values().zip(&e.values);
        parameters.filter(|(p, _)| p.unit == "s" && p.positive == positive).map(|(_, v)| *v).next()
    };
    let delays: Vec<f64> = fit.model.free_effects().filter_map(|e| in_seconds(e, false)).collect();
    let is_taken_back = |lag: f64| delays.iter().any(|delay| *delay < 0.0 && (lag + delay).abs() < TAKEN_BACK * lag);
    let mut lags = fit.model.free_effects().filter(|e| !e.effect.states.is_empty());
    lags.find(|e| problem.has_inputs_to_average() && in_seconds(e, true).is_some_and(is_taken_back)).cloned()
}

/// The effect that gains least beyond what it gains of noisy inputs where nothing is hidden, if that is less than it costs.
pub(crate) fn gained_of_nothing(
    selection: &Search,
    fit: &Fit,
    weighed: &[Weighed],
    progress: &OnProgress,
) -> Result<Option<Applied>> {
    if !selection.problem.has_noisy_inputs() {
        return Ok(None);
    }
    let mut least: Option<(f64, &Applied)> = None;
    for Weighed { effect, without } in weighed {
        let applied = &effect.applied;
        let price = applied.values.len() as f64 * selection.price(fit) + selection.price_of_scope(applied, fit);
        let Some(beyond) = selection.problem.gain_beyond_input_noise(without, applied, price, progress)? else {
            continue;
        };
        if beyond <= 1.0 && least.is_none_or(|(other, _)| beyond < other) {
            least = Some((beyond, applied));
        }
    }
    Ok(least.map(|(_, applied)| applied.clone()))
}

/// The effect of which the noise of the inputs makes most, where that is more than its share, or whose value it moves by
/// more than leaves it worth its price.
pub(crate) fn made_up(selection: &Search, fit: &Fit) -> Result<Option<Applied>> {
    let problem = selection.problem;
    if fit.p.is_empty() || !problem.has_noisy_inputs() {
        return Ok(None);
    }
    let (mut grown, mut moved) = (vec![0.0; fit.p.len()], vec![0.0; fit.p.len()]);
    for draw in 0..PHASES {
        let noisier = problem.with_noisier_inputs(draw);
        let again = noisier.fit(&fit.model, &fit.window_states, &fit.variances, Effort::FULL)?;
        let Some(again) = again else { return Ok(None) };
        for (i, by) in again.p.iter().zip(&fit.p).map(|(a, p)| a - p).enumerate() {
            grown[i] += by / PHASES as f64;
            moved[i] += by * by / PHASES as f64;
        }
    }
    let share = |e: &Applied| {
        let own = neutral_at_zero(fit, e);
        let sum = |of: &dyn Fn(usize, f64) -> f64| own.iter().map(|(i, v)| of(*i, *v)).sum::<f64>();
        sum(&|i, v| grown[i] * v) / sum(&|_, v| v * v).max(f64::MIN_POSITIVE)
    };
    let is_moved = |e: &Applied| {
        let bar = selection.price(fit) + selection.price_of_scope(e, fit);
        let variance = |i: usize| moved[i] + fit.variance(i).unwrap_or(0.0);
        let own = neutral_at_zero(fit, e);
        !own.is_empty() && own.iter().all(|(i, v)| v * v <= bar * variance(*i))
    };
    let shares = fit.model.free_effects().map(|e| (share(e), e)).filter(|(s, e)| *s > MOST || is_moved(e));
    Ok(shares.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, e)| e.clone()))
}
