//! What to drive next: the manoeuvre that is expected to tell most.
//!
//! A manoeuvre is driven by the model as fitted, without noise, and the other model is fitted to that *and* to what
//! the runs at hand say of it; what is left of the misfit is the deviance to expect.

use super::envelope::Envelope;
use super::manoeuvre::{LENGTH, Manoeuvre, library};
use super::next_step::{NextStep, PlannedManoeuvre};
use super::predicted_fit::{PredictedFit, PriorInformation};
use crate::discrepancy::diagnosis::equivalents::EquivalentEffect;
use crate::discrepancy::diagnosis::verdict::{Outcome, missed};
use crate::discrepancy::estimation::descent::Windows;
use crate::discrepancy::estimation::fit::Effort;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::estimation::priors::Priors;
use crate::discrepancy::estimation::problem::{Problem, starts};
use crate::discrepancy::initial_state::hidden_states;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::report::Verdict;
use crate::discrepancy::selection::choice::Selected;
use crate::discrepancy::selection::search::without_effect;
use crate::discrepancy::selection::select::Candidate;
use crate::discrepancy::shooting::windows::plan;
use crate::effects::Applied;
use crate::error::Result;
use crate::model::Model;
use crate::motion::{StateSensitivity, Stepper, Timing};
use rayon::prelude::*;

/// Rows a second of a manoeuvre that is thought through; more rows are less noise.
const RATE: f64 = 10.0;
/// Evidence that separates two effects beyond doubt.
const ENOUGH: f64 = 25.0;
/// A manoeuvre within this share of the best one is as good.
pub(crate) const ALIKE: f64 = 0.9;
/// A manoeuvre of a minute is repeated so often at most.
const MOST_REPETITIONS: f64 = 30.0;
/// More rivals than these are not thought of at once.
const MOST_RIVALS: usize = 4;

/// What is needed to think a manoeuvre through.
pub(crate) struct PredictedExperiment<'a> {
    pub(crate) envelope: Envelope,
    like: &'a Record,
    variances: NoiseModel,
    sample_size: f64,
}

/// What to drive next, after a verdict: for relatives that some run could tell apart, or for an effect that would have
/// been missed; else what the verdict itself advises.
///
/// # Errors
/// When a model's formulas are malformed.
pub fn next(
    problem: &Problem,
    choice: &Selected,
    relatives: &[Vec<EquivalentEffect>],
    outcome: &Outcome,
) -> Result<Option<NextStep>> {
    let own = match outcome.verdict {
        Verdict::MissingEffect | Verdict::UnnamedEffect => between(problem, choice, relatives)?,
        Verdict::NotIdentifiable | Verdict::Unexplained => {
            missed(&choice.candidates, choice.before.variance_inflation()).and_then(|c| revealing(problem, choice, c))
        }
        _ => None,
    };
    Ok(own.or_else(|| outcome.next.clone().map(NextStep::Advice)))
}

