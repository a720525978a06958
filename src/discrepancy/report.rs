//! What `discover` says, as data: the contract's `report.json` and the pictures of `report.html`.

use crate::effects::TypicalMotion;
use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The whole answer; its JSON form is fixed by the contract.
///
/// ```
/// use creepage::{Model, Report, Run, Verdict};
/// let model = Model::read("examples/runs/cornering/model.toml")?;
/// let eights = Run::read("examples/runs/cornering/eights.csv", &model)?;
/// let report: Report = creepage::discover(&model, &[eights])?.report;
/// assert_eq!((report.verdict, report.effects.len()), (Verdict::MissingEffect, 1));
/// assert!(report.json()?.contains("missing-effect"));
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Version of this layout.
    pub schema: u32,
    /// The first verdict that holds.
    pub verdict: Verdict,
    /// One sentence for a person who has not read the paper.
    pub summary: String,
    /// The effects named, in the order they were added.
    pub effects: Vec<Named>,
    /// Repeatable disagreement that no effect explains.
    pub unnamed: Vec<Unnamed>,
    /// Where model and measurement disagree before anything is added.
    pub disagreement: Vec<Disagreement>,
    /// What the fit asks for and is not named, and why.
    #[serde(default)]
    pub refuted: Vec<Refuted>,
    /// What remains above the noise floor; null at the floor.
    #[serde(default)]
    pub remains: Option<Remains>,
    /// Covariance of all fitted values.
    #[serde(default)]
    pub covariance: Option<Covariance>,
    /// Runs that differ from the others; what was found is of the others.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub odd_runs: Vec<OddRun>,
    /// What the last model leaves of each constraint.
    #[serde(default)]
    pub remaining: Option<Remaining>,
    /// Error of prediction over horizons, before and after.
    pub gap: Vec<Gap>,
    /// What the kinematic model of a log with forces says, where the log measures its wheels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kinematic: Option<KinematicComparison>,
    /// What to drive next, when the data cannot tell.
    pub next_experiment: Option<NextExperiment>,
    /// What each added effect did to the gap of the fitting data.
    pub steps: Vec<Step>,
    /// What was read.
    pub data: DataSummary,
    /// Where the answer comes from.
    pub provenance: Provenance,
}

/// The verdicts of the contract.
///
/// ```
/// use creepage::Verdict;
/// assert_eq!(serde_json::to_string(&Verdict::MissingEffect).unwrap(), "\"missing-effect\"");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The model does not apply to these data.
    UnusableData,
    /// Nothing significant found, and a plausible effect would have been missed.
    NotIdentifiable,
    /// A significant disagreement that has neither a name nor an equation.
    Unexplained,
    /// A repeatable disagreement that no effect explains.
    UnnamedEffect,
    /// One or more effects named.
    MissingEffect,
    /// The model explains the data to its noise.
    NoMissingEffect,
}

impl Verdict {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::UnusableData,
        Self::NotIdentifiable,
        Self::Unexplained,
        Self::UnnamedEffect,
        Self::MissingEffect,
        Self::NoMissingEffect,
    ];

    /// Its name in files.
    ///
    /// ```
    /// use creepage::discrepancy::report::Verdict;
    /// assert!(Verdict::ALL.iter().all(|v| serde_json::to_value(v).unwrap() == v.id()));
    /// ```
    pub fn id(self) -> &'static str {
        match self {
            Self::UnusableData => "unusable-data",
            Self::NotIdentifiable => "not-identifiable",
            Self::Unexplained => "unexplained",
            Self::UnnamedEffect => "unnamed-effect",
            Self::MissingEffect => "missing-effect",
            Self::NoMissingEffect => "no-missing-effect",
        }
    }
}

/// The kinematic model of a log beside the one with forces.
///
/// ```
/// use creepage::discrepancy::report::KinematicComparison;
/// fn creeps(beside: &KinematicComparison) -> Vec<&str> {
///     beside.report.effects.iter().map(|e| e.id.as_str()).collect()
/// }
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KinematicComparison {
    /// What is missing in the model that the measured wheels drive.
    pub report: Box<Report>,
    /// The values of its effects on the motion that the model with forces makes, in their order and by parameter.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub by_forces: Vec<BTreeMap<String, f64>>,
}

