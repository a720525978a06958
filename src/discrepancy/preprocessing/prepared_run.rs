//! A run set right before a fit: without the rows that hold nothing, and the stretches in which its reference jumps.

use super::cleaned_run::CleanedRun;
use super::clock_jumps::{ClockJump, clock_jump};
use super::reference_jumps::{self, Jumps};
use super::row_defects::RowDefect;
use crate::discrepancy::record::run_record::Record;
use crate::error::Result;
use crate::files::{InputTiming, Run};
use crate::model::Model;
use crate::wording::{GROSS, HELD, JUMPED, LIFTED};
use std::collections::BTreeMap;

/// Rows of runs that are left out before a fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct LeftOut {
    /// Their measured pose is grossly wrong.
    pub gross: usize,
    /// The reference jumps there.
    pub jumped: usize,
    /// They hold the pose of the row before.
    pub held: usize,
    /// The vehicle is lifted or carried.
    pub lifted: usize,
}

impl LeftOut {
    /// How many they are.
    pub fn rows(self) -> usize {
        self.gross + self.jumped + self.held + self.lifted
    }

    /// Their reasons, beside those that reading a file gave.
    pub fn tell(self, why_dropped: &mut BTreeMap<String, usize>) {
        for (why, rows) in [(GROSS, self.gross), (JUMPED, self.jumped), (HELD, self.held), (LIFTED, self.lifted)] {
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
    /// Rows that were left out.
    pub left_out: LeftOut,
    /// Pieces in which it was logged.
    pub pieces: usize,
    /// Rows and stretches in which something is wrong.
    pub defects: Vec<RowDefect>,
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
        let Some(cleaned) = CleanedRun::of(run, model, timing)? else {
            return Ok(Self::as_it_is(run, model, timing));
        };
        let whole = Self::as_it_is(&cleaned.run, model, timing);
        let rows = |record: &Record| record.time.len();
        let lifted: Vec<[f64; 2]> = cleaned.defects.iter().filter_map(RowDefect::span).collect();
        let driven = reference_jumps::without(whole.record.clone(), &lifted);
        let jumps = reference_jumps::jumps(&cleaned.run, &cleaned.reckoned);
        let spans: Vec<[f64; 2]> = jumps.iter().map(|j| j.span).collect();
        let record = reference_jumps::without(driven.clone(), &spans);
        let left_out = LeftOut {
            jumped: rows(&driven) - rows(&record),
            lifted: rows(&whole.record) - rows(&driven),
            held: cleaned.held,
            gross: 0,
        };
        let clock = clock_jump(&cleaned.run, &cleaned.reckoned);
        Ok(Self { record, left_out, jumps, clock, defects: cleaned.defects, pieces: whole.pieces })
    }

    /// A run that no model can be put to.
    pub fn as_it_is(run: &Run, model: &Model, timing: InputTiming) -> Self {
        let record = Record::of_run(run, timing, model.freedom());
        let pieces = record.segments(0.0).len();
        Self { record, left_out: LeftOut::default(), pieces, defects: vec![], jumps: vec![], clock: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::unicycle_file;

    /// A straight drive at 1 m/s whose reference is off by a metre from one row on, and of which some rows are missing.
    fn prepared(jump: Option<usize>, missing: std::ops::Range<usize>) -> PreparedRun {
        let file = unicycle_file("");
        let mut log = String::from("time,x,y,heading,wheel_rate,yaw_rate\n");
        for i in (0..200_usize).filter(|i| !missing.contains(i)) {
            let off = if jump.is_some_and(|j| i >= j) { 1.0 } else { 0.0 };
            let (t, noise) = (0.1 * i as f64, 1e-3 * ((7 * i * i) % 11) as f64 / 11.0);
            log += &format!("{t},{},{off},0,1,0\n", t + noise);
        }
        let run = Run::parse("run.csv", &log, &file).unwrap();
        let model = Model::from_file(&file, crate::effects::all(), &run.roles).unwrap();
        PreparedRun::of(&run, &model, file.input_timing).unwrap()
    }

    #[test]
    fn a_hole_left_by_a_jump_is_no_interruption() {
        let jumped = prepared(Some(80), 0..0);
        assert_eq!((jumped.jumps.len(), jumped.record.segments(0.0).len(), jumped.pieces), (1, 2, 1));
        assert_eq!(jumped.left_out.rows(), 200 - jumped.record.time.len());
        let interrupted = prepared(None, 80..120);
        assert_eq!((interrupted.jumps.len(), interrupted.pieces, interrupted.left_out.rows()), (0, 2, 0));
    }
}
