//! Runs cut into windows, and the model linearised along each.

use crate::discrepancy::estimation::autocorrelation::Blocks;
use crate::discrepancy::record::record::Record;
use crate::model::Equations;
use nalgebra::DMatrix;
use rayon::prelude::*;
use std::ops::Range;

pub use super::window_integration::each_window;

/// Length of a window, s.
pub const WINDOW: f64 = 1.0;
/// Times this close are the same: without it the rounding of a clock would decide where a window ends, s.
const SLACK: f64 = 1e-6;
/// Rows of a window at least.
const MIN_ROWS: usize = 4;
/// How far from the ends of a log the first and last windows stay, s: the longest delay that is looked for.
pub const MARGIN: f64 = 0.5;

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
pub type Starts = Vec<Vec<Vec<f64>>>;

/// The model along one window: to first order in the start z and the parameters p,
/// residuals r + J·(δz, δp) and end e + F·δz + B·δp.
#[derive(Clone, Debug)]
pub struct Linear {
    /// Σ (J, r)ᵀ(J, r) for each [`Channel`](crate::discrepancy::record::record::Channel), columns (z, p, 1).
    pub gram: [DMatrix<f64>; 3],
    /// Number of values of each channel.
    pub count: [usize; 3],
    /// Residuals of neighbouring rows together, for each channel.
    pub blocks: [Blocks; 3],
    /// δz of this window's start as (δz̃, δp, 1)-columns, δz̃ being the end before the jump against the next start.
    pub back: Option<DMatrix<f64>>,
    /// Axes of the body at the window's end; columns along, across, yaw, trailers.
    pub axes: DMatrix<f64>,
    /// Duration, s.
    pub duration: f64,
    /// End of the window minus the next start, in the body's axes.
    pub mismatch: Vec<f64>,
}

impl Linear {
    /// Sum of the squared residuals of a channel.
    pub fn square(&self, channel: usize) -> f64 {
        let last = self.gram[channel].nrows() - 1;
        self.gram[channel][(last, last)]
    }
}

/// The model along all windows; `None` where it is undefined.
pub fn linearise(
    equations: &Equations,
    p: &[f64],
    records: &[Record],
    plan: &[Segment],
    starts: &Starts,
) -> Option<Vec<Vec<Linear>>> {
    let along = |(segment, starts): (&Segment, &Vec<Vec<f64>>)| {
        let mut found = Vec::with_capacity(segment.windows.len());
        each_window(equations, p, &records[segment.record], segment, starts, |window| {
            found.push(window);
            Some(())
        })?;
        Some(found)
    };
    plan.par_iter().zip(starts).map(along).collect()
}