impl KinematicComparison {
    /// What the forces predict of a parameter of the i-th effect.
    pub fn predicted(&self, i: usize, parameter: &str) -> Option<f64> {
        self.by_forces.get(i)?.get(parameter).copied()
    }
}

/// An effect that was found.
///
/// ```
/// # use creepage::{Model, Run};
/// # let model = Model::read("examples/runs/cornering/model.toml")?;
/// # let eights = Run::read("examples/runs/cornering/eights.csv", &model)?;
/// use creepage::report::Named;
/// let report = creepage::discover(&model, &[eights])?.report;
/// let creep: &Named = &report.effects[0];
/// assert_eq!(creep.id, "cornering-creep");
/// assert!((creep.parameters["mass_over_bT"].value - 0.11).abs() < 0.01);
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Named {
    /// Its id in the library.
    pub id: String,
    /// What the vehicle or its log really does, in words.
    #[serde(default)]
    pub says: String,
    /// The same for anyone, with its numbers: a sentence without its end.
    #[serde(default)]
    pub plain: String,
    /// Where it acts.
    #[serde(rename = "where")]
    pub place: String,
    /// The role of the input it acts on, where it acts on one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
    /// When, where or in which regime it holds; always and everywhere where there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scope: Option<ScopeFound>,
    /// Its fitted parameters by name.
    pub parameters: BTreeMap<String, Estimate>,
    /// How strongly the data speak for it.
    pub evidence: Evidence,
    /// Effects these data (or any data) do not tell from it.
    pub indistinguishable_from: Vec<Rival>,
    /// What the effect says, as a formula.
    pub equation: String,
    /// Parameters run by run, where there are several runs.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub per_run: BTreeMap<String, PerRun>,
}

/// A parameter run by run, and how far it differs between them.
///
/// ```
/// use creepage::report::PerRun;
/// let text = r#"{"runs": [{"run": "a.csv", "value": 0.05, "std": 0.01}], "tau": 0.0, "q": 0.0, "p_value": 1.0}"#;
/// let slip: PerRun = serde_json::from_str(text).unwrap();
/// assert!(slip.tau <= slip.runs[0].std);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PerRun {
    /// What each run says alone, as far as it tells.
    pub runs: Vec<RunEstimate>,
    /// Standard deviation between runs, beyond their own.
    pub tau: f64,
    /// Cochran's Q.
    pub q: f64,
    /// Probability of so large a Q where all runs have one value.
    pub p_value: f64,
}

/// What a run says alone.
///
/// ```
/// use creepage::report::RunEstimate;
/// let one = RunEstimate { run: "a.csv".into(), value: 0.05, std: 0.01 };
/// assert!(one.value > 3.0 * one.std);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunEstimate {
    /// File name of the run.
    pub run: String,
    /// Its value.
    pub value: f64,
    /// Its standard deviation.
    pub std: f64,
}

/// A run that differs from all others.
///
/// ```
/// use creepage::report::OddRun;
/// let text = r#"{"run": "c.csv", "id": "track-width", "parameters": {}, "others": {}, "says": "c.csv differs"}"#;
/// let odd: OddRun = serde_json::from_str(text).unwrap();
/// assert_eq!((odd.run.as_str(), odd.id.as_str()), ("c.csv", "track-width"));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OddRun {
    /// File name of the run.
    pub run: String,
    /// The effect it has, by its id in the library.
    pub id: String,
    /// Its values there.
    pub parameters: BTreeMap<String, Estimate>,
    /// Its values in the others.
    pub others: BTreeMap<String, Estimate>,
    /// The effect for anyone, with its numbers there: a sentence without its end.
    #[serde(default)]
    pub plain: String,
    /// All this in words.
    pub says: String,
}

