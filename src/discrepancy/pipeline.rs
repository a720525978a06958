//! The main job in one line: runs → choice → gap → report.

use super::diagnosis::before_after::Judged;
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
use super::selection::select::{Chosen, choose};
use super::selection::unnamed_terms;
use crate::effects::Effect;
use crate::error::{Error, Result};
use crate::files::{EffectEntry, ModelFile, Run};
use crate::model::Model;
use crate::number_format::significant;
use std::collections::BTreeMap;

/// Why a row whose pose no smooth motion passes through is left out.
pub(crate) const GROSS: &str = "gross error of the measured pose";

/// A held-out gap that is so many times as large with what was found, and as the noise floor, has grown.
const GREW: f64 = 1.25;

/// What `discover` works on.
pub struct Request<'a> {
    /// The model as its user believes it.
    pub file: &'a ModelFile,
    /// Runs to fit.
    pub runs: &'a [Run],
    /// Runs that are only judged.
    pub held_out: &'a [Run],
    /// The effects that may be named.
    pub library: &'a [Effect],
    /// Horizons of the gap, s; the usual ones when empty.
    pub horizons: &'a [f64],
    /// Seed of the noise floor's random numbers.
    pub seed: u64,
}

/// What `discover` finds.
pub struct Discovery {
    /// The answer.
    pub report: Report,
    /// Its pictures.
    pub pictures: Pictures,
    /// The effects to add to the model file.
    pub added: Vec<EffectEntry>,
}

impl Discovery {
    /// The model file with the findings added.
    pub fn patched(&self, file: &ModelFile) -> String {
        file.patched(&self.added)
    }
}

