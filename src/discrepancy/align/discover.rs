//! `discover` for runs whose inputs and poses were logged apart.

use super::coarse::{Found, SHORTEST, search};
use super::fine::{Fitted, refined};
use super::motion::{Driven, Measured};
use crate::discrepancy::choose::choose;
use crate::discrepancy::clock::DELAY;
use crate::discrepancy::data::{Data, FITTED_SHARE};
use crate::discrepancy::discover::{Discovery, Request, common_roles, cut_short, discover};
use crate::discrepancy::identifiable::{Check, Checked, Finding, check};
use crate::discrepancy::problem::Problem;
use crate::discrepancy::report::{Estimate, RunClock, Verdict};
use crate::discrepancy::slips::too_sparse;
use crate::discrepancy::verdict::Outcome;
use crate::effects::Effect;
use crate::error::{Error, Result};
use crate::files::{Clock, ModelFile, Run};
use crate::model::Model;
use crate::picture::number::significant;
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
    until: f64,
}

/// Whether inputs and poses have one clock.
fn is_aligned(run: &Run) -> bool {
    run.apart.as_ref().is_none_or(|a| a.one_clock)
}

/// Why a run cannot be aligned, for a person.
struct Obstacle {
    verdict: Verdict,
    why: String,
}

impl Obstacle {
    fn unusable(why: String) -> Self {
        Self { verdict: Verdict::UnusableData, why }
    }

    fn outcome(self) -> Outcome {
        Outcome { verdict: self.verdict, sentence: Some(self.why), next_experiment: None }
    }
}

/// A model file without a delay of its inputs, which is one with the offset of the clocks; and a word where it has one.
fn without_delay(file: &ModelFile) -> (ModelFile, Option<String>) {
    let has_one = file.effects.iter().any(|e| e.id == DELAY);
    let effects = file.effects.iter().filter(|e| e.id != DELAY).cloned().collect();
    let says = "the model's input-delay is left out: it is one with the offset of the clocks, which has it";
    (ModelFile { effects, ..file.clone() }, has_one.then(|| says.into()))
}

/// As [`discover`], the clocks of inputs and poses estimated first where they stand in files of their own.
///
/// The clocks of the fitted runs come from the rows that are fitted, those of held-out runs from the model as it was
/// chosen without them.
///
/// # Errors
/// As [`discover`]; when some runs are in one file and others in two.
pub fn discover_aligned(request: &Request, near: Option<f64>, progress: &dyn Fn(&str)) -> Result<Discovery> {
    let all = || request.runs.iter().chain(request.held_out);
    if all().all(is_aligned) {
        return discover(request, progress);
    }
    if let Some(run) = all().find(|r| is_aligned(r)) {
        return Err(Error::input("has its poses in itself, where others have them in a file of their own")
            .at_file(&run.path)
            .help("name it under --truth as well"));
    }
    let (file, delay) = without_delay(request.file);
    let request = &Request { file: &file, ..*request };
    let roles = common_roles(request.runs, request.held_out)?;
    let model = Model::from_file(request.file, request.library, &roles)?;
    progress("aligning the clocks");
    let share = if request.held_out.is_empty() { FITTED_SHARE } else { 1.0 };
    let first = match aligned(request.runs, share, request, &model, near)? {
        Ok(first) => first,
        Err(obstacle) => return cut_short(request, obstacle.outcome()),
    };
    let chosen = with_effects(request, &model, &first, progress)?;
    let again = |a: &Aligned| beside(a, request, &chosen, progress);
    let fitted: Vec<Aligned> = match chosen.effects.len() == model.effects.len() {
        true => first,
        false => first.iter().map(again).collect::<Result<_>>()?,
    };
    // The held-out runs are looked at with the effects as they are: nothing but their clocks is fitted.
    let held_out = match aligned(request.held_out, 1.0, request, &chosen.fixed(), near)? {
        Ok(held_out) => held_out,
        Err(obstacle) => return cut_short(request, obstacle.outcome()),
    };
    let library: Vec<Effect> = request.library.iter().filter(|e| e.id != DELAY).cloned().collect();
    let runs = |all: &[Aligned]| all.iter().map(|a| a.run.clone()).collect::<Vec<Run>>();
    let (by_one, judged) = (runs(&fitted), runs(&held_out));
    let request = Request { runs: &by_one, held_out: &judged, library: &library, ..*request };
    let mut found = discover(&request, progress)?;
    let data = &mut found.report.data;
    data.clocks = fitted.iter().map(|a| a.clock(false)).chain(held_out.iter().map(|a| a.clock(true))).collect();
    data.warnings.extend(fitted.iter().chain(&held_out).filter_map(Aligned::doubt).chain(delay));
    Ok(found)
}

