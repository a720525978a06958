//! What a fit says of its effects: how far from neutral, how alike in all runs, how likely by chance.

use super::heterogeneity::spreads;
use crate::discrepancy::estimation::bounds::is_near_an_end;
use crate::discrepancy::estimation::fit::Fit;
use crate::effects::Applied;
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

/// Where an effect's values stand among the free ones, those that vanish where it is neutral.
pub(crate) fn neutral_at_zero(fit: &Fit, effect: &Applied) -> Vec<(usize, f64)> {
    let mut at = 0;
    for e in fit.model.free_effects() {
        if e.same_as(effect) {
            let all = e.effect.parameters.values().zip(&e.values).enumerate();
            let kept = all.filter(|(_, (p, _))| !p.periodic).map(|(i, (p, v))| (p.positive, (at + i, *v)));
            let (positive, signed): (Vec<_>, Vec<_>) = kept.partition(|(positive, _)| *positive);
            return if signed.is_empty() { positive } else { signed }.into_iter().map(|(_, v)| v).collect();
        }
        at += e.values.len();
    }
    vec![]
}

/// Whether the interval of a value of an effect reaches over an end of what any vehicle has.
pub(crate) fn reaches_an_end(fit: &Fit, effect: &Applied) -> bool {
    let Some(covariance) = &fit.covariance else { return false };
    let mut at = 0;
    for e in fit.model.free_effects() {
        if e.same_as(effect) {
            let mut values = e.effect.parameters.values().zip(&e.values).enumerate();
            return values.any(|(i, (p, v))| is_near_an_end(p, *v, covariance[(at + i, at + i)].sqrt()));
        }
        at += e.values.len();
    }
    false
}

/// Squared distance of an effect from neutral in units of a covariance; zero when that is not known.
fn distance(fit: &Fit, covariance: Option<&nalgebra::DMatrix<f64>>, effect: &Applied) -> f64 {
    distance_of(fit, covariance, effect, &|_, v| v)
}

/// The squared length of a vector in units of a covariance, made of an effect's values and where they stand among the free
/// ones; zero when the covariance is not known.
pub(crate) fn distance_of(
    fit: &Fit,
    covariance: Option<&nalgebra::DMatrix<f64>>,
    effect: &Applied,
    of: &dyn Fn(usize, f64) -> f64,
) -> f64 {
    let own = neutral_at_zero(fit, effect);
    let Some(c) = covariance else { return 0.0 };
    let block = nalgebra::DMatrix::from_fn(own.len(), own.len(), |i, j| c[(own[i].0, own[j].0)]);
    let v = nalgebra::DVector::from_iterator(own.len(), own.iter().map(|(i, v)| of(*i, *v)));
    block.cholesky().map_or(0.0, |c| v.dot(&c.solve(&v)))
}

/// As [`distance`] by the noise alone.
pub(crate) fn wald(fit: &Fit, effect: &Applied) -> f64 {
    distance(fit, fit.covariance.as_ref(), effect)
}

/// Largest probability that runs which scatter as these do show such an effect by chance.
const BY_CHANCE: f64 = 1e-3;
/// The same where every run shows the effect in one direction: whether it predicts the runs left out is asked beside it.
const BY_CHANCE_ALIKE: f64 = 0.05;

/// Whether an effect shows in the runs alike, and not in a few of them or in different directions.
///
/// Runs differ, and few of them tell by how much: where all have the effect in one direction their spread is that of its
/// value, and no doubt of it.
pub(crate) fn repeats(fit: &Fit, effect: &Applied) -> bool {
    let Some(between) = &fit.between_runs else { return true };
    let k = neutral_at_zero(fit, effect).len() as f64;
    let free = fit.runs as f64 - k;
    if free < 1.0 {
        return true;
    }
    let f = distance(fit, Some(between), effect) / k * free / (fit.runs as f64 - 1.0);
    let by_chance = FisherSnedecor::new(k, free).map_or(1.0, |d| d.sf(f));
    by_chance < BY_CHANCE || by_chance < BY_CHANCE_ALIKE && is_one_way(fit, effect)
}