/// Finds where a model and measured runs disagree, names the missing effect and shows the gap shrink.
///
/// The held-out data are opened after the last choice is made.
///
/// # Errors
/// When runs log different inputs, or the model file's effects do not apply to its vehicle.
pub fn discover(request: &Request, progress: &dyn Fn(&str)) -> Result<Discovery> {
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
    progress("opening the held-out data");
    let noise = choice.after.noise();
    let before = problem.violations(&model, &noise)?;
    let after = problem.violations(&choice.after.model, &noise)?;
    // What is explained to its noise needs no other clock.
    let clocks = if unnamed_terms::remains(&choice.after) { problem.drifts(&choice.after)? } else { vec![] };
    let found = verdict::after_fitting(&problem, &choice, &after, &clocks)?;
    let mut report = empty_report(request, &data);
    report.verdict = found.verdict;
    let relatives = relatives(&choice, request.library, equivalents::measured(&data.fitted[0]));
    report.next_experiment = design::next(&problem, &choice, &relatives, &found)?;
    if report.verdict != Verdict::UnusableData {
        let each = choice.chosen.iter().zip(&relatives);
        let (terms, effects): (Vec<_>, Vec<_>) = each.partition(|(c, _)| unnamed_terms::is_term(&c.applied));
        report.effects = effects.into_iter().map(|(c, relatives)| named(c, relatives, &model)).collect();
        let terms: Vec<&Chosen> = terms.into_iter().map(|(c, _)| c).collect();
        report.unnamed = without_name(&terms, &data, &choice.after, &model)?;
    }
    report.disagreement = driving_regimes::disagreements(&before);
    report.remaining = Some(remaining(&choice.after, data.fitted[0].has_heading, &after));
    let judged = Judged::of(&data, &model, &choice, request.seed)?;
    report.gap = judged.gaps(&horizons(request));
    report.data.warnings.extend(too_long(request, &report));
    if report.verdict != Verdict::UnusableData {
        report.data.warnings.extend(contradictions::warnings(&choice));
        report.data.warnings.extend(verdict::restated(&choice));
        report.data.warnings.extend(plausibility::warnings(&choice, &problem.records)?);
        report.data.warnings.extend(worse(&report.gap));
    }
    if unnamed_terms::remains(&choice.after) {
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

/// What inputs in coarse steps may have left unexplained; where nothing else has a say, finer ones are the advice.
fn told_of_steps(report: &mut Report, steps: Vec<String>, is_contested: bool) {
    if let Some(first) = steps.first().filter(|_| report.verdict == Verdict::NotIdentifiable && !is_contested) {
        report.next_experiment = Some(quantisation::finer(first));
    }
    report.data.warnings.extend(steps);
}

/// The input roles that all runs log.
pub(crate) fn common_roles(runs: &[Run], held_out: &[Run]) -> Result<Vec<String>> {
    let mut all = runs.iter().chain(held_out);
    let first = all.next().ok_or_else(|| Error::input("no run was given").help("name at least one CSV file"))?;
    for run in all {
        if run.roles != first.roles {
            let message = format!("logs {} where {} logs {}", run.roles.join(", "), first.name, first.roles.join(", "));
            return Err(Error::input(message).at_file(&run.path).help("give runs of one kind in one call"));
        }
        if run.heading.is_some() != first.heading.is_some() {
            let message = format!(
                "{} measures a heading, the other does not",
                if run.heading.is_some() { &run.name } else { &first.name }
            );
            return Err(Error::input(message).at_file(&run.path).help("give runs of one kind in one call"));
        }
    }
    Ok(first.roles.clone())
}

fn empty_report(request: &Request, data: &Data) -> Report {
    let runs = || request.runs.iter().chain(request.held_out);
    let mut why_dropped: BTreeMap<String, usize> = BTreeMap::new();
    runs().flat_map(|r| &r.why_dropped).for_each(|(why, n)| *why_dropped.entry(why.clone()).or_default() += n);
    if data.gross > 0 {
        *why_dropped.entry(GROSS.into()).or_default() += data.gross;
    }
    let warnings = runs().flat_map(|r| r.warnings.iter().map(move |w| format!("{}: {w}", r.name)));
    let mut hashes: BTreeMap<String, String> =
        runs().map(|r| (r.path.to_string_lossy().into_owned(), r.sha256.clone())).collect();
    let truths = runs().filter_map(|r| r.apart.as_ref());
    hashes.extend(truths.map(|a| (a.truth.to_string_lossy().into_owned(), a.truth_sha256.clone())));
    hashes.insert(request.file.path.to_string_lossy().into_owned(), request.file.sha256.clone());
    let own = request.library.iter().filter_map(|e| e.origin.as_deref()).chain(request.file.vehicle_origin());
    hashes.extend(own.map(|o| (o.path.to_string_lossy().into_owned(), o.sha256.clone())));
    let warnings = warnings.chain(data.warnings()).collect();
    Report {
        schema: 1,
        verdict: Verdict::NoMissingEffect,
        summary: String::new(),
        effects: vec![],
        unnamed: vec![],
        disagreement: vec![],
        remaining: None,
        gap: vec![],
        next_experiment: None,
        steps: vec![],
        data: DataSummary {
            runs: runs().count(),
            rows: runs().map(|r| r.time.len()).sum::<usize>() - data.gross,
            rows_dropped: runs().map(|r| r.rows_dropped).sum::<usize>() + data.gross,
            why_dropped,
            warnings,
            clocks: vec![],
        },
        provenance: Provenance { version: env!("CARGO_PKG_VERSION").into(), seed: request.seed, inputs_sha256: hashes },
    }
}

/// The answer for runs that are not even put to the model.
pub(crate) fn cut_short(request: &Request, outcome: verdict::Outcome) -> Result<Discovery> {
    let data = Data { fitted: vec![], held_out: vec![], gross: 0 };
    Ok(nothing_to_fit(request, &data, vec![], outcome))
}

fn nothing_to_fit(request: &Request, data: &Data, paths: Vec<PathPicture>, outcome: verdict::Outcome) -> Discovery {
    let mut report = empty_report(request, data);
    report.verdict = outcome.verdict;
    report.summary = outcome.sentence.unwrap_or_else(|| summary::verdict_sentence(&report));
    report.next_experiment = outcome.next_experiment;
    Discovery { report, pictures: Pictures { paths, ..Pictures::default() }, added: vec![] }
}

/// The horizons asked for that no run is long enough for.
fn too_long(request: &Request, report: &Report) -> Vec<String> {
    let is_missing = |h: &&f64| report.gap.iter().all(|g| g.horizon_s != **h);
    let told = |h: &f64| format!("the runs are too short for a gap after {h} s");
    request.horizons.iter().filter(is_missing).map(told).collect()
}

/// That held-out runs are predicted worse with what was found: at the horizon at which it is worst.
fn worse(gaps: &[Gap]) -> Option<String> {
    let of = |g: &Gap| g.held_out.as_ref().map(|h| (h.position_rms_before, h.position_rms_after, g.horizon_s));
    let grew = gaps.iter().filter(|g| of(g).is_some_and(|(_, after, _)| after > GREW * g.noise_floor.position_rms));
    let (before, after, horizon) = grew
        .filter_map(of)
        .filter(|(before, after, _)| *after > GREW * before)
        .max_by(|a, b| (a.1 / a.0).total_cmp(&(b.1 / b.0)))?;
    let [before, after] = [before, after].map(|gap| significant(gap, 3));
    Some(format!(
        "the held-out gap after {horizon} s grows with what was found, from {before} to {after} m: those runs do not bear \
         it out"
    ))
}

fn horizons(request: &Request) -> Vec<f64> {
    let mut h = if request.horizons.is_empty() { vec![1.0, 5.0, 30.0] } else { request.horizons.to_vec() };
    h.sort_by(f64::total_cmp);
    h.dedup();
    h
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_held_out_gap_that_grows_is_told_at_its_worst() {
        let gap = |horizon_s: f64, before: f64, after: f64| Gap {
            horizon_s,
            fit: None,
            held_out: Some(BeforeAfter {
                position_rms_before: before,
                position_rms_after: after,
                heading_rms_before: None,
                heading_rms_after: None,
            }),
            noise_floor: Floor { position_rms: 0.1, heading_rms: None },
        };
        let told = worse(&[gap(1.0, 0.2, 0.3), gap(5.0, 0.2, 0.5), gap(30.0, 1.0, 0.4)]).unwrap();
        assert!(told.contains("after 5 s") && told.contains("from 0.200 to 0.500 m"), "{told}");
        // Within the noise, and by a little, a gap does not grow.
        assert_eq!(worse(&[gap(1.0, 0.05, 0.12), gap(5.0, 1.0, 1.2)]), None);
    }
}
