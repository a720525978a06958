//! The outcome of a discovery: its report, put together once, its pictures and the patched model.

use super::rendering::{
    experiment_text, finding_text, odd_run_text, reason_text, refusal_text, regime_text, rest_text, summary,
    warning_text,
};
use super::report::*;
use crate::discrepancy::diagnosis::reason::Reason;
use crate::discrepancy::diagnosis::rest::Rest;
use crate::discrepancy::diagnosis::warning::Warning;
use crate::discrepancy::experiment::next_step::NextStep;
use crate::discrepancy::localisation::driving_regimes::Stretch;
use crate::discrepancy::preprocessing::dataset::Data;
use crate::discrepancy::request::Request;
use crate::discrepancy::selection::choice::Refused;
use crate::discrepancy::selection::odd_run::OddRun;
use crate::effects::TypicalMotion;
use crate::files::{EffectEntry, ModelFile, PoseFilter, with_pose_filter};
use std::collections::BTreeMap;

/// What `discover` finds.
pub struct Discovery {
    /// The answer.
    pub report: Report,
    /// Its pictures.
    pub pictures: Pictures,
    /// The effects to add to the model file.
    pub added: Vec<EffectEntry>,
    /// A filter of the pose to add to it.
    pub pose_filter: Option<PoseFilter>,
}

impl Discovery {
    /// The model file with the findings added.
    pub fn patched(&self, file: &ModelFile) -> String {
        let text = file.patched(&self.added);
        match self.pose_filter {
            Some(filter) => with_pose_filter(&text, filter),
            None => text,
        }
    }
}

/// The clocks of runs whose inputs and poses were logged apart, and what is to know of them.
#[derive(Clone, Default)]
pub(crate) struct Clocks {
    pub clocks: Vec<RunClock>,
    pub warnings: Vec<Warning>,
}

/// What all stages found; of runs that are not fitted the reason alone.
#[derive(Default)]
pub(crate) struct Findings {
    pub reason: Option<Reason>,
    pub next: Option<NextStep>,
    pub effects: Vec<Named>,
    pub unnamed: Vec<Unnamed>,
    pub disagreement: Vec<Stretch>,
    pub refused: Vec<Refused>,
    pub odd: Vec<OddRun>,
    pub motion: TypicalMotion,
    pub rest: Option<Rest>,
    pub covariance: Option<Covariance>,
    pub remaining: Option<Remaining>,
    pub gap: Vec<Gap>,
    pub steps: Vec<Step>,
    pub warnings: Vec<Warning>,
}

/// The report of a verdict and what was found.
pub(crate) fn report(request: &Request, data: &Data, verdict: Verdict, found: Findings, clocks: Clocks) -> Report {
    let composed = || summary::composed_sentence(verdict, &found.effects, &found.unnamed);
    let sentence = found.reason.as_ref().map_or_else(composed, reason_text::sentence);
    let roles = request.runs.first().map_or(&[][..], |r| &r.roles);
    let admitted = rest_text::admitted(&sentence, verdict, found.rest.as_ref());
    Report {
        schema: 2,
        verdict: odd_run_text::verdict(verdict, &found.odd),
        summary: odd_run_text::before(&found.odd, &admitted),
        effects: found.effects,
        unnamed: found.unnamed,
        disagreement: found.disagreement.iter().map(regime_text::disagreement).collect(),
        refuted: found.refused.iter().map(|r| refusal_text::refuted(r, roles)).collect(),
        remains: found.rest.as_ref().map(rest_text::remains),
        covariance: found.covariance,
        odd_runs: found.odd.iter().map(|o| odd_run_text::odd_run(o, found.motion)).collect(),
        remaining: found.remaining,
        gap: found.gap,
        kinematic: None,
        next_experiment: found.next.as_ref().map(experiment_text::next_experiment),
        steps: found.steps,
        data: DataSummary {
            findings: match &found.reason {
                Some(Reason::Slip(slip)) => vec![finding_text::slip(slip)],
                Some(Reason::OtherVehicle(other)) => vec![finding_text::other_vehicle(other)],
                _ => vec![],
            },
            ..summarised(request, data, found.warnings, clocks)
        },
        provenance: provenance(request),
    }
}

/// The runs of a request and what was left out of them, with all there is to know of them; `more` beside what reading them gave.
pub(crate) fn summarised(request: &Request, data: &Data, more: Vec<Warning>, clocks: Clocks) -> DataSummary {
    let runs = || request.runs.iter().chain(request.held_out);
    let reading = runs()
        .flat_map(|r| r.warnings.iter().map(move |says| Warning::Reading { run: r.name.clone(), says: says.clone() }));
    let of_data = data.notes().into_iter().map(Warning::Dataset);
    let warnings = reading.chain(of_data).chain(more).chain(clocks.warnings);
    DataSummary {
        runs: runs().count(),
        rows: runs().map(|r| r.time.len()).sum::<usize>() - data.left_out.rows(),
        rows_dropped: runs().map(|r| r.rows_dropped).sum::<usize>() + data.left_out.rows(),
        why_dropped: why_dropped(request, data),
        warnings: warnings.map(|w| warning_text::line(&w)).collect(),
        clocks: clocks.clocks,
        findings: vec![],
    }
}

fn why_dropped(request: &Request, data: &Data) -> BTreeMap<String, usize> {
    let mut why_dropped: BTreeMap<String, usize> = BTreeMap::new();
    let each = request.runs.iter().chain(request.held_out).flat_map(|r| &r.why_dropped);
    each.for_each(|(why, n)| *why_dropped.entry(why.clone()).or_default() += n);
    data.left_out.tell(&mut why_dropped);
    why_dropped
}

/// Where the answer comes from: every file that was read, by its hash.
pub(crate) fn provenance(request: &Request) -> Provenance {
    let runs = || request.runs.iter().chain(request.held_out);
    let mut hashes: BTreeMap<String, String> =
        runs().map(|r| (r.path.to_string_lossy().into_owned(), r.sha256.clone())).collect();
    let truths = runs().filter_map(|r| r.apart.as_ref());
    hashes.extend(truths.map(|a| (a.truth.to_string_lossy().into_owned(), a.truth_sha256.clone())));
    hashes.insert(request.file.path.to_string_lossy().into_owned(), request.file.sha256.clone());
    let own = request.library.iter().filter_map(|e| e.origin.as_deref()).chain(request.file.vehicle_origin());
    hashes.extend(own.map(|o| (o.path.to_string_lossy().into_owned(), o.sha256.clone())));
    // What was given as arrays has no file.
    hashes.retain(|path, _| !path.is_empty());
    Provenance { version: env!("CARGO_PKG_VERSION").into(), seed: request.seed, inputs_sha256: hashes }
}
