//! Slips of a log: what one repair of its data mends, looked for before any effect is weighed.

use super::unit_errors::Slip;
use super::{repair_search, stamp_defects};
use crate::error::Result;
use crate::files::{ModelFile, Run};
use crate::model::Model;

/// The first slip of some runs, that of their times first.
///
/// # Errors
/// When the model's formulas are malformed.
pub fn any<'a>(file: &ModelFile, model: &Model, runs: impl IntoIterator<Item = &'a Run>) -> Result<Option<Slip>> {
    let runs: Vec<&Run> = runs.into_iter().collect();
    match stamp_defects::bursts(runs.iter().copied()) {
        Some(slip) => Ok(Some(slip)),
        // What moves under forces is not where its inputs say at once: no repair is judged by that.
        None if model.forced.is_some() => Ok(None),
        None => repair_search::slip(file, model, &runs),
    }
}
