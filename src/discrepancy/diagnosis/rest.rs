//! What remains above the noise floor, whatever is named.

use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::unexplained;
use crate::discrepancy::localisation::constraint_residuals::ConstraintResiduals;
use crate::discrepancy::localisation::driving_regimes::{DrivingRegime, Stretch, disagreements};
use crate::discrepancy::localisation::unexplained_motion::disagrees;
use crate::discrepancy::report::{Gap, judged, judged_alike};
use crate::model::state::JUMPS;

/// A gap beyond so many floors is not the noise.
const ABOVE: f64 = 1.5;

/// What a model leaves above the noise floor.
#[derive(Clone, Debug)]
pub struct Rest {
    /// The gap over its floor, at the horizon and in the quantity where that is largest.
    pub ratio: f64,
    /// Whether the gap is that of held-out runs.
    pub is_held_out: bool,
    /// The stretch with the largest share of what remains on the fitted runs.
    pub most: Stretch,
}

impl Rest {
    /// Whether the gap is beyond its floor; else windows alone stand out of the noise.
    pub fn exceeds_floor(&self) -> bool {
        self.ratio > ABOVE
    }
}

/// What a model leaves; `None` at the floor.
pub(crate) fn rest(fit: &Fit, after: &[ConstraintResiduals], gaps: &[Gap]) -> Option<Rest> {
    let ratio = largest_ratio(gaps)?;
    let exceeds = ratio > ABOVE && unexplained::remains(fit);
    if !exceeds && !disagrees(fit, after) {
        return None;
    }
    let is_held_out = gaps.iter().any(|g| g.held_out.is_some());
    let most = disagreements(after).into_iter().next().or_else(|| everywhere(fit, after))?;
    Some(Rest { ratio, is_held_out, most })
}

/// The whole of a run and the constraint that needs the jumps most: what stands out of no window by itself.
fn everywhere(fit: &Fit, after: &[ConstraintResiduals]) -> Option<Stretch> {
    let most = unexplained::remaining(fit).max_by(|a, b| fit.unexplained[*a].total_cmp(&fit.unexplained[*b]))?;
    let run = after.iter().find(|v| v.span().is_some())?;
    let (place, regime) = (JUMPS[most].place, DrivingRegime::Whole);
    Some(Stretch { run: run.run.clone(), place, span: run.span()?, regime, share: 1.0 })
}

/// The largest number of floors that a gap is.
fn largest_ratio(gaps: &[Gap]) -> Option<f64> {
    let of = |g: &&Gap| {
        let (_, v) = judged(g)?;
        let position = v.position_rms_after / g.noise_floor.position_rms;
        let heading = v.heading_rms_after.zip(g.noise_floor.heading_rms).map_or(0.0, |(a, f)| a / f);
        Some(position.max(heading)).filter(|ratio| ratio.is_finite())
    };
    judged_alike(gaps).iter().filter_map(of).max_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{fit_of, unicycle};
    use crate::discrepancy::report::{BeforeAfter, Floor};

    fn gap(horizon_s: f64, after: [f64; 2], held_out: bool) -> Gap {
        let numbers = BeforeAfter {
            position_rms_before: 9.0,
            position_rms_after: after[0],
            heading_rms_before: Some(9.0),
            heading_rms_after: Some(after[1]),
        };
        let [fit, held] = if held_out { [None, Some(numbers)] } else { [Some(numbers), None] };
        Gap { horizon_s, fit, held_out: held, noise_floor: Floor { position_rms: 0.1, heading_rms: Some(0.01) } }
    }

    /// The largest ratio of position and heading over the horizons that are judged alike.
    #[test]
    fn a_rest_is_as_large_as_its_largest_ratio() {
        let ratio = |gaps: &[Gap]| largest_ratio(gaps).unwrap();
        assert!((ratio(&[gap(1.0, [0.2, 0.01], true), gap(5.0, [0.1, 0.05], true)]) - 5.0).abs() < 1e-12);
        // The fitted runs are not asked where others were held out.
        assert!((ratio(&[gap(1.0, [0.2, 0.01], true), gap(30.0, [9.0, 0.9], false)]) - 2.0).abs() < 1e-12);
        assert_eq!(largest_ratio(&[]), None);
    }

    #[test]
    fn where_nothing_is_left_unexplained_a_gap_above_its_floor_is_no_rest() {
        let missed = ConstraintResiduals::across("a.csv", &[0.2, -0.2, 0.2, 0.2, 0.2, -0.2]);
        let found = |unexplained: f64, after: f64| {
            let fit = Fit { unexplained: vec![0.0, unexplained, 0.0, 0.0], ..fit_of(unicycle(&[])) };
            rest(&fit, std::slice::from_ref(&missed), &[gap(5.0, [after, 0.01], true)])
        };
        let place = |unexplained| found(unexplained, 0.5).map(|r| r.most.place);
        assert_eq!((place(0.0), place(90.0)), (None, Some("traverse constraint")));
    }
}
