//! The manifest of a fleet: a table that says of each log which robot drove it, and under which conditions.

use crate::error::{Error, Result};
use crate::files::log::csv_records::Records;
use crate::files::toml::suggestions::advice;
use crate::files::toml::text::open;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::io::BufReader;
use std::path::{Path, PathBuf};

/// Columns that are no tags.
const KNOWN: [&str; 6] = ["robot", "run", "date", "log", "truth", "model"];

/// A log of a fleet.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FleetLog {
    /// The run, unique within its robot.
    pub run: String,
    /// The log.
    pub log: PathBuf,
    /// Measured poses in a file of their own.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub truth: Option<PathBuf>,
    /// When it was driven.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub date: Option<String>,
    /// Anything else the manifest says of it.
    #[serde(skip_serializing_if = "BTreeMap::is_empty", default)]
    pub tags: BTreeMap<String, String>,
}

/// A robot of a fleet.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Robot {
    /// Its name, which is a file name.
    pub robot: String,
    /// Its model.
    pub model: PathBuf,
    /// Its logs, in the order of the manifest.
    pub logs: Vec<FleetLog>,
}

/// A fleet.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    /// Its robots, in the order in which they are first named.
    pub robots: Vec<Robot>,
}

impl Manifest {
    /// Reads a manifest; paths are taken from its folder.
    ///
    /// # Errors
    /// With line and column: a column that is needed and missing, a cell that is empty, a robot with two models, a run
    /// named twice.
    pub fn read(path: &Path) -> Result<Self> {
        let unreadable = |e: std::io::Error| Error::input(format!("cannot be read: {e}")).at_file(path);
        let mut records = Records::new(BufReader::new(open(path)?), b',');
        let folder = path.parent().unwrap_or(Path::new(""));
        if !records.advance().map_err(unreadable)? {
            return Err(Error::input("is empty").at_file(path).help(HEADER));
        }
        let columns = header(&records, path)?;
        let mut manifest = Self::default();
        while records.advance().map_err(unreadable)? {
            let row = Row { path, folder, columns: &columns, records: &records };
            manifest.add(&row)?;
        }
        match manifest.robots.is_empty() {
            true => Err(Error::input("names no log").at_file(path).help("write a line for every log")),
            false => Ok(manifest),
        }
    }

    fn add<R: std::io::BufRead>(&mut self, row: &Row<R>) -> Result<()> {
        let robot = row.file_name("robot")?;
        let (log, model) = (row.needed_path("log")?, row.needed_path("model")?);
        let stem = || log.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
        let tags = row.columns.iter().filter(|c| !KNOWN.contains(&c.as_str()));
        let tags = tags.map(|c| Ok((c.clone(), row.cell(c)?.unwrap_or_default()))).collect::<Result<_>>()?;
        let run = row.cell("run")?.unwrap_or_else(stem);
        let entry = FleetLog { run, truth: row.path("truth")?, date: row.cell("date")?, tags, log };
        let at = match self.robots.iter().position(|r| r.robot == robot) {
            Some(at) => at,
            None => {
                self.robots.push(Robot { robot, model: model.clone(), logs: vec![] });
                self.robots.len() - 1
            }
        };
        let known = &mut self.robots[at];
        if known.model != model {
            let message = format!("robot {} has the model {} before", known.robot, known.model.display());
            return Err(row.error("model", message).help("give a robot one model"));
        }
        if known.logs.iter().any(|l| l.run == entry.run) {
            let message = format!("robot {} has a run {} before", known.robot, entry.run);
            return Err(row.error("run", message).help("name each run of a robot once, in a column \"run\""));
        }
        if known.logs.iter().any(|l| l.log == entry.log) {
            return Err(row.error("log", "the log is named twice".into()).help("name it once"));
        }
        known.logs.push(entry);
        Ok(())
    }

    /// All tags, sorted.
    pub fn tags(&self) -> BTreeSet<&str> {
        self.robots.iter().flat_map(|r| &r.logs).flat_map(|l| l.tags.keys().map(String::as_str)).collect()
    }

    /// How many logs there are.
    pub fn logs(&self) -> usize {
        self.robots.iter().map(|r| r.logs.len()).sum()
    }
}

const HEADER: &str =
    "the first line names the columns: robot,run,date,log,truth,model and any tags; needed are robot,log,model";

fn header<R: std::io::BufRead>(records: &Records<R>, path: &Path) -> Result<Vec<String>> {
    let columns: Vec<String> =
        (0..records.len()).map(|i| String::from_utf8_lossy(records.cell(i)).into_owned()).collect();
    let at = |i: usize| records.place(i);
    for (i, column) in columns.iter().enumerate() {
        let (line, place) = at(i);
        if column.is_empty() || columns[..i].contains(column) {
            let message = if column.is_empty() {
                "a column has no name".to_string()
            } else {
                format!("two columns are named \"{column}\"")
            };
            return Err(Error::input(message).at_file(path).at(line, place).help(HEADER));
        }
    }
    for needed in ["robot", "log", "model"] {
        if !columns.iter().any(|c| c == needed) {
            let known: Vec<&str> = columns.iter().map(String::as_str).collect();
            let help = format!("{HEADER}; {}", advice(needed, "columns of this file", &known));
            return Err(Error::input(format!("no column \"{needed}\"")).at_file(path).at(1, 1).help(help));
        }
    }
    Ok(columns)
}

