//! A run whose inputs and poses have clocks of their own, by one clock.

use super::cross_correlation::{Found, SHORTEST, search};
use super::refinement::Fitted;
use super::refinement::refined;
use super::speed_profile::{Driven, Measured};
use crate::discrepancy::diagnosis::reason::Reason;
use crate::discrepancy::diagnosis::verdict::{Outcome, unusable};
use crate::discrepancy::diagnosis::warning::Warning;
use crate::discrepancy::preprocessing::unit_errors::too_sparse;
use crate::discrepancy::report::{Estimate, RunClock, Verdict};
use crate::discrepancy::request::Request;
use crate::effects::of_clock;
use crate::error::Result;
use crate::files::Clock;
use crate::files::{ModelFile, Run};
use crate::model::Model;
use crate::progress::{Counter, OnProgress, Stage};
use rayon::prelude::*;

/// Grid of the poses' motion, s.
const GRID: f64 = 0.1;
/// Deviance that tells one offset from another beyond doubt.
const SURE: f64 = 40.0;
/// Deviations of what differs by chance that are no chance.
const CHANCE: f64 = 5.0;
/// Longest file whose clock is looked for, s: what is tried grows with it.
const LONGEST: f64 = 2e5;
/// Motions that agree less are not of one drive.
const ALIKE: f64 = 0.5;

/// A run by one clock, and what was found of its clocks.
#[derive(Clone, Debug)]
pub struct Aligned {
    /// The run, its inputs by the clock of the poses.
    pub run: Run,
    /// The clock and its deviations.
    pub fitted: Fitted,
    /// Correlation of the motion in both files.
    pub correlation: f64,
    /// Another offset that agrees nearly as well, s.
    pub other: Option<f64>,
    /// The last time of the poses that the clock may come from, s: those behind it are held out.
    pub(crate) until: f64,
}

impl Aligned {
    /// As the report lists it.
    pub fn clock(&self, held_out: bool) -> RunClock {
        let Fitted { clock, offset_std, drift_std, .. } = self.fitted;
        RunClock {
            run: self.run.name.clone(),
            truth: self.run.apart.as_ref().map(|a| file_name(&a.truth)).unwrap_or_default(),
            held_out,
            offset_s: Estimate { value: clock.offset, std: offset_std, unit: "s".into(), course: None },
            drift: Estimate { value: clock.drift, std: drift_std, unit: "1".into(), course: None },
            at_s: clock.at,
            correlation: self.correlation,
            other_offset_s: self.other,
        }
    }

    /// A warning where another offset would do nearly as well.
    pub(crate) fn doubt(&self) -> Option<Warning> {
        let own = self.fitted.clock.offset;
        Some(Warning::ClockOffsetInDoubt { run: self.run.name.clone(), own, other: self.other? })
    }
}

/// Runs by one clock each; the first obstacle where that is not to be had.
///
/// # Errors
/// When the model's formulas are malformed.
pub(crate) fn aligned(
    runs: &[Run],
    share: f64,
    request: &Request,
    model: &Model,
    near: Option<f64>,
    progress: &OnProgress,
) -> Result<std::result::Result<Vec<Aligned>, Outcome>> {
    let counter = Counter::begin(progress, Stage::ClockAlignment, runs.len())?;
    let one = |run: &Run| {
        let found = aligned_one(run, share, request, model, near)?;
        counter.one()?;
        Ok(found)
    };
    let all: Vec<std::result::Result<Aligned, Outcome>> = runs.par_iter().map(one).collect::<Result<_>>()?;
    Ok(all.into_iter().collect())
}

fn aligned_one(
    run: &Run,
    share: f64,
    request: &Request,
    model: &Model,
    near: Option<f64>,
) -> Result<std::result::Result<Aligned, Outcome>> {
    if let Some(obstacle) = endless(run) {
        return Ok(Err(Outcome::new(Verdict::UnusableData, obstacle, None)));
    }
    if let Some(slip) = too_sparse(model, [run])? {
        return Ok(Err(unusable(slip)));
    }
    let timings = crate::motion::timings(&run.differences, request.file.input_timing);
    let timing = timings.first().copied().unwrap_or(request.file.input_timing.into());
    let driven = Driven::of(model, run, timing)?;
    let laid = |part: &Run| {
        let poses = [part.time[0], part.time[part.time.len() - 1]];
        search(&driven, &Measured::of(part, GRID), poses, near).filter(|f| f.correlation > ALIKE)
    };
    let mut part = run.beginning(share);
    let Some(mut found) = laid(&part) else { return Ok(Err(unlike(run))) };
    // The share is one of the time that both files have, which the clock tells. What is behind it is held out: where it
    // was looked at, the clock is looked for again without it.
    let until = if share < 1.0 { held_out_from(run, &found.clock, share) } else { f64::INFINITY };
    let seen = part.time[part.time.len() - 1];
    part = run.until(until);
    if until < seen {
        let Some(again) = laid(&part) else { return Ok(Err(unlike(run))) };
        found = again;
    }
    let Found { clock, correlation, other } = found;
    let Some(fitted) = refined(&part, model, request.file, clock)? else { return Ok(Err(unlike(run))) };
    let rival = match other {
        Some(other) => refined(&part, model, request.file, Clock { offset: other, ..clock })?,
        None => None,
    };
    let (fitted, other) = settled(fitted, rival);
    let by_one = run.aligned(&fitted.clock);
    if by_one.time.len() < 2 {
        return Ok(Err(unlike(run)));
    }
    Ok(Ok(Aligned { run: by_one, fitted, correlation, other, until }))
}

