//! The main job in one line: runs → choice → gap → report.

use super::diagnosis::before_after::ModelComparison;
use super::diagnosis::equivalents;
use super::diagnosis::equivalents::relatives;
use super::diagnosis::findings::{named, without_name};
use super::diagnosis::{contradictions, plausibility, verdict};
use super::estimation::problem::Problem;
use super::experiment::design;
use super::localisation::driving_regimes;
use super::localisation::unexplained_motion::remaining;
use super::preprocessing::dataset::Data;
use super::preprocessing::quantisation;
use super::preprocessing::unit_errors;
use super::rendering::{figure_data, summary};
use super::report::*;
use super::selection::select::choose;
use crate::discrepancy::discovery::{
    Discovery, cut_short, empty_report, nothing_to_fit, told_of_steps, too_long, worse,
};
use crate::discrepancy::estimation::unexplained;
use crate::discrepancy::request::{Request, common_roles, horizons};
use crate::discrepancy::selection::choice::SelectedEffect;
use crate::error::Result;
use crate::model::Model;
use crate::model::effect_equation;
use crate::progress::{OnProgress, Stage, begin};

/// Finds where a model and measured runs disagree, names the missing effect and shows the gap shrink.
///
/// The held-out data are opened after the last choice is made.
///
/// # Errors
/// When runs log different inputs, or the model file's effects do not apply to its vehicle.
pub fn discover(request: &Request, progress: &OnProgress) -> Result<Discovery> {
    let roles = common_roles(request.runs, request.held_out)?;
    let model = Model::from_file(request.file, request.library, &roles)?;
    if let Some(why) = unit_errors::too_sparse(&model, request.runs.iter().chain(request.held_out))? {
        return cut_short(request, verdict::unusable(why));
    }
    let data = Data::of(request, &model)?;
    let known = request.file.noise;
    let problem = Problem::new(data.fitted.clone(), known.position, known.heading);
    if let Some(verdict) = verdict::before_fitting(&problem, &model)? {
        let given = |r| figure_data::path_as_given(r, &model);
        let paths = data.fitted.iter().map(given).collect::<Result<_>>()?;
        return Ok(nothing_to_fit(request, &data, paths, verdict));
    }
    let Some(choice) = choose(&problem, &model, request.library, progress)? else {
        let paths = data.fitted.iter().map(|r| figure_data::measured_path(r, false)).collect();
        return Ok(nothing_to_fit(request, &data, paths, verdict::undefined_motion()));
    };
    begin(progress, Stage::HeldOut)?;
    let noise = choice.after.noise();
    let before = problem.violations(&model, &noise)?;
    let after = problem.violations(&choice.after.model, &noise)?;
    // What is explained to its noise needs no other clock.
    let clocks = if unexplained::remains(&choice.after) { problem.drifts(&choice.after)? } else { vec![] };
    let found = verdict::after_fitting(&problem, &choice, &after, &clocks)?;
    let mut report = empty_report(request, &data);
    report.verdict = found.verdict;
    let relatives = relatives(&choice, request.library, equivalents::measured(&data.fitted[0]));
    begin(progress, Stage::Experiment)?;
    report.next_experiment = design::next(&problem, &choice, &relatives, &found)?;
    if report.verdict != Verdict::UnusableData {
        let each = choice.chosen.iter().zip(&relatives);
        let (terms, effects): (Vec<_>, Vec<_>) = each.partition(|(c, _)| effect_equation::is_term(&c.applied));
        report.effects = effects.into_iter().map(|(c, relatives)| named(c, relatives, &model)).collect();
        let terms: Vec<&SelectedEffect> = terms.into_iter().map(|(c, _)| c).collect();
        report.unnamed = without_name(&terms, &data, &choice.after, &model)?;
    }
    report.disagreement = driving_regimes::disagreements(&before);
    report.remaining = Some(remaining(&choice.after, data.fitted[0].has_heading, &after));
    let judged = ModelComparison::of(&data, &model, &choice, request.seed)?;
    report.gap = judged.gaps(&horizons(request));
    report.data.warnings.extend(too_long(request, &report));
    if report.verdict != Verdict::UnusableData {
        report.data.warnings.extend(contradictions::warnings(&choice));
        report.data.warnings.extend(verdict::restated(&choice));
        report.data.warnings.extend(plausibility::warnings(&choice, &problem.records)?);
        report.data.warnings.extend(worse(&report.gap));
    }
    if unexplained::remains(&choice.after) {
        let steps = request.runs.iter().flat_map(|run| quantisation::says(&model, run)).collect();
        told_of_steps(&mut report, steps, contradictions::is_contested(&choice));
    }
    report.steps = judged.steps(&choice, &report.gap)?;
    report.summary = found.sentence.unwrap_or_else(|| summary::verdict_sentence(&report));
    let added = match report.verdict {
        Verdict::UnusableData => vec![],
        _ => choice.chosen.iter().map(|c| c.applied.entry()).collect(),
    };
    let mut pictures = figure_data::pictures(&data, &choice, &report, &judged);
    for (b, a) in before.iter().zip(&after) {
        pictures.residuals.extend(b.pictures(a));
    }
    Ok(Discovery { report, pictures, added })
}
