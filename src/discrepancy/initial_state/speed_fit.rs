//! Speeds that forces change, at a row of a log: the model's own motion through the rows around it, by least squares.

use super::hidden_states;
use super::pose::pose_of;
use crate::discrepancy::record::local_polynomial;
use crate::discrepancy::record::run_record::Record;
use crate::model::Equations;
use crate::motion::{StateSensitivity, Stepper};
use nalgebra::{Cholesky, DMatrix, DVector};
use std::ops::Range;

/// Rows from so long before a row to so long after it, s.
pub const AROUND: [f64; 2] = [0.75, 0.75];
/// The same where a prediction begins: what comes is not looked at.
pub const BEFORE: [f64; 2] = [1.5, 0.0];
/// At the start of a log less has gone before: then as much as this is looked at, s.
const LEAST: f64 = 1.5;
/// Steps of Gauss and Newton.
const STEPS: usize = 4;
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
    if equations.poses == equations.visible {
        return None;
    }
    let rows = stretch(record, row, around);
    let noise = noises(record);
    let mut begin = pose_of(equations, &record.smoothed(rows.start));
    let mut last = None;
    for _ in 0..STEPS {
        let along = Along::of(equations, record, &rows, row, &begin, &noise)?;
        let information = Cholesky::new(along.information.clone())?;
        let step = information.solve(&along.gradient);
        if !step.iter().all(|s| s.is_finite()) {
            return None;
        }
        begin.iter_mut().zip(step.iter()).for_each(|(z, s)| *z -= s);
        let covariance_at_first = information.inverse();
        let all = &along.there * &covariance_at_first * along.there.transpose();
        let moved = &along.there * &step;
        let m = begin.len();
        last = Some(SpeedFit {
            state: along.state.iter().zip(moved.iter()).map(|(z, s)| z - s).collect(),
            covariance: all.view((0, 0), (m, m)).into_owned(),
            first: (rows.start, along.first),
            covariance_at_first,
        });
    }
    last.filter(|fit| fit.state.iter().chain(fit.covariance.iter()).all(|v| v.is_finite()))
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

/// The noise of each column, as its rows show it.
fn noises(record: &Record) -> Vec<f64> {
    let rows = record.rows.clone();
    let noise = |c: &Vec<f64>| local_polynomial::noise(&record.time[rows.clone()], &c[rows.clone()]);
    record.columns.iter().map(|c| noise(c).unwrap_or(1e-3).max(1e-9)).collect()
}

/// A motion along rows, what it misses, and where it is at one of them.
struct Along {
    information: DMatrix<f64>,
    gradient: DVector<f64>,
    /// The states at the row.
    state: Vec<f64>,
    /// How they hang on the nodes at the first.
    there: DMatrix<f64>,
    /// The arc at the first.
    first: StateSensitivity,
}

impl Along {
    fn of(
        equations: &Equations,
        record: &Record,
        rows: &Range<usize>,
        row: usize,
        begin: &[f64],
        noise: &[f64],
    ) -> Option<Self> {
        let m = equations.visible;
        let mut stepper = Stepper::new(equations, &record.signals, &[]);
        let hidden = hidden_states::carried(equations, &[], record, rows.start, begin);
        let mut arc = begun(&stepper, begin, &hidden);
        let first = arc.clone();
        let mut information = DMatrix::identity(m, m) * WEAK;
        let mut gradient = DVector::zeros(m);
        let mut there = None;
        for i in rows.clone() {
            let all = DMatrix::from_row_slice(arc.z.len(), m, &arc.s);
            let s = all.rows(0, m);
            let y = stepper.outputs(&arc.z);
            for channel in record.channels() {
                let slopes = DMatrix::from_row_slice(1, m, &y[m + channel.output * m..][..m]) * s;
                let sigma = noise[channel.column] * record.weights.deviation(channel.column, i);
                let off = channel.difference(y[channel.output] - record.columns[channel.column][i]) / sigma;
                let line = slopes.transpose() / sigma;
                information.ger(1.0, &line.column(0), &line.column(0), 1.0);
                gradient.axpy(off, &line.column(0), 1.0);
            }
            if i == row {
                there = Some((arc.z.clone(), all));
            }
            if i + 1 < rows.end {
                stepper.advance(&mut arc, record.time[i], record.time[i + 1]);
            }
        }
        let (state, there) = there?;
        Some(Self { information, gradient, state, there, first })
    }
}

/// An arc that begins at nodes, with the states that follow them.
fn begun(stepper: &Stepper, nodes: &[f64], hidden: &StateSensitivity) -> StateSensitivity {
    let mut arc = stepper.start(&[nodes, &hidden.z].concat(), None);
    let from = nodes.len() * stepper.columns();
    if hidden.s.len() == arc.s.len() {
        arc.s[from..].copy_from_slice(&hidden.s[from..]);
    }
    arc
}

/// The covariance of what a sensor measures after a motion that begins at nodes of a covariance: by output.
pub fn spread(stepper: &mut Stepper, arc: &StateSensitivity, covariance: &DMatrix<f64>) -> DMatrix<f64> {
    let m = covariance.nrows();
    let s = DMatrix::from_row_slice(m, m, &arc.s[..m * m]);
    let y = stepper.outputs(&arc.z);
    let by = DMatrix::from_fn(m, m, |i, k| y[m + i * m + k]) * s;
    &by * covariance * by.transpose()
}
