//! The rows of a fleet: a file for every robot, written whole, from which an interrupted map goes on.

use crate::discrepancy::calibration::targets::Target;
use crate::discrepancy::calibration_report::Calibration;
use crate::discrepancy::report::{Estimate, Evidence, Report, Verdict};
use crate::error::{Error, Result};
use crate::files::{Manifest, Robot, write_whole};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// What a whole fleet was mapped with: the manifest, and files of the user's own.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Mapped {
    /// Version of this form.
    pub schema: u32,
    /// The robots and their logs.
    pub manifest: Manifest,
    /// The user's own vehicles.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub vehicles: Option<PathBuf>,
    /// The user's own effects.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub effects: Option<PathBuf>,
}

/// What `discover` says of a robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Discovered {
    /// SHA-256 of everything that decides it.
    pub identity: String,
    /// The robot.
    pub robot: Robot,
    /// The effects that its runs name together.
    pub named: Vec<Vote>,
    /// What each run says, in the order of the manifest.
    pub runs: Vec<Answer>,
    /// What all its runs say in one call, where none says anything alone.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub together: Option<Answer>,
}

impl Discovered {
    /// The verdict of most answers, of as many the first.
    pub fn verdict(&self) -> Verdict {
        let answers = || self.runs.iter().map(|a| a.report.verdict);
        let count = |v: Verdict| answers().filter(|a| *a == v).count();
        let most = || answers().rev().max_by_key(|v| count(*v)).unwrap_or(Verdict::UnusableData);
        self.together.as_ref().map_or_else(most, |a| a.report.verdict)
    }
}

/// What `discover` says of runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// The effects that it names.
    pub named: Vec<Vote>,
    /// All it says.
    pub report: Report,
}

/// An effect that a robot asks for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Vote {
    /// The effect as `creepage fit` takes it: `ID`, `ID@INPUT` or `ID@TRAILER`.
    pub target: String,
    /// What it means.
    pub says: String,
    /// Whether it holds in part only, or moves with time.
    pub in_part: bool,
    /// Effects that no data tell from it.
    pub identical: Vec<String>,
    /// How strongly the robot's runs speak for it.
    pub evidence: Evidence,
    /// Its values.
    pub parameters: BTreeMap<String, Estimate>,
}

impl Vote {
    /// Whether both ask for the same, under whatever name.
    pub fn is_same(&self, other: &Vote) -> bool {
        self.in_part == other.in_part && self.means(&other.target)
    }

    /// Whether no data tell it from an effect on the same input or trailer.
    pub fn means(&self, target: &str) -> bool {
        let (Ok(own), Ok(other)) = (self.target.parse::<Target>(), target.parse::<Target>()) else { return false };
        own == other || own.on == other.on && self.identical.contains(&other.id)
    }
}

/// What `fit` says of each run of a robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fitted {
    /// SHA-256 of everything that decides it.
    pub identity: String,
    /// The effects that were fitted.
    pub targets: Vec<String>,
    /// The runs, in the order of the manifest.
    pub runs: Vec<FittedRun>,
}

/// What `fit` says of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FittedRun {
    /// The run.
    pub run: String,
    /// The answer.
    pub calibration: Calibration,
}

/// A folder of rows.
#[derive(Clone, Debug)]
pub struct Rows {
    folder: PathBuf,
}

impl Rows {
    /// The rows in a folder.
    pub fn at(folder: &Path) -> Self {
        Self { folder: folder.into() }
    }

    /// The file that says what was mapped.
    fn mapped(&self) -> PathBuf {
        self.folder.join("fleet.json")
    }

    fn discovered(&self, robot: &str) -> PathBuf {
        self.folder.join("discovered").join(format!("{robot}.json"))
    }

    fn fitted(&self, robot: &str) -> PathBuf {
        self.folder.join("fitted").join(format!("{robot}.json"))
    }

    /// Writes what is mapped; all shards write the same.
    pub fn begin(&self, mapped: &Mapped) -> Result<()> {
        for folder in ["discovered", "fitted"] {
            let path = self.folder.join(folder);
            fs::create_dir_all(&path).map_err(|e| Error::input(format!("cannot be made: {e}")).at_file(&path))?;
        }
        write(&self.mapped(), mapped)
    }

    /// What was mapped.
    pub fn read(&self) -> Result<Mapped> {
        let path = self.mapped();
        if !path.is_file() {
            return Err(Error::input("holds no rows of a fleet")
                .at_file(&self.folder)
                .help("creepage fleet map MANIFEST.csv --out ROWS makes them"));
        }
        read(&path)
    }

    /// What `discover` said of a robot, where it was of just these data.
    pub fn kept(&self, robot: &str, identity: &str) -> Option<Discovered> {
        read::<Discovered>(&self.discovered(robot)).ok().filter(|d| d.identity == identity)
    }

    /// What `discover` said of a robot; none where it has not been asked.
    pub fn of(&self, robot: &str) -> Result<Option<Discovered>> {
        let path = self.discovered(robot);
        if path.is_file() { read(&path).map(Some) } else { Ok(None) }
    }

    /// Keeps what `discover` said of a robot.
    pub fn keep(&self, row: &Discovered) -> Result<()> {
        write(&self.discovered(&row.robot.robot), row)
    }

    /// What `fit` said of a robot's runs, where it was asked just this.
    pub fn kept_fit(&self, robot: &str, identity: &str) -> Option<Fitted> {
        read::<Fitted>(&self.fitted(robot)).ok().filter(|f| f.identity == identity)
    }

    /// Keeps what `fit` said of a robot's runs.
    pub fn keep_fit(&self, robot: &str, row: &Fitted) -> Result<()> {
        write(&self.fitted(robot), row)
    }
}

fn write<T: Serialize>(path: &Path, what: &T) -> Result<()> {
    let text = serde_json::to_string_pretty(what).map_err(|e| Error::run(format!("no JSON: {e}")))?;
    write_whole(path, format!("{text}\n").as_bytes())
}

fn read<T: DeserializeOwned>(path: &Path) -> Result<T> {
    let text = crate::files::read_text(path)?;
    serde_json::from_str(&text).map_err(|e| {
        Error::input(format!("is no row of a fleet: {e}")).at_file(path).help("delete it, and run fleet map again")
    })
}

/// SHA-256 of a robot's model and logs, of the user's own files, and of what is asked.
pub fn identity(mapped: &Mapped, robot: &Robot, asked: &str) -> Result<String> {
    let mut hash = Sha256::new();
    hash.update(env!("CARGO_PKG_VERSION"));
    hash.update(asked);
    hash.update(serde_json::to_string(robot).unwrap_or_default());
    let logs = robot.logs.iter().flat_map(|l| std::iter::once(&l.log).chain(&l.truth));
    for path in std::iter::once(&robot.model).chain(logs).chain(&mapped.vehicles).chain(&mapped.effects) {
        let bytes = fs::read(path).map_err(|e| Error::input(format!("cannot be read: {e}")).at_file(path))?;
        hash.update(Sha256::digest(&bytes));
    }
    Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}