/// When, where or in which regime an effect holds; the keys are those of a model file.
///
/// ```
/// use creepage::report::ScopeFound;
/// let scope: ScopeFound = serde_json::from_str(r#"{"from": 35.3, "says": "from 35.3 s on"}"#).unwrap();
/// assert_eq!((scope.from, scope.until), (Some(35.3), None));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ScopeFound {
    /// When it begins, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<f64>,
    /// When it ends, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until: Option<f64>,
    /// When it begins and ends, several times, s.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub intervals: Vec<[f64; 2]>,
    /// The regime of driving.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub regime: Option<String>,
    /// The speed above which it holds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub above: Option<AboveSpeed>,
    /// x, y and radius of a disk, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub disk: Option<[f64; 3]>,
    /// A formula, greater than zero where it holds.
    #[serde(rename = "where", default, skip_serializing_if = "Option::is_none")]
    pub positive: Option<String>,
    /// All this in words.
    #[serde(default)]
    pub says: String,
}

/// A speed above which an effect holds.
///
/// ```
/// use creepage::report::AboveSpeed;
/// assert_eq!(serde_json::to_string(&AboveSpeed { speed: 1.5 }).unwrap(), r#"{"speed":1.5}"#);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AboveSpeed {
    /// The speed, m/s.
    pub speed: f64,
}

/// How a parameter moves with time.
///
/// ```
/// use creepage::report::CourseFound;
/// let text = r#"{"kind": "linear", "per_s": 0.0004, "std": 0.00001, "since": 0.0}"#;
/// let warming: CourseFound = serde_json::from_str(text).unwrap();
/// assert!(warming.std.zip(warming.per_s).is_some_and(|(std, per_s)| per_s > 3.0 * std));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CourseFound {
    /// `linear` or `random-walk`.
    pub kind: String,
    /// Of a linear one how fast, in the parameter's unit a second.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub per_s: Option<f64>,
    /// Of a walk the deviation of its steps over a second, in the parameter's unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub per_sqrt_s: Option<f64>,
    /// The standard deviation of that; null where the data give none.
    pub std: Option<f64>,
    /// Of a linear one when the parameter has its value, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub since: Option<f64>,
}

/// A fitted number.
///
/// ```
/// use creepage::report::Estimate;
/// let creep = Estimate { value: 0.05, std: Some(0.01), unit: "1".into(), course: None };
/// assert!(creep.std.is_some_and(|std| creep.value.abs() > 3.0 * std));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// Its standard deviation; null where the data give none.
    pub std: Option<f64>,
    /// Its unit.
    pub unit: String,
    /// How it moves with time, where it does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub course: Option<CourseFound>,
}

/// Evidence for an effect on the fitting data.
///
/// ```
/// use creepage::report::Evidence;
/// let evidence = Evidence { delta_bic: 120.0, p_value: 1e-9 };
/// assert!(evidence.delta_bic > 10.0 && evidence.p_value < 1e-3);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evidence {
    /// BIC without minus BIC with the effect.
    pub delta_bic: f64,
    /// Probability of so large an improvement where nothing is missing.
    pub p_value: f64,
}

/// An effect that is not told from a named one.
///
/// ```
/// use creepage::report::{Named, Rival};
/// fn rivals(effect: &Named) -> Vec<&str> {
///     effect.indistinguishable_from.iter().map(|rival: &Rival| rival.id.as_str()).collect()
/// }
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rival {
    /// Its id.
    pub id: String,
    /// `identical`, `first order` or `data`.
    pub why: String,
}

/// A disagreement with an equation but no name.
///
/// ```
/// use creepage::report::Unnamed;
/// fn is_worth_a_look(term: &Unnamed) -> bool {
///     term.held_out_reduction > 0.3
/// }
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Unnamed {
    /// The constraint it violates.
    #[serde(rename = "where")]
    pub place: String,
    /// Its equation.
    pub equation: String,
    /// Share of the held-out disagreement it removes.
    pub held_out_reduction: f64,
    /// Its coefficient by name.
    #[serde(default)]
    pub parameters: BTreeMap<String, Estimate>,
}

