//! What a request gives: the records to fit and those to judge by.

use super::clock_jumps::ClockJump;
use super::outliers;
use super::prepared_run::{LeftOut, PreparedRun};
use super::reference_jumps::Jumps;
use super::row_defects::RowDefect;
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
    /// Rows left out.
    pub left_out: LeftOut,
    /// Stretches in which the reference jumps; they are left out.
    pub jumps: Vec<Jumps>,
    /// Jumps of a clock.
    pub clocks: Vec<ClockJump>,
    /// Rows and stretches in which something is wrong.
    pub defects: Vec<RowDefect>,
    /// Runs that were logged in pieces.
    pub interrupted: Vec<(String, usize)>,
}

impl Data {
    /// The records of a request's runs.
    pub fn of(request: &Request, model: &Model) -> Result<Self> {
        Self::cut(request, model, FITTED_SHARE)
    }

    /// The same with all rows fitted where no run is held out.
    pub fn whole(request: &Request, model: &Model) -> Result<Self> {
        Self::cut(request, model, 1.0)
    }

    fn cut(request: &Request, model: &Model, share: f64) -> Result<Self> {
        let timing = request.file.input_timing;
        let each = |runs: &[Run]| -> Result<Vec<PreparedRun>> {
            runs.par_iter().map(|r| PreparedRun::of(r, model, timing)).collect()
        };
        let (runs, judged) = (each(request.runs)?, each(request.held_out)?);
        let all = || runs.iter().chain(&judged);
        let (jumps, clocks) =
            (all().flat_map(|r| r.jumps.clone()).collect(), all().filter_map(|r| r.clock.clone()).collect());
        let defects = all().flat_map(|r| r.defects.clone()).collect();
        let in_pieces = all().filter(|r| r.pieces > 1);
        let interrupted = in_pieces.map(|r| (r.record.name.clone(), r.pieces)).collect();
        let sum = |of: &dyn Fn(LeftOut) -> usize| all().map(|r| of(r.left_out)).sum::<usize>();
        let [jumped, held, lifted] = [sum(&|l| l.jumped), sum(&|l| l.held), sum(&|l| l.lifted)];
        let records = |runs: Vec<PreparedRun>| runs.into_iter().map(|r| r.record).collect::<Vec<Record>>();
        let whole = records(runs);
        let (fitted, held_out): (Vec<Record>, Vec<Record>) = match judged.is_empty() {
            true if share < 1.0 => whole.iter().map(|r| r.split(share)).unzip(),
            true => (whole, vec![]),
            false => (whole, records(judged)),
        };
        let clean = |records: &[Record]| -> Result<(Vec<Record>, Vec<usize>)> {
            let each = records.par_iter().map(|r| outliers::without_gross_errors(r, model));
            Ok(each.collect::<Result<Vec<_>>>()?.into_iter().unzip())
        };
        let ((fitted, a), (held_out, b)) = (clean(&fitted)?, clean(&held_out)?);
        let left_out = LeftOut { gross: a.iter().chain(&b).sum(), jumped, held, lifted };
        Ok(Self { fitted, held_out, left_out, jumps, clocks, defects, interrupted })
    }

    /// The data without some runs; what is held out of them goes where it is a part of them.
    pub fn without(self, runs: &[&str], is_held_out_of_them: bool) -> Self {
        let kept = |all: Vec<Record>, goes: bool| {
            all.into_iter().filter(|r| !goes || !runs.contains(&r.name.as_str())).collect()
        };
        Self { fitted: kept(self.fitted, true), held_out: kept(self.held_out, is_held_out_of_them), ..self }
    }

    /// The same where every input that may be rounded is.
    pub(crate) fn with_rounded_inputs(self) -> Self {
        let rounded = |all: &[Record]| all.iter().map(Record::with_rounded_inputs).collect();
        Self { fitted: rounded(&self.fitted), held_out: rounded(&self.held_out), ..self }
    }

    /// Logs that were interrupted, and such as are too short to be fitted beside others.
    pub fn notes(&self) -> Vec<DatasetNote> {
        // Where rows were left out is said with the reason.
        let interrupted =
            self.interrupted.iter().map(|(run, pieces)| DatasetNote::Interrupted { run: run.clone(), pieces: *pieces });
        let some = self.fitted.iter().any(has_windows);
        let short = self.fitted.iter().filter(|r| some && !has_windows(r));
        let jumps = self.jumps.iter().cloned().map(DatasetNote::Jumps);
        self.defects
            .iter()
            .cloned()
            .map(DatasetNote::Defect)
            .chain(jumps)
            .chain(self.clocks.iter().cloned().map(DatasetNote::ClockJump))
            .chain(interrupted)
            .chain(short.map(|r| DatasetNote::NotFitted { run: r.name.clone() }))
            .collect()
    }
}

/// How a run enters the data otherwise than as a whole.
#[derive(Clone, Debug, PartialEq)]
pub enum DatasetNote {
    /// Something is wrong with rows, or in a stretch.
    Defect(RowDefect),
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
