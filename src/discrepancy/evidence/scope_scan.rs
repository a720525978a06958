//! Change-point scan with the score test: what an effect would gain if it held in a part of the data alone.
//!
//! The data are cut into blocks of windows, and the effect gets a value of its own in each. One elimination of the poses
//! gives the gradient g and the information A of these values, all else free. An effect that holds with one value where
//! s is one, and nowhere else, then gains (sᵀg)²/(sᵀ·A·s); so every scope costs a quadratic form, and no pass over the
//! data (Rao's score test; Page, 1954, for the change of a level).

use super::cross_validation::Along;
use crate::discrepancy::estimation::elimination::{InformationFilter, ReducedForm};
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;
use crate::discrepancy::shooting::windows::Segment;
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// Blocks of windows at most.
const MOST_BLOCKS: usize = 120;

/// How the windows of all segments are put into blocks.
#[derive(Clone, Debug)]
pub(crate) struct Blocks {
    /// The block of each window, segment by segment.
    of_window: Vec<Vec<usize>>,
    /// How many there are.
    pub count: usize,
}

impl Blocks {
    /// Neighbouring windows of one segment in blocks of one size.
    pub fn of(windows: &[usize]) -> Self {
        let all: usize = windows.iter().sum();
        let size = all.div_ceil(MOST_BLOCKS).max(1);
        let mut count = 0;
        let of_segment = |n: &usize| {
            let first = count;
            count += n.div_ceil(size);
            (0..*n).map(|k| first + k / size).collect()
        };
        let of_window = windows.iter().map(of_segment).collect();
        Self { of_window, count }
    }

    /// Of the windows of a plan.
    pub fn of_plan(plan: &[Segment]) -> Self {
        Self::of(&plan.iter().map(|s| s.windows.len()).collect::<Vec<_>>())
    }

    /// The run and the rows of every block.
    pub fn rows(&self, plan: &[Segment]) -> Vec<(usize, Range<usize>)> {
        let of = |(segment, own): (usize, Range<usize>)| {
            let Segment { record, windows } = &plan[segment];
            (*record, windows[own.start].start..windows[own.end - 1].end)
        };
        self.windows().into_iter().map(of).collect()
    }

    /// The windows of every block: segment, and places of the windows within it.
    fn windows(&self) -> Vec<(usize, Range<usize>)> {
        let mut found: Vec<(usize, Range<usize>)> = vec![(0, 0..0); self.count];
        for (segment, blocks) in self.of_window.iter().enumerate() {
            for (window, block) in blocks.iter().enumerate() {
                let own = &mut found[*block];
                let from = if own.1.is_empty() { window } else { own.1.start };
                *own = (segment, from..window + 1);
            }
        }
        found
    }
}

/// Gradient and information of an effect's values block by block, everything else free.
#[derive(Clone, Debug)]
pub(crate) struct BlockScores {
    /// Parameters of the effect.
    parameters: usize,
    pub(crate) information: DMatrix<f64>,
    pub(crate) gradient: DVector<f64>,
}

impl BlockScores {
    /// Of the parameters in some columns of windows that are linearised in `all` of them, beside others that are kept.
    pub fn of(
        linear: &Along,
        blocks: &Blocks,
        v: &NoiseModel,
        all: usize,
        kept: &[usize],
        own: &[usize],
    ) -> Option<Self> {
        let (k, wide) = (own.len(), blocks.count * own.len());
        let (mut information, mut gradient) =
            (DMatrix::zeros(kept.len() + wide, kept.len() + wide), DVector::zeros(kept.len() + wide));
        for (windows, of_window) in linear.iter().zip(&blocks.of_window) {
            let Some(first) = of_window.first() else { continue };
            let (part, slope) = segment_normal(windows, of_window, v, all, kept, own)?;
            // The values kept stand first, then those of the segment's own blocks.
            let place = |i: usize| if i < kept.len() { i } else { i + first * k };
            for j in 0..slope.len() {
                gradient[place(j)] += slope[j];
                (0..slope.len()).for_each(|i| information[(place(i), place(j))] += part[(i, j)]);
            }
        }
        let (known, open) = (0..kept.len(), kept.len()..kept.len() + wide);
        let part =
            |r: &Range<usize>, c: &Range<usize>| information.view((r.start, c.start), (r.len(), c.len())).into_owned();
        let (mut a, mut g) = (part(&open, &open), gradient.rows(open.start, wide).into_owned());
        if !known.is_empty() {
            let mut corner = part(&known, &known);
            (0..corner.nrows()).for_each(|i| corner[(i, i)] *= 1.0 + 1e-9);
            let corner = corner.cholesky()?;
            let across = part(&known, &open);
            g -= across.tr_mul(&corner.solve(&gradient.rows(0, known.len()).into_owned()));
            a -= across.tr_mul(&corner.solve(&across));
        }
        Some(Self { parameters: k, information: a, gradient: g })
    }

