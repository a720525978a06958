//! A planning task as a nonlinear program: states at the ends of spans, coefficients of the inputs' splines and the duration are
//! unknown; that the motion joins, and that it reaches what it is to reach, are equations.

use super::limits::Limit;
use super::path::Path;
use super::quadratic_program::QuadraticProgram;
use super::shooting::{Shooting, Span};
use super::tracked_point::TrackedPoint;
use crate::error::Result;
use rayon::prelude::*;

/// A pose that is to be reached at the end of a span.
#[derive(Clone, Debug, PartialEq)]
pub struct Waypoint {
    /// The span.
    pub span: usize,
    /// x, y, heading; a heading that does not matter is none.
    pub pose: (f64, f64, Option<f64>),
}

/// What a plan is to be besides right, each weight a share of a cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// Of the duration.
    pub time: f64,
    /// Of the inputs' changes.
    pub smoothness: f64,
    /// Of the inputs' sizes.
    pub effort: f64,
}

/// Time and smooth inputs.
impl Default for Weights {
    fn default() -> Self {
        Self { time: 1.0, smoothness: 0.1, effort: 0.1 }
    }
}

/// A planning task.
pub struct Program<'a> {
    /// The motion.
    pub shooting: Shooting<'a>,
    /// The state at the beginning.
    pub start: Vec<f64>,
    /// The point that goals speak of.
    pub point: &'a TrackedPoint,
    /// What is to be reached.
    pub waypoints: Vec<Waypoint>,
    /// What is to be followed.
    pub path: Path,
    /// Limits of the inputs.
    pub limits: &'a [Limit],
    /// The most by which neighbours of a train may be bent, rad.
    pub bend: Option<f64>,
    /// Least and most duration, s.
    pub duration: [f64; 2],
    /// A duration of usual size, s.
    pub usual: f64,
    /// What else counts.
    pub weights: Weights,
    /// What equations may be off by, m and rad.
    pub tolerance: f64,
}

/// A value of everything that is unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// States at the ends of spans.
    pub states: Vec<Vec<f64>>,
    /// Coefficients of the inputs' splines.
    pub coefficients: Vec<Vec<f64>>,
    /// The duration, s.
    pub duration: f64,
}

