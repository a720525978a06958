//! The heading of a vehicle whose heading nothing measures, from where its model says it went.

use super::hidden_states;
use super::speed_fit::{self, SpeedFit};
use crate::discrepancy::initial_state::pose::pose_of;
use crate::discrepancy::record::angle::wrapped;
use crate::discrepancy::record::run_record::Record;
use crate::model::Equations;
use crate::model::observation::BODY_HEADING;
use crate::model::state::DIRECTION;
use crate::motion::{StateSensitivity, Stepper};
use nalgebra::{Rotation2, Vector2};
use std::ops::Range;

/// Half width of the stretch that is laid on the measured path, s; wider where the vehicle hardly moves.
const HALF_WIDTHS: [f64; 3] = [1.0, 3.0, 9.0];
/// Points this many times their noise from their mean, all together, tell a direction.
const LONG_ENOUGH: f64 = 20.0;
/// Headings that differ by more do not agree, rad.
const AGREEMENT: f64 = 0.5;
/// Turn that shows what a heading moves, rad.
const TRIED: f64 = 1e-3;
/// Rounds; more than one because what an effect does may hang on where the vehicle is.
const ROUNDS: usize = 2;

/// A row with what errors of its x and y do to a heading.
pub type Weight = (usize, f64, f64);

/// A heading with what position noise does to it.
#[derive(Clone, Debug, Default)]
pub struct PathHeading {
    /// The measured heading at the row, as a sensor would give it, rad.
    pub heading: f64,
    /// How far the points that tell it reach, m: the root of the sum of squares about their mean of what turning the
    /// vehicle by a radian would move them by. What moves them whichever way it heads, a slope or a current, tells nothing.
    pub reach: f64,
    /// δheading = Σ (a·δx + b·δy) over rows: (row, a, b).
    pub weights: Vec<Weight>,
}

impl PathHeading {
    /// Whether the path tells the heading, and not the noise of its points.
    pub fn is_told(&self, record: &Record) -> bool {
        self.reach > LONG_ENOUGH * record.position_noise()
    }

    /// The variance of the heading in units of that of a position, where errors are independent.
    pub fn share(&self) -> f64 {
        self.weights.iter().map(|(_, a, b)| a * a + b * b).sum()
    }

    /// What errors of the positions do to the heading.
    pub fn error(&self, of: impl Fn(usize) -> [f64; 2]) -> f64 {
        self.weights.iter().map(|(i, a, b)| [*a, *b].iter().zip(of(*i)).map(|(w, e)| w * e).sum::<f64>()).sum()
    }
}

/// The heading at a row: the model's own motion around it, turned until it lies best on the measured path.
///
/// θ = atan2(Σ p×m, Σ p·m) with the modelled points p and the measured points m about their means, both less what a
/// slope or a current does to them. Reversing, sliding and a tracked point off the axle are in the motion, which a
/// direction of travel alone does not know.
pub fn heading_at(equations: &Equations, record: &Record, row: usize) -> PathHeading {
    heading_over(equations, record, row, 0.0)
}

/// The heading at a row that holds over a span of time: the model's motion over all of the span laid on the measured path,
/// and no less of it than tells a heading. From a short stretch the error of the guess would grow with the span, and be
/// taken for the model's.
pub fn heading_over(equations: &Equations, record: &Record, row: usize, span: f64) -> PathHeading {
    let mut best = PathHeading { heading: record.smoothed(row)[BODY_HEADING], ..PathHeading::default() };
    for half in HALF_WIDTHS {
        let rows = stretch(record, row, [half, half.max(span)]);
        let Some(course) = laid_on(equations, record, row, rows, best.heading) else { continue };
        best = course;
        if best.is_told(record) {
            break;
        }
    }
    best
}

/// The heading from a stretch.
fn laid_on(equations: &Equations, record: &Record, row: usize, rows: Range<usize>, guess: f64) -> Option<PathHeading> {
    if rows.len() < 3 {
        return None;
    }
    // Forward from the stretch's first row: states that forget would blow up backwards.
    let mut begin = guess;
    let mut course = None;
    for _ in 0..ROUNDS {
        let here = path(equations, record, rows.clone(), begin)?;
        let beside = path(equations, record, rows.clone(), begin + TRIED)?;
        let heading = here[row - rows.start][BODY_HEADING];
        let found = HeadingRegistration::of(record, rows.start, &here, &beside)?;
        begin += found.turn;
        course = Some(PathHeading { heading: heading + found.turn, reach: found.reach, weights: found.weights });
    }
    course
}

