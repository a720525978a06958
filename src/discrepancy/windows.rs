//! Runs cut into windows, and the model linearised along each.

use super::angle::wrapped;
use super::record::{Channel, Record};
use super::whiteness::{Blocks, Run};
use crate::formula::Kernel;
use crate::model::Equations;
use crate::motion::{Arc, Arcs, LaneStepper};
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

/// Windows that are integrated side by side: two vectors of AVX-512, so that one waits while the other works.
const LANES: usize = 16;
/// With many parameters, so many that the sums over rows would not fit near the processor.
const FEW_LANES: usize = 8;
const MANY: usize = 32;
/// With more parameters than these columns fill the vectors.
const WIDE: usize = 256;

/// The model along the windows of a segment, one after another; `None` where it is undefined, or where `take` ends it.
pub fn each_window(
    equations: &Equations,
    p: &[f64],
    record: &Record,
    segment: &Segment,
    starts: &[Vec<f64>],
    mut take: impl FnMut(Linear) -> Option<()>,
) -> Option<()> {
    let along = Along { equations, p, record, windows: &segment.windows, starts };
    let first = super::carry::before(equations, p, record, segment.windows[0].start, &starts[0]);
    if p.len() > WIDE || segment.windows.len() == 1 {
        return along.side_by_side::<1>(0, &[first], &mut take).map(|_| ());
    }
    if equations.n() == equations.visible {
        return match p.len() > MANY {
            true => along.side_by_side::<FEW_LANES>(0, &[], &mut take).map(|_| ()),
            false => along.side_by_side::<LANES>(0, &[], &mut take).map(|_| ()),
        };
    }
    // States that no sensor sees go from window to window. Where their motion does not ask for the pose they are
    // carried ahead by themselves; windows that find them elsewhere at their end than they were taken to be go alone.
    let ahead = along.ahead(&first).unwrap_or_default();
    let (done, hidden) = along.side_by_side::<LANES>(0, &ahead, &mut take)?;
    along.side_by_side::<1>(done, &[hidden.unwrap_or(first)], &mut take).map(|_| ())
}

/// Equations along the windows of a segment.
struct Along<'a> {
    equations: &'a Equations,
    p: &'a [f64],
    record: &'a Record,
    windows: &'a [Range<usize>],
    starts: &'a [Vec<f64>],
}

