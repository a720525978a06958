//! The verdict: the first of the contract's five that holds.

use super::contradictions::{partly, too_seldom};
use crate::discrepancy::diagnosis::advice::drive;
use crate::discrepancy::diagnosis::advice::{oftener, settling};
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::estimation::unexplained;
use crate::discrepancy::localisation::clock_drift::Drift;
use crate::discrepancy::localisation::constraint_residuals::ConstraintResiduals;
use crate::discrepancy::preprocessing::unit_errors;
use crate::discrepancy::report::{NextExperiment, Verdict};
use crate::discrepancy::selection::choice::Selected;
use crate::discrepancy::selection::search::find;
use crate::discrepancy::selection::select::Candidate;
use crate::effects::Applied;
use crate::error::Result;
use crate::model::Model;
use crate::model::effect_equation;
use crate::model::observation::{HEADING, POSITION};
use crate::model::state::JUMPS;
use crate::number_format::significant;
use crate::wording::listed;

/// A verdict with what there is to say about it.
pub struct Outcome {
    /// The verdict.
    pub verdict: Verdict,
    /// A sentence that says more than the usual one.
    pub sentence: Option<String>,
    /// What to drive next.
    pub next_experiment: Option<NextExperiment>,
}

/// Windows that a statement about effects needs at least.
const FEWEST_WINDOWS: usize = 5;
/// A model that misses more than this share of the motion does not describe it.
const HOPELESS: f64 = 0.5;

/// Motion less than this many times what noise makes of none is none.
const OUT_OF_NOISE: f64 = 5.0;

/// A vehicle that turns less says nothing of how its model turns, rad/s, root mean square.
const TURNING: f64 = 0.1;

/// A violation this many times as large as what noise makes of none is seen without statistics.
const VISIBLE: f64 = 2.0;

/// A slip angle beyond creep, rad.
const SLIP_ANGLE: f64 = 0.35;
/// A stretch of so much slip that is no bump, s.
const LONG_SLIDE: f64 = 1.5;

/// Unusable or too short before anything is fitted.
///
/// # Errors
/// When the model's formulas are malformed.
pub fn before_fitting(problem: &Problem, model: &Model) -> Result<Option<Outcome>> {
    if let Some(outcome) = still_or_short(problem) {
        return Ok(Some(outcome));
    }
    Ok(unit_errors::another_motion(model, &problem.records)?.map(unusable))
}

fn still_or_short(problem: &Problem) -> Option<Outcome> {
    if !moves(problem) && driven(problem) {
        let sentence = "The inputs say that the vehicle moves in these runs, but the poses show no more than their scatter \
                        from row to row, so nothing can be said about its model.";
        let next = NextExperiment {
            why: "between two rows of poses more happens than from one end of the run to the other".into(),
            manoeuvre: "log the poses several times as often, and check the units of their columns".into(),
        };
        return Some(outcome(Verdict::UnusableData, sentence, Some(next)));
    }
    if !moves(problem) {
        let sentence = "The vehicle does not move in these runs, so nothing can be said about its model.";
        return Some(outcome(Verdict::UnusableData, sentence, Some(drive("a model is tested by motion"))));
    }
    (problem.windows() < FEWEST_WINDOWS).then(|| {
        let sentence = format!(
            "These runs are too short to tell: {} windows of one second, and at least {FEWEST_WINDOWS} are needed.",
            problem.windows()
        );
        outcome(Verdict::NotIdentifiable, &sentence, Some(drive("the runs are too short")))
    })
}

/// The model cannot be evaluated along the runs.
pub fn undefined_motion() -> Outcome {
    let sentence =
        "The model is undefined somewhere along these runs (a steering angle of 90°, say), so it cannot be fitted.";
    outcome(Verdict::UnusableData, sentence, None)
}

/// Data that cannot be put to the model, and why.
pub fn unusable(why: String) -> Outcome {
    Outcome { verdict: Verdict::UnusableData, sentence: Some(why), next_experiment: None }
}

fn outcome(verdict: Verdict, sentence: &str, next_experiment: Option<NextExperiment>) -> Outcome {
    Outcome { verdict, sentence: Some(sentence.into()), next_experiment }
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
        let moved = (0..2).any(|c| span(part(c)) > 20.0 * noise(POSITION));
        moved || (r.has_heading && span(part(2)) > 20.0 * noise(HEADING))
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
    if let Some(missed) = hopeless(after) {
        let slip = unit_errors::suspected(&choice.before.model, &problem.records)?;
        let why = slip.unwrap_or_else(|| "clocks, columns or units do not match, or the wheels spin.".into());
        return Ok(outcome(Verdict::UnusableData, &format!("{missed}: {why}"), None));
    }
    Ok(fitted(choice, after, clocks))
}

