//! Motion that a fit leaves unexplained: process noise that it needs beyond chance.

use crate::discrepancy::estimation::autocorrelation::NOTICEABLE;
use crate::discrepancy::estimation::fit::Fit;

/// Named effects from which on one simpler term is tried whatever remains.
const MANY: usize = 2;

/// What a fit leaves of the variance of what another leaves unexplained, at most, where it explains most of it.
const LEFT: f64 = 0.04;

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

/// Whether a fit leaves nothing, or far less than another: beside a large rest a scope may imitate whatever is there.
pub(crate) fn explains_most(fit: &Fit, than: &Fit) -> bool {
    let left = |fit: &Fit| fit.variances.process().iter().map(|c| c.variance).collect::<Vec<f64>>();
    let (now, before) = (left(fit), left(than));
    let worst = |c: usize| before[c] * than.unexplained[c];
    let most = (0..before.len()).max_by(|a, b| worst(*a).total_cmp(&worst(*b)));
    !remains(fit) || most.is_some_and(|c| now[c] < LEFT * before[c])
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
