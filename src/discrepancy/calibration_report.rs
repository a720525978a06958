//! The result of a calibration.

use crate::discrepancy::report::{Covariance, DataSummary, PerRun, Provenance};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How a calibration ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Standing {
    /// Values with their covariance.
    Fitted,
    /// Values, but the data leave a direction open: no deviations.
    NotIdentifiable,
    /// The model does not apply to the runs.
    UnusableData,
}

/// Values of the effects that were asked for, and how well they are known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// Version of this form.
    pub schema: u32,
    /// How it ended.
    pub verdict: Standing,
    /// In a sentence.
    pub summary: String,
    /// The effects, in the order they were asked for.
    pub effects: Vec<CalibratedEffect>,
    /// Of all values: by the noise, with alike rows and windows counted once.
    pub covariance: Option<Covariance>,
    /// Deviation of a measured position, m, and heading, rad.
    pub noise: BTreeMap<String, f64>,
    /// Whether motion is left that these effects do not explain: deviations then count it as random.
    pub remains: bool,
    /// Twice the log likelihood gained by all of them together.
    pub deviance_gained: f64,
    /// Runs and rows that were fitted.
    pub data: DataSummary,
    /// Where it comes from.
    pub provenance: Provenance,
}

/// An effect at its fitted values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CalibratedEffect {
    /// Its id.
    pub id: String,
    /// What it means.
    pub says: String,
    /// The input it acts on.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub on: Option<String>,
    /// The trailer it acts on.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub trailer: Option<usize>,
    /// Its parameters.
    pub parameters: BTreeMap<String, CalibratedValue>,
    /// BIC without minus BIC with it, beside all others: above zero the data ask for it. Nothing is selected by it. Absent
    /// where the effect vanishes.
    pub delta_bic: Option<f64>,
    /// Its values run by run, where there are several.
    #[serde(skip_serializing_if = "BTreeMap::is_empty", default)]
    pub per_run: BTreeMap<String, PerRun>,
}

/// A fitted value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CalibratedValue {
    /// The value.
    pub value: f64,
    /// Its standard deviation, where the data give one.
    pub std: Option<f64>,
    /// Its unit.
    pub unit: String,
    /// The ends of its 95 % interval; an end that the data leave open is absent.
    pub interval: [Option<f64>; 2],
    /// How the interval was found.
    pub by: IntervalBy,
    /// Whether it stands at an end of its range.
    pub at_bound: bool,
    /// Mean and deviation of what was known before.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub prior: Option<[f64; 2]>,
}

/// How an interval was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum IntervalBy {
    /// By the curvature at the fitted value.
    Wald,
    /// By the likelihood with all other values fitted anew, for values whose interval is not symmetric.
    Profile,
}
