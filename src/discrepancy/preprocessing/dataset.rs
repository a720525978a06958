//! What a request gives: the records to fit and those to judge by.

use super::outliers;
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
pub(crate) struct Data {
    pub fitted: Vec<Record>,
    pub held_out: Vec<Record>,
    /// Rows left out because their measured pose is grossly wrong.
    pub gross: usize,
}

impl Data {
    /// The records of a request's runs.
    pub fn of(request: &Request, model: &Model) -> Result<Self> {
        let record = |r: &Run| Record::of_run(r, request.file.input_timing, model.trailer_count());
        let whole: Vec<Record> = request.runs.iter().map(record).collect();
        let (fitted, held_out): (Vec<Record>, Vec<Record>) = match request.held_out.is_empty() {
            true => whole.iter().map(|r| r.split(FITTED_SHARE)).unzip(),
            false => (whole, request.held_out.iter().map(record).collect()),
        };
        let clean = |records: &[Record]| -> Result<(Vec<Record>, Vec<usize>)> {
            let each = records.par_iter().map(|r| outliers::without_gross_errors(r, model));
            Ok(each.collect::<Result<Vec<_>>>()?.into_iter().unzip())
        };
        let ((fitted, a), (held_out, b)) = (clean(&fitted)?, clean(&held_out)?);
        Ok(Self { fitted, held_out, gross: a.iter().chain(&b).sum() })
    }

    /// Logs that were interrupted, and such as are too short to be fitted beside others.
    pub fn notes(&self) -> Vec<DatasetNote> {
        let interrupted = self.fitted.iter().chain(&self.held_out).filter_map(|r| {
            let pieces = r.segments(0.0).len();
            (pieces > 1).then(|| DatasetNote::Interrupted { run: r.name.clone(), pieces })
        });
        let some = self.fitted.iter().any(has_windows);
        let short = self.fitted.iter().filter(|r| some && !has_windows(r));
        interrupted.chain(short.map(|r| DatasetNote::NotFitted { run: r.name.clone() })).collect()
    }
}

/// How a run enters the data otherwise than as a whole.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DatasetNote {
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
