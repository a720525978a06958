//! The main job in one line: runs → choice → gap → report.

use super::diagnosis::advice::Advice;
use super::diagnosis::before_after::{ModelComparison, grown, too_long};
use super::diagnosis::equivalents::{EquivalentEffect, measured, relatives};
use super::diagnosis::findings::{covariance, named, per_run, without_name};
use super::diagnosis::forecasts::forecasts;
use super::diagnosis::held_out::{Judge, refuted};
use super::diagnosis::reason::Reason;
use super::diagnosis::rest::rest;
use super::diagnosis::scope_spans::Gates;
use super::diagnosis::verdict::{self, Outcome};
use super::diagnosis::warning::Warning;
use super::diagnosis::{contradictions, plausibility};
use super::discovery::{Clocks, Discovery, Findings, report};
use super::estimation::problem::Problem;
use super::estimation::unexplained;
use super::evidence::heterogeneity::spreads;
use super::experiment::design;
use super::experiment::next_step::NextStep;
use super::localisation::constraint_residuals::ConstraintResiduals;
use super::localisation::driving_regimes;
use super::localisation::sensor_residuals::{missed, remaining_sensors};
use super::localisation::unexplained_motion::remaining;
use super::preprocessing::dataset::{Data, FITTED_SHARE};
use super::preprocessing::driving::driving;
use super::preprocessing::input_effects::on_inputs;
use super::preprocessing::prepared_run::PreparedRun;
use super::preprocessing::quantisation::{CoarseInput, coarse_inputs};
use super::preprocessing::{slips, unit_errors};
use super::record::run_record::Record;
use super::rendering::{figure_data, plain_text};
use super::report::{Named, PathPicture, Pictures, Unnamed, Verdict, middle};
use super::request::{Request, common_roles, horizons};
use super::selection::choice::{Selected, SelectedEffect};
use super::selection::odd_run::{is_sought, odd_runs};
use super::selection::other_vehicle::in_its_place;
use super::selection::refute::{Judging, refute};
use super::selection::rounded_inputs::rounded_inputs;
use super::selection::search::first_of;
use super::selection::select::choose;
use crate::effects::Applied;
use crate::error::Result;
use crate::model::Model;
use crate::model::effect_equation;
use crate::progress::{OnProgress, Stage, begin};