/// What the fit asks for, and is neither named nor in the patched model.
///
/// ```
/// use creepage::{Report, report::Refuted};
/// fn reasons(report: &Report) -> Vec<&str> {
///     report.refuted.iter().map(|refuted: &Refuted| refuted.says.as_str()).collect()
/// }
/// let model = creepage::Model::read("examples/runs/cornering/model.toml")?;
/// let eights = creepage::Run::read("examples/runs/cornering/eights.csv", &model)?;
/// assert!(reasons(&creepage::discover(&model, &[eights])?.report).is_empty());
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Refuted {
    /// Its id in the library.
    pub id: String,
    /// Its fitted parameters by name.
    pub parameters: BTreeMap<String, Estimate>,
    /// Why, in words.
    pub says: String,
}

/// What remains above the noise floor.
///
/// ```
/// use creepage::report::Remains;
/// let text = r#"{"ratio": 5.0, "where": "yaw rate", "from": 27.0, "to": 58.0, "regime": "reverse", "says": ""}"#;
/// let remains: Remains = serde_json::from_str(text).unwrap();
/// assert_eq!((remains.place.as_str(), remains.to - remains.from), ("yaw rate", 31.0));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Remains {
    /// The error over the noise floor: of the position at the horizon of the first page, or as `says` has it.
    pub ratio: f64,
    /// The constraint that is violated most.
    #[serde(rename = "where")]
    pub place: String,
    /// Start of the stretch in which it is, s.
    pub from: f64,
    /// End of the stretch, s.
    pub to: f64,
    /// What the vehicle does where it is violated most.
    pub regime: String,
    /// All this in words.
    pub says: String,
}

/// The covariance of fitted values, as far as rows and windows are independent; the deviations of the report have in them, too,
/// by how much parts of the data scatter and what lies between the rows of the inputs.
///
/// ```
/// use creepage::report::Covariance;
/// let text = r#"{"names": ["track-width scale"], "matrix": [[0.0004]]}"#;
/// let covariance: Covariance = serde_json::from_str(text).unwrap();
/// assert_eq!(covariance.matrix[0][0].sqrt(), 0.02);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Covariance {
    /// Effect and parameter of each row, such as `lever-arm a`.
    pub names: Vec<String>,
    /// Its rows.
    pub matrix: Vec<Vec<f64>>,
}

/// A stretch of a run in which a constraint is violated.
///
/// ```
/// use creepage::report::Disagreement;
/// fn worst(all: &[Disagreement]) -> Option<&Disagreement> {
///     all.iter().max_by(|a, b| a.share_of_gap.total_cmp(&b.share_of_gap))
/// }
/// assert_eq!(worst(&[]), None);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Disagreement {
    /// File name of the run.
    pub run: String,
    /// The constraint.
    #[serde(rename = "where")]
    pub place: String,
    /// Start, s.
    pub from: f64,
    /// End, s.
    pub to: f64,
    /// What the vehicle did there.
    pub regime: String,
    /// Share of the whole disagreement that lies here.
    pub share_of_gap: f64,
}

/// What the last model leaves, on the fitted data.
///
/// ```
/// use creepage::report::Remaining;
/// fn is_white(remaining: &Remaining) -> bool {
///     remaining.rows_alike < 1.5
/// }
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Remaining {
    /// Standard deviation of a measured coordinate, m.
    pub position_noise: f64,
    /// Standard deviation of a measured heading, rad, where one is measured.
    pub heading_noise: Option<f64>,
    /// How many rows in a row the noise is alike: 1 where it is white.
    pub rows_alike: f64,
    /// How many windows in a row what no effect explains is alike: 1 where it is white or nothing.
    pub windows_alike: f64,
    /// Constraint by constraint.
    pub constraints: Vec<RemainingConstraint>,
    /// Quantity by quantity that is measured beside the pose.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sensors: Vec<RemainingSensor>,
}

/// What remains of a quantity that is measured beside the pose.
///
/// ```
/// use creepage::report::RemainingSensor;
/// fn is_noise(left: &RemainingSensor) -> bool {
///     left.rms <= 2.0 * left.noise
/// }
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RemainingSensor {
    /// Its name in the model file.
    pub name: String,
    /// Its SI unit; empty where nothing says it.
    pub unit: String,
    /// RMS of what the last model says minus what is measured.
    pub rms: f64,
    /// The noise that its rows show.
    pub noise: f64,
}

