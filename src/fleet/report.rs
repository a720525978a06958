//! The result of a fleet.

use crate::discrepancy::report::{Estimate, Evidence};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What a fleet of robots says together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FleetReport {
    /// Version of this form.
    pub schema: u32,
    /// In a sentence or two.
    pub summary: String,
    /// Robots that were asked.
    pub robots: usize,
    /// Their runs.
    pub runs: usize,
    /// Robots by the verdict of `discover` on most of their runs.
    pub verdicts: BTreeMap<String, usize>,
    /// The effects that the fleet needs, those of most robots first.
    pub effects: Vec<FleetEffect>,
    /// What robots name and the fleet does not need.
    pub not_needed: Vec<NotNeeded>,
    /// Robots whose value differs from all others.
    pub odd_robots: Vec<OddRobot>,
    /// Runs that differ from the others of their robot.
    pub odd_runs: Vec<OddRobot>,
    /// Robots that need an effect which nobody else has.
    pub own_effects: Vec<OwnEffect>,
    /// Each robot.
    pub per_robot: Vec<RobotReport>,
    /// What is to know of the rows.
    pub warnings: Vec<String>,
    /// The version of the program.
    pub version: String,
}

/// An effect that the fleet needs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FleetEffect {
    /// The effect, `ID`, `ID@INPUT` or `ID@TRAILER`.
    pub effect: String,
    /// What it means.
    pub says: String,
    /// Names that robots gave to it which no data tell from it.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub also_named: Vec<String>,
    /// How many robots name it by themselves.
    pub named_by: usize,
    /// BIC without minus BIC with it, summed over these.
    pub delta_bic: f64,
    /// Share of false discoveries among effects named by as many.
    pub q_value: f64,
    /// Its parameters.
    pub parameters: BTreeMap<String, FleetParameter>,
}

/// A parameter of a fleet; undefined numbers are absent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FleetParameter {
    /// Its unit.
    pub unit: String,
    /// Robots whose runs tell it, odd ones left out.
    pub robots: usize,
    /// Runs that have a value and a deviation.
    pub runs: usize,
    /// Runs that do not tell it.
    pub runs_without: usize,
    /// The mean over robots, at the most common tags, mean numbers and the mean date.
    pub mean: Option<Interval>,
    /// Standard deviation between robots.
    pub between_robots: Option<Interval>,
    /// Standard deviation between runs of a robot beyond their own; absent where no robot has several.
    pub between_runs: Option<f64>,
    /// How it depends on tags and dates.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub tags: Vec<TagEffect>,
}

/// A value with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// The value.
    pub value: f64,
    /// Its standard deviation, where it has one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub std: Option<f64>,
    /// The ends of its 95 % interval.
    pub interval: [f64; 2],
}

/// How a parameter depends on a tag.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TagEffect {
    /// The tag; `date` for wear with time.
    pub tag: String,
    /// The level, of a tag of words.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub level: Option<String>,
    /// The level it is compared with, of a tag of words.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub against: Option<String>,
    /// The difference of the level, or the slope: a day of a date, one of a number.
    pub value: f64,
    /// Its standard deviation.
    pub std: f64,
    /// Probability that the tag explains so much by chance.
    pub p_value: f64,
}

/// What robots name and the fleet does not need.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NotNeeded {
    /// The effect.
    pub effect: String,
    /// Robots that name it.
    pub robots: Vec<String>,
    /// Share of false discoveries among effects named by as many.
    pub q_value: f64,
    /// Whether the runs do not tell it from the effects that are needed.
    pub not_told_apart: bool,
}

/// A robot, or a run of it, that differs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OddRobot {
    /// The robot.
    pub robot: String,
    /// The run, where it is one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub run: Option<String>,
    /// The effect.
    pub effect: String,
    /// Its parameter.
    pub parameter: String,
    /// The value.
    pub value: f64,
    /// Its deviation.
    pub std: f64,
    /// The unit.
    pub unit: String,
    /// The value of the others.
    pub others: f64,
    /// How many deviations it lies from what the others predict.
    pub z: f64,
    /// Probability that the farthest of so many lies so far.
    pub p_value: f64,
    /// All this in words.
    pub says: String,
}

/// An effect that one robot needs and nobody else has.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OwnEffect {
    /// The robot.
    pub robot: String,
    /// The effect.
    pub effect: String,
    /// Whether it holds in part only, or moves with time: the robot's row has the scope.
    pub in_part: bool,
    /// Its values.
    pub parameters: BTreeMap<String, Estimate>,
    /// How strongly the robot's runs speak for it.
    pub evidence: Evidence,
    /// All this in words.
    pub says: String,
}

/// A robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RobotReport {
    /// Its name.
    pub robot: String,
    /// Its runs.
    pub runs: usize,
    /// What `discover` says of most of its runs.
    pub verdict: String,
    /// Its values, `EFFECT PARAMETER`.
    pub values: BTreeMap<String, ValueOfRobot>,
    /// What each dated run says of them, by date, where there are several.
    #[serde(skip_serializing_if = "BTreeMap::is_empty", default)]
    pub over_time: BTreeMap<String, Vec<RunValue>>,
    /// Lines of its ROS 2 controller's parameters that these change, where there is one for the vehicle.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub mend: Vec<String>,
}

/// What a dated run says of a value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunValue {
    /// The run.
    pub run: String,
    /// Its date, as the manifest has it.
    pub date: String,
    /// The value.
    pub value: f64,
    /// Its deviation.
    pub std: f64,
    /// Whether the run differs from the others of its robot.
    pub is_odd: bool,
}

/// A value of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ValueOfRobot {
    /// What its runs say beside those of all others, at its last run; its own, where it differs from all others.
    pub value: f64,
    /// The deviation of that.
    pub std: f64,
    /// What its own runs say alone.
    pub own: f64,
    /// The deviation of that.
    pub own_std: f64,
    /// How many deviations it lies from what the others predict.
    pub z: Option<f64>,
    /// The share of robots that lie as far by chance among those that do.
    pub q_value: Option<f64>,
    /// Whether it differs from all others.
    pub is_odd: bool,
}