/// Finds where a model and measured runs disagree, names the missing effect and shows the gap shrink; of runs whose clocks
/// were aligned before, and with their pose as it was logged.
///
/// The held-out data are opened after the last choice is made.
///
/// # Errors
/// When runs log different inputs, or the model file's effects do not apply to its vehicle.
pub(crate) fn discover_by_clocks(request: &Request, clocks: Clocks, progress: &OnProgress) -> Result<Discovery> {
    let roles = common_roles(request.runs, request.held_out)?;
    let model = Model::from_file(request.file, request.library, &roles)?;
    let all = || request.runs.iter().chain(request.held_out);
    let slip = slips::any(request.file, &model, all())?;
    if let Some(sparse) = unit_errors::too_sparse(&model, all())? {
        return Ok(unfitted(request, clocks, verdict::unusable(slip.unwrap_or(sparse))));
    }
    if let Some(slip) = slip {
        let given = |r| {
            let whole = PreparedRun::as_it_is(r, &model, request.file.input_timing).record;
            let fitted = if request.held_out.is_empty() { whole.split(FITTED_SHARE).0 } else { whole };
            figure_data::path_as_given(&fitted, &model)
        };
        let paths = request.runs.iter().map(given).collect::<Result<_>>()?;
        // What follows from the slip is not told beside it.
        let data = Data::default();
        return Ok(early(request, &data, clocks, as_logged(request, &model, paths), verdict::unusable(slip)));
    }
    let library = on_inputs(request.library, &model, request.runs);
    let request = &Request { library: &library, ..*request };
    let mut data = Data::of(request, &model)?;
    let posed = |data: &Data| {
        Problem::new(data.fitted.clone(), request.file.noise.position, request.file.noise.heading)
            .knowing_its_inputs(&model)
    };
    let mut problem = posed(&data)?;
    if let Some(outcome) = verdict::before_fitting(&problem, &model)? {
        let given = |r| figure_data::path_as_given(r, &model);
        let paths = data.fitted.iter().map(given).collect::<Result<_>>()?;
        return Ok(early(request, &data, clocks, as_logged(request, &model, paths), outcome));
    }
    let mut choice = choose(&problem, &model, request.library, progress)?;
    let mut odd = vec![];
    if let Some(all) = choice.as_ref().filter(|c| is_sought(c)) {
        odd = odd_runs(&problem, &all.after.model, request.library, progress)?;
        if !odd.is_empty() {
            // What the others have is chosen without the runs that differ.
            let names: Vec<&str> = odd.iter().map(|o| o.run.as_str()).collect();
            data = data.without(&names, request.held_out.is_empty());
            problem = posed(&data)?;
            choice = choose(&problem, &model, request.library, progress)?;
        }
    }
    let rounded =
        choice.as_ref().map(|chosen| rounded_inputs(&problem, &model, chosen)).transpose()?.unwrap_or_default();
    if !rounded.is_empty() {
        data = data.with_rounded_inputs();
        problem = posed(&data)?;
        choice = choose(&problem, &model, request.library, progress)?;
    }
    let Some(selected) = choice else {
        let paths = data.fitted.iter().map(|r| figure_data::measured_path(r, false)).collect();
        return Ok(early(request, &data, clocks, as_logged(request, &model, paths), verdict::undefined_motion()));
    };
    begin(progress, Stage::HeldOut)?;
    let horizons = horizons(request);
    let held_out = if request.held_out.is_empty() { Judging::HeldOutEnds } else { Judging::HeldOutRuns };
    let judge = |records, which| Judge { records, which, horizons: &horizons, seed: request.seed };
    let [fitted, held_out] = [judge(&data.fitted, Judging::Fitted), judge(&data.held_out, held_out)];
    let selected = refute(&problem, request.library, selected, &[&fitted, &held_out], progress)?;
    let (selected, other) = in_its_place(&problem, request.library, selected, progress)?;
    let noise = selected.after.noise();
    let before = problem.violations(&model, &noise)?;
    let after = problem.violations(&selected.after.model, &noise)?;
    let remains = unexplained::remains(&selected.after);
    // What is explained to its noise needs no other clock.
    let drifts = if remains { problem.drifts(&selected.after)? } else { vec![] };
    let jumps = selected.after.variances.process();
    let unseen = ConstraintResiduals::beside_jumps(&selected.after.model, &data.held_out, &noise, jumps)?;
    let sensors = remaining_sensors(&problem, &selected.after)?;
    let outcome = match other {
        Some(other) => Outcome::new(Verdict::Unexplained, Reason::OtherVehicle(Box::new(other)), None),
        None => verdict::after_fitting(&problem, &selected, &after, &drifts)?.beside_sensors(&sensors),
    };
    let relatives = relatives(&selected, request.library, measured(&data.fitted[0]));
    let usable = outcome.verdict != Verdict::UnusableData;
    let comparison = ModelComparison::of(&data, &model, &selected, request.seed)?;
    let driving = driving(comparison.fitted[0].each());
    let motion = driving.motion;
    let told = |e: &Applied| plain_text::plain(e, motion);
    let (effects, unnamed) =
        if usable { chosen(&selected, &relatives, &data, &problem.records, &model, told)? } else { (vec![], vec![]) };
    let gap = comparison.gaps(&horizons);
    let mut warnings = vec![];
    if usable {
        warnings.extend(refuted(&selected));
        warnings.extend(grown(&gap, |h| comparison.held_out[0].windows(h)));
    }
    warnings.extend(too_long(request.horizons, &gap));
    if usable {
        warnings.extend(contradictions::warnings(&selected));
        warnings.extend(verdict::restated(&selected));
        warnings.extend(plausibility::warnings(&selected, &problem.records)?);
    }
    warnings.extend(missed(&sensors).cloned().map(Warning::SensorMissed));
    let steps = |run| if remains { coarse_inputs(&model, run) } else { vec![] };
    let coarse: Vec<CoarseInput> = request.runs.iter().flat_map(steps).collect();
    begin(progress, Stage::Experiment)?;
    let is_other = matches!(outcome.reason, Some(Reason::OtherVehicle(_)));
    let next = if is_other { None } else { next(&problem, &selected, &relatives, &outcome, coarse.first())? };
    warnings.extend(coarse.into_iter().map(Warning::CoarseInput));
    warnings.extend(rounded.into_iter().map(Warning::TakenAsRounded));
    // What is random and all that is left has been said.
    let is_noise = matches!(outcome.reason, Some(Reason::RandomRest(_)));
    let found = Findings {
        reason: outcome.reason,
        next,
        effects,
        unnamed,
        disagreement: driving_regimes::disagreements(&before),
        rest: rest(&selected.after, &after, &unseen, &gap).filter(|_| usable && !is_noise),
        covariance: covariance(&selected.after).filter(|_| usable),
        odd,
        motion,
        refused: selected.refused.iter().filter(|_| usable).cloned().collect(),
        remaining: Some(remaining(&selected.after, data.fitted[0].measures_heading(), &after, sensors)),
        steps: comparison.steps(&selected, &gap)?,
        gap,
        warnings,
    };
    let report = report(request, &data, outcome.verdict, found, clocks);
    let added = selected.chosen.iter().filter(|_| usable).map(|c| c.applied.entry()).collect();
    let gates = Gates::of(&model, selected.chosen.iter().map(|c| &c.applied))?;
    let pictures = Pictures {
        driving: Some(driving),
        forecasts: forecasts(&comparison, middle(&report.gap), &gates),
        ..figure_data::pictures(&data, &selected, &report, &comparison, [&before, &after])
    };
    Ok(Discovery { report, pictures, added, pose_filter: None })
}

