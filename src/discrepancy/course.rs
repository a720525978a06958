//! The heading of a vehicle whose heading nothing measures, from where its model says it went.

use super::angle::wrapped;
use super::carry;
use super::problem::pose_of;
use super::record::Record;
use crate::model::Equations;
use crate::motion::{Arc, Stepper};
use nalgebra::{Rotation2, Vector2};
use std::ops::Range;

/// Half width of the stretch that is laid on the measured path, s; wider where the vehicle hardly moves.
const HALF_WIDTHS: [f64; 3] = [1.0, 3.0, 9.0];
/// Points this many times their noise from their mean, all together, tell a direction.
const LONG_ENOUGH: f64 = 20.0;
/// Headings that differ by more do not agree, rad.
const AGREEMENT: f64 = 0.5;
/// Rounds; more than one because drift and slopes know where north is.
const ROUNDS: usize = 3;

/// A row with what errors of its x and y do to a heading.
pub type Weight = (usize, f64, f64);

/// A heading with what position noise does to it.
#[derive(Clone, Debug, Default)]
pub struct Course {
    /// The measured heading at the row, as a sensor would give it, rad.
    pub heading: f64,
    /// How far the points that tell it reach, m: the root of the sum of squares about their mean.
    pub reach: f64,
    /// δheading = Σ (a·δx + b·δy) over rows: (row, a, b).
    pub weights: Vec<Weight>,
}

impl Course {
    /// What errors of the positions do to the heading.
    pub fn error(&self, of: impl Fn(usize) -> [f64; 2]) -> f64 {
        self.weights.iter().map(|(i, a, b)| [*a, *b].iter().zip(of(*i)).map(|(w, e)| w * e).sum::<f64>()).sum()
    }
}

/// The heading at a row: the model's own motion around it, turned until it lies best on the measured path.
///
/// θ = atan2(Σ p×m, Σ p·m) with the modelled points p and the measured points m about their means. Reversing, sliding
/// and a tracked point off the axle are in the motion, which a direction of travel alone does not know.
pub fn heading_at(equations: &Equations, record: &Record, row: usize) -> Course {
    let noise = record.position_noise();
    let mut best = Course { heading: record.smoothed(row)[2], ..Course::default() };
    for half in HALF_WIDTHS {
        let Some(course) = laid_on(equations, record, row, half, best.heading) else { continue };
        best = course;
        if best.reach > LONG_ENOUGH * noise {
            break;
        }
    }
    best
}

/// The heading from a stretch.
fn laid_on(equations: &Equations, record: &Record, row: usize, half: f64, guess: f64) -> Option<Course> {
    let rows = stretch(record, row, half);
    if rows.len() < 3 {
        return None;
    }
    // Forward from the stretch's first row: states that forget would blow up backwards.
    let mut begin = guess;
    let mut course = None;
    for _ in 0..ROUNDS {
        let path = path(equations, record, rows.clone(), begin)?;
        let here = path[row - rows.start][2];
        let (turn, found, length) = turned(record, rows.start, &path)?;
        begin += turn;
        course = Some(Course { heading: here + turn, reach: length, weights: found });
    }
    course
}

/// Rows around a row without a gap, never beyond those that take part.
fn stretch(record: &Record, row: usize, half: f64) -> Range<usize> {
    let time = &record.time;
    let gap = record.gap();
    let near = |i: usize| (time[i] - time[row]).abs() <= half;
    let first = (0..row).rev().take_while(|i| near(*i) && time[i + 1] - time[*i] <= gap).last().unwrap_or(row);
    let last = (row + 1..record.rows.end).take_while(|i| near(*i) && time[*i] - time[i - 1] <= gap).last();
    first..last.unwrap_or(row) + 1
}

/// Modelled measurements (x, y, heading) over a stretch that begins with a heading.
fn path(equations: &Equations, record: &Record, rows: Range<usize>, heading: f64) -> Option<Vec<[f64; 3]>> {
    let mut stepper = Stepper::new(equations, &record.signals, &[]);
    let mut start = record.smoothed(rows.start);
    start[2] = heading;
    let start = pose_of(equations, &start);
    let hidden = carry::before(equations, &[], record, rows.start, &start);
    let mut arc = Arc { z: [start, hidden.z].concat(), s: vec![] };
    let mut found = Vec::with_capacity(rows.len());
    for i in rows.clone() {
        let y = stepper.outputs(&arc.z);
        found.push([y[0], y[1], y[2]]);
        if i + 1 < rows.end {
            stepper.advance(&mut arc, record.time[i], record.time[i + 1]);
        }
    }
    found.iter().flatten().all(|v| v.is_finite()).then_some(found)
}