fn fitted(choice: &Selected, after: &[ConstraintResiduals], clocks: &[Drift]) -> Outcome {
    if let Some(sentence) = sliding(after).or_else(|| mismatched(clocks)) {
        return outcome(Verdict::UnusableData, &sentence, None);
    }
    let without_name = choice.chosen.iter().any(|c| effect_equation::is_term(&c.applied));
    let contradicted = !choice.inconsistent.is_empty();
    if !choice.chosen.is_empty() {
        let verdict = if without_name { Verdict::UnnamedEffect } else { Verdict::MissingEffect };
        let sentence = (!without_name && contradicted).then(|| partly(choice));
        return Outcome { verdict, sentence, next_experiment: contradicted.then(|| settling(choice)) };
    }
    if let Some(asked) = too_seldom(choice).filter(|_| !contradicted) {
        let sentence = "The inputs change faster than they are logged, so nothing can be named.";
        return outcome(Verdict::NotIdentifiable, sentence, Some(oftener(&asked)));
    }
    if contradicted || disagrees(&choice.after, after) {
        let why = if contradicted {
            "but not alike in all parts of these runs"
        } else {
            "and neither an effect of the library nor a simple law explains it"
        };
        let sentence = format!("Model and measurement disagree, {why}: nothing can be named.");
        return outcome(Verdict::NotIdentifiable, &sentence, Some(settling(choice)));
    }
    match missed(&choice.candidates, choice.before.variance_inflation()) {
        Some(candidate) => {
            let label = candidate.applied.label();
            let sentence =
                format!("Nothing significant was found, but these runs could not have shown a plausible {label}.");
            outcome(
                Verdict::NotIdentifiable,
                &sentence,
                Some(drive(&format!("a plausible {label} would have been missed"))),
            )
        }
        None => Outcome { verdict: Verdict::NoMissingEffect, sentence: trace(&choice.after), next_experiment: None },
    }
}

/// What a model leaves beyond chance without standing out of the noise to the eye; `None` where it leaves nothing.
fn trace(after: &Fit) -> Option<String> {
    let places: Vec<&str> = unexplained::remaining(after).map(|c| JUMPS[c].place).collect();
    (!places.is_empty()).then(|| {
        format!(
            "No effect is missing that can be named: the model explains these runs but for a trace at the {}, more than \
             chance and less than their noise.",
            listed(places.iter().map(ToString::to_string))
        )
    })
}

/// Effects of the model file that the runs ask for with other values.
pub(crate) fn restated(choice: &Selected) -> Vec<String> {
    let values = |a: &Applied| {
        let each = a.effect.parameters.keys().zip(&a.values);
        listed(each.map(|(name, v)| format!("{name} = {}", significant(*v, 3))))
    };
    let told = |new: &Applied| {
        let old = find(&choice.before.model, new)?;
        let (label, old, new) = (new.label(), values(&old), values(new));
        Some(format!("the model has {label} with {old}; these runs ask for {new} in its place"))
    };
    choice.chosen.iter().filter_map(|c| told(&c.applied)).collect()
}

/// Whether what a fit leaves of a constraint is more than chance, and stands out of the noise to the eye.
fn disagrees(fit: &Fit, after: &[ConstraintResiduals]) -> bool {
    let visible = |c: usize| ConstraintResiduals::rms(after, c).is_some_and(|(rms, noise)| rms > VISIBLE * noise);
    unexplained::remaining(fit).any(visible)
}

/// A model that misses most of the motion or of the turning, whatever is added to it.
fn hopeless(after: &[ConstraintResiduals]) -> Option<String> {
    let squares = after.iter().map(ConstraintResiduals::against_motion);
    let sums = squares.fold([[0.0; 3]; 2], |sum, of| [0, 1].map(|k| [0, 1, 2].map(|i| sum[k][i] + of[k][i])));
    // What turns on the spot goes no way of which a share could be missed.
    let moves = sums[0][1] > OUT_OF_NOISE.powi(2) * sums[0][2];
    let turns = sums[1][1] > TURNING.powi(2) * after.iter().map(ConstraintResiduals::count).sum::<usize>() as f64;
    let share = |[miss, motion, _]: [f64; 3]| (miss / motion.max(f64::MIN_POSITIVE)).sqrt();
    let asked = [("motion", moves, share(sums[0])), ("turning", turns, share(sums[1]))];
    let (what, _, share) = asked.into_iter().find(|(_, asked, share)| *asked && *share > HOPELESS)?;
    Some(format!("The model misses {:.0} % of the {what} over one second, whatever is added", 100.0 * share.min(1.0)))
}

/// A vehicle that slides: no coefficient of creep describes slip angles of tens of degrees.
fn sliding(after: &[ConstraintResiduals]) -> Option<String> {
    let slides = after.iter().filter_map(|v| v.slide(SLIP_ANGLE.tan()));
    let (run, [from, to]) = slides.max_by(|(_, a), (_, b)| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
    (to - from >= LONG_SLIDE).then(|| {
        format!(
            "The vehicle slides: in {run} from {from:.1} to {to:.1} s it moves more than {:.0}° beside where its model \
             points, and creep does not describe that; leave this stretch out.",
            SLIP_ANGLE.to_degrees()
        )
    })
}

/// Clocks that do not match.
fn mismatched(clocks: &[Drift]) -> Option<String> {
    let worst = clocks.iter().filter(|d| d.is_mismatch()).max_by(|a, b| a.total.abs().total_cmp(&b.total.abs()))?;
    Some(format!(
        "The clocks do not match: in {} the delay between inputs and measured pose drifts by {:.0} ms, so neither \
         constraints nor effects can be judged; give the log to --truth as well, and its clocks are aligned.",
        worst.run,
        1000.0 * worst.total.abs()
    ))
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
    use crate::effects;

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
        let told = sliding(&[second.clone(), first.clone(), third.clone()]).unwrap();
        assert!(told.contains("in first from 4.0 to 7.0 s"), "{told}");
        let told = sliding(&[second, third]).unwrap();
        assert!(told.contains("from 0.0 to 2.0 s") || told.contains("from 3.0 to 5.0 s"), "{told}");
        // A single second is a bump, and what stays below the angle is creep.
        assert!(sliding(&[ConstraintResiduals::across("bump", &[0.0, 0.5, 0.0, 0.5, 0.0])]).is_none());
        assert!(sliding(&[ConstraintResiduals::across("creeping", &[0.3; 8])]).is_none());
    }
}