/// What remains of one constraint.
///
/// ```
/// use creepage::report::RemainingConstraint;
/// fn is_noise(left: &RemainingConstraint) -> bool {
///     left.p_value > 0.01 || left.rms <= left.noise
/// }
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RemainingConstraint {
    /// The constraint.
    #[serde(rename = "where")]
    pub place: String,
    /// Unit of the violated rate.
    pub unit: String,
    /// Root mean square of the violated rate over windows of a second.
    pub rms: f64,
    /// What noise alone makes of it.
    pub noise: f64,
    /// Probability of so much unexplained motion by chance.
    pub p_value: f64,
}

/// RMS error of prediction over one horizon.
///
/// ```
/// # use creepage::{Model, Run};
/// # let model = Model::read("examples/runs/cornering/model.toml")?;
/// # let eights = Run::read("examples/runs/cornering/eights.csv", &model)?;
/// use creepage::report::Gap;
/// let gaps: Vec<Gap> = creepage::discover(&model, &[eights])?.report.gap;
/// assert_eq!(gaps.iter().map(|g| g.horizon_s).collect::<Vec<_>>(), [1.0, 5.0, 30.0]);
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gap {
    /// Horizon, s.
    pub horizon_s: f64,
    /// On the data that were fitted.
    pub fit: Option<BeforeAfter>,
    /// On the data that were held out.
    pub held_out: Option<BeforeAfter>,
    /// What remains when the patched model is true.
    pub noise_floor: Floor,
}

/// Position in metres, heading in radians; heading is null when none was measured.
///
/// ```
/// use creepage::report::BeforeAfter;
/// let gap = BeforeAfter {
///     position_rms_before: 0.20,
///     position_rms_after: 0.01,
///     heading_rms_before: None,
///     heading_rms_after: None,
/// };
/// assert!(gap.position_rms_after < 0.1 * gap.position_rms_before);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeforeAfter {
    /// Position error of the model as given.
    pub position_rms_before: f64,
    /// Position error of the patched model.
    pub position_rms_after: f64,
    /// Heading error of the model as given.
    pub heading_rms_before: Option<f64>,
    /// Heading error of the patched model.
    pub heading_rms_after: Option<f64>,
}

/// The gap that measurement noise alone makes.
///
/// ```
/// use creepage::report::Floor;
/// let floor = Floor { position_rms: 0.002, heading_rms: None };
/// assert!(0.0021 < 1.5 * floor.position_rms);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Floor {
    /// Position, m.
    pub position_rms: f64,
    /// Heading, rad.
    pub heading_rms: Option<f64>,
}

/// A manoeuvre that would tell what these data cannot.
///
/// ```
/// use creepage::report::NextExperiment;
/// fn order(next: &NextExperiment) -> String {
///     format!("drive: {}", next.manoeuvre)
/// }
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NextExperiment {
    /// What it would tell.
    pub why: String,
    /// What to drive.
    pub manoeuvre: String,
}

/// One step of the selection.
///
/// ```
/// use creepage::report::Step;
/// let step = Step { added: "cornering-creep".into(), gap_after: 0.01 };
/// assert!(step.gap_after < 0.05);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Step {
    /// The effect added.
    pub added: String,
    /// Position gap of the fitting data after it, m, at the middle horizon.
    pub gap_after: f64,
}

/// What was read.
///
/// ```
/// use creepage::report::DataSummary;
/// fn dropped(data: &DataSummary) -> f64 {
///     data.rows_dropped as f64 / (data.rows + data.rows_dropped).max(1) as f64
/// }
/// ```
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct DataSummary {
    /// Number of runs.
    pub runs: usize,
    /// Rows used.
    pub rows: usize,
    /// Rows dropped.
    pub rows_dropped: usize,
    /// Rows dropped by reason.
    pub why_dropped: BTreeMap<String, usize>,
    /// Things a user should know of the data.
    pub warnings: Vec<String>,
    /// The clocks of runs whose inputs and poses stand in files of their own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub clocks: Vec<RunClock>,
    /// What is wrong with the data, and how it is mended.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<Finding>,
}