/// Rows from so long before a row until so long after it without a gap, never beyond those that take part.
fn stretch(record: &Record, row: usize, [before, after]: [f64; 2]) -> Range<usize> {
    let time = &record.time;
    let gap = record.gap();
    let early = |i: usize| time[row] - time[i] <= before;
    let late = |i: usize| time[i] - time[row] <= after;
    let first = (0..row).rev().take_while(|i| early(*i) && time[i + 1] - time[*i] <= gap).last().unwrap_or(row);
    let last = (row + 1..record.rows.end).take_while(|i| late(*i) && time[*i] - time[i - 1] <= gap).last();
    first..last.unwrap_or(row) + 1
}

/// Modelled measurements (x, y, heading) over a stretch that begins with a heading.
fn path(equations: &Equations, record: &Record, rows: Range<usize>, heading: f64) -> Option<Vec<[f64; 3]>> {
    let mut stepper = Stepper::new(equations, &record.signals, &[]);
    let mut start = record.smoothed(rows.start);
    start[BODY_HEADING] = heading;
    let start = pose_of(equations, &start);
    let hidden = hidden_states::carried(equations, &[], record, rows.start, &start);
    let mut arc = StateSensitivity { z: [start, hidden.z].concat(), s: vec![] };
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

/// What lays a path on the measured one.
struct HeadingRegistration {
    turn: f64,
    weights: Vec<Weight>,
    reach: f64,
}

impl HeadingRegistration {
    /// From a path and the one that begins turned by a little: what lies between them turns with the vehicle, and the
    /// rest of the path stays where it is.
    fn of(record: &Record, first: usize, path: &[[f64; 3]], beside: &[[f64; 3]]) -> Option<Self> {
        // A vector that turns moves by itself, a quarter turned.
        let arm = |(a, b): (&[f64; 3], &[f64; 3])| Vector2::new(b[1] - a[1], a[0] - b[0]) / TRIED;
        let arms = centred(path.iter().zip(beside).map(arm).collect());
        let points = centred(path.iter().map(|p| Vector2::new(p[0], p[1])).collect());
        let at = |k: usize| Vector2::new(record.columns[0][first + k], record.columns[1][first + k]);
        let measured = centred((0..path.len()).map(at).collect());
        let (mut dot, mut cross, mut square) = (0.0, 0.0, 0.0);
        for ((arm, point), measured) in arms.iter().zip(&points).zip(&measured) {
            let turned = measured - (point - arm);
            dot += arm.dot(&turned);
            cross += arm.perp(&turned);
            square += arm.norm_squared();
        }
        let turn = cross.atan2(dot);
        let turning = Rotation2::new(turn);
        let weight = |(k, arm): (usize, &Vector2<f64>)| {
            let p = turning * arm;
            (first + k, -p.y / square, p.x / square)
        };
        let weights = arms.iter().enumerate().map(weight).collect();
        (square > 0.0 && turn.is_finite()).then_some(Self { turn, weights, reach: square.sqrt() })
    }
}

fn centred(points: Vec<Vector2<f64>>) -> Vec<Vector2<f64>> {
    let mean = points.iter().sum::<Vector2<f64>>() / points.len() as f64;
    points.iter().map(|p| p - mean).collect()
}

/// Poses at the starts of windows. Headings that nothing measures follow each other by the model's own turning from
/// where the path tells them best: a vehicle that stands or drifts shows no heading, and a reversed one a false one.
pub fn starts(equations: &Equations, record: &Record, windows: &[Range<usize>]) -> Vec<Vec<f64>> {
    let rows: Vec<usize> = windows.iter().map(|w| w.start).collect();
    let placed: Vec<MeasuredPose> = rows.iter().map(|i| MeasuredPose::at(equations, record, *i)).collect();
    let mut poses: Vec<Vec<f64>> = placed.iter().map(|p| pose_of(equations, &p.measured)).collect();
    if record.has_heading() {
        return poses;
    }
    let best = (0..rows.len()).max_by(|a, b| placed[*a].reach().total_cmp(&placed[*b].reach())).unwrap_or(0);
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
    let hidden = hidden_states::at_rest(equations, &[], &mut stepper, record.time[rows.start], pose);
    let mut arc = StateSensitivity { z: [pose, &hidden.z].concat(), s: vec![] };
    rows.clone().for_each(|i| stepper.advance(&mut arc, record.time[i], record.time[i + 1]));
    arc.z[DIRECTION] - pose[DIRECTION]
}

/// Keeps a heading that agrees with its neighbour's, and else takes the neighbour's, turned.
fn follow(poses: &mut [Vec<f64>], k: usize, neighbour: usize, turn: f64) {
    let expected = poses[neighbour][DIRECTION] + turn;
    let off = wrapped(poses[k][DIRECTION] - expected);
    poses[k][DIRECTION] = if off.abs() < AGREEMENT { expected + off } else { expected };
}

/// The smoothed measurement at a row, with the heading that the model says where none is measured, and speeds by slopes.
pub fn measured_at(equations: &Equations, record: &Record, row: usize) -> Vec<f64> {
    smoothed_over(equations, record, row, 0.0).0
}

/// As [`measured_at`], known well enough for a span of time, s, and what the heading is taken from where none is measured.
fn smoothed_over(equations: &Equations, record: &Record, row: usize, span: f64) -> (Vec<f64>, Option<PathHeading>) {
    let mut measured = record.smoothed(row);
    let course = (!record.has_heading()).then(|| heading_over(equations, record, row, span));
    if let Some(course) = &course {
        // Trailers that nothing measures follow straight.
        measured[2..equations.poses].iter_mut().enumerate().for_each(|(i, y)| {
            if i == 0 || i >= record.columns.len() - 1 {
                *y = course.heading;
            }
        });
    }
    (measured, course)
}

/// Where the vehicle is at a row.
#[derive(Clone, Debug)]
pub struct MeasuredPose {
    /// The smoothed measurement, with the heading that the model says where none is measured.
    pub measured: Vec<f64>,
    /// What the heading is taken from where none is measured.
    pub course: Option<PathHeading>,
    /// The state by the rows around, of a vehicle whose speeds forces change.
    pub speeds: Option<SpeedFit>,
}

impl MeasuredPose {
    /// At a row of a record.
    pub fn at(equations: &Equations, record: &Record, row: usize) -> Self {
        Self::over(equations, record, row, 0.0)
    }

    /// At a row of a record, known well enough for a span of time, s.
    pub fn over(equations: &Equations, record: &Record, row: usize, span: f64) -> Self {
        let (mut measured, course) = smoothed_over(equations, record, row, span);
        // Where a prediction begins, what comes is not looked at.
        let around = if span > 0.0 { speed_fit::BEFORE } else { speed_fit::AROUND };
        let fit = speed_fit::speeds_at(equations, record, row, around);
        if let Some(fit) = &fit {
            measured[equations.poses..].copy_from_slice(&fit.state[equations.poses..equations.visible]);
        }
        Self { measured, course, speeds: fit }
    }

    /// How far the points reach that tell the heading, m; without end where it is measured.
    pub fn reach(&self) -> f64 {
        self.course.as_ref().map_or(f64::INFINITY, |c| c.reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{equations, logged};
    use std::f64::consts::TAU;

    /// Points twenty times their noise from their mean tell a heading.
    #[test]
    fn a_path_longer_than_its_noise_is_told() {
        let (equations, p) = equations(&[]);
        let time = (0..200).map(|i| 0.1 * f64::from(i)).collect();
        let record = logged((&equations, &p), time, [&|_| 2.0, &|_| 0.3], &[0.0; 3], 1e-3);
        let noise = record.position_noise();
        assert!(noise > 1e-4 && noise < 1e-2, "{noise}");
        for (reach, is_told) in [(20.1, true), (19.9, false), (0.0, false), (1e3, true)] {
            assert_eq!(
                PathHeading { reach: reach * noise, ..PathHeading::default() }.is_told(&record),
                is_told,
                "{reach}"
            );
        }
    }

    /// Full turns apart is no disagreement; more than half a radian is, and the neighbour's heading, turned, stands.
    #[test]
    fn a_heading_that_agrees_is_kept_and_another_is_the_neighbours() {
        for (own, expect) in [(1.4, 1.4), (1.4 + TAU, 1.4), (1.4 - TAU, 1.4), (1.9, 1.2), (0.5, 1.2), (1.2 + 3.0, 1.2)]
        {
            let mut poses = vec![vec![0.0, 0.0, 1.0], vec![0.0, 0.0, own]];
            follow(&mut poses, 1, 0, 0.2);
            assert!((poses[1][2] - expect).abs() < 1e-12 && poses[0][2] == 1.0, "{own}: {}", poses[1][2]);
        }
    }
}
