//! The outcome of a discovery: its report, put together once, its pictures and the patched model.

use super::diagnosis::verdict;
use super::preprocessing::dataset::Data;
use super::rendering::summary;
use super::report::*;
use crate::discrepancy::diagnosis::advice;
use crate::discrepancy::preprocessing::outliers::GROSS;
use crate::discrepancy::request::Request;
use crate::error::Result;
use crate::files::{EffectEntry, ModelFile};
use crate::number_format::significant;
use std::collections::BTreeMap;

/// A held-out gap that is so many times as large with what was found, and as the noise floor, has grown.
const GREW: f64 = 1.25;

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

/// What inputs in coarse steps may have left unexplained; where nothing else has a say, finer ones are the advice.
pub(crate) fn told_of_steps(report: &mut Report, steps: Vec<String>, is_contested: bool) {
    if let Some(first) = steps.first().filter(|_| matches!(report.verdict, Verdict::NotIdentifiable | Verdict::Unexplained) && !is_contested) {
        report.next_experiment = Some(advice::finer(first));
    }
    report.data.warnings.extend(steps);
}

pub(crate) fn empty_report(request: &Request, data: &Data) -> Report {
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
    // What was given as arrays has no file.
    hashes.retain(|path, _| !path.is_empty());
    let warnings = warnings.chain(data.warnings()).collect();
    Report {
        schema: 2,
        verdict: Verdict::NoMissingEffect,
        summary: String::new(),
        effects: vec![],
        unnamed: vec![],
        disagreement: vec![],
        refuted: vec![],
        remains: None,
        covariance: None,
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

pub(crate) fn nothing_to_fit(
    request: &Request,
    data: &Data,
    paths: Vec<PathPicture>,
    outcome: verdict::Outcome,
) -> Discovery {
    let mut report = empty_report(request, data);
    report.verdict = outcome.verdict;
    report.summary = outcome.sentence.unwrap_or_else(|| summary::verdict_sentence(&report));
    report.next_experiment = outcome.next_experiment;
    Discovery { report, pictures: Pictures { paths, ..Pictures::default() }, added: vec![] }
}

/// The horizons asked for that no run is long enough for.
pub(crate) fn too_long(request: &Request, report: &Report) -> Vec<String> {
    let is_missing = |h: &&f64| report.gap.iter().all(|g| g.horizon_s != **h);
    let told = |h: &f64| format!("the runs are too short for a gap after {h} s");
    request.horizons.iter().filter(is_missing).map(told).collect()
}

/// That held-out runs are predicted worse with what was found: at the horizon at which it is worst.
pub(crate) fn worse(gaps: &[Gap]) -> Option<String> {
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