/// Something to know of the data.
///
/// ```
/// use creepage::report::Finding;
/// fn is_one_sided(findings: &[Finding]) -> bool {
///     findings.iter().any(|finding| finding.id == "one-turn-direction")
/// }
/// assert!(!is_one_sided(&[]));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Its kind, for scripts, such as `one-turn-direction`.
    pub id: String,
    /// In words.
    pub says: String,
    /// The lines of the model file that mend it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mend: Option<String>,
}

/// The clock of a run whose inputs and poses were logged apart: time of the poses = time of the inputs + offset +
/// drift·(time of the inputs − at).
///
/// ```
/// use creepage::report::RunClock;
/// fn is_unique(clock: &RunClock) -> bool {
///     clock.other_offset_s.is_none()
/// }
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunClock {
    /// File name of the inputs.
    pub run: String,
    /// File name of the poses.
    pub truth: String,
    /// Whether it was only judged.
    pub held_out: bool,
    /// Offset, s.
    pub offset_s: Estimate,
    /// Drift, seconds a second.
    pub drift: Estimate,
    /// The time of the inputs at which the clocks differ by the offset, s.
    pub at_s: f64,
    /// Correlation of the motion in both files, at most one.
    pub correlation: f64,
    /// Another offset at which both files agree nearly as well, s.
    pub other_offset_s: Option<f64>,
}

/// Where an answer comes from.
///
/// ```
/// use creepage::report::Provenance;
/// fn is_ours(of: &Provenance, sha256: &str) -> bool {
///     of.inputs_sha256.values().any(|digest| digest == sha256)
/// }
/// ```
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Provenance {
    /// Version of the program.
    pub version: String,
    /// Seed of every random number used.
    pub seed: u64,
    /// SHA-256 of every input file, by name.
    pub inputs_sha256: BTreeMap<String, String>,
}

/// What the pictures of the HTML report show; everything in SI units.
#[derive(Clone, Debug, Default)]
pub struct Pictures {
    /// Measured and predicted paths, one entry a run.
    pub paths: Vec<PathPicture>,
    /// The gap over the horizon on held-out data (on fitted data when nothing was held out).
    pub gap: GapCurve,
    /// Violation of each constraint over time.
    pub residuals: Vec<ResidualPicture>,
    /// The columns of the runs, where these are not fitted.
    pub columns: Vec<ColumnPicture>,
    /// The candidates by evidence, best first.
    pub candidates: Vec<CandidatePicture>,
    /// The patched constraints: name, text equation.
    pub equations: Vec<(String, String)>,
    /// The vehicle, as its model file calls it.
    pub vehicle: String,
    /// How the runs were driven; none where nothing was fitted.
    pub driving: Option<Driving>,
    /// Where both models would be some seconds ahead, from many places of each run.
    pub forecasts: Vec<Forecast>,
    /// What to change, in the words of each thing that can be changed.
    pub changes: Vec<Change>,
}

/// How runs were driven.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Driving {
    /// Number of runs, or of parts of them.
    pub runs: usize,
    /// From the first row to the last, in all, s.
    pub seconds: f64,
    /// Way by the model, in all, m.
    pub metres: f64,
    /// Turns to the left.
    pub left_turns: usize,
    /// Turns to the right.
    pub right_turns: usize,
    /// The usual motion, at which effects are told.
    pub motion: TypicalMotion,
}

/// Predictions from many places of a run, all as far ahead.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forecast {
    /// File name of the run.
    pub run: String,
    /// From when on it was held out, s; infinite where it was fitted.
    pub held_out_from: f64,
    /// How far ahead, s.
    pub ahead: f64,
    /// What noise alone makes of such an error, m.
    pub floor: f64,
    /// From when until when an effect holds that holds in part, s.
    pub scoped: Vec<[f64; 2]>,
    /// Times of the places, s.
    pub time: Vec<f64>,
    /// Measured x, y and heading there.
    pub pose: Vec<[f64; 3]>,
    /// Where the model as given would be from there on, and the patched one; nowhere too near to the end of the run.
    pub paths: Vec<[Vec<[f64; 2]>; 2]>,
    /// How far from the measured position each ends, m; not a number too near to the end of the run.
    pub error: Vec<[f64; 2]>,
}

