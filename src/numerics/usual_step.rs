//! The usual time between rows: the median of the steps, which neither gaps nor bursts move.

/// The median of the steps of rising times; of an even number of them the later middle. `None` of fewer than two times.
pub(crate) fn usual_step(time: &[f64]) -> Option<f64> {
    let mut steps: Vec<f64> = time.windows(2).map(|w| w[1] - w[0]).collect();
    let middle = steps.len() / 2;
    (!steps.is_empty()).then(|| *steps.select_nth_unstable_by(middle, f64::total_cmp).1)
}
