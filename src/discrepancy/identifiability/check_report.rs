//! What `check` says, as data; its JSON form is documented in the guide, "Checking a log before a fit".

use crate::discrepancy::report::{Finding, NextExperiment, RunClock};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The whole answer.
///
/// ```
/// use creepage::{Check, Model, Run};
/// let model = Model::read("examples/runs/cornering/model.toml")?;
/// let eights = Run::read("examples/runs/cornering/eights.csv", &model)?;
/// let told: Check = creepage::check(&model, &[eights])?;
/// assert!(told.data.findings.iter().all(|finding| !finding.id.is_empty()));
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// Version of this layout.
    pub schema: u32,
    /// Whether `discover` could answer.
    pub verdict: Standing,
    /// One sentence for a person.
    pub summary: String,
    /// The state of the data.
    pub data: Health,
    /// Every effect of the library that applies, in its order.
    pub effects: Vec<Prospect>,
    /// Pairs of effects that these runs would not tell apart.
    pub not_separated: Vec<Pair>,
    /// What to drive for what is missing.
    pub next_experiment: Option<NextExperiment>,
}

/// What the runs are good for.
///
/// ```
/// use creepage::report::Standing;
/// assert_eq!(serde_json::to_string(&Standing::NotIdentifiable).unwrap(), "\"not-identifiable\"");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Standing {
    /// The model does not apply to these data.
    UnusableData,
    /// An effect of plausible size would be missed.
    NotIdentifiable,
    /// Every basic effect of plausible size would be seen.
    Identifiable,
}

/// Whether an effect of plausible size would be seen.
///
/// ```
/// use creepage::report::Seen;
/// assert_eq!(serde_json::to_string(&Seen::OnceExplained).unwrap(), "\"once-explained\"");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Seen {
    /// It would.
    Yes,
    /// Once the motion that the model leaves unexplained has been explained.
    OnceExplained,
    /// It would not.
    No,
}

/// What is to be expected of an effect.
///
/// ```
/// use creepage::report::{Prospect, Seen};
/// fn missed(all: &[Prospect]) -> Vec<&str> {
///     all.iter().filter(|effect| effect.seen == Seen::No).map(|effect| effect.id.as_str()).collect()
/// }
/// assert!(missed(&[]).is_empty());
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Prospect {
    /// The effect.
    pub id: String,
    /// The trailer it acts on.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub trailer: Option<usize>,
    /// Where it acts.
    #[serde(rename = "where")]
    pub place: String,
    /// Whether it would be seen at its plausible size.
    pub seen: Seen,
    /// Its parameters.
    pub parameters: BTreeMap<String, Parameter>,
}

/// How well a parameter would be known.
///
/// ```
/// use creepage::report::Parameter;
/// fn shows(parameter: &Parameter) -> bool {
///     parameter.smallest_seen.is_some_and(|least| least < parameter.plausible)
/// }
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// SI unit.
    pub unit: String,
    /// Standard deviation against the noise alone; none when the runs say nothing of it.
    pub std: Option<f64>,
    /// Standard deviation as long as unexplained motion counts as chance.
    pub std_unexplained: Option<f64>,
    /// A plausible magnitude.
    pub plausible: f64,
    /// The smallest magnitude that would be seen with 95 %, against the noise alone; smaller ones may be.
    pub smallest_seen: Option<f64>,
}

/// Two effects that would not be told apart.
///
/// ```
/// use creepage::report::Pair;
/// fn is_about(pair: &Pair, id: &str) -> bool {
///     pair.effects.iter().any(|effect| effect == id)
/// }
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pair {
    /// Both of them, as they are listed.
    pub effects: [String; 2],
    /// `identical`, `first order` or `data`.
    pub why: String,
    /// By how much the deviance is expected to tell one from the other.
    pub misfit: f64,
}

/// The state of the data.
///
/// ```
/// use creepage::report::Health;
/// assert!(Health::default().runs.is_empty());
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Health {
    /// Run by run.
    pub runs: Vec<RunHealth>,
    /// Estimated scatter of a measured position, m.
    pub position_noise: Option<f64>,
    /// Estimated scatter of a measured heading, rad.
    pub heading_noise: Option<f64>,
    /// How many rows in a row are alike in their noise; 1 is white.
    pub rows_alike: Option<f64>,
    /// The clocks of runs whose inputs and poses stand in files of their own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub clocks: Vec<RunClock>,
    /// What the driver of these runs should know.
    pub findings: Vec<Finding>,
}

/// The state of one run.
///
/// ```
/// use creepage::report::RunHealth;
/// let run = RunHealth { rows: 600, duration_s: 60.0, ..RunHealth::default() };
/// assert_eq!(run.rows as f64 / run.duration_s, 10.0);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunHealth {
    /// Its name.
    pub run: String,
    /// Rows used.
    pub rows: usize,
    /// Rows left out.
    pub rows_dropped: usize,
    /// Why.
    pub why_dropped: BTreeMap<String, usize>,
    /// From the first row to the last, s.
    pub duration_s: f64,
    /// Rows a second, by the usual time between them.
    pub rate_hz: f64,
    /// Spread of the times between rows, as a share of the usual one: half of what lies between their 5 % and 95 %.
    pub jitter: f64,
    /// How often the log is interrupted.
    pub gaps: usize,
    /// Longest time between two rows, s.
    pub longest_gap_s: f64,
    /// Forward speed by the model: 5 %, 50 % and 95 % of the time it moves, m/s.
    pub speed: Option<[f64; 3]>,
    /// Share of the time it turns left, right, stands, and goes backwards.
    pub left: f64,
    /// See `left`.
    pub right: f64,
    /// See `left`.
    pub standing: f64,
    /// See `left`.
    pub backwards: f64,
    /// Measured way over the way the model drives.
    pub way_ratio: Option<f64>,
    /// Measured turning over that of the model.
    pub turn_ratio: Option<f64>,
}
