//! Some windows row by row, and what is summed over their rows.

use crate::discrepancy::initial_state::slow_manifold::FORGOTTEN;
use crate::discrepancy::record::angle::wrapped;
use crate::discrepancy::record::run_record::{Channel, Record};
use crate::discrepancy::shooting::block_sums::{Blocks, Run};
use crate::discrepancy::shooting::hidden_start::HiddenStart;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;
use crate::formula::Kernel;
use crate::model::{observation, state};
use crate::motion::{LaneStates, LaneStepper, StateSensitivity};
use crate::numerics::bounded_inverse::bounded_inverse;
use nalgebra::DMatrix;
use std::ops::Range;

/// What is summed over the rows of L windows.
pub(crate) struct NormalEquations<const L: usize> {
    /// Columns (z, p, 1), and before the last those of the start of hidden states, if any.
    width: usize,
    /// How many of them are (z, p).
    columns: usize,
    channels: Vec<Channel>,
    /// How many quantities are measured beside the pose, and the first component of their noise.
    quantities: usize,
    first_quantity: usize,
    /// Upper halves of Σ (J, r)ᵀ(J, r) for each component of the noise, column by column; empty where nothing has it.
    gram: Vec<Vec<[f64; L]>>,
    blocks: Vec<[Blocks; L]>,
    runs: Vec<[Run; L]>,
    line: Vec<[f64; L]>,
}

impl<const L: usize> NormalEquations<L> {
    /// Sums of as many columns, and of some more for the start of hidden states.
    pub fn new(columns: usize, hidden_starts: usize, record: &Record) -> Self {
        let channels = record.channels();
        let width = columns + hidden_starts + 1;
        let first_quantity = observation::sensor_noise(record.freedom().clone()).len();
        let (quantities, kinds) = (record.quantities.len(), first_quantity + record.freedom().quantities.len());
        let mut sums = Self {
            width,
            columns,
            quantities,
            first_quantity,
            gram: vec![],
            blocks: vec![[Blocks::default(); L]; kinds],
            runs: vec![[Run::default(); L]; channels.len() + quantities],
            line: vec![[0.0; L]; width],
            channels,
        };
        let entries = |kind: usize| if sums.columns(kind) > 0 { width * (width + 1) / 2 } else { 0 };
        sums.gram = (0..kinds).map(|kind| vec![[0.0; L]; entries(kind)]).collect();
        sums
    }

    /// How many columns have the noise of a kind.
    fn columns(&self, kind: usize) -> usize {
        let of_pose = self.channels.iter().filter(|c| c.noise == kind).count();
        of_pose + usize::from(kind >= self.first_quantity && self.quantities > 0)
    }

    pub fn clear(&mut self) {
        self.gram.iter_mut().for_each(|g| g.fill([0.0; L]));
        self.blocks.fill([Blocks::default(); L]);
        self.runs.fill([Run::default(); L]);
    }

    /// The sums of one window, by (z, p, 1); `None` where they, or its end, are undefined.
    pub(super) fn linear(
        &self,
        l: usize,
        record: &Record,
        rows: &Range<usize>,
        (arc, start): (&StateSensitivity, &HiddenStart),
        next: Option<&Vec<f64>>,
    ) -> Option<LinearisedWindow> {
        let visible = visible_of(record);
        let kinds = 0..self.gram.len();
        let gram: Vec<DMatrix<f64>> = kinds.clone().map(|kind| start.in_gram(self.gram_of(kind, l))).collect();
        if !arc.z.iter().chain(&arc.s).all(|x| x.is_finite()) || !gram.iter().all(|g| g.iter().all(|x| x.is_finite())) {
            return None;
        }
        let count = kinds.map(|kind| self.columns(kind) * rows.len()).collect();
        let axes = body_axes(arc.z[state::DIRECTION], visible);
        let last = if next.is_some() { rows.end } else { rows.end - 1 };
        let duration = record.time[last] - record.time[rows.start];
        let (back, mismatch) = match next {
            Some(next) => {
                let differences = arc.z.iter().zip(next).map(|(end, next)| end - next);
                let c: Vec<f64> = nodes_of(record)
                    .zip(differences)
                    .map(|(node, d)| if node.is_angle { wrapped(d) } else { d })
                    .collect();
                let mismatch = axes.tr_mul(&nalgebra::DVector::from_column_slice(&c));
                (Some(backwards(&arc.s, &c, visible, self.columns)?), mismatch.as_slice().to_vec())
            }
            None => (None, vec![]),
        };
        Some(LinearisedWindow {
            gram,
            count,
            blocks: self.blocks.iter().map(|b| b[l]).collect(),
            back,
            axes,
            duration,
            mismatch,
            initial_state_dof: 0.0,
        })
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
pub(crate) struct WindowKernel<'s, 'a, const L: usize> {
    pub stepper: &'s mut LaneStepper<'a, L>,
    pub record: &'s Record,
    /// Empty for a lane that has nothing to do.
    pub rows: &'s [Range<usize>; L],
    /// Whether the next window's start is asked for.
    pub goes_on: &'s [bool; L],
    pub arcs: &'s mut LaneStates<L>,
    pub sums: &'s mut NormalEquations<L>,
}

impl<const L: usize> Kernel for WindowKernel<'_, '_, L> {
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
            if sums.quantities > 0 {
                stepper.evaluate_quantities(&arcs.z, &from);
                sums.add_quantities(stepper, arcs, record, &at, &active);
            }
            stepper.advance(&mut arcs.z, &mut arcs.s, &from, &to);
        }
    }
}