/// Manoeuvres for what the runs at hand leave open: the first chosen effect with relatives that differ from it.
///
/// # Errors
/// When a model's formulas are malformed.
fn between(problem: &Problem, choice: &Selected, relatives: &[Vec<EquivalentEffect>]) -> Result<Option<NextStep>> {
    let open = choice.chosen.iter().zip(relatives);
    let open = open.map(|(c, r)| (c, most_different(r)));
    let Some((chosen, rivals)) = open.into_iter().find(|(_, r)| !r.is_empty()) else { return Ok(None) };
    let after = &choice.after;
    let fitted = |r: &&EquivalentEffect| -> Result<Option<(Applied, Fit)>> {
        let model =
            without_effect(&after.model, &chosen.applied, &choice.before.model).with_effect(r.applied.clone().freed());
        let fit = problem.fit(&model, &after.window_states, &after.variances, Effort::SCREENING)?;
        Ok(fit.map(|fit| (r.applied.clone(), fit)))
    };
    let fits: Vec<Option<(Applied, Fit)>> = rivals.iter().take(MOST_RIVALS).map(fitted).collect::<Result<_>>()?;
    let fits: Vec<(Applied, Fit)> = fits.into_iter().flatten().collect();
    let Some(thought) = PredictedExperiment::of(problem, after) else { return Ok(None) };
    let truth = PriorInformation::of(after);
    let others: Vec<PriorInformation> = fits.iter().map(|(_, fit)| PriorInformation::of(fit)).collect();
    if others.is_empty() {
        return Ok(None);
    }
    // Whichever is true, the other must fall short.
    let apart = |m: &Manoeuvre, a: &PriorInformation, b: &PriorInformation| {
        Some(thought.expected_delta_bic(m, a, b)?.min(thought.expected_delta_bic(m, b, a)?))
    };
    let all: Vec<&'static Manoeuvre> = library(&thought.envelope).collect();
    let each: Vec<Vec<Option<f64>>> =
        all.par_iter().map(|m| others.iter().map(|o| apart(m, &truth, o)).collect()).collect();
    let (within, beyond) = within_reach(&each, others.len());
    let least = |of: &Vec<Option<f64>>| {
        let all = within.iter().map(|i| of[*i]).collect::<Option<Vec<f64>>>();
        all.map(|all| all.into_iter().fold(f64::INFINITY, f64::min))
    };
    let worths: Vec<Option<f64>> = each.iter().map(least).collect();
    // One of the rivals may be the true one, and the others are then its rivals.
    let among = |m: &Manoeuvre| {
        let pairs = others.iter().enumerate().flat_map(|(i, a)| others[..i].iter().map(move |b| (a, b)));
        pairs.filter(|(a, b)| apart(m, a, b).is_some_and(|worth| worth > ENOUGH)).count()
    };
    let named = |of: &[usize]| of.iter().map(|i| fits[*i].0.clone()).collect::<Vec<Applied>>();
    let step = |(m, worth)| NextStep::Separate {
        chosen: chosen.applied.clone(),
        rivals: named(&within),
        beyond: named(&beyond),
        manoeuvre: thought.planned(m),
        expected_delta_bic: worth,
        times: repetitions(worth),
    };
    Ok(best(&all, &worths, among).map(step))
}

/// The rivals that some manoeuvre tells from the chosen effect in reasonable time, and those that none does, by the evidence of
/// every manoeuvre against each of so many; all of them are asked for where none is within reach.
fn within_reach(each: &[Vec<Option<f64>>], rivals: usize) -> (Vec<usize>, Vec<usize>) {
    let most = |i: usize| each.iter().filter_map(|of| of[i]).fold(f64::NEG_INFINITY, f64::max);
    let (within, beyond): (Vec<usize>, Vec<usize>) = (0..rivals).partition(|i| repetitions(most(*i)).is_some());
    if within.is_empty() { (beyond, within) } else { (within, beyond) }
}

/// The manoeuvre that would show an effect of plausible size that the runs at hand would not have shown.
///
/// # Errors
/// When a model's formulas are malformed.
fn revealing(problem: &Problem, choice: &Selected, missed: &Candidate) -> Option<NextStep> {
    let before = &choice.after;
    let thought = PredictedExperiment::of(problem, before)?;
    let of = PriorInformation::of(before);
    let effect = &missed.applied.effect;
    let sizes: Vec<f64> = effect.parameters.values().map(|p| p.size).collect();
    let applied = Applied::new(effect, missed.applied.trailer, sizes);
    let model = before.model.clone().with_effect(applied.clone().freed());
    let truth = PriorInformation { model, ..PriorInformation::of(before) };
    let all: Vec<&'static Manoeuvre> = library(&thought.envelope).collect();
    let worths: Vec<Option<f64>> = all.par_iter().map(|m| thought.expected_delta_bic(m, &truth, &of)).collect();
    let (m, worth) = best(&all, &worths, |_| 0)?;
    (worth > ENOUGH).then(|| NextStep::Reveal {
        effect: applied,
        manoeuvre: thought.planned(m),
        expected_delta_bic: worth,
    })
}

/// How often a manoeuvre of such a worth has to be driven to separate two effects beyond doubt; `None` where that is
/// beyond reason.
fn repetitions(worth: f64) -> Option<f64> {
    Some((ENOUGH / worth.max(1e-9)).ceil().max(1.0)).filter(|times| *times <= MOST_REPETITIONS)
}