/// The time of the poses at which a share of what both files have is over.
fn held_out_from(run: &Run, clock: &Clock, share: f64) -> f64 {
    let both = run.aligned(clock).time;
    match (both.first(), both.last()) {
        (Some(first), Some(last)) => first + share * (last - first),
        _ => f64::INFINITY,
    }
}

/// The better of two clocks by their fits, and the other one's offset where these do not tell for sure.
fn settled(first: Fitted, rival: Option<Fitted>) -> (Fitted, Option<f64>) {
    let Some(rival) = rival else { return (first, None) };
    let (good, bad) = if rival.misfit < first.misfit { (rival, first) } else { (first, rival) };
    // Misfits are deviances a row; rows that are alike count once.
    let apart = (bad.misfit - good.misfit) * good.rows / good.variance_inflation;
    // Rows that only one of both has differ by chance, too: a value's deviance has a variance of two.
    let chance = (2.0 * (good.alone(&bad) + bad.alone(&good)) / good.variance_inflation).sqrt();
    let told = apart > SURE + CHANCE * chance;
    (good, (!told).then_some(bad.clock.offset))
}

/// Files too long to lay upon each other, or to be in seconds.
fn endless(run: &Run) -> Option<Reason> {
    let lasts = span(run.input_time()).max(span(&run.time));
    let reason = || Reason::ClockTooLong { run: run.name.clone(), lasts, longest: LONGEST };
    (lasts.is_nan() || lasts > LONGEST).then(reason)
}

/// Why no clock makes both files one drive.
fn unlike(run: &Run) -> Outcome {
    let truth = run.apart.as_ref().map(|a| file_name(&a.truth)).unwrap_or_default();
    let lasts = span(run.input_time()).min(span(&run.time));
    let run = run.name.clone();
    if lasts < SHORTEST {
        let reason = Reason::ClockTooShort { run, truth, lasts, needed: SHORTEST };
        return Outcome::new(Verdict::NotIdentifiable, reason, None);
    }
    Outcome::new(Verdict::UnusableData, Reason::ClocksUnlike { run, truth }, None)
}

fn span(time: &[f64]) -> f64 {
    time.last().zip(time.first()).map_or(0.0, |(last, first)| last - first)
}

fn file_name(path: &std::path::Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// Whether inputs and poses have one clock.
pub(crate) fn is_aligned(run: &Run) -> bool {
    run.apart.as_ref().is_none_or(|a| a.one_clock)
}

/// A model file without a delay of its inputs, which is one with the offset of the clocks; and a warning where it has one.
pub(crate) fn without_delay(file: &ModelFile) -> (ModelFile, Option<Warning>) {
    let is_delay = |id: &str| of_clock().is_some_and(|e| e.id == id);
    let has_one = file.effects.iter().any(|e| is_delay(&e.id));
    let effects = file.effects.iter().filter(|e| !is_delay(&e.id)).cloned().collect();
    (ModelFile { effects, ..file.clone() }, has_one.then_some(Warning::DelayLeftOut))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::unicycle_file;

    /// A clock whose fit misses so much a value, of so many values that begin at a time and last 100 s.
    fn clock(offset: f64, misfit: f64, rows: f64, from: f64, variance_inflation: f64) -> Fitted {
        let clock = Clock { offset, drift: 0.0, at: 0.0 };
        let covers = [from, from + 100.0];
        Fitted { clock, offset_std: None, drift_std: None, misfit, rows, covers, variance_inflation }
    }

    /// Beyond doubt are 40, and five deviations of what the values make that only one of both has.
    #[test]
    fn a_rival_is_told_by_its_deviance_and_what_both_have() {
        // Rows of the rival, how much later it begins, how many rows are alike; the misfits a value that do and do not tell.
        for (rows, later, variance_inflation, told, open) in [
            (1000.0, 0.0, 1.0, 0.0401, 0.0399),
            (1000.0, 0.0, 4.0, 0.1604, 0.1596),
            (1000.0, 20.0, 1.0, 0.1815, 0.1813),
            (1500.0, 20.0, 1.0, 0.1982, 0.1980),
            (1500.0, 20.0, 4.0, 0.4765, 0.4760),
        ] {
            for (more, is_told) in [(told, true), (open, false)] {
                let good = clock(1.0, 1.0, 1000.0, 0.0, variance_inflation);
                let bad = clock(7.0, 1.0 + more, rows, later, variance_inflation);
                for (first, rival) in [(good, bad), (bad, good)] {
                    let (best, other) = settled(first, Some(rival));
                    assert_eq!((best.clock.offset, other), (1.0, (!is_told).then_some(7.0)), "{rows} {later} {more}");
                }
            }
        }
        let (alone, other) = settled(clock(3.0, 9.0, 10.0, 0.0, 1.0), None);
        assert_eq!((alone.clock.offset, other), (3.0, None));
    }

    #[test]
    fn a_delay_of_the_model_is_left_out_and_told() {
        let (creep, delay) =
            ("[[effects]]\nid = \"traverse-creep\"\ne_tc = 0.1\n", "[[effects]]\nid = \"input-delay\"\ndelay = 0.1\n");
        let ids = |file: &ModelFile| file.effects.iter().map(|e| e.id.clone()).collect::<Vec<_>>();
        let (file, says) = without_delay(&unicycle_file(creep));
        assert!(ids(&file) == ["traverse-creep"] && says.is_none());
        let (file, says) = without_delay(&unicycle_file(&[creep, delay].concat()));
        assert_eq!(ids(&file), ["traverse-creep"]);
        assert!(matches!(says, Some(Warning::DelayLeftOut)));
    }
}
