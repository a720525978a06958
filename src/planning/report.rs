//! The result of planning.

use serde::{Deserialize, Serialize};

/// A plan, what becomes of it, and what would have become of one made without creep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanReport {
    /// Version of this form.
    pub schema: u32,
    /// How long the plan takes, s.
    pub duration_s: f64,
    /// Metres that the sensor's point moves.
    pub length_m: f64,
    /// Times at which the speed changes its sign.
    pub reversals: usize,
    /// Where it ends on the model, by another integration than the planner's.
    pub reached: Reached,
    /// The largest distance from the path, m, where one is followed.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub off_path_m: Option<f64>,
    /// What a plan made on the model without its effects does on the model with them; absent where there are none, or where
    /// there is no such plan.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub ideal: Option<Ideal>,
    /// The deviation of where the plan ends, from the covariance of the model's parameters.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub spread: Option<Spread>,
    /// Effects of the model that the plan reckons with.
    pub effects: Vec<String>,
}

/// Where a plan ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reached {
    /// x, m.
    pub x: f64,
    /// y, m.
    pub y: f64,
    /// Heading, rad.
    pub heading: f64,
    /// Distance from the goal, m.
    pub miss_m: f64,
    /// Heading less that of the goal, rad; absent where none is asked for.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub miss_rad: Option<f64>,
}

/// The plan made without creep, driven with it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ideal {
    /// How long it takes, s.
    pub duration_s: f64,
    /// Where it ends.
    pub reached: Reached,
}

/// Standard deviations of where a plan ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Along the widest direction, m.
    pub position_m: f64,
    /// rad.
    pub heading_rad: f64,
}