/// A text to put somewhere.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Change {
    /// What it changes, such as "model" or "ROS 2".
    pub of: String,
    /// The text.
    pub text: String,
}

/// One run seen from above.
#[derive(Clone, Debug, Default)]
pub struct PathPicture {
    /// File name of the run.
    pub run: String,
    /// Whether the run (or this part of it) was held out.
    pub held_out: bool,
    /// Measured points (x, y).
    pub measured: Vec<[f64; 2]>,
    /// The model as given, driven by the log's inputs, restarted at each piece's start.
    pub before: Vec<Vec<[f64; 2]>>,
    /// The patched model, likewise.
    pub after: Vec<Vec<[f64; 2]>>,
}

/// One column of a run over time.
#[derive(Clone, Debug, Default)]
pub struct ColumnPicture {
    /// File name of the run.
    pub run: String,
    /// What the column is, such as "wheel rate".
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// Times, s.
    pub time: Vec<f64>,
    /// Values.
    pub values: Vec<f64>,
}

/// RMS gap against horizon.
#[derive(Clone, Debug, Default)]
pub struct GapCurve {
    /// Horizons, s, increasing.
    pub horizon: Vec<f64>,
    /// Position RMS of the model as given, m.
    pub before: Vec<f64>,
    /// Position RMS of the patched model, m.
    pub after: Vec<f64>,
    /// Noise floor, m.
    pub floor: Vec<f64>,
}

/// Violation of one constraint over time in one run.
#[derive(Clone, Debug, Default)]
pub struct ResidualPicture {
    /// The constraint, such as "rotation constraint".
    pub constraint: String,
    /// File name of the run.
    pub run: String,
    /// Unit of the values, such as "m/s".
    pub unit: String,
    /// Times, s.
    pub time: Vec<f64>,
    /// Violated rate with the model as given.
    pub before: Vec<f64>,
    /// Violated rate with the patched model.
    pub after: Vec<f64>,
    /// One standard deviation that measurement noise gives such a value.
    pub noise: f64,
}

/// One effect of the library as a candidate.
#[derive(Clone, Debug, Default)]
pub struct CandidatePicture {
    /// Its id.
    pub id: String,
    /// Evidence on the fitting data, BIC without minus with; negative speaks against it.
    pub delta_bic: f64,
    /// Whether it was chosen.
    pub chosen: bool,
    /// Whether it is listed as indistinguishable from a chosen one.
    pub rival: bool,
}

impl Report {
    /// The text of `report.json`.
    ///
    /// # Errors
    /// When a number of the report has no JSON.
    pub fn json(&self) -> Result<String> {
        let json = serde_json::to_string_pretty(self).map_err(|e| Error::run(format!("no report.json: {e}")))?;
        Ok(json + "\n")
    }
}

/// The gaps that are judged on the same runs: held-out ones where there are such.
pub fn judged_alike(gaps: &[Gap]) -> Vec<&Gap> {
    let is_held_out = gaps.iter().any(|g| g.held_out.is_some());
    gaps.iter().filter(|g| g.held_out.is_some() == is_held_out).collect()
}

/// The gap at the middle horizon of those that are judged alike; of two horizons the longer.
pub fn middle(gaps: &[Gap]) -> Option<&Gap> {
    let alike = judged_alike(gaps);
    alike.get(alike.len() / 2).copied()
}

/// The numbers a gap is judged by, held out where there are such, and what they are called.
pub fn judged(gap: &Gap) -> Option<(&'static str, &BeforeAfter)> {
    let held_out = gap.held_out.as_ref().map(|g| ("held-out", g));
    held_out.or_else(|| gap.fit.as_ref().map(|g| ("fitted", g)))
}
