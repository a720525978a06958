//! A planning task: where a motion begins, what it is to reach within which limits, and what else counts.

use super::limits::Limit;
use super::path::Path;
use super::transcription::Weights;
use crate::error::Result;
use crate::model::{Equations, Model};
use crate::motion::{initial_hidden, visible_state};

/// What is to be planned.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// The measured pose at the beginning: x, y, heading, headings of trailers.
    pub start: Vec<f64>,
    /// Poses to pass, in their order, the goal last; a heading that does not matter is none.
    pub poses: Vec<(f64, f64, Option<f64>)>,
    /// Points to follow on the way, in place of poses to pass.
    pub path: Path,
    /// Whose pose it is: 0 for what the sensor of the tractor measures, else the trailer.
    pub of_trailer: usize,
    /// Limits of the inputs, in the model's order.
    pub limits: Vec<Limit>,
    /// The duration, s, where it is given.
    pub duration: Option<f64>,
    /// What else counts.
    pub weights: Weights,
    /// Polynomial pieces of the inputs.
    pub spans: usize,
    /// The degree of the pieces: 3 for samples of the inputs, 2 for means since the row before.
    pub degree: usize,
}

impl Task {
    /// From the origin to poses, the tractor's, within usual limits and in whatever time.
    pub fn from_origin(model: &Model, poses: Vec<(f64, f64, Option<f64>)>, spans: usize) -> Self {
        Self {
            start: vec![0.0; 3 + model.trailer_count()],
            poses,
            path: Path::default(),
            of_trailer: 0,
            limits: Limit::usual(model),
            duration: None,
            weights: Weights::default(),
            spans,
            degree: 3,
        }
    }

    /// The states of a model, its free parameters at some values, at the beginning.
    ///
    /// # Errors
    /// When no pose of the vehicle gives the measured one.
    pub fn first_states(&self, equations: &Equations, p: &[f64]) -> Result<Vec<f64>> {
        let mut states = visible_state(equations, p, &self.start)?;
        states.extend(initial_hidden(equations, p, &vec![0.0; equations.inputs.len()], &states));
        Ok(states)
    }

    /// How many polynomial pieces each leg to a pose has.
    pub fn legs(&self) -> Vec<usize> {
        let end = |i: usize| self.spans * i / self.poses.len().max(1);
        (0..self.poses.len()).map(|i| end(i + 1) - end(i)).collect()
    }
}
