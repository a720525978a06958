//! The verdict: the first of the contract's that holds.

use super::advice::{Advice, Motive, settling};
use super::reason::{MissedMotion, Reason};
use super::warning::Warning;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::estimation::unexplained;
use crate::discrepancy::localisation::clock_drift::Drift;
use crate::discrepancy::localisation::constraint_residuals::ConstraintResiduals;
use crate::discrepancy::localisation::sensor_residuals::missed as missed_sensors;
use crate::discrepancy::localisation::unexplained_motion::{disagrees, is_random, visible};
use crate::discrepancy::preprocessing::slip_angle::longest_slide;
use crate::discrepancy::preprocessing::unit_errors::{self, Slip};
use crate::discrepancy::report::{RemainingSensor, Verdict};
use crate::discrepancy::selection::choice::Selected;
use crate::discrepancy::selection::search::find;
use crate::discrepancy::selection::select::Candidate;
use crate::error::Result;
use crate::model::Model;
use crate::model::effect_equation;
use crate::model::observation::{BODY_HEADING, HEADING, PLACE, POSITION};
use crate::model::state::JUMPS;

/// A verdict, its reason and the next experiment.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The verdict.
    pub verdict: Verdict,
    /// Why, where the report's numbers do not say it by themselves.
    pub reason: Option<Reason>,
    /// What to drive or log next.
    pub next: Option<Advice>,
}

impl Outcome {
    pub(crate) fn new(verdict: Verdict, reason: Reason, next: Option<Advice>) -> Self {
        Self { verdict, reason: Some(reason), next }
    }

    /// The verdict beside what sensors other than that of the pose show: what they contradict is not explained.
    pub(crate) fn beside_sensors(self, sensors: &[RemainingSensor]) -> Self {
        let missed: Vec<String> = missed_sensors(sensors).map(|s| s.name.clone()).collect();
        match self.verdict == Verdict::NoMissingEffect && !missed.is_empty() {
            true => Self::new(Verdict::Unexplained, Reason::SensorsDisagree(missed), None),
            false => self,
        }
    }
}

/// Windows that a statement about effects needs at least.
const FEWEST_WINDOWS: usize = 5;
/// A model that misses more than this share of the motion does not describe it.
const HOPELESS: f64 = 0.5;

/// Motion less than this many times what noise makes of none is none.
const OUT_OF_NOISE: f64 = 5.0;

/// A vehicle that turns less says nothing of how its model turns, rad/s, root mean square.
const TURNING: f64 = 0.1;

/// A slip angle beyond creep, rad.
const SLIP_ANGLE: f64 = 0.35;
/// A stretch of so much slip that is no bump, s.
const LONG_SLIDE: f64 = 1.5;

/// Unusable or too short before anything is fitted.
///
/// # Errors
/// When the model's formulas are malformed.
pub fn before_fitting(problem: &Problem, model: &Model) -> Result<Option<Outcome>> {
    if let Some(outcome) = still_or_short(problem, model) {
        return Ok(Some(outcome));
    }
    if model.forced.is_some() {
        // Whose sliding is in the model.
        return Ok(None);
    }
    if let Some(slip) = unit_errors::another_motion(model, &problem.records)? {
        return Ok(Some(unusable(slip)));
    }
    let slide = longest_slide(model, &problem.records)?;
    Ok(slide.map(|slide| Outcome::new(Verdict::UnusableData, Reason::Drifts(slide), None)))
}

fn still_or_short(problem: &Problem, model: &Model) -> Option<Outcome> {
    if !moves(problem) {
        let (reason, next) = match driven(problem) {
            true => (Reason::PosesStand, Advice::PosesOftener),
            false => (Reason::NothingMoves, Advice::varied(model, Motive::Motion)),
        };
        return Some(Outcome::new(Verdict::UnusableData, reason, Some(next)));
    }
    let windows = problem.windows();
    (windows < FEWEST_WINDOWS).then(|| {
        let reason = Reason::TooFewWindows { windows, needed: FEWEST_WINDOWS };
        Outcome::new(Verdict::NotIdentifiable, reason, Some(Advice::varied(model, Motive::Length)))
    })
}

/// The model cannot be evaluated along the runs.
pub fn undefined_motion() -> Outcome {
    Outcome::new(Verdict::UnusableData, Reason::UndefinedMotion, None)
}

/// Data that cannot be put to the model, for a slip.
pub fn unusable(slip: Slip) -> Outcome {
    Outcome::new(Verdict::UnusableData, Reason::Slip(slip), None)
}

