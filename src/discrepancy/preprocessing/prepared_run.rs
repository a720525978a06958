//! A run set right before a fit: without the stretches in which its reference jumps.

use super::clock_jumps::{ClockJump, clock_jump};
use super::dead_reckoning::DeadReckoning;
use super::reference_jumps::{self, Jumps};
use crate::discrepancy::record::run_record::Record;
use crate::error::Result;
use crate::files::{InputTiming, Run};
use crate::model::Model;
use crate::wording::{GROSS, JUMPED};
use std::collections::BTreeMap;

/// Rows of runs that are left out before a fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct LeftOut {
    /// Their measured pose is grossly wrong.
    pub gross: usize,
    /// The reference jumps there.
    pub jumped: usize,
}

impl LeftOut {
    /// How many they are.
    pub fn rows(self) -> usize {
        self.gross + self.jumped
    }

    /// Their reasons, beside those that reading a file gave.
    pub fn tell(self, why_dropped: &mut BTreeMap<String, usize>) {
        for (why, rows) in [(GROSS, self.gross), (JUMPED, self.jumped)] {
            if rows > 0 {
                *why_dropped.entry(why.into()).or_default() += rows;
            }
        }
    }
}

/// A run as a record, and what was found of it on the way.
pub(crate) struct PreparedRun {
    /// The record, without its jumps.
    pub record: Record,
    /// Rows that were left out with the jumps.
    pub jumped: usize,
    /// Stretches in which the reference jumps.
    pub jumps: Vec<Jumps>,
    /// The jump of the clock.
    pub clock: Option<ClockJump>,
}

impl PreparedRun {
    /// A run that a model may be put to.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn of(run: &Run, model: &Model, timing: InputTiming) -> Result<Self> {
        let whole = Self::as_it_is(run, model, timing);
        let Some(reckoning) = DeadReckoning::of(model, timing, run)? else { return Ok(whole) };
        let reckoned = reckoning.path(&run.inputs);
        let jumps = reference_jumps::jumps(run, &reckoned);
        let all = whole.record.time.len();
        let record = reference_jumps::without(whole.record, &jumps);
        Ok(Self { jumped: all - record.time.len(), record, jumps, clock: clock_jump(run, &reckoned) })
    }

    /// A run that no model can be put to.
    pub fn as_it_is(run: &Run, model: &Model, timing: InputTiming) -> Self {
        Self { record: Record::of_run(run, timing, model.trailer_count()), jumped: 0, jumps: vec![], clock: None }
    }
}
