//! What a request gives: the records to fit and those to judge by.

use super::clock_jumps::{ClockJump, clock_jump};
use super::outliers;
use super::reference_jumps::{self, Jumps};
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::request::Request;
use crate::discrepancy::shooting::windows::has_windows;
use crate::error::Result;
use crate::files::Run;
use crate::model::Model;
use rayon::prelude::*;

/// Share of every run that is fitted when no run is held out.
pub(crate) const FITTED_SHARE: f64 = 0.75;

/// Runs cut into what is fitted and what is held out.
#[derive(Default)]
pub(crate) struct Data {
    pub fitted: Vec<Record>,
    pub held_out: Vec<Record>,
    /// Rows left out because their measured pose is grossly wrong.
    pub gross: usize,
    /// Stretches in which the reference jumps; they are left out.
    pub jumps: Vec<Jumps>,
    /// Jumps of a clock.
    pub clocks: Vec<ClockJump>,
}

impl Data {
    /// The records of a request's runs.
    pub fn of(request: &Request, model: &Model) -> Result<Self> {
        let timing = request.file.input_timing;
        let record = |r: &Run| -> Result<(Record, Vec<Jumps>)> {
            let jumps = reference_jumps::jumps(model, timing, r)?;
            let record = Record::of_run(r, timing, model.trailer_count());
            Ok((reference_jumps::without(&record, &jumps), jumps))
        };
        let each = |runs: &[Run]| -> Result<(Vec<Record>, Vec<Vec<Jumps>>)> {
            Ok(runs.par_iter().map(record).collect::<Result<Vec<_>>>()?.into_iter().unzip())
        };
        let (whole, mut jumps) = each(request.runs)?;
        let (judged, of_judged) = each(request.held_out)?;
        jumps.extend(of_judged);
        let all: Vec<&Run> = request.runs.iter().chain(request.held_out).collect();
        let clocks = all.into_par_iter().map(|r| clock_jump(model, timing, r)).collect::<Result<Vec<_>>>()?;
        let (fitted, held_out): (Vec<Record>, Vec<Record>) = match request.held_out.is_empty() {
            true => whole.iter().map(|r| r.split(FITTED_SHARE)).unzip(),
            false => (whole, judged),
        };
        let clean = |records: &[Record]| -> Result<(Vec<Record>, Vec<usize>)> {
            let each = records.par_iter().map(|r| outliers::without_gross_errors(r, model));
            Ok(each.collect::<Result<Vec<_>>>()?.into_iter().unzip())
        };
        let ((fitted, a), (held_out, b)) = (clean(&fitted)?, clean(&held_out)?);
        Ok(Self {
            fitted,
            held_out,
            gross: a.iter().chain(&b).sum(),
            jumps: jumps.into_iter().flatten().collect(),
            clocks: clocks.into_iter().flatten().collect(),
        })
    }

    /// Logs that were interrupted, and such as are too short to be fitted beside others.
    pub fn notes(&self) -> Vec<DatasetNote> {
        let interrupted = self.fitted.iter().chain(&self.held_out).filter_map(|r| {
            let pieces = r.segments(0.0).len();
            (pieces > 1).then(|| DatasetNote::Interrupted { run: r.name.clone(), pieces })
        });
        let some = self.fitted.iter().any(has_windows);
        let short = self.fitted.iter().filter(|r| some && !has_windows(r));
        let jumps = self.jumps.iter().cloned().map(DatasetNote::Jumps);
        jumps
            .chain(self.clocks.iter().cloned().map(DatasetNote::ClockJump))
            .chain(interrupted)
            .chain(short.map(|r| DatasetNote::NotFitted { run: r.name.clone() }))
            .collect()
    }
}

/// How a run enters the data otherwise than as a whole.
#[derive(Clone, Debug, PartialEq)]
pub enum DatasetNote {
    /// The reference jumps, and the stretch is left out.
    Jumps(Jumps),
    /// A clock jumps.
    ClockJump(ClockJump),
    /// The log is interrupted, and used in so many pieces.
    Interrupted {
        /// Name of the run.
        run: String,
        /// Pieces.
        pieces: usize,
    },
    /// Too short for a window of one second.
    NotFitted {
        /// Name of the run.
        run: String,
    },
}