/// Whether any run leaves its place by more than its noise.
fn moves(problem: &Problem) -> bool {
    let noise = |k: usize| problem.variances.measurement()[k].variance.sqrt().max(1e-6);
    let span = |column: &[f64]| {
        let (low, high) = column.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(*x), h.max(*x)));
        high - low
    };
    problem.records.iter().any(|r| {
        let part = |c: usize| &r.columns[c][r.rows.clone()];
        let moved = PLACE.into_iter().any(|c| span(part(c)) > 20.0 * noise(POSITION));
        moved || (r.has_heading() && span(part(BODY_HEADING)) > 20.0 * noise(HEADING))
    })
}

/// Whether any input is ever other than zero.
fn driven(problem: &Problem) -> bool {
    problem.records.iter().any(|r| {
        let mut value = vec![0.0; r.signals.channels()];
        let mut slope = value.clone();
        r.signals.knots().iter().any(|t| {
            r.signals.at(*t, &mut value, &mut slope);
            value.iter().any(|v| *v != 0.0)
        })
    })
}

/// The verdict after the choice.
///
/// # Errors
/// When the model's formulas are malformed.
pub fn after_fitting(
    problem: &Problem,
    choice: &Selected,
    after: &[ConstraintResiduals],
    clocks: &[Drift],
) -> Result<Outcome> {
    if let Some((motion, share)) = hopeless(after) {
        let slip = unit_errors::suspected(&choice.before.model, &problem.records)?;
        let reason = Reason::MissesMotion { motion, share, slip: slip.map(Box::new) };
        return Ok(Outcome::new(Verdict::UnusableData, reason, None));
    }
    Ok(fitted(choice, after, clocks, problem.has_noisy_inputs()))
}

fn fitted(choice: &Selected, after: &[ConstraintResiduals], clocks: &[Drift], has_noisy_inputs: bool) -> Outcome {
    // Under forces sliding is in the model.
    let slides = || if choice.before.model.forced.is_some() { None } else { sliding(after) };
    if let Some(reason) = slides().or_else(|| mismatched(clocks)) {
        return Outcome::new(Verdict::UnusableData, reason, None);
    }
    let without_name = choice.chosen.iter().any(|c| effect_equation::is_term(&c.applied));
    let contradicted = !choice.inconsistent.is_empty();
    if !choice.chosen.is_empty() {
        let verdict = if without_name { Verdict::UnnamedEffect } else { Verdict::MissingEffect };
        let partly = || Reason::PartlyInconsistent(choice.chosen.iter().map(|c| c.applied.clone()).collect());
        let reason = (!without_name && contradicted).then(partly);
        return Outcome { verdict, reason, next: contradicted.then(|| settling(choice)) };
    }
    if !choice.sampling_sensitive.is_empty() && !contradicted {
        let next = Advice::InputsOftener(choice.sampling_sensitive.clone());
        return Outcome::new(Verdict::NotIdentifiable, Reason::InputsTooSeldom, Some(next));
    }
    let random = random(&choice.after, after);
    // What noisy inputs ask for, and parts of the data do not bear out, is that noise unless the eye sees something.
    let is_seen = !has_noisy_inputs || visible(&choice.after, after).next().is_some();
    if random.is_none() && contradicted && is_seen || disagrees(&choice.after, after) {
        let reason = if contradicted { Reason::Inconsistent } else { Reason::Unexplained };
        return Outcome::new(Verdict::Unexplained, reason, Some(settling(choice)));
    }
    match missed(&choice.candidates, choice.before.variance_inflation()) {
        Some(candidate) => {
            let missed = || Box::new(candidate.applied.clone());
            let next = Advice::varied(&choice.before.model, Motive::Missed(missed()));
            Outcome::new(Verdict::NotIdentifiable, Reason::Missed(missed()), Some(next))
        }
        None => {
            let reason = random.or_else(|| trace(&choice.after));
            Outcome { verdict: Verdict::NoMissingEffect, reason, next: None }
        }
    }
}

/// The reason where what a model leaves is random.
fn random(fit: &Fit, after: &[ConstraintResiduals]) -> Option<Reason> {
    is_random(fit, after).then(|| Reason::RandomRest(visible(fit, after).map(|c| JUMPS[c].place).collect()))
}

/// What a model leaves beyond chance without standing out of the noise to the eye; `None` where it leaves nothing.
fn trace(after: &Fit) -> Option<Reason> {
    let places: Vec<&str> = unexplained::remaining(after).map(|c| JUMPS[c].place).collect();
    (!places.is_empty()).then_some(Reason::Trace(places))
}

/// Effects of the model file that the runs ask for with other values.
pub(crate) fn restated(choice: &Selected) -> Vec<Warning> {
    let asked = choice.chosen.iter().map(|c| &c.applied);
    let old = |new| find(&choice.before.model, new);
    asked.filter_map(|new| Some(Warning::Restated { old: Box::new(old(new)?), new: Box::new(new.clone()) })).collect()
}