    /// What one value gains where a share of each block is in scope.
    pub fn gain(&self, share: &[f64]) -> f64 {
        let k = self.parameters;
        let on: Vec<usize> = (0..share.len()).filter(|b| share[*b] > 0.0).collect();
        let mut g = DVector::zeros(k);
        let mut a = DMatrix::zeros(k, k);
        for i in &on {
            for p in 0..k {
                g[p] += share[*i] * self.gradient[i * k + p];
                for (j, q) in on.iter().flat_map(|j| (0..k).map(move |q| (j, q))) {
                    a[(p, q)] += share[*i] * share[*j] * self.information[(i * k + p, j * k + q)];
                }
            }
        }
        gained(g, a)
    }

    /// Sums of gradient and information over the blocks before each, for gains of intervals.
    pub fn cumulated(&self) -> Cumulated {
        let (k, n) = (self.parameters, self.gradient.len() / self.parameters);
        let mut g = vec![DVector::zeros(k); n + 1];
        let mut a = vec![DMatrix::zeros(k, k); (n + 1) * (n + 1)];
        for i in 0..n {
            g[i + 1] = &g[i] + self.gradient.rows(i * k, k);
            for j in 0..n {
                let here = self.information.view((i * k, j * k), (k, k));
                a[(i + 1) * (n + 1) + j + 1] =
                    &a[i * (n + 1) + j + 1] + &a[(i + 1) * (n + 1) + j] - &a[i * (n + 1) + j] + here;
            }
        }
        Cumulated { blocks: n, g, a }
    }
}

/// Sums over the blocks before each.
pub(crate) struct Cumulated {
    /// How many blocks there are.
    pub blocks: usize,
    g: Vec<DVector<f64>>,
    a: Vec<DMatrix<f64>>,
}

impl Cumulated {
    /// The sums over some intervals of blocks that do not overlap.
    pub fn taken(&self, intervals: &[Range<usize>]) -> Taken {
        let n = self.blocks + 1;
        let k = self.g[0].len();
        let mut along = vec![DMatrix::zeros(k, k); n];
        let mut g = DVector::zeros(k);
        for i in intervals {
            g += &self.g[i.end] - &self.g[i.start];
            for (j, sum) in along.iter_mut().enumerate() {
                *sum += &self.a[i.end * n + j] - &self.a[i.start * n + j];
            }
        }
        let a = intervals.iter().fold(DMatrix::zeros(k, k), |a, i| a + (&along[i.end] - &along[i.start]));
        Taken { g, a, along }
    }

    /// What one value gains in intervals with one more, or with one taken out of them.
    pub fn gain_with(&self, taken: &Taken, ends: &Range<usize>, is_more: bool) -> f64 {
        let n = self.blocks + 1;
        let sign = if is_more { 1.0 } else { -1.0 };
        let Range { start, end } = *ends;
        if taken.g.len() == 1 {
            let g = taken.g[0] + sign * (self.g[end][0] - self.g[start][0]);
            let across = taken.along[end][0] - taken.along[start][0];
            let at = |i: usize, j: usize| self.a[i * n + j][0];
            let own = at(end, end) + at(start, start) - at(start, end) - at(end, start);
            let a = taken.a[0] + 2.0 * sign * across + own;
            return if a > 0.0 { g * g / (a * (1.0 + 1e-9)) } else { 0.0 };
        }
        let g = &taken.g + (&self.g[end] - &self.g[start]) * sign;
        let across = &taken.along[end] - &taken.along[start];
        let at = |i: usize, j: usize| &self.a[i * n + j];
        let own = at(end, end) + at(start, start) - at(start, end) - at(end, start);
        gained(g, &taken.a + (&across + across.transpose()) * sign + own)
    }
}

/// Sums over intervals of blocks, and of the information that they have with the blocks before each.
pub(crate) struct Taken {
    g: DVector<f64>,
    a: DMatrix<f64>,
    along: Vec<DMatrix<f64>>,
}