/// The relatives that a run is to tell apart: those that agree to first order only where there are no others, for they
/// would have a say in every choice and are told apart by precision more than by a manoeuvre.
fn most_different(relatives: &[EquivalentEffect]) -> Vec<&EquivalentEffect> {
    let by_data: Vec<&EquivalentEffect> = relatives.iter().filter(|r| r.why == "data").collect();
    if by_data.is_empty() { relatives.iter().filter(|r| r.differs()).collect() } else { by_data }
}

/// The manoeuvre of the most worth, or the simplest of those that are nearly as good; of those that separate beyond doubt the ones
/// that settle most of the other questions.
fn best(
    all: &[&'static Manoeuvre],
    worths: &[Option<f64>],
    settled: impl Fn(&Manoeuvre) -> usize + Sync,
) -> Option<(&'static Manoeuvre, f64)> {
    let enough = |w: &Option<f64>| w.is_some_and(|w| w > ENOUGH);
    let each = all.par_iter().zip(worths).map(|(m, w)| if enough(w) { settled(m) } else { 0 });
    let each: Vec<usize> = each.collect();
    let most_settled = each.iter().copied().max().unwrap_or(0);
    let eligible = |i: usize| worths[i].filter(|_| each[i] == most_settled);
    let most = (0..all.len()).filter_map(eligible).fold(f64::NEG_INFINITY, f64::max);
    let first = (0..all.len()).find_map(|i| eligible(i).filter(|w| nearly(*w, most)).map(|w| (i, w)));
    first.map(|(i, w)| (all[i], w))
}

/// Whether a worth, which may be negative, is nearly as much as the most.
fn nearly(worth: f64, most: f64) -> bool {
    worth >= most - (1.0 - ALIKE) * most.abs()
}

impl<'a> PredictedExperiment<'a> {
    pub(crate) fn of(problem: &'a Problem, fit: &Fit) -> Option<Self> {
        let like = problem.records.first()?;
        let envelope = Envelope::of(&fit.model, &problem.records)?;
        let of = Self { envelope, like, variances: fit.variances.clone(), sample_size: fit.sample_size };
        Some(Self { variances: of.scaled(fit.variances.clone()), ..of })
    }

    /// Variances at the rows of a manoeuvre that says as much as one with the rows of the runs.
    pub(crate) fn scaled(&self, mut v: NoiseModel) -> NoiseModel {
        v.measurement_mut().iter_mut().for_each(|c| c.variance *= (self.like.step() * RATE).min(1e3));
        v
    }

    /// A manoeuvre at the speeds and turns of the runs at hand.
    pub(crate) fn planned(&self, manoeuvre: &'static Manoeuvre) -> PlannedManoeuvre {
        PlannedManoeuvre { manoeuvre, envelope: self.envelope.clone() }
    }

    /// By how much the BIC of `other` is expected to exceed that of `truth` after a manoeuvre.
    fn expected_delta_bic(&self, m: &Manoeuvre, truth: &PriorInformation, other: &PriorInformation) -> Option<f64> {
        let equations = other.model.free_equations().ok()?;
        let records = [self.driven(m, &truth.model)?];
        let plan = plan(&records);
        let (v, nothing) = (&self.variances, Priors::default());
        let windows = Windows { records: &records, plan: &plan, equations: &equations, v, priors: &nothing };
        let left = PredictedFit { windows, other }.left(starts(&other.model, &records, &plan).ok()?)?;
        Some(left + other.charge(self.sample_size) - truth.charge(self.sample_size)).filter(|w| w.is_finite())
    }

    /// What the sensors would log of a manoeuvre, without noise.
    pub(crate) fn driven(&self, m: &Manoeuvre, truth: &Model) -> Option<Record> {
        let times: Vec<f64> = (0..=(LENGTH * RATE) as usize).map(|i| i as f64 / RATE).collect();
        let inputs = m.inputs(&self.envelope, &times);
        let equations = truth.equations(&[]).ok()?;
        let mut record = Record::new(
            "manoeuvre",
            times,
            vec![vec![]; self.like.columns.len()],
            self.like.has_heading(),
            &inputs,
            Timing::Sample,
        );
        record.observation = self.like.observation.clone();
        let (signals, outputs) = (record.signals.clone(), self.like.observation.columns());
        let mut stepper = Stepper::new(&equations, &signals, &[]);
        let mut z = vec![0.0; equations.visible];
        z.extend(hidden_states::at_rest(&equations, &[], &mut stepper, record.time[0], &z).z);
        let mut arc = StateSensitivity { z, s: vec![] };
        for i in 0..record.time.len() {
            let y = stepper.outputs(&arc.z);
            for (column, output) in record.columns.iter_mut().zip(outputs) {
                column.push(y[*output]);
            }
            if i + 1 < record.time.len() {
                stepper.advance(&mut arc, record.time[i], record.time[i + 1]);
            }
        }
        record.columns.iter().flatten().all(|x| x.is_finite()).then_some(record)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{WEAVING, applied, fit_of, logged, noise_of, unicycle};
    use nalgebra::DMatrix;

    #[test]
    fn a_worth_is_near_the_most_on_either_side_of_nothing() {
        for (worth, most, is_near) in
            [(9.01, 10.0, true), (8.99, 10.0, false), (-10.99, -10.0, true), (-11.01, -10.0, false), (0.0, 0.0, true)]
        {
            assert_eq!(nearly(worth, most), is_near, "{worth} {most}");
        }
    }

    /// Of a creep that is known to be a hundredth less than it is, with an information I, and that a manoeuvre would show to be what
    /// it is with an information G, there remain G·I/(G + I) times the square of the difference.
    #[test]
    fn what_is_known_and_what_a_manoeuvre_shows_share_the_misfit() {
        let known = |e: f64, information: f64| {
            let model = unicycle(&[("traverse-creep", &[e])]);
            PriorInformation {
                information: DMatrix::from_element(1, 1, information),
                ..PriorInformation::of(&fit_of(model))
            }
        };
        let fixed = |e: f64| {
            let creep = Applied { values: vec![e], ..applied("traverse-creep") };
            PriorInformation::of(&fit_of(unicycle(&[]).with_effect(creep)))
        };
        let truth = known(-0.05, 1.0);
        let equations = truth.model.free_equations().unwrap();
        let time = (0..600).map(|i| 0.05 * f64::from(i)).collect();
        let records = [logged((&equations, &[-0.05]), time, WEAVING, &[0.0; 3], 1e-3)];
        let thought = PredictedExperiment {
            envelope: Envelope::of(&truth.model, &records).unwrap(),
            like: &records[0],
            variances: noise_of(0, [1e-6; 2], &[1e-9; 3]),
            sample_size: 1000.0,
        };
        let m = library(&thought.envelope).next().unwrap();
        let of = |other: &PriorInformation| thought.expected_delta_bic(m, &truth, other).unwrap();
        // A model without the creep as a free value is charged a parameter less.
        let whole = of(&fixed(-0.04)) + 1000.0_f64.ln();
        assert!(whole > 30.0 && (of(&fixed(-0.05)) + 1000.0_f64.ln()).abs() < 1e-3, "{whole}");
        // What has the truth for its own lacks nothing, and is charged the same.
        assert!(of(&known(-0.05, 1.0)).abs() < 1e-3);
        let g = whole / 1e-4;
        for (information, share) in [(1e-6 * g, 0.0), (g / 3.0, 0.25), (g, 0.5), (3.0 * g, 0.75), (1e6 * g, 1.0)] {
            let left = of(&known(-0.04, information)) / whole;
            assert!((left - share).abs() < 0.01, "{information}: {left}");
        }
    }

    /// What no manoeuvre tells apart leaves the others to be asked for.
    #[test]
    fn rivals_beyond_reach_are_left_out() {
        let each = [vec![Some(30.0), Some(0.1), None], vec![Some(1.0), Some(0.2), Some(2.0)]];
        assert_eq!(within_reach(&each, 3), (vec![0, 2], vec![1]));
        let hopeless = [vec![Some(0.1), None]];
        assert_eq!(within_reach(&hopeless, 2), (vec![0, 1], vec![]));
    }

    /// A manoeuvre that is worth the evidence in one minute is driven once, one that needs a few as often as that.
    #[test]
    fn a_manoeuvre_is_repeated_until_it_is_worth_enough() {
        for (worth, times) in [
            (30.0, Some(1.0)),
            (25.0, Some(1.0)),
            (24.0, Some(2.0)),
            (25.0 / 30.0, Some(30.0)),
            (0.8, None),
            (-3.0, None),
        ] {
            assert_eq!(repetitions(worth), times, "{worth}");
        }
    }
}