/// The turn that lays a path on the measured one, the weights of the measured points in it, and the path's extent.
fn turned(record: &Record, first: usize, path: &[[f64; 3]]) -> Option<(f64, Vec<Weight>, f64)> {
    let n = path.len() as f64;
    let mean = |f: &dyn Fn(usize) -> f64| (0..path.len()).map(f).sum::<f64>() / n;
    let measured = |k: usize| [record.columns[0][first + k], record.columns[1][first + k]];
    let centre = [mean(&|k| path[k][0]), mean(&|k| path[k][1])];
    let target = [mean(&|k| measured(k)[0]), mean(&|k| measured(k)[1])];
    let (mut dot, mut cross, mut square) = (0.0, 0.0, 0.0);
    for (k, point) in path.iter().enumerate() {
        let p = Vector2::new(point[0] - centre[0], point[1] - centre[1]);
        let m = Vector2::new(measured(k)[0] - target[0], measured(k)[1] - target[1]);
        dot += p.dot(&m);
        cross += p.perp(&m);
        square += p.norm_squared();
    }
    let turn = cross.atan2(dot);
    let turning = Rotation2::new(turn);
    let weight = |(k, point): (usize, &[f64; 3])| {
        let p = turning * Vector2::new(point[0] - centre[0], point[1] - centre[1]);
        (first + k, -p.y / square, p.x / square)
    };
    let found: Vec<Weight> = path.iter().enumerate().map(weight).collect();
    (square > 0.0 && turn.is_finite()).then(|| (turn, found, square.sqrt()))
}

/// Poses at the starts of windows. Headings that nothing measures follow each other by the model's own turning from
/// where the path tells them best: a vehicle that stands or drifts shows no heading, and a reversed one a false one.
pub fn starts(equations: &Equations, record: &Record, windows: &[Range<usize>]) -> Vec<Vec<f64>> {
    let rows: Vec<usize> = windows.iter().map(|w| w.start).collect();
    let mut poses: Vec<Vec<f64>> =
        rows.iter().map(|i| pose_of(equations, &measured_at(equations, record, *i))).collect();
    if record.has_heading {
        return poses;
    }
    let reach = |i: &usize| heading_at(equations, record, *i).reach;
    let reaches: Vec<f64> = rows.iter().map(reach).collect();
    let best = (0..rows.len()).max_by(|a, b| reaches[*a].total_cmp(&reaches[*b])).unwrap_or(0);
    let turns: Vec<f64> =
        (1..rows.len()).map(|k| turning(equations, record, rows[k - 1]..rows[k], &poses[k - 1])).collect();
    for k in best + 1..rows.len() {
        follow(&mut poses, k, k - 1, turns[k - 1]);
    }
    for k in (0..best).rev() {
        follow(&mut poses, k, k + 1, -turns[k]);
    }
    poses
}

/// By how much the model turns between two rows.
fn turning(equations: &Equations, record: &Record, rows: Range<usize>, pose: &[f64]) -> f64 {
    let mut stepper = Stepper::new(equations, &record.signals, &[]);
    let hidden = carry::at_rest(equations, &[], &mut stepper, record.time[rows.start], pose);
    let mut arc = Arc { z: [pose, &hidden.z].concat(), s: vec![] };
    rows.clone().for_each(|i| stepper.advance(&mut arc, record.time[i], record.time[i + 1]));
    arc.z[2] - pose[2]
}

/// Keeps a heading that agrees with its neighbour's, and else takes the neighbour's, turned.
fn follow(poses: &mut [Vec<f64>], k: usize, neighbour: usize, turn: f64) {
    let expected = poses[neighbour][2] + turn;
    let off = wrapped(poses[k][2] - expected);
    poses[k][2] = if off.abs() < AGREEMENT { expected + off } else { expected };
}

/// The smoothed measurement at a row, with the heading that the model says where none is measured.
pub fn measured_at(equations: &Equations, record: &Record, row: usize) -> Vec<f64> {
    let mut y = record.smoothed(row);
    if !record.has_heading {
        let own = heading_at(equations, record, row).heading;
        // Trailers that nothing measures follow straight.
        y[2..].iter_mut().enumerate().for_each(|(i, y)| {
            if i == 0 || i >= record.columns.len() - 1 {
                *y = own;
            }
        });
    }
    y
}