impl Program<'_> {
    pub(super) fn n(&self) -> usize {
        self.start.len()
    }

    pub(super) fn spans(&self) -> usize {
        self.shooting.spline.spans
    }

    pub(super) fn per_channel(&self) -> usize {
        self.shooting.spline.coefficients()
    }

    /// How many unknowns there are.
    pub(super) fn width(&self) -> usize {
        self.spans() * self.n() + self.limits.len() * self.per_channel() + 1
    }

    /// The place of a state's component at the end of a span.
    pub(super) fn of_state(&self, span: usize, i: usize) -> usize {
        span * self.n() + i
    }

    pub(super) fn of_coefficient(&self, channel: usize, j: usize) -> usize {
        self.spans() * self.n() + channel * self.per_channel() + j
    }

    pub(super) fn of_duration(&self) -> usize {
        self.width() - 1
    }

    fn before<'p>(&'p self, point: &'p Point, span: usize) -> &'p [f64] {
        if span == 0 { &self.start } else { &point.states[span - 1] }
    }

    /// Coefficients that are to be zero.
    fn resting(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let ends = [0, self.per_channel() - 1];
        let channels = self.limits.iter().enumerate().filter(|(_, l)| l.rests);
        channels.flat_map(move |(channel, _)| ends.into_iter().map(move |j| (channel, j)))
    }

    /// What equations are off by: gaps between spans, then waypoints, then inputs that are to rest.
    pub fn violations(&self, point: &Point) -> Result<Vec<f64>> {
        let end = |span: usize| {
            let end = self.shooting.end(self.before(point, span), &point.coefficients, span, point.duration)?;
            Ok(point.states[span].iter().zip(&end).map(|(a, b)| a - b).collect::<Vec<f64>>())
        };
        let gaps: Vec<Vec<f64>> = (0..self.spans()).into_par_iter().map(end).collect::<Result<_>>()?;
        let mut all = gaps.concat();
        for way in &self.waypoints {
            all.extend(self.missed(way, &self.point.at(&point.states[way.span]).0));
        }
        all.extend(self.resting().map(|(channel, j)| point.coefficients[channel][j]));
        Ok(all)
    }

    fn missed(&self, way: &Waypoint, at: &[f64; 3]) -> Vec<f64> {
        let (x, y, heading) = way.pose;
        [at[0] - x, at[1] - y].into_iter().chain(heading.map(|h| at[2] - h)).collect()
    }

    /// The program of a step from a point that takes back all that equations are off by.
    ///
    /// # Errors
    /// When the motion from the point is undefined.
    pub fn step(&self, point: &Point, damping: f64) -> Result<QuadraticProgram> {
        let mut program = self.linearised(point)?;
        self.costs(point, damping, &mut program);
        Ok(program)
    }

    /// The program of the least change of a point that does, whatever it costs.
    ///
    /// # Errors
    /// When the motion from the point is undefined.
    pub fn projection(&self, point: &Point) -> Result<QuadraticProgram> {
        let mut program = self.linearised(point)?;
        self.distances(&mut program);
        Ok(program)
    }

    /// Equations and limits at a point, without a cost.
    fn linearised(&self, point: &Point) -> Result<QuadraticProgram> {
        let span = |k: usize| self.shooting.span(self.before(point, k), &point.coefficients, k, point.duration);
        let spans: Vec<Span> = (0..self.spans()).into_par_iter().map(span).collect::<Result<_>>()?;
        let mut program = QuadraticProgram { linear: vec![0.0; self.width()], ..QuadraticProgram::default() };
        self.joined(point, &spans, &mut program);
        self.reached(point, &mut program);
        self.bounded(point, &mut program);
        Ok(program)
    }

    fn joined(&self, point: &Point, spans: &[Span], program: &mut QuadraticProgram) {
        let (n, acting) = (self.n(), self.shooting.spline.degree + 1);
        for (k, span) in spans.iter().enumerate() {
            for i in 0..n {
                let row = program.equal_to.len();
                program.equal.push((row, self.of_state(k, i), 1.0));
                let columns = (0..n).filter(|_| k > 0).map(|j| (self.of_state(k.max(1) - 1, j), j));
                let of_inputs = (0..self.limits.len())
                    .flat_map(|c| (0..acting).map(move |j| (c, j)))
                    .map(|(c, j)| (self.of_coefficient(c, k + j), n + c * acting + j));
                let of_duration = (self.of_duration(), n + self.limits.len() * acting);
                for (column, slope) in columns.chain(of_inputs).chain([of_duration]) {
                    program.equal.push((row, column, -span.slopes[(i, slope)]));
                }
                program.equal_to.push(span.end[i] - point.states[k][i]);
            }
        }
    }

    fn reached(&self, point: &Point, program: &mut QuadraticProgram) {
        for way in &self.waypoints {
            let (at, slopes) = self.point.at(&point.states[way.span]);
            for (i, miss) in self.missed(way, &at).into_iter().enumerate() {
                let row = program.equal_to.len();
                program.equal.extend((0..self.n()).map(|j| (row, self.of_state(way.span, j), slopes[(i, j)])));
                program.equal_to.push(-miss);
            }
        }
        for (channel, j) in self.resting() {
            program.equal.push((program.equal_to.len(), self.of_coefficient(channel, j), 1.0));
            program.equal_to.push(-point.coefficients[channel][j]);
        }
    }

    fn bounded(&self, point: &Point, program: &mut QuadraticProgram) {
        let mut below = |entries: &[(usize, f64)], least: f64| {
            let row = program.below_of.len();
            program.below.extend(entries.iter().map(|(j, v)| (row, *j, *v)));
            program.below_of.push(least);
        };
        let duration = self.of_duration();
        below(&[(duration, 1.0)], self.duration[1] - point.duration);
        below(&[(duration, -1.0)], point.duration - self.duration[0]);
        let spline = self.shooting.spline;
        for (channel, limit) in self.limits.iter().enumerate() {
            let c = &point.coefficients[channel];
            for (j, value) in c.iter().enumerate() {
                below(&[(self.of_coefficient(channel, j), 1.0)], limit.range[1] - value);
                below(&[(self.of_coefficient(channel, j), -1.0)], value - limit.range[0]);
            }
            // ±(c_{j+1} − c_j) ≤ rate·T·pitch/spans, which bounds the slope of the spline.
            for j in 0..c.len() - 1 {
                let most = limit.rate * spline.pitch(j) / spline.spans as f64;
                let (ahead, here) = (self.of_coefficient(channel, j + 1), self.of_coefficient(channel, j));
                for sign in [1.0, -1.0] {
                    let room = most * point.duration - sign * (c[j + 1] - c[j]);
                    below(&[(ahead, sign), (here, -sign), (duration, -most)], room);
                }
            }
        }
        let trailers = self.shooting.equations.poses - 3;
        for (bend, (k, i)) in
            self.bend.iter().flat_map(|b| (0..self.spans()).flat_map(move |k| (0..trailers).map(move |i| (b, (k, i)))))
        {
            let (ahead, own) = (2 + i, 3 + i);
            let bent = point.states[k][ahead] - point.states[k][own];
            for sign in [1.0, -1.0] {
                below(&[(self.of_state(k, ahead), sign), (self.of_state(k, own), -sign)], bend - sign * bent);
            }
        }
    }

    /// A point that lies a share of a step further.
    pub fn moved(&self, point: &Point, step: &[f64], share: f64) -> Point {
        let by = |at: usize| share * step[at];
        let states = point.states.iter().enumerate();
        let state =
            |(k, z): (usize, &Vec<f64>)| z.iter().enumerate().map(|(i, v)| v + by(self.of_state(k, i))).collect();
        let channel = |(ch, c): (usize, &Vec<f64>)| {
            c.iter().enumerate().map(|(j, v)| v + by(self.of_coefficient(ch, j))).collect()
        };
        Point {
            states: states.map(state).collect(),
            coefficients: point.coefficients.iter().enumerate().map(channel).collect(),
            duration: point.duration + by(self.of_duration()),
        }
    }
}
