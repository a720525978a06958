//! The run of a sweep, block by block on all cores, written in the order of the cases.

use super::journal::Journal;
use super::prepared_sweep::Sweep;
use super::shard::Shard;
use super::table::{Format, csv, header};
use crate::error::Result;
use crate::motion::Case;
use crate::progress::{OnProgress, Stage, tell};
use rayon::prelude::*;
use sha2::{Digest, Sha256};
use std::ops::Range;
use std::path::Path;
use std::time::{Duration, Instant};

/// Numbers that a block of cases holds, about: 512 KiB.
const BLOCK_NUMBERS: usize = 1 << 16;
/// Blocks that are computed between two writes, for each thread: at first, and at most.
const ROUND_BLOCKS: [usize; 2] = [4, 64];
/// A round that takes less than this may be longer: at its end threads wait for one another. What is longer would be lost
/// by a kill.
const QUICK_ROUND: Duration = Duration::from_millis(50);

/// What a sweep has written.
///
/// ```
/// use creepage::sweep::Summary;
/// let all_well = |s: &Summary| s.undefined == 0 && s.not_converged == 0;
/// assert!(all_well(&Summary { cases: 10, found: 4, undefined: 0, not_converged: 0 }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Summary {
    /// Cases of the part.
    pub cases: usize,
    /// Cases taken over from an earlier run that was stopped.
    pub found: usize,
    /// Cases whose motion is undefined.
    pub undefined: usize,
    /// Cases that did not reach the error asked for.
    pub not_converged: usize,
}

/// Encoded rows of some cases.
struct Rows {
    bytes: Vec<u8>,
    cases: usize,
    troubles: [usize; 2],
}

impl Sweep {
    /// Runs a part of the sweep and writes its table; goes on where an earlier run of it was stopped.
    ///
    /// The first part has the header, so that parts in their order, one behind the other, are the whole table.
    ///
    /// # Errors
    /// When the output cannot be written, or the listener stops it: what is done waits beside the output then.
    pub fn write(&self, shard: Shard, out: &Path, progress: &OnProgress) -> Result<Summary> {
        let format = Format::of(out)?;
        let range = shard.of(self.cases());
        let columns = self.columns();
        let first = if format == Format::Csv && shard.is_first() { header(&columns) } else { vec![] };
        let identity = format!("{:x}", Sha256::digest(format!("{} {range:?} {format:?}", self.identity)));
        // What a link leads to, and everything beside it there.
        let out = &crate::files::check_target(out)?;
        let mut journal = Journal::open(out, &identity, &first)?;
        let all = range.len();
        let mut next = range.start + journal.cases();
        let mut computed: Vec<Result<Rows>> = vec![];
        let mut blocks = ROUND_BLOCKS[0];
        loop {
            if let Err(stopped) = tell(progress, Stage::Cases { found: journal.found }, journal.cases(), all) {
                append(&mut journal, computed)?;
                journal.note()?;
                return Err(stopped);
            }
            let began = Instant::now();
            let round = next..range.end.min(next + self.block() * blocks * rayon::current_num_threads());
            next = round.end;
            // What was computed is written while the next cases are.
            let before = std::mem::take(&mut computed);
            let last = round.is_empty();
            let (written, after) = rayon::join(|| append(&mut journal, before), || self.compute(round, format));
            written?;
            computed = after;
            if last {
                break;
            }
            if began.elapsed() < QUICK_ROUND {
                blocks = ROUND_BLOCKS[1].min(2 * blocks);
            }
        }
        let ([undefined, not_converged], found) = (journal.troubles(), journal.found);
        journal.finish(out, format, &columns)?;
        Ok(Summary { cases: all, found, undefined, not_converged })
    }

    /// Cases of a block: whole vectors, and not more numbers than fit near the processor.
    fn block(&self) -> usize {
        (BLOCK_NUMBERS / (self.rows * self.width)).clamp(32, 1024) / 32 * 32
    }

    fn compute(&self, cases: Range<usize>, format: Format) -> Vec<Result<Rows>> {
        let starts: Vec<usize> = cases.clone().step_by(self.block()).collect();
        let block = |start: &usize| self.compute_block(*start..cases.end.min(start + self.block()), format);
        starts.par_iter().map(block).collect()
    }

    fn compute_block(&self, cases: Range<usize>, format: Format) -> Result<Rows> {
        let (mut values, varied) = (Vec::new(), self.names.len());
        cases.clone().for_each(|i| self.cases.push(i, &mut values));
        let given: Vec<&[f64]> = (0..cases.len()).map(|i| &values[i * varied..(i + 1) * varied]).collect();
        let found = self.ensemble.run(&self.plan, &given)?;
        let mut rows = Vec::with_capacity(cases.len() * self.rows * self.width);
        for ((number, values), case) in cases.clone().zip(&given).zip(&found) {
            self.push_rows(number, values, case, &mut rows);
        }
        let bytes = match format {
            Format::Csv => csv(&rows, self.width),
            Format::Parquet => rows.iter().flat_map(|v| v.to_le_bytes()).collect(),
        };
        let count = |bad: fn(&Case) -> bool| found.iter().filter(|c| bad(c)).count();
        let troubles = [count(|c| !c.is_defined()), count(|c| c.is_defined() && !c.converged)];
        Ok(Rows { bytes, cases: cases.len(), troubles })
    }
}

fn append(journal: &mut Journal, rows: Vec<Result<Rows>>) -> Result<()> {
    for rows in rows {
        let rows = rows?;
        journal.append(&rows.bytes, rows.cases, rows.troubles)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Kind;
    use crate::progress::unheard;
    use std::ops::ControlFlow;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn a_stopped_sweep_keeps_what_is_done_and_goes_on() {
        let sweep = Sweep::read("examples/sweeps/wheels.toml").unwrap();
        let dir = tempfile::tempdir().unwrap();
        let out = dir.path().join("wheels.csv");
        let calls = AtomicUsize::new(0);
        let once = |_| match calls.fetch_add(1, Ordering::Relaxed) {
            0 => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        };
        let stopped = sweep.write(Shard::WHOLE, &out, &once).unwrap_err();
        assert_eq!((stopped.kind(), out.exists()), (Kind::Stopped, false));
        let written = sweep.write(Shard::WHOLE, &out, &unheard).unwrap();
        assert!(written.cases == sweep.cases() && written.found > 0, "{written:?}");
    }
}