/// gᵀ·A⁻¹·g; nothing where the data say nothing.
fn gained(g: DVector<f64>, mut a: DMatrix<f64>) -> f64 {
    (0..g.len()).for_each(|p| a[(p, p)] = if a[(p, p)] > 0.0 { a[(p, p)] * (1.0 + 1e-9) } else { 1.0 });
    a.cholesky().map_or(0.0, |a| g.dot(&a.solve(&g)))
}

/// Information and gradient of a segment: of the values kept and of those in its own blocks.
///
/// A window depends on the values of blocks up to its own, so the form grows with each block that begins.
fn segment_normal(
    windows: &[LinearisedWindow],
    of_window: &[usize],
    v: &NoiseModel,
    all: usize,
    kept: &[usize],
    own: &[usize],
) -> Option<(DMatrix<f64>, DVector<f64>)> {
    let mut chain = InformationFilter::new(v, kept.len() + own.len(), false);
    let (first, mut last) = (of_window[0], of_window[0]);
    for (window, block) in windows.iter().zip(of_window) {
        chain.grow((block - last) * own.len());
        last = *block;
        chain.push(&in_block(window, all, kept, own, block - first, block - first + 1))?;
    }
    let mut joined = ReducedForm::nothing(kept.len() + (last - first + 1) * own.len());
    joined.add(chain)?;
    Some(joined.normal())
}

/// A window whose columns are its poses, the parameters kept, and for each block the effect's own: zero but in its own.
fn in_block(
    window: &LinearisedWindow,
    all: usize,
    kept: &[usize],
    own: &[usize],
    block: usize,
    blocks: usize,
) -> LinearisedWindow {
    let poses = window.gram[0].nrows() - 1 - all;
    let begin = poses + kept.len() + block * own.len();
    let n = poses + kept.len() + blocks * own.len() + 1;
    // The columns that are not zero: of the wider window, and of the window as it is.
    let columns: Vec<(usize, usize)> = (0..poses)
        .map(|j| (j, j))
        .chain(kept.iter().enumerate().map(|(i, c)| (poses + i, poses + c)))
        .chain(own.iter().enumerate().map(|(i, c)| (begin + i, poses + c)))
        .chain([(n - 1, poses + all)])
        .collect();
    let wide = |g: &DMatrix<f64>| {
        let mut out = DMatrix::zeros(n, n);
        for (i, from_i) in &columns {
            columns.iter().for_each(|(j, from_j)| out[(*i, *j)] = g[(*from_i, *from_j)]);
        }
        out
    };
    // What is measured by nothing adds nothing; the first tells the size.
    let unless_empty = |i: usize, n: usize, g: &DMatrix<f64>| {
        if i == 0 || n > 0 { wide(g) } else { DMatrix::zeros(0, 0) }
    };
    let wide_back = |b: &DMatrix<f64>| {
        let mut out = DMatrix::zeros(poses, n);
        for (j, from) in &columns {
            out.column_mut(*j).copy_from(&b.column(*from));
        }
        out
    };
    LinearisedWindow {
        gram: window.gram.iter().zip(&window.count).enumerate().map(|(i, (g, n))| unless_empty(i, *n, g)).collect(),
        back: window.back.as_ref().map(wide_back),
        ..window.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Five blocks of one value and of two: what is gained with an interval more, or less, is what all of them gain.
    #[test]
    fn a_change_of_intervals_gains_what_the_intervals_gain() {
        for k in [1, 2] {
            let n = 5 * k;
            let root = DMatrix::from_fn(n, n, |i, j| ((3 * i + 7 * j) as f64).sin());
            let information = &root * root.transpose() + DMatrix::identity(n, n);
            let gradient = DVector::from_fn(n, |i, _| (1.0 + i as f64).cos());
            let scores = BlockScores { parameters: k, information, gradient };
            let sums = scores.cumulated();
            let is_same = |a: f64, b: f64| (a - b).abs() < 1e-9 * b;
            let whole = sums.taken(&[0..2, 3..5]);
            let alone = |interval: Range<usize>| sums.taken(&[interval]);
            let some = alone(0..4);
            assert!(is_same(sums.gain_with(&whole, &(2..3), true), scores.gain(&[1.0; 5])));
            assert!(is_same(sums.gain_with(&some, &(1..3), false), scores.gain(&[1.0, 0.0, 0.0, 1.0, 0.0])));
            assert!(is_same(sums.gain_with(&alone(0..2), &(3..5), true), scores.gain(&[1.0, 1.0, 0.0, 1.0, 1.0])));
        }
    }
}
