//! Residuals of the quantities that are measured beside the pose, against the noise that their own rows show.

use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::report::RemainingSensor;
use crate::discrepancy::shooting::window_integration::linearise;
use crate::error::Result;

/// A residual this many times as large as the noise of its column is no noise.
const VISIBLE: f64 = 2.0;

/// What a fit leaves of every measured quantity on the data it was fitted to.
///
/// | symbol | meaning |
/// |---|---|
/// | RMS | √(Σ(modelled − measured)²/n) over the rows of all windows |
/// | noise | the median over runs of the scatter about a local polynomial, see [`crate::discrepancy::record`] |
///
/// # Errors
/// When a formula of the model is undefined by name.
pub fn remaining_sensors(problem: &Problem, fit: &Fit) -> Result<Vec<RemainingSensor>> {
    let measured = &fit.model.measured;
    if measured.is_empty() {
        return Ok(vec![]);
    }
    let equations = fit.model.free_equations()?;
    let windows = linearise(&equations, &fit.p, &problem.records, &problem.plan, &fit.window_states);
    let first = fit.variances.measurement().len() - measured.len();
    let of = |(k, quantity): (usize, &crate::model::measured::MeasuredQuantity)| {
        let all = windows.iter().flatten().flatten().filter(|w| w.count[first + k] > 0);
        let (square, count) = all.fold((0.0, 0), |(s, n), w| (s + w.square(first + k), n + w.count[first + k]));
        (count > 0).then(|| RemainingSensor {
            name: quantity.name.clone(),
            unit: quantity.unit.clone(),
            rms: (square / count as f64).sqrt(),
            noise: problem.quantity_noise(k),
        })
    };
    Ok(measured.iter().enumerate().filter_map(of).collect())
}

/// Those that a model misses by more than their noise.
pub(crate) fn missed(sensors: &[RemainingSensor]) -> impl Iterator<Item = &RemainingSensor> {
    sensors.iter().filter(|s| s.rms > VISIBLE * s.noise)
}