impl Along<'_> {
    /// The hidden states at the start of every window, without what the pose does meanwhile.
    ///
    /// States that forget within a window where they began, bit for bit, come to the same end from any start: all
    /// windows are tried side by side, and once more from the ends found. What is the same twice is what one window
    /// after another would give; the rest goes one after another.
    fn ahead(&self, first: &Arc) -> Option<Vec<Arc>> {
        let carried = self.equations.carried()?;
        let mut found = vec![first.clone()];
        if self.forgets(carried, first) {
            let once = self.ends(carried, &vec![first.clone(); self.windows.len()]);
            found = self.ends(carried, &once);
            let same = |k: &usize| once[*k].is_same(&found[*k], carried.visible);
            let known = (0..found.len()).find(|k| !same(k)).unwrap_or(found.len() - 1);
            found.truncate(known + 1);
        }
        let mut stepper = LaneStepper::new(carried, &self.record.signals, [self.p]);
        for k in found.len() - 1..self.windows.len() - 1 {
            let [end] = self.end_of(carried, &mut stepper, [k], [&found[k]]);
            found.push(end);
        }
        Some(found)
    }

    /// Whether the hidden states end the first window the same wherever they begin it.
    fn forgets(&self, carried: &Equations, first: &Arc) -> bool {
        let elsewhere =
            Arc { z: first.z.iter().map(|z| z + 1.0).collect(), s: first.s.iter().map(|s| s + 1.0).collect() };
        let mut stepper = LaneStepper::new(carried, &self.record.signals, [self.p; 2]);
        let [a, b] = self.end_of(carried, &mut stepper, [0; 2], [first, &elsewhere]);
        a.is_same(&b, carried.visible)
    }

    /// The first start, and where every window but the last ends, side by side.
    fn ends(&self, carried: &Equations, starts: &[Arc]) -> Vec<Arc> {
        let mut stepper = LaneStepper::new(carried, &self.record.signals, [self.p; LANES]);
        let mut found = vec![starts[0].clone()];
        let last = self.windows.len() - 2;
        while found.len() < starts.len() {
            let k: [usize; LANES] = std::array::from_fn(|l| (found.len() - 1 + l).min(last));
            let ends = self.end_of(carried, &mut stepper, k, k.map(|k| &starts[k]));
            let more = starts.len() - found.len();
            found.extend(ends.into_iter().take(more));
        }
        found
    }

    /// The hidden states at the ends of some windows.
    fn end_of<const L: usize>(
        &self,
        carried: &Equations,
        stepper: &mut LaneStepper<L>,
        windows: [usize; L],
        starts: [&Arc; L],
    ) -> [Arc; L] {
        let time = &self.record.time;
        let mut arcs = started(carried.visible, stepper.columns(), |l| &self.starts[windows[l]], |l| starts[l]);
        let rows = windows.map(|k| self.windows[k].clone());
        for r in 0..rows.iter().map(Range::len).max().unwrap_or(0) {
            let from = rows.each_ref().map(|rows| time[(rows.start + r).min(rows.end)]);
            let to = rows.each_ref().map(|rows| time[(rows.start + r + 1).min(rows.end)]);
            stepper.advance(&mut arcs.z, &mut arcs.s, &from, &to);
        }
        std::array::from_fn(|l| arcs.one(l).hidden(carried.visible))
    }

    /// Windows from one on, L at a time, with their hidden states: one for each window, or the first to be carried on.
    /// Ends before a window that does not begin where the one before it ended; says which, and what was found there.
    fn side_by_side<const L: usize>(
        &self,
        from: usize,
        hidden: &[Arc],
        take: &mut impl FnMut(Linear) -> Option<()>,
    ) -> Option<(usize, Option<Arc>)> {
        let (record, visible) = (self.record, self.equations.visible);
        let mut k = from;
        if k == self.windows.len() || L > 1 && hidden.is_empty() && self.equations.n() > visible {
            return Some((k, None));
        }
        let none = Arc::default();
        let mut last = hidden.first().cloned();
        let mut stepper = LaneStepper::new(self.equations, &record.signals, [self.p; L]);
        let mut sums = Sums::new(stepper.columns(), record);
        for windows in self.windows[from..].chunks(L) {
            let next = |l: usize| self.starts.get(k + l + 1).filter(|_| l < windows.len());
            let at = |l: usize| k + l.min(windows.len() - 1);
            let carried = |l: usize| if L == 1 { last.as_ref() } else { hidden.get(at(l)) }.unwrap_or(&none);
            let mut arcs = started(visible, stepper.columns(), |l| &self.starts[at(l)], carried);
            let rows = std::array::from_fn(|l| windows.get(l).cloned().unwrap_or(0..0));
            let goes_on = std::array::from_fn(|l| next(l).is_some());
            sums.clear();
            let isa = stepper.isa();
            let (stepper, arcs, sums) = (&mut stepper, &mut arcs, &mut sums);
            isa.dispatch(Walk { stepper, record, rows: &rows, goes_on: &goes_on, arcs, sums });
            for (l, rows) in rows.iter().enumerate().take(windows.len()) {
                let arc = arcs.one(l);
                take(sums.linear(l, record, rows, &arc, next(l))?)?;
                let end = arc.hidden(visible);
                if L > 1 && hidden.get(k + l + 1).is_some_and(|taken| !taken.is_same(&end, visible)) {
                    return Some((k + l + 1, Some(end)));
                }
                last = Some(end);
            }
            k += windows.len();
        }
        Some((k, None))
    }
}

