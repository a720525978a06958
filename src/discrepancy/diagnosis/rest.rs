//! What remains above the noise floor, whatever is named.

use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::unexplained;
use crate::discrepancy::localisation::constraint_residuals::ConstraintResiduals;
use crate::discrepancy::localisation::driving_regimes::{DrivingRegime, Stretch, disagreements};
use crate::discrepancy::localisation::unexplained_motion::disagrees;
use crate::discrepancy::report::{Gap, judged, judged_alike, middle};
use crate::model::state::JUMPS;

/// A gap beyond so many floors is not the noise.
const ABOVE: f64 = 1.5;

/// What a model leaves above the noise floor.
#[derive(Clone, Debug)]
pub struct Rest {
    /// The gap over its floor.
    pub excess: Excess,
    /// Whether the gap is that of held-out runs.
    pub is_held_out: bool,
    /// The stretch with the largest share of what remains, on the runs of the gap.
    pub most: Stretch,
}

/// How many floors a gap is, and which gap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excess {
    /// The gap over its floor.
    pub ratio: f64,
    /// After so many seconds.
    pub horizon_s: f64,
    /// Whether it is the heading's, and not the position's.
    pub of_heading: bool,
}

impl Excess {
    /// Whether it is more than the floor.
    fn is_real(&self) -> bool {
        self.ratio > ABOVE
    }
}

impl Rest {
    /// Whether the gap is beyond its floor; else windows alone stand out of the noise.
    pub fn exceeds_floor(&self) -> bool {
        self.excess.is_real()
    }
}

/// What a model leaves of the fitted and of the held-out runs; `None` at the floor.
///
/// Where the gap is beyond its floor, its number and its place are of the same runs.
pub(crate) fn rest(
    fit: &Fit,
    after: &[ConstraintResiduals],
    held_out: &[ConstraintResiduals],
    gaps: &[Gap],
) -> Option<Rest> {
    let excess = excess(gaps)?;
    let is_held_out = gaps.iter().any(|g| g.held_out.is_some());
    // What explains the fitted runs need not hold in others.
    let unseen_disagree = is_held_out && !disagreements(held_out).is_empty();
    let exceeds = excess.is_real() && (unexplained::remains(fit) || unseen_disagree);
    if !exceeds && !disagrees(fit, after) {
        return None;
    }
    let judged = if is_held_out && excess.is_real() { held_out } else { after };
    let most = disagreements(judged).into_iter().next().or_else(|| everywhere(fit, judged))?;
    Some(Rest { excess, is_held_out, most })
}

/// The whole of a run and the constraint that needs the jumps most: what stands out of no window by itself.
fn everywhere(fit: &Fit, after: &[ConstraintResiduals]) -> Option<Stretch> {
    let most = unexplained::remaining(fit).max_by(|a, b| fit.unexplained[*a].total_cmp(&fit.unexplained[*b]))?;
    let run = after.iter().find(|v| v.span().is_some())?;
    let (place, regime) = (JUMPS[most].place, DrivingRegime::Whole);
    Some(Stretch { run: run.run.clone(), place, span: run.span()?, regime, share: 1.0 })
}

/// How far the gaps are beyond their floors: the position's at the middle horizon, as the page shows it first; where that is
/// at its floor the heading's there, and else the largest.
fn excess(gaps: &[Gap]) -> Option<Excess> {
    let of = |g: &Gap| -> Vec<Excess> {
        let Some((_, v)) = judged(g) else { return vec![] };
        let position = Some(v.position_rms_after / g.noise_floor.position_rms);
        let heading = v.heading_rms_after.zip(g.noise_floor.heading_rms).map(|(after, floor)| after / floor);
        let both = [(position, false), (heading, true)].into_iter();
        let each =
            both.filter_map(|(ratio, of_heading)| Some(Excess { ratio: ratio?, horizon_s: g.horizon_s, of_heading }));
        each.filter(|e| e.ratio.is_finite()).collect()
    };
    let shown = middle(gaps).map_or_else(Vec::new, of);
    let all = judged_alike(gaps).into_iter().flat_map(of);
    let largest = all.max_by(|a, b| a.ratio.total_cmp(&b.ratio));
    shown.into_iter().find(Excess::is_real).or(largest)
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

    /// The number of the page, of its horizon; another where that is at its floor.
    #[test]
    fn a_rest_is_as_large_as_the_page_shows_it() {
        let found =
            |gaps: &[Gap]| excess(gaps).map(|e| ((1000.0 * e.ratio).round() / 1000.0, e.horizon_s, e.of_heading));
        let [first, last] = [gap(1.0, [0.2, 0.01], true), gap(30.0, [2.6, 0.5], true)];
        assert_eq!(found(&[first.clone(), gap(5.0, [0.5, 0.08], true), last.clone()]), Some((5.0, 5.0, false)));
        assert_eq!(found(&[first.clone(), gap(5.0, [0.1, 0.08], true), last.clone()]), Some((8.0, 5.0, true)));
        assert_eq!(found(&[first.clone(), gap(5.0, [0.1, 0.01], true), last]), Some((50.0, 30.0, true)));
        // The fitted runs are not asked where others were held out.
        assert_eq!(found(&[first, gap(30.0, [9.0, 0.9], false)]), Some((2.0, 1.0, false)));
        assert_eq!(found(&[]), None);
    }

    /// A number of held-out runs has its place in them; what stands out of windows alone has it in the fitted ones.
    #[test]
    fn a_rest_has_its_number_and_its_place_of_the_same_runs() {
        let missed = |run: &str| vec![ConstraintResiduals::across(run, &[0.2, -0.2, 0.2, 0.2, 0.2, -0.2])];
        let fit = Fit { unexplained: vec![0.0, 90.0, 0.0, 0.0], ..fit_of(unicycle(&[])) };
        let run = |after: f64, is_held_out: bool| {
            let found = rest(&fit, &missed("fitted.csv"), &missed("held.csv"), &[gap(5.0, [after, 0.01], is_held_out)]);
            found.map(|r| r.most.run)
        };
        assert_eq!(run(0.5, true).as_deref(), Some("held.csv"));
        assert_eq!(run(0.5, false).as_deref(), Some("fitted.csv"));
        assert!(run(0.1, true).is_none_or(|run| run == "fitted.csv"));
    }

    /// A gap above its floor is chance where neither the fit needs jumps nor the held-out windows stand out of their noise.
    #[test]
    fn a_gap_above_its_floor_is_a_rest_where_the_fit_or_the_held_out_windows_say_so() {
        let missed = ConstraintResiduals::across("a.csv", &[0.2, -0.2, 0.2, 0.2, 0.2, -0.2]);
        let found = |unexplained: f64, held_out: &ConstraintResiduals, after: f64| {
            let fit = Fit { unexplained: vec![0.0, unexplained, 0.0, 0.0], ..fit_of(unicycle(&[])) };
            let [fitted, held_out] = [&missed, held_out].map(std::slice::from_ref);
            rest(&fit, fitted, held_out, &[gap(5.0, [after, 0.01], true)]).map(|r| r.most.place)
        };
        let quiet = ConstraintResiduals::across("held.csv", &[0.0; 6]);
        let place = Some("traverse constraint");
        assert_eq!((found(0.0, &quiet, 0.5), found(90.0, &quiet, 0.5)), (None, place));
        assert_eq!((found(0.0, &missed, 0.1), found(0.0, &missed, 0.5)), (None, place));
    }
}
