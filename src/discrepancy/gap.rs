//! The gap: how far a model strays from the measurements after a horizon, and what noise alone would make of it.

use super::angle::wrapped;
use super::carry;
use super::course::{Course, heading_at, measured_at};
use super::problem::pose_of;
use super::record::Record;
use super::windows::MARGIN;
use crate::error::Result;
use crate::model::{Equations, Model};
use crate::motion::{Arc, Stepper};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

/// Sum of squared errors over windows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    position: f64,
    heading: f64,
    windows: usize,
    headings: usize,
}

impl Errors {
    fn add(&mut self, position: [f64; 2], heading: Option<f64>) {
        self.position += position[0] * position[0] + position[1] * position[1];
        self.windows += 1;
        if let Some(h) = heading {
            let h = wrapped(h);
            self.heading += h * h;
            self.headings += 1;
        }
    }

    /// Errors of more windows.
    pub fn joined(mut self, other: Errors) -> Errors {
        self.position += other.position;
        self.heading += other.heading;
        self.windows += other.windows;
        self.headings += other.headings;
        self
    }

    /// RMS position error, m.
    pub fn position_rms(&self) -> f64 {
        (self.position / self.windows as f64).sqrt()
    }

    /// RMS heading error, rad, when a heading was measured.
    pub fn heading_rms(&self) -> Option<f64> {
        (self.headings > 0).then(|| (self.heading / self.headings as f64).sqrt())
    }

    /// How many windows there were.
    pub fn windows(&self) -> usize {
        self.windows
    }
}

/// A model that predicts along a run, restarted from smoothed measurements; hidden states are carried from the
/// data before.
pub struct Predictor<'a> {
    record: &'a Record,
    equations: Equations,
    hidden: Vec<Vec<f64>>,
}

impl<'a> Predictor<'a> {
    /// A model along a run.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn new(model: &Model, record: &'a Record) -> Result<Self> {
        let equations = model.equations(&[])?;
        let hidden = hidden_along(&equations, record);
        Ok(Self { record, equations, hidden })
    }

    /// The state at a row: the smoothed pose and the carried hidden states.
    fn start(&self, i: usize) -> Vec<f64> {
        let mut z = pose_of(&self.equations, &measured_at(&self.equations, self.record, i));
        z.extend(self.hidden.get(i).into_iter().flatten());
        z
    }

    /// The outputs at rows `from..=to`, restarted at `from`.
    pub fn outputs(&self, from: usize, to: usize) -> Vec<Vec<f64>> {
        let mut stepper = Stepper::new(&self.equations, &self.record.signals, &[]);
        let mut arc = Arc { z: self.start(from), s: vec![] };
        let visible = self.equations.visible;
        let mut found = vec![stepper.outputs(&arc.z)[..visible].to_vec()];
        for i in from..to {
            stepper.advance(&mut arc, self.record.time[i], self.record.time[i + 1]);
            found.push(stepper.outputs(&arc.z)[..visible].to_vec());
        }
        found
    }

    /// The rows at which the non-overlapping windows of a horizon begin and end.
    pub fn windows(&self, horizon: f64) -> Vec<(usize, usize)> {
        let time = &self.record.time;
        let mut found = Vec::new();
        for segment in self.record.segments(MARGIN) {
            let mut start = segment.start;
            // Half a step early counts as on time.
            let slack = 0.5 * self.record.step();
            for i in segment {
                if time[i] - time[start] >= horizon - slack {
                    found.push((start, i));
                    start = i;
                }
            }
        }
        found
    }

    /// Errors after a horizon over non-overlapping windows.
    pub fn errors(&self, horizon: f64) -> Errors {
        let mut errors = Errors::default();
        for (from, to) in self.windows(horizon) {
            if let Some(end) = self.outputs(from, to).pop() {
                let c = &self.record.columns;
                let heading = self.record.has_heading.then(|| end[2] - c[2][to]);
                errors.add([end[0] - c[0][to], end[1] - c[1][to]], heading);
            }
        }
        errors
    }

    /// What [`Predictor::errors`] would give if this model were true, by drawing measurement noise.
    ///
    /// Noise enters twice: at the restart, whose smoothed pose it shifts and turns, and at the end. A model of
    /// a vehicle on a plane moves rigidly with its start, so no trajectory has to be integrated anew.
    pub fn floor(&self, horizon: f64, noise: &[f64; 3], seed: u64) -> Errors {
        let windows = self.windows(horizon);
        // A heading that is taken from the path inherits the noise of its positions.
        let courses: Vec<Option<Course>> = windows
            .iter()
            .map(|(from, _)| (!self.record.has_heading).then(|| heading_at(&self.equations, self.record, *from)))
            .collect();
        let ends: Vec<[f64; 2]> = windows.iter().map(|(from, to)| displacement(&self.outputs(*from, *to))).collect();
        let mut errors = Errors::default();
        let draws = (2000 / windows.len().max(1)).clamp(4, 200);
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        for _ in 0..draws {
            let noisy = with_noise(self.record, noise, &mut rng);
            for (((from, to), d), course) in windows.iter().zip(&ends).zip(&courses) {
                let (clean, shifted) = (self.record.smoothed(*from), noisy.smoothed(*from));
                let moved = |i: usize| [0, 1].map(|c| noisy.columns[c][i] - self.record.columns[c][i]);
                let turn = course.as_ref().map_or(shifted[2] - clean[2], |c| c.error(moved));
                let turn = wrapped(turn);
                let (sin, cos) = turn.sin_cos();
                let turned = [(cos - 1.0) * d[0] - sin * d[1], sin * d[0] + (cos - 1.0) * d[1]];
                let end = |c: usize| noisy.columns[c][*to] - self.record.columns[c][*to];
                let error = [0, 1].map(|c| shifted[c] - clean[c] + turned[c] - end(c));
                errors.add(error, self.record.has_heading.then(|| turn - end(2)));
            }
        }
        errors
    }
}

fn displacement(path: &[Vec<f64>]) -> [f64; 2] {
    match (path.first(), path.last()) {
        (Some(a), Some(b)) => [b[0] - a[0], b[1] - a[1]],
        _ => [0.0; 2],
    }
}

fn with_noise(record: &Record, noise: &[f64; 3], rng: &mut ChaCha8Rng) -> Record {
    let mut noisy = record.clone();
    let channels = record.channels();
    for (column, channel) in noisy.columns.iter_mut().zip(channels) {
        let sigma = noise[channel as usize].sqrt();
        column.iter_mut().for_each(|y| *y += sigma * rng.sample::<f64, _>(StandardNormal));
    }
    noisy
}

/// Hidden states at every row of a log, from rest at its start; empty when there are none.
fn hidden_along(equations: &Equations, record: &Record) -> Vec<Vec<f64>> {
    if equations.n() == equations.visible {
        return vec![];
    }
    let mut stepper = Stepper::new(equations, &record.signals, &[]);
    let visible = |i: usize| record.measured(i);
    let mut hidden = carry::at_rest(equations, &[], &mut stepper, record.time[0], &visible(0)).z;
    let mut found = Vec::with_capacity(record.time.len());
    for i in 0..record.time.len() {
        found.push(hidden.clone());
        if i + 1 < record.time.len() {
            let mut arc = Arc { z: [visible(i), hidden].concat(), s: vec![] };
            stepper.advance(&mut arc, record.time[i], record.time[i + 1]);
            hidden = arc.z[equations.visible..].to_vec();
        }
    }
    found
}