/// Arcs that begin at poses, with the hidden states as they were carried there.
fn started<'z, const L: usize>(
    visible: usize,
    k: usize,
    begin: impl Fn(usize) -> &'z Vec<f64>,
    hidden: impl Fn(usize) -> &'z Arc,
) -> Arcs<L> {
    let mut z: Vec<[f64; L]> = (0..visible).map(|i| std::array::from_fn(|l| begin(l)[i])).collect();
    z.extend((0..hidden(0).z.len()).map(|i| std::array::from_fn(|l| hidden(l).z[i])));
    let mut s = vec![[0.0; L]; z.len() * k];
    (0..visible).for_each(|i| s[i * k + i] = [1.0; L]);
    for i in visible..z.len() {
        (visible..k).for_each(|c| s[i * k + c] = std::array::from_fn(|l| hidden(l).s[i * k + c]));
    }
    Arcs { z, s }
}

/// What is summed over the rows of L windows.
struct Sums<const L: usize> {
    /// Columns (z, p, 1).
    width: usize,
    channels: Vec<Channel>,
    /// The output that each column of the record is compared with.
    outputs: Vec<usize>,
    /// Upper halves of Σ (J, r)ᵀ(J, r), column by column; empty for a channel that nothing measures.
    gram: [Vec<[f64; L]>; 3],
    blocks: [[Blocks; L]; 3],
    runs: Vec<[Run; L]>,
    line: Vec<[f64; L]>,
}

impl<const L: usize> Sums<L> {
    fn new(columns: usize, record: &Record) -> Self {
        let channels = record.channels();
        let width = columns + 1;
        let entries =
            |kind: usize| if channels.iter().any(|c| *c as usize == kind) { width * (width + 1) / 2 } else { 0 };
        Self {
            width,
            outputs: (0..channels.len()).map(|c| record.output_of(c)).collect(),
            gram: [0, 1, 2].map(|kind| vec![[0.0; L]; entries(kind)]),
            blocks: [[Blocks::default(); L]; 3],
            runs: vec![[Run::default(); L]; channels.len()],
            line: vec![[0.0; L]; width],
            channels,
        }
    }

    fn clear(&mut self) {
        self.gram.iter_mut().for_each(|g| g.fill([0.0; L]));
        self.blocks = [[Blocks::default(); L]; 3];
        self.runs.fill([Run::default(); L]);
    }

    /// The sums of one window; `None` where they, or its end, are undefined.
    fn linear(
        &self,
        l: usize,
        record: &Record,
        rows: &Range<usize>,
        arc: &Arc,
        next: Option<&Vec<f64>>,
    ) -> Option<Linear> {
        let visible = visible_of(record);
        let gram = [0, 1, 2].map(|kind| self.gram_of(kind, l));
        if !arc.z.iter().chain(&arc.s).all(|x| x.is_finite()) || !gram.iter().all(|g| g.iter().all(|x| x.is_finite())) {
            return None;
        }
        let count = [0, 1, 2].map(|kind| self.channels.iter().filter(|c| **c as usize == kind).count() * rows.len());
        let axes = body_axes(arc.z[2], visible);
        let last = if next.is_some() { rows.end } else { rows.end - 1 };
        let duration = record.time[last] - record.time[rows.start];
        let (back, mismatch) = match next {
            Some(next) => {
                let c: Vec<f64> = (0..visible).map(|i| difference_of(i, arc.z[i] - next[i])).collect();
                let mismatch = axes.tr_mul(&nalgebra::DVector::from_column_slice(&c));
                (Some(backwards(&arc.s, &c, visible, self.width - 1)?), mismatch.as_slice().to_vec())
            }
            None => (None, vec![]),
        };
        Some(Linear { gram, count, blocks: self.blocks.map(|b| b[l]), back, axes, duration, mismatch })
    }

    fn gram_of(&self, kind: usize, l: usize) -> DMatrix<f64> {
        let mut gram = DMatrix::zeros(self.width, self.width);
        let mut sums = self.gram[kind].iter();
        for column in 0..self.width {
            for (row, sum) in (0..=column).zip(&mut sums) {
                gram[(row, column)] = sum[l];
                gram[(column, row)] = sum[l];
            }
        }
        gram
    }
}

/// L windows from their first row to their last, sums and all.
struct Walk<'s, 'a, const L: usize> {
    stepper: &'s mut LaneStepper<'a, L>,
    record: &'s Record,
    /// Empty for a lane that has nothing to do.
    rows: &'s [Range<usize>; L],
    /// Whether the next window's start is asked for.
    goes_on: &'s [bool; L],
    arcs: &'s mut Arcs<L>,
    sums: &'s mut Sums<L>,
}

