//! The front door of `check`: clocks aligned first where inputs and poses have clocks of their own.

use super::clock_alignment::aligned_run::{Aligned, aligned};
use super::identifiability::check::{Assessment, assess};
use super::identifiability::data_finding::DataFinding;
use super::identifiability::{Check, Checked};
use super::rendering::experiment_text::next_experiment;
use super::rendering::{check_text, finding_text};
use crate::discrepancy::clock_alignment::aligned_run::{is_aligned, without_delay};
use crate::discrepancy::report::RunClock;
use crate::discrepancy::request::{Request, common_roles};
use crate::effects::Effect;
use crate::error::Result;
use crate::files::Run;
use crate::model::Model;
use crate::progress::OnProgress;

/// Says what runs can tell of a model.
///
/// ```no_run
/// use creepage::discrepancy::check::check;
/// use creepage::discrepancy::identifiability::Checked;
/// use creepage::files::{ModelFile, Run};
/// use creepage::{effects, model};
/// let file = ModelFile::read("model.toml", &model::known(effects::all())).unwrap();
/// let runs = [Run::read("run.csv", &file).unwrap()];
/// let answer = check(&Checked { file: &file, runs: &runs, library: effects::all() }, &creepage::progress::unheard).unwrap();
/// println!("{}", answer.summary);
/// ```
///
/// # Errors
/// When runs log different inputs, or the model file's effects do not apply to its vehicle.
pub fn check(of: &Checked, progress: &OnProgress) -> Result<Check> {
    Ok(told(assess(of, progress)?, vec![]))
}

/// As [`check`], the clocks of inputs and poses estimated first where they
/// stand in files of their own.
///
/// # Errors
/// As [`discover_aligned`](crate::discrepancy::discover::discover_aligned).
pub fn check_aligned(of: &Checked, near: Option<f64>, progress: &OnProgress) -> Result<Check> {
    if of.runs.iter().all(is_aligned) {
        return check(of, progress);
    }
    let Checked { file, runs, library } = *of;
    let (file, delay) = without_delay(file);
    let file = &file;
    let roles = common_roles(runs, &[])?;
    let model = Model::from_file(file, library, &roles)?;
    let request = Request { file, runs, held_out: &[], library, horizons: &[], seed: 0 };
    let by_one = match aligned(runs, 1.0, &request, &model, near, progress)? {
        Ok(by_one) => by_one,
        Err(outcome) => return Ok(told(Assessment::cut_short(outcome), vec![])),
    };
    let library: Vec<Effect> = library.iter().filter(|e| !e.is_of_clock()).cloned().collect();
    let runs: Vec<Run> = by_one.iter().map(|a| a.run.clone()).collect();
    let mut found = assess(&Checked { file, runs: &runs, library: &library }, progress)?;
    found.findings.extend(by_one.iter().filter_map(Aligned::doubt).chain(delay).map(Box::new).map(DataFinding::Clock));
    Ok(told(found, by_one.iter().map(|a| a.clock(false)).collect()))
}

/// An assessment in words, with the clocks of its runs.
fn told(of: Assessment, clocks: Vec<RunClock>) -> Check {
    let summary = check_text::summary(&of);
    let mut data = of.data;
    data.findings = of.findings.iter().map(finding_text::finding).collect();
    data.clocks = clocks;
    Check {
        schema: 1,
        verdict: of.standing,
        summary,
        data,
        effects: of.effects,
        not_separated: of.not_separated,
        next_experiment: of.next.as_ref().map(next_experiment),
    }
}
