//! `discover` for runs whose inputs and poses were logged apart.

use super::clock_alignment::aligned_run::{Aligned, aligned};
use super::clock_alignment::refinement::refined;
use super::estimation::problem::Problem;
use super::kinematic_comparison::kinematic;
use super::pipeline::unfitted;
use super::pose_filter::discover_before_filter;
use super::preprocessing::dataset::{Data, FITTED_SHARE};
use super::preprocessing::slips;
use super::rendering::changes::changes;
use super::selection::select::choose;
use crate::discrepancy::clock_alignment::aligned_run::{is_aligned, without_delay};
use crate::discrepancy::diagnosis::verdict;
use crate::discrepancy::discovery::{Clocks, Discovery};
use crate::discrepancy::request::{Request, common_roles};
use crate::effects::Effect;
use crate::error::{Error, Result};
use crate::files::Run;
use crate::model::Model;
use crate::progress::{OnProgress, Stage, tell};

/// Finds where a model and measured runs disagree, names the missing effect and shows the gap shrink.
///
/// The held-out data are opened after the last choice is made.
///
/// # Errors
/// When runs log different inputs, or the model file's effects do not apply to its vehicle.
pub fn discover(request: &Request, progress: &OnProgress) -> Result<Discovery> {
    let found = discover_before_filter(request, Clocks::default(), progress)?;
    finished(found, request, progress)
}

/// A discovery with the kinematic model beside it, and with what it asks to be changed.
fn finished(mut found: Discovery, request: &Request, progress: &OnProgress) -> Result<Discovery> {
    found.report.kinematic = kinematic(request, &found, progress)?;
    found.pictures.vehicle = request.file.title();
    found.pictures.changes = changes(&found.report, request.file, &found.added);
    Ok(found)
}

/// As [`discover`], the clocks of inputs and poses estimated first where they stand in files of their own.
///
/// The clocks of the fitted runs come from the rows that are fitted, those of held-out runs from the model as it was
/// chosen without them.
///
/// # Errors
/// As [`discover`]; when some runs are in one file and others in two.
pub fn discover_aligned(request: &Request, near: Option<f64>, progress: &OnProgress) -> Result<Discovery> {
    finished(by_aligned_clocks(request, near, progress)?, request, progress)
}

fn by_aligned_clocks(request: &Request, near: Option<f64>, progress: &OnProgress) -> Result<Discovery> {
    let all = || request.runs.iter().chain(request.held_out);
    if all().all(is_aligned) {
        return discover_before_filter(request, Clocks::default(), progress);
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
    let share = if request.held_out.is_empty() { FITTED_SHARE } else { 1.0 };
    let first = match aligned(request.runs, share, request, &model, near, progress)? {
        Ok(first) => first,
        Err(outcome) => return Ok(unfitted(request, Clocks::default(), outcome)),
    };
    let chosen = with_effects(request, &model, &first, progress)?;
    let all = first.len();
    let again = |(i, a): (usize, &Aligned)| {
        tell(progress, Stage::ClockRefinement, i, all)?;
        beside(a, request, &chosen)
    };
    let fitted: Vec<Aligned> = match chosen.effects.len() == model.effects.len() {
        true => first,
        false => first.iter().enumerate().map(again).collect::<Result<_>>()?,
    };
    // The held-out runs are looked at with the effects as they are: nothing but their clocks is fitted.
    let held_out = match aligned(request.held_out, 1.0, request, &chosen.fixed(), near, progress)? {
        Ok(held_out) => held_out,
        Err(outcome) => return Ok(unfitted(request, Clocks::default(), outcome)),
    };
    let library: Vec<Effect> = request.library.iter().filter(|e| !e.is_of_clock()).cloned().collect();
    let runs = |all: &[Aligned]| all.iter().map(|a| a.run.clone()).collect::<Vec<Run>>();
    let (by_one, judged) = (runs(&fitted), runs(&held_out));
    let request = Request { runs: &by_one, held_out: &judged, library: &library, ..*request };
    let clocks = Clocks {
        clocks: fitted.iter().map(|a| a.clock(false)).chain(held_out.iter().map(|a| a.clock(true))).collect(),
        warnings: fitted.iter().chain(&held_out).filter_map(Aligned::doubt).chain(delay).collect(),
    };
    discover_before_filter(&request, clocks, progress)
}

/// The model with the effects that the aligned runs ask for, free; the delay they ask for goes into the clocks.
fn with_effects(request: &Request, model: &Model, first: &[Aligned], progress: &OnProgress) -> Result<Model> {
    let runs: Vec<Run> = first.iter().map(|a| a.run.clone()).collect();
    let request = Request { runs: &runs, held_out: &[], ..*request };
    if slips::any(request.file, model, request.runs)?.is_some() {
        return Ok(model.clone());
    }
    // Three quarters of the rows are enough to choose by.
    let data = Data::of(&request, model)?;
    let problem = Problem::new(data.fitted, request.file.noise.position, request.file.noise.heading);
    if verdict::before_fitting(&problem, model)?.is_some() {
        return Ok(model.clone());
    }
    let Some(choice) = choose(&problem, model, request.library, progress)? else { return Ok(model.clone()) };
    let mut chosen = choice.after.model;
    chosen.effects.retain(|e| !e.effect.is_of_clock() || !e.free);
    Ok(chosen)
}

/// A run aligned again, beside effects.
fn beside(a: &Aligned, request: &Request, model: &Model) -> Result<Aligned> {
    let original = request.runs.iter().find(|r| r.path == a.run.path).unwrap_or(&a.run);
    let fitted = refined(&original.until(a.until), model, request.file, a.fitted.clock)?;
    let Some(fitted) = fitted else { return Ok(a.clone()) };
    Ok(Aligned { run: original.aligned(&fitted.clock), fitted, ..a.clone() })
}
