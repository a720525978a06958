//! Speeds that forces change, at a row of a log: the model's own motion through the rows around it, by least squares.

use super::hidden_states;
use super::pose::pose_of;
use crate::discrepancy::record::run_record::{Channel, Record};
use crate::model::Equations;
use crate::motion::{StateSensitivity, Stepper};
use crate::numerics::levenberg_marquardt::{Damping, LeastSquares, Minimum, minimise};
use nalgebra::{Cholesky, DMatrix, DVector};
use std::ops::Range;

/// Rows from so long before a row to so long after it, s.
pub const AROUND: [f64; 2] = [0.75, 0.75];
/// The same where a prediction begins: what comes is not looked at.
pub const BEFORE: [f64; 2] = [1.5, 0.0];
/// At the start of a log less has gone before: then as much as this is looked at, s.
const LEAST: f64 = 1.5;
/// Steps of Levenberg and Marquardt at most.
const MOST_STEPS: usize = 12;
/// A step that gains less, in units of χ², is the last: what one leaves goes with the square of what it gains.
const SETTLED: f64 = 1e-3;
/// A vanishing information on every state, so that what no row shows stays where it is.
const WEAK: f64 = 1e-6;

/// The state of a vehicle at a row with what the noise of the rows around it makes of it.
#[derive(Clone, Debug)]
pub struct SpeedFit {
    /// Pose, speeds, and the states that follow them.
    pub state: Vec<f64>,
    /// The covariance of pose and speeds for the noise that the rows show.
    pub covariance: DMatrix<f64>,
    /// The row that the motion was followed from, and the state there.
    pub first: (usize, StateSensitivity),
    /// The covariance of pose and speeds there.
    pub covariance_at_first: DMatrix<f64>,
}

/// Pose and speeds at a row by the rows around it; `None` where a vehicle has no such speeds, or the rows do not tell.
pub fn speeds_at(equations: &Equations, record: &Record, row: usize, around: [f64; 2]) -> Option<SpeedFit> {
    if !equations.has_speeds() {
        return None;
    }
    let rows = stretch(record, row, around);
    let first = rows.start;
    let squares = Stretch { equations, record, channels: record.channels(), rows, row };
    let begin = pose_of(equations, &record.smoothed(first));
    let Minimum { here, step, is_settled, .. } = minimise(&squares, squares.at(begin)?, &Damping::USUAL, MOST_STEPS);
    // Where the steps end before it settles the last point still fits the rows better than slopes do.
    let step = step.filter(|_| is_settled).unwrap_or_else(|| DVector::zeros(equations.visible));
    let covariance_at_first = Cholesky::new(here.information.clone())?.inverse();
    let m = equations.visible;
    let all = &here.there * &covariance_at_first * here.there.transpose();
    let moved = &here.there * &step;
    let fit = SpeedFit {
        state: here.state.iter().zip(moved.iter()).map(|(z, s)| z + s).collect(),
        covariance: all.view((0, 0), (m, m)).into_owned(),
        first: (first, here.begin),
        covariance_at_first,
    };
    fit.state.iter().chain(fit.covariance.iter()).all(|v| v.is_finite()).then_some(fit)
}

/// Rows around a row without a gap, none beyond those that take part.
fn stretch(record: &Record, row: usize, [before, after]: [f64; 2]) -> Range<usize> {
    let (time, gap) = (&record.time, record.gap());
    let joined = |i: usize| time[i + 1] - time[i] <= gap;
    let first = (0..row).rev().take_while(|i| joined(*i) && time[row] - time[*i] <= before).last().unwrap_or(row);
    let after = after.max(LEAST - (time[row] - time[first]));
    let last = (row + 1..record.rows.end).take_while(|i| joined(i - 1) && time[*i] - time[row] <= after).last();
    first..last.unwrap_or(row) + 1
}

/// What a motion that begins at some nodes misses of the rows of a stretch, in units of their noise, as a sum of squares.
struct Stretch<'a> {
    equations: &'a Equations,
    record: &'a Record,
    channels: Vec<Channel>,
    rows: Range<usize>,
    row: usize,
}

