//! Runs cut into windows, and the model linearised along each.

use crate::discrepancy::record::run_record::Record;
use std::ops::Range;

/// Length of a window, s.
pub const WINDOW: f64 = 1.0;
/// Times this close are the same: without it the rounding of a clock would decide where a window ends, s.
const SLACK: f64 = 1e-6;
/// Rows of a window at least.
const MIN_ROWS: usize = 4;
/// How far from the ends of a log the first and last windows stay, s: the longest delay that is looked for.
pub const MARGIN: f64 = 0.5;

/// Windows that are integrated side by side: two vectors of AVX-512, so that one waits while the other works.
pub(crate) const LANES: usize = 16;

/// A stretch of a run cut into windows; each window ends where the next begins.
#[derive(Clone, Debug)]
pub struct Segment {
    /// Index of the run.
    pub record: usize,
    /// Rows of each window.
    pub windows: Vec<Range<usize>>,
}

/// Cuts runs into windows.
pub fn plan(records: &[Record]) -> Vec<Segment> {
    let cut = |(record, r): (usize, &Record)| {
        r.segments(MARGIN).into_iter().map(move |rows| Segment { record, windows: cut(r, rows) }).collect::<Vec<_>>()
    };
    records.iter().enumerate().flat_map(cut).filter(|s| !s.windows.is_empty()).collect()
}

fn cut(record: &Record, rows: Range<usize>) -> Vec<Range<usize>> {
    let mut windows = Vec::new();
    let mut start = rows.start;
    for i in rows.clone() {
        if record.time[i] - record.time[start] >= WINDOW - SLACK && i - start >= MIN_ROWS {
            windows.push(start..i);
            start = i;
        }
    }
    // A short remainder belongs to the last window.
    match windows.last_mut() {
        Some(w) if rows.end - start < MIN_ROWS => w.end = rows.end,
        _ if rows.end - start >= MIN_ROWS => windows.push(start..rows.end),
        _ => {}
    }
    windows
}

/// Poses (and trailer headings) at the start of every window, segment by segment.
pub type WindowStates = Vec<Vec<Vec<f64>>>;

/// Whether a run is long enough to be cut into windows.
pub(crate) fn has_windows(record: &Record) -> bool {
    !plan(std::slice::from_ref(record)).is_empty()
}
