//! A plan: inputs as splines, and the states that they lead through.

use super::b_spline::BSpline;
use super::dead_time::DeadTime;

/// A plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The splines of the inputs.
    pub spline: BSpline,
    /// Their coefficients, input by input.
    pub coefficients: Vec<Vec<f64>>,
    /// How long the motion takes, s.
    pub duration: f64,
    /// How long the motion waits for inputs that act late, and how long each input is held back for it.
    pub dead_time: DeadTime,
    /// Over which share of what they are apart kinks of inputs were smoothed, where the model has any.
    pub smoothed: f64,
    /// The states it is to pass, the first one ahead.
    pub states: Vec<Vec<f64>>,
}

impl Plan {
    /// When the vehicle is there, s after the first command.
    pub fn arrives(&self) -> f64 {
        self.dead_time.longest + self.duration
    }

    /// An input as it is commanded at a time; before it moves it is as at the beginning, afterwards as at the end.
    pub fn command(&self, input: usize, t: f64) -> f64 {
        self.spline.at(&self.coefficients[input], (t - self.dead_time.waits[input]) / self.duration)
    }
}