/// As [`check`](crate::discrepancy::identifiable::check), the clocks of inputs and poses estimated first where they
/// stand in files of their own.
///
/// # Errors
/// As [`discover_aligned`].
pub fn check_aligned(of: &Checked, near: Option<f64>, progress: &dyn Fn(&str)) -> Result<Check> {
    if of.runs.iter().all(is_aligned) {
        return check(of, progress);
    }
    let Checked { file, runs, library } = *of;
    let (file, delay) = without_delay(file);
    let file = &file;
    let roles = common_roles(runs, &[])?;
    let model = Model::from_file(file, library, &roles)?;
    progress("aligning the clocks");
    let request = Request { file, runs, held_out: &[], library, horizons: &[], seed: 0 };
    let by_one = match aligned(runs, 1.0, &request, &model, near)? {
        Ok(by_one) => by_one,
        Err(obstacle) => return Ok(Check::cut_short(obstacle.outcome())),
    };
    let library: Vec<Effect> = library.iter().filter(|e| e.id != DELAY).cloned().collect();
    let runs: Vec<Run> = by_one.iter().map(|a| a.run.clone()).collect();
    let mut found = check(&Checked { file, runs: &runs, library: &library }, progress)?;
    found.data.clocks = by_one.iter().map(|a| a.clock(false)).collect();
    let doubts = by_one.iter().filter_map(Aligned::doubt).chain(delay);
    found.data.findings.extend(doubts.map(|says| Finding { id: "clock-offset".into(), says }));
    Ok(found)
}

/// Runs by one clock each; the first obstacle where that is not to be had.
///
/// # Errors
/// When the model's formulas are malformed.
fn aligned(
    runs: &[Run],
    share: f64,
    request: &Request,
    model: &Model,
    near: Option<f64>,
) -> Result<std::result::Result<Vec<Aligned>, Obstacle>> {
    runs.par_iter().map(|run| aligned_one(run, share, request, model, near)).collect()
}

fn aligned_one(
    run: &Run,
    share: f64,
    request: &Request,
    model: &Model,
    near: Option<f64>,
) -> Result<std::result::Result<Aligned, Obstacle>> {
    if let Some(obstacle) = endless(run) {
        return Ok(Err(Obstacle::unusable(obstacle)));
    }
    if let Some(obstacle) = too_sparse(model, [run])? {
        return Ok(Err(Obstacle::unusable(obstacle)));
    }
    let driven = Driven::of(model, run, request.file.input_timing.into())?;
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
    let apart = (bad.misfit - good.misfit) * good.rows / good.dependence;
    // Rows that only one of both has differ by chance, too: a value's deviance has a variance of two.
    let chance = (2.0 * (good.alone(&bad) + bad.alone(&good)) / good.dependence).sqrt();
    let told = apart > SURE + CHANCE * chance;
    (good, (!told).then_some(bad.clock.offset))
}

