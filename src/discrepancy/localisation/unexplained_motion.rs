//! What the last model leaves: constraint by constraint, against the noise, and whether it is white.

use super::constraint_residuals::ConstraintResiduals;
use super::whiteness::is_white;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::unexplained;
use crate::discrepancy::evidence::chi_squared::tail;
use crate::discrepancy::report::{Remaining, RemainingConstraint, RemainingSensor};
use crate::model::observation::{HEADING, POSITION};
use crate::model::state::JUMPS;

/// What a fit leaves of every constraint on the data it was fitted to.
///
/// | symbol | meaning |
/// |---|---|
/// | RMS, noise | the violated rate over windows, and what smoothing noise alone makes of it |
/// | p | probability of so much unexplained motion by chance: half of χ²₁, for a variance is never negative |
/// | rows, windows alike | integrated correlations, see [`crate::discrepancy::estimation::autocorrelation`]: 1 where noise and jumps are white |
pub fn remaining(
    fit: &Fit,
    has_heading: bool,
    after: &[ConstraintResiduals],
    sensors: Vec<RemainingSensor>,
) -> Remaining {
    let noise = |k: usize| fit.variances.measurement()[k].variance.sqrt();
    let constraints = JUMPS.iter().enumerate().filter_map(|(c, jump)| {
        let (rms, noise) = ConstraintResiduals::rms(after, c)?;
        // Of noise that is not white the poses wander: what that makes of the rate is no motion.
        let moved = if fit.noise_correlation_time > 1.0 { (1.0 - (noise / rms).powi(2)).max(0.0) } else { 1.0 };
        let gain = moved * fit.unexplained[c] / fit.variance_inflation();
        // Half of the weight lies on zero.
        let p_value = if gain > 0.0 { 0.5 * tail(gain, 1) } else { 1.0 };
        Some(RemainingConstraint { place: jump.place.into(), unit: jump.rate_unit.into(), rms, noise, p_value })
    });
    Remaining {
        position_noise: noise(POSITION),
        heading_noise: has_heading.then(|| noise(HEADING)),
        rows_alike: fit.noise_correlation_time,
        windows_alike: fit.residual_correlation_time,
        constraints: constraints.collect(),
        sensors,
    }
}

/// A violation this many times as large as what noise makes of none is seen without statistics.
const VISIBLE: f64 = 2.0;

/// The constraints at which a fit leaves more than chance does, and as much as stands out of the noise to the eye.
pub(crate) fn visible(fit: &Fit, after: &[ConstraintResiduals]) -> impl Iterator<Item = usize> {
    let stands_out = |c: &usize| ConstraintResiduals::rms(after, *c).is_some_and(|(rms, noise)| rms > VISIBLE * noise);
    unexplained::remaining(fit).filter(stands_out)
}

/// Whether what a fit leaves stands out of the noise, and is not random.
pub(crate) fn disagrees(fit: &Fit, after: &[ConstraintResiduals]) -> bool {
    visible(fit, after).any(|c| !is_white(after, c))
}

/// Whether what a fit leaves stands out of the noise, and all of it is random.
pub(crate) fn is_random(fit: &Fit, after: &[ConstraintResiduals]) -> bool {
    visible(fit, after).next().is_some() && !disagrees(fit, after)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{fit_of, unicycle};

    /// What noise that wanders makes of a rate is taken off what remains; of white noise nothing is.
    #[test]
    fn what_remains_is_judged_beside_its_noise() {
        let mut missed = ConstraintResiduals::across("a.csv", &[0.2, -0.2, 0.2, 0.2]);
        missed.noise = vec![0.0, 0.1, 0.0];
        let p_of = |colour: f64, correlation: f64, unexplained: f64| {
            let fit = Fit {
                noise_correlation_time: colour,
                residual_correlation_time: correlation,
                unexplained: vec![0.0, unexplained, 0.0],
                ..fit_of(unicycle(&[]))
            };
            let left = remaining(&fit, false, std::slice::from_ref(&missed), vec![]);
            let of = left.constraints.iter().find(|c| c.place == "traverse constraint").unwrap();
            assert!((of.rms - 0.2).abs() < 1e-12 && (of.noise - 0.1).abs() < 1e-12);
            assert!(left.heading_noise.is_none() && (left.position_noise - 1e-3).abs() < 1e-12);
            of.p_value
        };
        let close = |p: f64, gain: f64| (p - 0.5 * tail(gain, 1)).abs() < 1e-12;
        assert!(close(p_of(1.0, 1.0, 8.0), 8.0) && close(p_of(1.0, 2.0, 8.0), 4.0));
        assert!(close(p_of(2.0, 1.0, 8.0), 0.75 * 4.0) && close(p_of(4.0, 2.0, 40.0), 0.75 * 5.0));
        assert_eq!((p_of(1.0, 1.0, 0.0), p_of(2.0, 1.0, -1.0)), (1.0, 1.0));
    }
}