/// A motion along a stretch, what it misses, and where it is at one of its rows.
struct Along {
    /// The arc at the first row.
    begin: StateSensitivity,
    information: DMatrix<f64>,
    gradient: DVector<f64>,
    /// Half the sum of squares.
    half: f64,
    /// The states at the row.
    state: Vec<f64>,
    /// How they hang on the nodes at the first.
    there: DMatrix<f64>,
}

impl Stretch<'_> {
    /// The motion from some nodes; `None` where it is undefined.
    fn at(&self, nodes: Vec<f64>) -> Option<Along> {
        let Self { equations, record, .. } = self;
        let m = equations.visible;
        let mut stepper = Stepper::new(equations, &record.signals, &[]);
        let hidden = hidden_states::carried(equations, &[], record, self.rows.start, &nodes);
        let mut arc = stepper.start(&[&nodes[..], &hidden.z].concat(), Some(&hidden.s));
        let mut along = Along {
            begin: arc.clone(),
            information: DMatrix::identity(m, m) * WEAK,
            gradient: DVector::zeros(m),
            half: 0.0,
            state: vec![],
            there: DMatrix::zeros(0, 0),
        };
        for i in self.rows.clone() {
            let all = DMatrix::from_row_slice(arc.z.len(), m, &arc.s);
            let y = stepper.outputs(&arc.z);
            for channel in &self.channels {
                let slopes = DMatrix::from_row_slice(1, m, &y[m + channel.output * m..][..m]) * all.rows(0, m);
                let sigma = record.noise_of(channel.column) * record.weights.deviation(channel.column, i);
                let off = channel.difference(y[channel.output] - record.columns[channel.column][i]) / sigma;
                along.add(off, &(slopes.transpose().column(0) / sigma));
            }
            if !record.quantities.is_empty() {
                let there = stepper.quantities(&arc, record.time[i]);
                for (k, (value, slopes)) in there.into_iter().enumerate() {
                    let sigma = record.noise_of_quantity(k);
                    along.add((value - record.quantities[k][i]) / sigma, &(DVector::from_vec(slopes) / sigma));
                }
            }
            if i == self.row {
                (along.state, along.there) = (arc.z.clone(), all);
            }
            if i + 1 < self.rows.end {
                stepper.advance(&mut arc, record.time[i], record.time[i + 1]);
            }
        }
        along.half.is_finite().then_some(along)
    }
}

impl Along {
    /// Adds a residual and its slopes by the nodes, in units of its noise.
    fn add(&mut self, off: f64, slopes: &DVector<f64>) {
        self.information.ger(1.0, slopes, slopes, 1.0);
        self.gradient.axpy(off, slopes, 1.0);
        self.half += 0.5 * off * off;
    }
}

impl LeastSquares for Stretch<'_> {
    type Point = Along;

    fn normal(&self, here: &Along) -> (DMatrix<f64>, DVector<f64>) {
        (here.information.clone(), here.gradient.clone())
    }

    fn next(&self, here: &Along, step: &DVector<f64>, _: f64) -> Option<Along> {
        self.at(here.begin.z.iter().zip(step.iter()).map(|(z, s)| z + s).collect())
    }

    fn gain(&self, here: &Along, next: &Along, _: f64) -> f64 {
        here.half - next.half
    }

    fn tolerance(&self, here: &Along) -> f64 {
        1e-9 * here.half
    }

    fn is_small(&self, here: &Along, step: &DVector<f64>, _: Option<f64>) -> bool {
        // A model that misses something leaves more than noise: then less is asked for.
        -here.gradient.dot(step) < SETTLED * (here.half / self.rows.len() as f64).max(1.0)
    }
}

/// The covariance of what a sensor measures after a motion that begins at nodes of a covariance: by output.
pub fn spread(stepper: &mut Stepper, arc: &StateSensitivity, covariance: &DMatrix<f64>) -> DMatrix<f64> {
    let m = covariance.nrows();
    let s = DMatrix::from_row_slice(m, m, &arc.s[..m * m]);
    let y = stepper.outputs(&arc.z);
    let by = DMatrix::from_fn(m, m, |i, k| y[m + i * m + k]) * s;
    &by * covariance * by.transpose()
}
