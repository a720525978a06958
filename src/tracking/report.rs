//! The result of driving plans with feedback.

use serde::{Deserialize, Serialize};

/// Plans driven by the vehicle as it is, with feedback on several models.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrackingReport {
    /// Version of this form.
    pub schema: u32,
    /// Time between two samples, s.
    pub sample_s: f64,
    /// Deviations of the sensor.
    pub noise: SensorDeviation,
    /// Drives of each way with feedback; a plan alone is driven once.
    pub drives: usize,
    /// Effects that the vehicle has.
    pub effects: Vec<String>,
    /// The ways to drive, and how each went.
    pub ways: Vec<WayReport>,
    /// What the observer found.
    pub observed: Vec<Observed>,
}

/// Deviations of a measured pose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SensorDeviation {
    /// m.
    pub position_m: f64,
    /// rad.
    pub heading_rad: f64,
}

/// One way to drive.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WayReport {
    /// `ideal-plan`, `ideal`, `observer`, `model-plan` or `model`.
    pub id: String,
    /// How long its plan takes, s.
    pub duration_s: f64,
    /// Distance from the plan, root of the mean square over all samples and drives, m.
    pub off_plan_m: f64,
    /// Heading off the plan, likewise, rad.
    pub off_plan_rad: f64,
    /// Distance from where the plan ends, mean over the drives, m.
    pub end_m: f64,
    /// The largest of them, m.
    pub worst_end_m: f64,
    /// Heading off where the plan ends, mean of its size, rad.
    pub end_rad: f64,
}

/// A coefficient that the observer had as a state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Observed {
    /// Effect and parameter.
    pub name: String,
    /// What the vehicle has.
    pub true_value: f64,
    /// What the observer came to, mean over the drives.
    pub found: f64,
    /// Its scatter between drives, root of the mean square about the truth.
    pub error: f64,
    /// What the filter says of its own error, mean over the drives.
    pub deviation: f64,
}