/// Whether every run that tells an effect's largest value beyond its own deviation tells it in the direction of all.
pub(crate) fn is_one_way(fit: &Fit, effect: &Applied) -> bool {
    let Some(c) = &fit.covariance else { return false };
    let far = |(i, v): &(usize, f64)| v * v / c[(*i, *i)];
    let most = neutral_at_zero(fit, effect).into_iter().max_by(|a, b| far(a).total_cmp(&far(b)));
    let Some((i, value)) = most else { return false };
    spreads(fit)[i].as_ref().is_some_and(|s| s.values.len() == fit.runs && s.is_along(value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{KNOWN, applied, fit_of, unicycle};
    use nalgebra::DMatrix;

    #[test]
    fn an_effect_is_told_by_the_values_that_vanish_with_it() {
        let fit = fit_of(unicycle(&KNOWN));
        let places = |id: &str| neutral_at_zero(&fit, &applied(id));
        assert_eq!(places("relaxation-length"), [(1, 0.1)]);
        assert_eq!((places("traction-creep"), places("traverse-creep")), (vec![(0, 0.3)], vec![(3, -0.05)]));
        assert_eq!(places("side-slope"), []);
    }

    /// A wheel may lose no more than nine tenths of its radius; what builds up over no distance is no more than not there.
    #[test]
    fn a_value_at_an_end_of_its_range_is_known_from_its_interval() {
        let reaches = |id: &str, values: &[f64], std: f64| {
            let model = unicycle(&[(id, values)]);
            let covariance = Some(DMatrix::identity(values.len(), values.len()) * std * std);
            reaches_an_end(&Fit { covariance, ..fit_of(model) }, &applied(id))
        };
        assert_eq!([-0.88, -0.87, 0.5].map(|scale| reaches("wheel-radius", &[scale], 0.012)), [true, false, false]);
        assert!(!reaches("relaxation-length", &[0.1, 0.001], 0.01));
    }

    /// One value over its spread between runs, squared, is F of one and of the runs less one: of five runs 74.1 is met by one
    /// in a thousand, of two 405 284.
    #[test]
    fn what_the_runs_scatter_by_is_no_effect() {
        let effect = applied("traverse-creep");
        let repeats = |runs: usize, ratio: f64| {
            let mut between = DMatrix::identity(4, 4);
            between[(3, 3)] = (0.05 / ratio).powi(2);
            super::repeats(&Fit { runs, between_runs: Some(between), ..fit_of(unicycle(&KNOWN)) }, &effect)
        };
        assert_eq!([8.5, 8.7].map(|ratio| repeats(5, ratio)), [false, true]);
        assert_eq!([630.0, 640.0].map(|ratio| repeats(2, ratio)), [false, true]);
        assert!(repeats(1, 0.1) && super::repeats(&fit_of(unicycle(&KNOWN)), &effect));
    }
    /// Five deviations of four runs are met by one in sixty; runs that all show it in one direction need no more.
    #[test]
    fn what_all_runs_show_in_one_direction_may_scatter_more() {
        let effect = applied("traverse-creep");
        let repeats = |steps: [f64; 4]| {
            let mut between = DMatrix::identity(4, 4);
            between[(3, 3)] = 0.01_f64.powi(2);
            let of_run = |step: f64| {
                let mut form = DMatrix::identity(5, 5) * 1e6;
                (form[(3, 4)], form[(4, 3)]) = (-1e6 * step, -1e6 * step);
                form
            };
            let of_runs = steps.map(of_run).to_vec();
            let covariance = Some(DMatrix::identity(4, 4) * 1e-6);
            let fit = fit_of(unicycle(&KNOWN));
            super::repeats(&Fit { runs: 4, between_runs: Some(between), of_runs, covariance, ..fit }, &effect)
        };
        assert!(repeats([-0.02, 0.02, 0.03, -0.03]));
        assert!(!repeats([-0.06, 0.0, 0.0, 0.06]));
    }
}