/// The chosen effects and the laws without a name, as the report lists them.
fn chosen(
    selected: &Selected,
    relatives: &[Vec<EquivalentEffect>],
    data: &Data,
    records: &[Record],
    model: &Model,
    told: impl Fn(&Applied) -> String,
) -> Result<(Vec<Named>, Vec<Unnamed>)> {
    let each = selected.chosen.iter().zip(relatives);
    let (terms, effects): (Vec<_>, Vec<_>) = each.partition(|(c, _)| effect_equation::is_term(&c.applied));
    let spreads = spreads(&selected.after);
    let run_by_run = |a: &Applied| per_run(a, &spreads, first_of(&selected.after, a), records);
    let with_runs = |(c, relatives): (&SelectedEffect, &Vec<EquivalentEffect>)| Named {
        per_run: run_by_run(&c.applied),
        plain: told(&c.applied),
        ..named(c, relatives, model)
    };
    let effects = effects.into_iter().map(with_runs).collect();
    let terms: Vec<&SelectedEffect> = terms.into_iter().map(|(c, _)| c).collect();
    Ok((effects, without_name(&terms, data, &selected.after, model)?))
}

/// What to drive or log next; inputs in finer steps where these may be all that is left unexplained.
fn next(
    problem: &Problem,
    selected: &Selected,
    relatives: &[Vec<EquivalentEffect>],
    outcome: &Outcome,
    coarse: Option<&CoarseInput>,
) -> Result<Option<NextStep>> {
    let open = matches!(outcome.verdict, Verdict::NotIdentifiable | Verdict::Unexplained)
        && !contradictions::is_contested(selected);
    match coarse.filter(|_| open) {
        Some(input) => Ok(Some(NextStep::Advice(Advice::FinerInputs(input.clone())))),
        None => design::next(problem, selected, relatives, outcome),
    }
}

/// The answer for runs that are not even put to the model.
pub(crate) fn unfitted(request: &Request, clocks: Clocks, outcome: Outcome) -> Discovery {
    early(request, &Data::default(), clocks, Pictures::default(), outcome)
}

/// What runs that are not fitted show: their paths, and their columns as they were logged.
fn as_logged(request: &Request, model: &Model, paths: Vec<PathPicture>) -> Pictures {
    Pictures { paths, columns: figure_data::columns(request.runs, model), ..Pictures::default() }
}

/// The answer for runs that are not fitted.
fn early(request: &Request, data: &Data, clocks: Clocks, pictures: Pictures, outcome: Outcome) -> Discovery {
    let next = outcome.next.map(NextStep::Advice);
    let found = Findings { reason: outcome.reason, next, ..Findings::default() };
    let report = report(request, data, outcome.verdict, found, clocks);
    Discovery { report, pictures, added: vec![], pose_filter: None }
}