impl<const L: usize> Kernel for Walk<'_, '_, L> {
    #[inline(always)]
    fn run(self) {
        let Self { stepper, record, rows, goes_on, arcs, sums } = self;
        let time = &record.time;
        let mut longest = 0;
        for rows in rows {
            longest = longest.max(rows.len());
        }
        for r in 0..longest {
            let y = stepper.outputs_here(&arcs.z);
            let (mut from, mut to, mut active, mut at) = ([0.0; L], [0.0; L], [false; L], [0; L]);
            for l in 0..L {
                active[l] = r < rows[l].len();
                at[l] = if active[l] { rows[l].start + r } else { 0 };
                from[l] = time[at[l]];
                let moves = active[l] && (r + 1 < rows[l].len() || goes_on[l]);
                to[l] = time[at[l] + usize::from(moves)];
            }
            sums.add(y, &arcs.s, record, &at, &active);
            stepper.advance_here(&mut arcs.z, &mut arcs.s, &from, &to);
        }
    }
}

impl<const L: usize> Sums<L> {
    /// Adds a row of each window: outputs y, sensitivities s.
    #[inline(always)]
    fn add(&mut self, y: &[[f64; L]], s: &[[f64; L]], record: &Record, at: &[usize; L], active: &[bool; L]) {
        let k = self.width - 1;
        let visible = visible_of(record);
        for (c, channel) in self.channels.iter().enumerate() {
            let output = self.outputs[c];
            output_line(y, output, visible, k, s, &mut self.line);
            let measured = &record.columns[c];
            let (kind, rest) = (*channel as usize, &mut self.line[k]);
            for l in 0..L {
                rest[l] = y[output][l] - measured[at[l]];
            }
            if *channel != Channel::Position {
                for l in 0..L {
                    rest[l] = wrapped(rest[l]);
                }
            }
            let mut all = true;
            for l in 0..L {
                all &= active[l];
                if active[l] {
                    self.runs[c][l].push(rest[l], &mut self.blocks[kind][l]);
                }
            }
            if !all {
                for line in &mut self.line {
                    for l in 0..L {
                        line[l] = if active[l] { line[l] } else { 0.0 };
                    }
                }
            }
            add_square(&mut self.gram[kind], &self.line);
        }
    }
}

/// How many states the pose and the trailers make.
fn visible_of(record: &Record) -> usize {
    3 + record.trailers
}

fn difference_of(i: usize, difference: f64) -> f64 {
    if i < 2 { difference } else { wrapped(difference) }
}

/// One row of J: ∂y/∂z·S plus the direct dependence of the sensor on p.
#[inline(always)]
fn output_line<const L: usize>(
    y: &[[f64; L]],
    output: usize,
    visible: usize,
    k: usize,
    s: &[[f64; L]],
    line: &mut [[f64; L]],
) {
    let outputs = visible;
    let row = &y[outputs + output * k..outputs + (output + 1) * k];
    let line = &mut line[..k];
    line.fill([0.0; L]);
    for (j, slope) in row[..visible].iter().enumerate() {
        let mut none = true;
        for l in 0..L {
            none &= slope[l] == 0.0;
        }
        if none {
            continue;
        }
        for (line, s) in line.iter_mut().zip(&s[j * k..(j + 1) * k]) {
            for l in 0..L {
                line[l] += slope[l] * s[l];
            }
        }
    }
    for (line, direct) in line[visible..].iter_mut().zip(&row[visible..]) {
        for l in 0..L {
            line[l] += direct[l];
        }
    }
}

/// Adds the upper half of line·lineᵀ.
#[inline(always)]
fn add_square<const L: usize>(gram: &mut [[f64; L]], line: &[[f64; L]]) {
    let mut rest = gram;
    for (column, right) in line.iter().enumerate() {
        let (own, others) = rest.split_at_mut(column + 1);
        for (sum, left) in own.iter_mut().zip(line) {
            for l in 0..L {
                sum[l] += left[l] * right[l];
            }
        }
        rest = others;
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