/// A model that misses most of the motion or of the turning, whatever is added to it, and the share that it misses.
fn hopeless(after: &[ConstraintResiduals]) -> Option<(MissedMotion, f64)> {
    let squares = after.iter().map(ConstraintResiduals::against_motion);
    let sums = squares.fold([[0.0; 3]; 2], |sum, of| [0, 1].map(|k| [0, 1, 2].map(|i| sum[k][i] + of[k][i])));
    // What turns on the spot goes no way of which a share could be missed.
    let moves = sums[0][1] > OUT_OF_NOISE.powi(2) * sums[0][2];
    let turns = sums[1][1] > TURNING.powi(2) * after.iter().map(ConstraintResiduals::count).sum::<usize>() as f64;
    let share = |[miss, motion, _]: [f64; 3]| (miss / motion.max(f64::MIN_POSITIVE)).sqrt();
    let asked = [(MissedMotion::Way, moves, share(sums[0])), (MissedMotion::Turning, turns, share(sums[1]))];
    let (motion, _, share) = asked.into_iter().find(|(_, asked, share)| *asked && *share > HOPELESS)?;
    Some((motion, share))
}

/// A vehicle that slides: no coefficient of creep describes slip angles of tens of degrees.
fn sliding(after: &[ConstraintResiduals]) -> Option<Reason> {
    let slides = after.iter().filter_map(|v| v.slide(SLIP_ANGLE.tan()));
    let (run, span) = slides.max_by(|(_, a), (_, b)| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
    let slides = || Reason::Slides { run: run.to_string(), span, angle: SLIP_ANGLE };
    (span[1] - span[0] >= LONG_SLIDE).then(slides)
}

/// Clocks that do not match.
fn mismatched(clocks: &[Drift]) -> Option<Reason> {
    let worst = clocks.iter().filter(|d| d.is_mismatch()).max_by(|a, b| a.total.abs().total_cmp(&b.total.abs()))?;
    Some(Reason::ClocksDrift { run: worst.run.clone(), total: worst.total })
}

/// A basic effect that would not have stood out at its plausible size, where so many values say what one would.
pub(crate) fn missed(candidates: &[Candidate], variance_inflation: f64) -> Option<&Candidate> {
    candidates.iter().find(|c| {
        let sizes = c.applied.effect.parameters.values().map(|p| p.size);
        let hides = |(size, std): (f64, &f64)| 4.0 * std * variance_inflation.sqrt() > size;
        c.applied.effect.basic && sizes.zip(&c.std).any(hides)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{self, Applied};

    #[test]
    fn only_a_basic_effect_that_could_hide_is_missed() {
        let scored = |id: &str, share: f64| {
            let effect = effects::named(id).unwrap();
            let std = effect.parameters.values().map(|p| share * p.size).collect();
            Candidate { applied: Applied::new(effect, None, vec![0.0]), std, delta_bic: 0.0 }
        };
        let known = [scored("rotation-creep", 0.2), scored("yaw-rate-bias", 0.01), scored("wheel-radius", 9.0)];
        assert!(missed(&known, 1.0).is_none(), "what is known to a quarter of its size would have been seen");
        let alike = missed(&known, 2.0).unwrap();
        assert_eq!(alike.applied.effect.id, "rotation-creep", "rows that are alike say half as much");
        let open = [scored("rotation-creep", 0.2), scored("yaw-rate-scale", 0.3)];
        assert_eq!(missed(&open, 1.0).unwrap().applied.effect.id, "yaw-rate-scale");
    }

    #[test]
    fn the_longest_slide_of_all_runs_is_told() {
        let first = ConstraintResiduals::across("first", &[0.0, 0.5, 0.5, 0.0, -0.5, 0.5, 0.5, 0.0]);
        let second = ConstraintResiduals::across("second", &[0.5, 0.5, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0]);
        let third = ConstraintResiduals::across("third", &[0.0, 0.0, 0.0, 0.5, 0.5, 0.0, 0.0, 0.0]);
        let of = |runs: &[ConstraintResiduals]| match sliding(runs) {
            Some(Reason::Slides { run, span, .. }) => (run, span),
            other => panic!("{other:?}"),
        };
        assert_eq!(of(&[second.clone(), first.clone(), third.clone()]), ("first".to_string(), [4.0, 7.0]));
        let (_, span) = of(&[second, third]);
        assert!([[0.0, 2.0], [3.0, 5.0]].contains(&span), "{span:?}");
        // A single second is a bump, and what stays below the angle is creep.
        assert!(sliding(&[ConstraintResiduals::across("bump", &[0.0, 0.5, 0.0, 0.5, 0.0])]).is_none());
        assert!(sliding(&[ConstraintResiduals::across("creeping", &[0.3; 8])]).is_none());
    }
}
