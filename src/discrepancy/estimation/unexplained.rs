//! Motion that a fit leaves unexplained: process noise that it needs beyond chance.

use crate::discrepancy::estimation::autocorrelation::NOTICEABLE;
use crate::discrepancy::estimation::fit::Fit;

/// Named effects from which on one simpler term is tried whatever remains.
const MANY: usize = 2;

/// Whether motion remains that a fit does not explain.
pub fn remains(fit: &Fit) -> bool {
    remaining(fit).next().is_some()
}

/// The kinds of jumps that a fit needs beyond chance, by their deviance over how many rows the noise is alike.
///
/// That jumps are alike over many windows makes an effect that explains them less certain, for they are one observation of
/// it and not many; that there is something to explain it makes more certain. So it is not divided by.
pub(crate) fn remaining(fit: &Fit) -> impl Iterator<Item = usize> {
    (0..fit.unexplained.len()).filter(|c| fit.unexplained[*c] / fit.noise_correlation_time > NOTICEABLE)
}

/// Whether a term may be asked for: something remains, or suspiciously much was needed.
pub(crate) fn is_wanted(named: &Fit) -> bool {
    remains(named) || named.model.free_effects().count() >= MANY
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{fit_of, unicycle};

    /// Noise that is alike over rows makes jumps of nothing; jumps that are alike over windows are no less there.
    #[test]
    fn a_lasting_violation_remains() {
        let of = |rows: f64, windows: f64| {
            let fit = Fit {
                unexplained: vec![0.0, 0.0, 200.0],
                noise_correlation_time: rows,
                residual_correlation_time: windows,
                ..fit_of(unicycle(&[]))
            };
            remaining(&fit).collect::<Vec<usize>>()
        };
        assert_eq!((of(1.0, 1.0), of(1.0, 13.0), of(7.9, 13.0)), (vec![2], vec![2], vec![2]));
        assert!(of(8.1, 1.0).is_empty());
    }
}