/// A row of the manifest.
struct Row<'a, R> {
    path: &'a Path,
    folder: &'a Path,
    columns: &'a [String],
    records: &'a Records<R>,
}

impl<R: std::io::BufRead> Row<'_, R> {
    fn index(&self, column: &str) -> Option<usize> {
        self.columns.iter().position(|c| c == column).filter(|i| *i < self.records.len())
    }

    fn error(&self, column: &str, message: String) -> Error {
        let (line, place) = self.index(column).map_or((self.records.line(), 1), |i| self.records.place(i));
        Error::input(message).at_file(self.path).at(line, place)
    }

    /// The text of a cell; none where it is empty.
    fn cell(&self, column: &str) -> Result<Option<String>> {
        if self.records.len() > self.columns.len() {
            let (line, place) = self.records.place(self.columns.len());
            let message = format!("{} cells under {} columns", self.records.len(), self.columns.len());
            return Err(Error::input(message)
                .at_file(self.path)
                .at(line, place)
                .help("quote a cell that holds a comma"));
        }
        let Some(i) = self.index(column) else { return Ok(None) };
        match std::str::from_utf8(self.records.cell(i)) {
            Ok("") => Ok(None),
            Ok(text) => Ok(Some(text.to_string())),
            Err(_) => Err(self.error(column, "is no UTF-8 text".into()).help("save the table as UTF-8")),
        }
    }

    fn needed(&self, column: &str) -> Result<String> {
        let missing =
            || self.error(column, format!("the row has no {column}")).help(format!("fill in the column \"{column}\""));
        self.cell(column)?.ok_or_else(missing)
    }

    fn path(&self, column: &str) -> Result<Option<PathBuf>> {
        Ok(self.cell(column)?.map(|p| self.folder.join(p)))
    }

    fn needed_path(&self, column: &str) -> Result<PathBuf> {
        Ok(self.folder.join(self.needed(column)?))
    }

    /// A name that files can bear.
    fn file_name(&self, column: &str) -> Result<String> {
        let name = self.needed(column)?;
        let fit = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '.' | ' ');
        match name.chars().all(fit) && !name.starts_with('.') && name.len() <= 100 {
            true => Ok(name),
            false => Err(self
                .error(column, format!("\"{name}\" cannot name a file"))
                .help("use letters, digits, blanks and - _ . for names of robots")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Manifest> {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("fleet.csv");
        std::fs::write(&path, text).unwrap();
        Manifest::read(&path)
    }

    #[test]
    fn logs_are_kept_by_robot_with_their_tags() {
        let text = "robot,date,log,model,floor\nr1,2026-01-02,a.csv,m.toml,tile\nr2,,b.csv,m.toml,\"wood, old\"\nr1,,c.csv,m.toml,\n";
        let found = read(text).unwrap();
        assert_eq!((found.robots.len(), found.logs(), found.tags().len()), (2, 3, 1));
        let [a, c] = &found.robots[0].logs[..] else { panic!() };
        assert!(a.log.ends_with("a.csv") && a.date.as_deref() == Some("2026-01-02") && a.run == "a" && c.run == "c");
        assert_eq!(found.robots[1].logs[0].tags["floor"], "wood, old");
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        for (text, says, place) in [
            ("", "is empty", None),
            ("robot,log\n", "no column \"model\"", Some((1, 1))),
            ("robot,log,model\n", "names no log", None),
            ("robot,log,model,log\n", "two columns are named \"log\"", Some((1, 17))),
            ("robot,log,model\nr1,,m.toml\n", "the row has no log", Some((2, 4))),
            ("robot,log,model\nr1,a.csv\n", "the row has no model", Some((2, 1))),
            ("robot,log,model\n../r,a.csv,m.toml\n", "cannot name a file", Some((2, 1))),
            ("robot,log,model\nr,a.csv,m.toml\nr,b.csv,n.toml\n", "has the model", Some((3, 9))),
            ("robot,log,model\nr,a.csv,m.toml\nr,d/a.csv,m.toml\n", "has a run a before", Some((3, 1))),
            ("robot,log,model\nr,a.csv,m.toml,7\n", "4 cells under 3 columns", Some((2, 16))),
        ] {
            let e = read(text).unwrap_err();
            assert!(e.exit_code() == 2 && e.message().contains(says), "{text}: {e}");
            assert_eq!(e.place(), place, "{text}");
        }
    }
}