impl<const L: usize> NormalEquations<L> {
    /// Adds a row of each window: outputs y, sensitivities s.
    #[inline(always)]
    fn add(&mut self, y: &[[f64; L]], s: &[[f64; L]], record: &Record, at: &[usize; L], active: &[bool; L]) {
        let k = self.width - 1;
        let visible = visible_of(record);
        for c in 0..self.channels.len() {
            let channel = self.channels[c];
            output_line(y, channel.output, visible, self.columns, s, &mut self.line[..k]);
            let measured = &record.columns[channel.column];
            let (kind, rest) = (channel.noise, &mut self.line[k]);
            for l in 0..L {
                rest[l] = y[channel.output][l] - measured[at[l]];
            }
            if channel.is_angle {
                for rest in rest.iter_mut() {
                    *rest = wrapped(*rest);
                }
            }
            if let Some(weights) = record.weights.of(channel.column) {
                for line in &mut self.line {
                    for l in 0..L {
                        line[l] *= weights[at[l]];
                    }
                }
            }
            self.sum(c, kind, active);
        }
    }

    /// Adds what is measured beside the pose, evaluated at a row of each window.
    #[inline(always)]
    fn add_quantities(
        &mut self,
        stepper: &LaneStepper<L>,
        arcs: &LaneStates<L>,
        record: &Record,
        at: &[usize; L],
        active: &[bool; L],
    ) {
        let k = self.width - 1;
        for (i, measured) in record.quantities.iter().enumerate() {
            let value = stepper.quantity(i, arcs.z.len(), &arcs.s, &mut self.line[..k]);
            for l in 0..L {
                self.line[k][l] = value[l] - measured[at[l]];
            }
            self.sum(self.channels.len() + i, self.first_quantity + i, active);
        }
    }

    /// Adds the line of a column, whose noise is of a kind, where its window has a row.
    #[inline(always)]
    fn sum(&mut self, column: usize, kind: usize, active: &[bool; L]) {
        let rest = self.line[self.width - 1];
        let mut all = true;
        for l in 0..L {
            all &= active[l];
            if active[l] {
                self.runs[column][l].push(rest[l], &mut self.blocks[kind][l]);
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

/// The states that are free at the start of every window.
fn nodes_of(record: &Record) -> impl ExactSizeIterator<Item = state::Node> {
    state::nodes(record.freedom().clone())
}

/// How many there are.
pub(crate) fn visible_of(record: &Record) -> usize {
    nodes_of(record).len()
}

/// One row of J: ∂y/∂z·S plus the direct dependence of the sensor on the first columns, (z, p).
#[inline(always)]
fn output_line<const L: usize>(
    y: &[[f64; L]],
    output: usize,
    visible: usize,
    columns: usize,
    s: &[[f64; L]],
    line: &mut [[f64; L]],
) {
    let outputs = visible;
    let row = &y[outputs + output * columns..outputs + (output + 1) * columns];
    let k = line.len();
    line.fill([0.0; L]);
    for (j, slope) in row[..visible].iter().enumerate() {
        let mut none = true;
        for slope in slope {
            none &= *slope == 0.0;
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
    let [x, y] = state::PLACE;
    axes[(x, x)] = cos;
    axes[(x, y)] = -sin;
    axes[(y, x)] = sin;
    axes[(y, y)] = cos;
    axes
}

/// δz = F⁻¹(δz̃ − B·δp − c) as a matrix on (δz̃, δp, 1).
fn backwards(s: &[f64], c: &[f64], visible: usize, k: usize) -> Option<DMatrix<f64>> {
    let f = DMatrix::from_fn(visible, visible, |i, j| s[i * k + j]);
    let inverse = bounded_inverse(&f, FORGOTTEN)?;
    let mut right = DMatrix::zeros(visible, k + 1);
    for i in 0..visible {
        right[(i, i)] = 1.0;
        (visible..k).for_each(|j| right[(i, j)] = -s[i * k + j]);
        right[(i, k)] = -c[i];
    }
    Some(inverse * right)
}