/// Files too long to lay upon each other, or to be in seconds.
fn endless(run: &Run) -> Option<String> {
    let longest = span(inputs_of(run)).max(span(&run.time));
    (longest.is_nan() || longest > LONGEST).then(|| {
        format!(
            "The clocks of {} cannot be aligned: it lasts {} s, and at most {} s can be; is its time in seconds?",
            run.name,
            significant(longest, 3),
            significant(LONGEST, 2)
        )
    })
}

/// Why no clock makes both files one drive.
fn unlike(run: &Run) -> Obstacle {
    let truth = run.apart.as_ref().map(|a| file_name(&a.truth)).unwrap_or_default();
    let shortest = span(inputs_of(run)).min(span(&run.time));
    if shortest < SHORTEST {
        let why = format!(
            "{} and {truth} are too short to find how their clocks belong together: {} s, and at least {} s are needed.",
            run.name,
            significant(shortest, 2),
            significant(SHORTEST, 2)
        );
        return Obstacle { verdict: Verdict::NotIdentifiable, why };
    }
    Obstacle::unusable(format!(
        "No offset of their clocks makes the inputs of {} move as the poses of {truth} do: check that both are of one \
         drive, the columns and the units.",
        run.name
    ))
}

/// The times of a run's inputs.
fn inputs_of(run: &Run) -> &[f64] {
    run.apart.as_ref().map_or(&run.time, |a| &a.time)
}

fn span(time: &[f64]) -> f64 {
    time.last().zip(time.first()).map_or(0.0, |(last, first)| last - first)
}

/// The model with the effects that the aligned runs ask for, free; the delay they ask for goes into the clocks.
fn with_effects(request: &Request, model: &Model, first: &[Aligned], progress: &dyn Fn(&str)) -> Result<Model> {
    let runs: Vec<Run> = first.iter().map(|a| a.run.clone()).collect();
    let request = Request { runs: &runs, held_out: &[], ..*request };
    // Three quarters of the rows are enough to choose by.
    let data = Data::of(&request, model)?;
    let problem = Problem::new(data.fitted, request.file.noise.position, request.file.noise.heading);
    if crate::discrepancy::verdict::before_fitting(&problem, model)?.is_some() {
        return Ok(model.clone());
    }
    let Some(choice) = choose(&problem, model, request.library, progress)? else { return Ok(model.clone()) };
    let mut chosen = choice.after.model;
    chosen.effects.retain(|e| e.effect.id != DELAY || !e.free);
    Ok(chosen)
}

/// A run aligned again, beside effects.
fn beside(a: &Aligned, request: &Request, model: &Model, progress: &dyn Fn(&str)) -> Result<Aligned> {
    progress("aligning the clocks beside what was chosen");
    let original = request.runs.iter().find(|r| r.path == a.run.path).unwrap_or(&a.run);
    let fitted = refined(&original.until(a.until), model, request.file, a.fitted.clock)?;
    let Some(fitted) = fitted else { return Ok(a.clone()) };
    Ok(Aligned { run: original.aligned(&fitted.clock), fitted, ..a.clone() })
}

impl Aligned {
    /// As the report lists it.
    pub fn clock(&self, held_out: bool) -> RunClock {
        let Fitted { clock, offset_std, drift_std, .. } = self.fitted;
        RunClock {
            run: self.run.name.clone(),
            truth: self.run.apart.as_ref().map(|a| file_name(&a.truth)).unwrap_or_default(),
            held_out,
            offset_s: Estimate { value: clock.offset, std: offset_std, unit: "s".into() },
            drift: Estimate { value: clock.drift, std: drift_std, unit: "1".into() },
            at_s: clock.at,
            correlation: self.correlation,
            other_offset_s: self.other,
        }
    }

    /// A warning where another offset would do nearly as well.
    fn doubt(&self) -> Option<String> {
        let other = significant(self.other?, 4);
        let own = significant(self.fitted.clock.offset, 4);
        Some(format!(
            "{}: a clock offset of {other} s fits nearly as well as {own} s; give --clock-offset if you know it",
            self.run.name
        ))
    }
}

fn file_name(path: &std::path::Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
