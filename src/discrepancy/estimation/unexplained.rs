//! Motion that a fit leaves unexplained: process noise that it needs beyond chance.

use crate::discrepancy::estimation::autocorrelation::NOTICEABLE;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::noise_model::{Component, NoiseModel};

/// Named effects from which on one simpler term is tried whatever remains.
const MANY: usize = 2;

/// What a fit leaves of the variance of what another leaves unexplained, at most, where it explains most of it.
const LEFT: f64 = 0.04;

/// What is left of a variance that is explained by half.
const HALF: f64 = 0.5;

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

/// The variances of a fit's jumps beyond those that the noise of its inputs is known to make.
fn beyond_known(fit: &Fit) -> Vec<f64> {
    fit.variances.process().iter().map(Component::beyond_known).collect()
}

/// Whether a fit leaves nothing, or at some constraint less than half of the variance of what another leaves there.
pub(crate) fn explains_half(fit: &Fit, than: &Fit) -> bool {
    let [now, before] = [fit, than].map(beyond_known);
    !remains(fit) || remaining(than).any(|c| now[c] < HALF * before[c])
}

/// The noise of a fit with the rest that [`explains_most`] lets another leave: at it an effect is seen that the jumps hide where
/// they are taken for noise.
pub(crate) fn noise_if_explained(fit: &Fit) -> NoiseModel {
    remaining(fit).fold(fit.variances.clone(), |noise, c| noise.with_share_of_jump(c, LEFT))
}

/// Whether a fit leaves nothing, or far less than another: beside a large rest a scope may imitate whatever is there.
pub(crate) fn explains_most(fit: &Fit, than: &Fit) -> bool {
    let [now, before] = [fit, than].map(beyond_known);
    let worst = |c: usize| before[c] * than.unexplained[c];
    let most = (0..before.len()).max_by(|a, b| worst(*a).total_cmp(&worst(*b)));
    !remains(fit) || most.is_some_and(|c| now[c] < LEFT * before[c])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{fit_of, noise_of, unicycle};

    /// Half of what another left at one constraint, beyond what the noise of the inputs makes.
    #[test]
    fn half_is_explained_where_one_constraint_is() {
        let of = |variances: [f64; 3], unexplained: [f64; 3], known: f64| Fit {
            unexplained: unexplained.to_vec(),
            variances: noise_of(0, [1e-6; 2], &variances).knowing([0.0, 0.0, known]),
            ..fit_of(unicycle(&[]))
        };
        let before = of([1e-6, 1e-4, 1e-4], [0.0, 90.0, 900.0], 0.0);
        let left = |across: f64, yaw: f64| explains_half(&of([1e-6, across, yaw], [0.0, 90.0, 900.0], 0.0), &before);
        assert!(left(1e-4, 4e-5) && left(4e-5, 1e-4) && !left(6e-5, 6e-5));
        // Of a rest there was nothing at the first constraint.
        assert!(!explains_half(&of([1e-9, 1e-4, 1e-4], [0.0, 90.0, 900.0], 0.0), &before));
        assert!(explains_half(&of([1e-6, 1e-4, 1e-4], [0.0; 3], 0.0), &before));
        let noisy = |yaw: f64| of([1e-6, 1e-4, yaw], [0.0, 0.0, 900.0], 9e-5);
        assert!(explains_half(&noisy(9.4e-5), &noisy(1e-4)) && !explains_half(&noisy(9.6e-5), &noisy(1e-4)));
    }

    /// Where a rest remains there is as much noise as an explanation may leave; elsewhere as before.
    #[test]
    fn a_rest_is_left_out_of_the_noise() {
        let fit = Fit {
            unexplained: vec![0.0, 0.0, 900.0],
            variances: noise_of(0, [1e-6; 2], &[1e-6, 1e-4, 1e-4]),
            ..fit_of(unicycle(&[]))
        };
        let quiet = noise_if_explained(&fit);
        let of = |noise: &NoiseModel| noise.process().iter().map(|c| c.variance).collect::<Vec<f64>>();
        assert_eq!(of(&quiet)[..2], of(&fit.variances)[..2]);
        assert!((of(&quiet)[2] / 4e-6 - 1.0).abs() < 1e-9, "{:?}", of(&quiet));
        let after = Fit { variances: quiet, ..fit.clone() };
        assert!(!explains_most(&after, &fit), "an explanation leaves less than that");
    }

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
