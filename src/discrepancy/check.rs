//! The front door of `check`: clocks aligned first where inputs and poses have clocks of their own.

use super::clock_alignment::aligned_run::{Aligned, aligned};
use super::identifiability::{Check, Checked, Finding, check};
use crate::discrepancy::clock_alignment::aligned_run::{is_aligned, without_delay};
use crate::discrepancy::request::{Request, common_roles};
use crate::effects::Effect;
use crate::error::Result;
use crate::files::Run;
use crate::model::Model;

/// As [`check`], the clocks of inputs and poses estimated first where they
/// stand in files of their own.
///
/// # Errors
/// As [`discover_aligned`](crate::discrepancy::discover::discover_aligned).
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
    let library: Vec<Effect> = library.iter().filter(|e| !e.is_of_clock()).cloned().collect();
    let runs: Vec<Run> = by_one.iter().map(|a| a.run.clone()).collect();
    let mut found = check(&Checked { file, runs: &runs, library: &library }, progress)?;
    found.data.clocks = by_one.iter().map(|a| a.clock(false)).collect();
    let doubts = by_one.iter().filter_map(Aligned::doubt).chain(delay);
    found.data.findings.extend(doubts.map(|says| Finding { id: "clock-offset".into(), says }));
    Ok(found)
}
