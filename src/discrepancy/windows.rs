//! Runs cut into windows, and the model linearised along each.

use super::angle::wrapped;
use super::record::{Channel, Record};
use super::whiteness::{Blocks, Run};
use crate::model::Equations;
use crate::motion::{Arc, Stepper};
use nalgebra::DMatrix;
use rayon::prelude::*;
use std::ops::Range;

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
    /// Σ (J, r)ᵀ(J, r) for each [`Channel`], columns (z, p, 1).
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

/// The model along the windows of a segment, one after another; `None` where it is undefined, or where `take` ends it.
pub fn each_window(
    equations: &Equations,
    p: &[f64],
    record: &Record,
    segment: &Segment,
    starts: &[Vec<f64>],
    mut take: impl FnMut(Linear) -> Option<()>,
) -> Option<()> {
    let mut stepper = Stepper::new(equations, &record.signals, p);
    let mut hidden = super::carry::before(equations, p, &mut stepper, record, segment.windows[0].start, &starts[0]);
    for (k, rows) in segment.windows.iter().enumerate() {
        let z = [&starts[k][..], &hidden.z].concat();
        let mut arc = stepper.start(&z, Some(&hidden.s));
        let linear = window_along(&mut stepper, record, rows, &mut arc, starts.get(k + 1))?;
        hidden.z = arc.z[equations.visible..].to_vec();
        hidden.s = arc.s;
        take(linear)?;
    }
    Some(())
}

fn window_along(
    stepper: &mut Stepper,
    record: &Record,
    rows: &Range<usize>,
    arc: &mut Arc,
    next: Option<&Vec<f64>>,
) -> Option<Linear> {
    let k = stepper.columns();
    let visible = visible_of(record);
    let mut gram = [0, 1, 2].map(|_| DMatrix::zeros(k + 1, k + 1));
    let mut count = [0; 3];
    let mut blocks = [Blocks::default(); 3];
    let channels = record.channels();
    let mut runs = vec![Run::default(); channels.len()];
    let mut line = vec![0.0; k + 1];
    for i in rows.clone() {
        let y = stepper.outputs(&arc.z);
        for (c, channel) in channels.iter().enumerate() {
            let output = record.output_of(c);
            output_line(y, output, visible, k, &arc.s, &mut line);
            line[k] = y[output] - record.columns[c][i];
            if *channel != Channel::Position {
                line[k] = wrapped(line[k]);
            }
            let kind = *channel as usize;
            runs[c].push(line[k], &mut blocks[kind]);
            add_square(&mut gram[kind], &line);
            count[kind] += 1;
        }
        if i + 1 < rows.end || next.is_some() {
            stepper.advance(arc, record.time[i], record.time[i + 1]);
        }
    }
    gram.iter_mut().for_each(|g| g.fill_lower_triangle_with_upper_triangle());
    if !arc.z.iter().chain(&arc.s).all(|x| x.is_finite()) || !gram.iter().all(|g| g.iter().all(|x| x.is_finite())) {
        return None;
    }
    let axes = body_axes(arc.z[2], visible);
    let last = if next.is_some() { rows.end } else { rows.end - 1 };
    let duration = record.time[last] - record.time[rows.start];
    let (back, mismatch) = match next {
        Some(next) => {
            let c: Vec<f64> = (0..visible).map(|i| difference_of(i, arc.z[i] - next[i])).collect();
            let mismatch = axes.tr_mul(&nalgebra::DVector::from_column_slice(&c));
            (Some(backwards(&arc.s, &c, visible, k)?), mismatch.as_slice().to_vec())
        }
        None => (None, vec![]),
    };
    Some(Linear { gram, count, blocks, back, axes, duration, mismatch })
}

/// How many states the pose and the trailers make.
fn visible_of(record: &Record) -> usize {
    3 + record.trailers
}

fn difference_of(i: usize, difference: f64) -> f64 {
    if i < 2 { difference } else { wrapped(difference) }
}

/// One row of J: ∂y/∂z·S plus the direct dependence of the sensor on p.
fn output_line(y: &[f64], output: usize, visible: usize, k: usize, s: &[f64], line: &mut [f64]) {
    let outputs = visible;
    let row = &y[outputs + output * k..outputs + (output + 1) * k];
    line[..k].fill(0.0);
    for (j, slope) in row[..visible].iter().enumerate().filter(|(_, slope)| **slope != 0.0) {
        for c in 0..k {
            line[c] += slope * s[j * k + c];
        }
    }
    for c in visible..k {
        line[c] += row[c];
    }
}

/// Adds the upper half of line·lineᵀ.
fn add_square(gram: &mut DMatrix<f64>, line: &[f64]) {
    let n = line.len();
    for (column, right) in
        gram.as_mut_slice().chunks_exact_mut(n).zip(line).enumerate().map(|(c, (g, r))| (&mut g[..=c], r))
    {
        column.iter_mut().zip(line).for_each(|(g, left)| *g += left * right);
    }
}

/// Columns: along and across the body, yaw, trailers.
fn body_axes(heading: f64, visible: usize) -> DMatrix<f64> {
    let mut axes = DMatrix::identity(visible, visible);
    let (sin, cos) = heading.sin_cos();
    axes[(0, 0)] = cos;
    axes[(0, 1)] = -sin;
    axes[(1, 0)] = sin;
    axes[(1, 1)] = cos;
    axes
}

/// δz = F⁻¹(δz̃ − B·δp − c) as a matrix on (δz̃, δp, 1).
fn backwards(s: &[f64], c: &[f64], visible: usize, k: usize) -> Option<DMatrix<f64>> {
    let f = DMatrix::from_fn(visible, visible, |i, j| s[i * k + j]);
    let inverse = f.try_inverse()?;
    let mut right = DMatrix::zeros(visible, k + 1);
    for i in 0..visible {
        right[(i, i)] = 1.0;
        (visible..k).for_each(|j| right[(i, j)] = -s[i * k + j]);
        right[(i, k)] = -c[i];
    }
    Some(inverse * right)
}
