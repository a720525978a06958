//! Effects asked of inputs with their own noise once more: simulation and extrapolation (Cook & Stefanski, 1994).
//!
//! Noise of the inputs moves the values of a fit by a bias that grows with its variance. With noise of the same kind
//! added once more the bias is twice as large; what a value grows by then is what the noise makes of nothing.

use super::search::Search;
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::evidence::wald_test::neutral_at_zero;
use crate::effects::Applied;
use crate::error::Result;

/// An effect of which more than this share may be what noise makes of nothing is none.
const MOST: f64 = 0.5;
/// Times noise is added.
const DRAWS: u64 = 3;

/// The effect of which the noise of the inputs makes most, where that is more than its share.
pub(crate) fn made_up(selection: &Search, fit: &Fit) -> Result<Option<Applied>> {
    let problem = selection.problem;
    if fit.p.is_empty() || !problem.records.iter().any(|r| r.input_noise.is_there()) {
        return Ok(None);
    }
    let mut grown = vec![0.0; fit.p.len()];
    for draw in 0..DRAWS {
        let noisier = problem.with_noisier_inputs(draw);
        let again = noisier.fit(&fit.model, &fit.window_states, &fit.variances, Effort::FULL)?;
        let Some(again) = again else { return Ok(None) };
        grown.iter_mut().zip(again.p.iter().zip(&fit.p)).for_each(|(g, (a, p))| *g += (a - p) / DRAWS as f64);
    }
    let share = |e: &Applied| {
        let own = neutral_at_zero(fit, e);
        let sum = |of: &dyn Fn(usize, f64) -> f64| own.iter().map(|(i, v)| of(*i, *v)).sum::<f64>();
        sum(&|i, v| grown[i] * v) / sum(&|_, v| v * v).max(f64::MIN_POSITIVE)
    };
    let shares = fit.model.free_effects().map(|e| (share(e), e)).filter(|(s, _)| *s > MOST);
    Ok(shares.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, e)| e.clone()))
}
