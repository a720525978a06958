//! A logged run: times, measured poses and inputs, ready to compute with.

use super::columns::Resolved;
use super::csv_table::{Numbers, Sheet};
use super::log_file::Log;
use super::row_order;
use crate::error::{Error, Result};
use crate::files::model::model_file::ModelFile;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The fewest rows of a run: an interval has two ends.
const MIN_ROWS: usize = 2;

/// The usable rows of a log, in the order of time, each time once.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Name of the file, without its folder.
    pub name: String,
    /// Where it was read.
    pub path: PathBuf,
    /// SHA-256 of its bytes, hexadecimal.
    pub sha256: String,
    /// Strictly increasing times, s.
    pub time: Vec<f64>,
    /// Measured positions along x, m.
    pub x: Vec<f64>,
    /// Measured positions along y, m.
    pub y: Vec<f64>,
    /// Measured headings, rad, without jumps; none when the log has no such column.
    pub heading: Option<Vec<f64>>,
    /// Measured absolute headings of each trailer, rad, without jumps; empty when not measured.
    pub trailer_headings: Vec<Vec<f64>>,
    /// What each of the inputs is.
    pub roles: Vec<String>,
    /// The inputs as logged, one `Vec` per role.
    pub inputs: Vec<Vec<f64>>,
    /// How many rows of the file were left out.
    pub rows_dropped: usize,
    /// How many rows were left out for each reason.
    pub why_dropped: BTreeMap<String, usize>,
    /// What a user should know of the file.
    pub warnings: Vec<String>,
    /// Of a run whose inputs were logged apart from its poses: their own times, and the file of the poses.
    pub apart: Option<Apart>,
}

/// Inputs that were logged apart from the measured poses.
#[derive(Clone, Debug, PartialEq)]
pub struct Apart {
    /// Strictly increasing times of the inputs, s: by their own clock, or by that of the poses once they are aligned.
    pub time: Vec<f64>,
    /// The file of the poses.
    pub truth: PathBuf,
    /// SHA-256 of its bytes, hexadecimal.
    pub truth_sha256: String,
    /// Whether both have one clock, as the topics of a bag or the rows of a log of which some have no pose.
    pub one_clock: bool,
}

impl Run {
    /// Reads a log by the columns of a model file, in one pass; a bag, whose topics have times of their own, in two.
    pub fn read(path: impl AsRef<Path>, model: &impl AsRef<ModelFile>) -> Result<Self> {
        let (path, model) = (path.as_ref(), model.as_ref());
        let log = Log::open(path)?;
        if log.has_topics() {
            return Self::read_bag(path, model);
        }
        let found = model.columns.resolve(log.header()).map_err(|e| log.at_header(e))?;
        let inputs = driven(&found);
        let run = Self::of(path, log.numbers(&wanted(&found))?, found)?;
        if !run.lacks_cells() {
            return Ok(run);
        }
        Ok(run.with_inputs(Log::open(path)?.numbers(&inputs)?))
    }

    /// A log that is at hand as text; `name` stands for its file.
    ///
    /// # Errors
    /// As [`Run::read`].
    pub fn parse(name: &str, text: &str, model: &ModelFile) -> Result<Self> {
        let path = Path::new(name);
        let sheet = Sheet::new(text.as_bytes(), path)?;
        let found = model.columns.resolve(&sheet.header).map_err(|e| sheet.at_header(e))?;
        let inputs = driven(&found);
        let run = Self::of(path, sheet.numbers(&wanted(&found))?, found)?;
        if !run.lacks_cells() {
            return Ok(run);
        }
        Ok(run.with_inputs(Sheet::new(text.as_bytes(), path)?.numbers(&inputs)?))
    }

    /// Whether rows were left out for what a cell of them holds.
    fn lacks_cells(&self) -> bool {
        self.why_dropped.keys().any(|why| why.contains("cell") || why.contains("value"))
    }

    /// The run with the inputs of all rows that have them. A row whose pose is blank says nothing of where the vehicle is,
    /// and still what was done to it: without its inputs those around it would be taken to go on.
    fn with_inputs(mut self, mut numbers: Numbers) -> Self {
        arrange(&mut numbers);
        let mut columns = numbers.columns.into_iter();
        let time = columns.next().unwrap_or_default();
        if time.len() <= self.time.len() {
            return self;
        }
        self.inputs = columns.collect();
        self.apart = Some(Apart { time, truth: self.path.clone(), truth_sha256: self.sha256.clone(), one_clock: true });
        self
    }

    fn of(path: &Path, mut numbers: Numbers, found: Resolved) -> Result<Self> {
        let warnings = arrange(&mut numbers);
        enough(&numbers).map_err(|e| e.at_file(path))?;
        Ok(Self::build(path, found, numbers, warnings))
    }

    pub(crate) fn build(path: &Path, found: Resolved, numbers: Numbers, warnings: Vec<String>) -> Self {
        let mut columns = numbers.columns.into_iter();
        let mut next = || columns.next().unwrap_or_default();
        let (time, x, y) = (next(), next(), next());
        let mut angle = || {
            let mut angles = next();
            row_order::unwrap(&mut angles);
            angles
        };
        let heading = found.heading.map(|_| angle());
        let trailer_headings = found.trailer_headings.iter().map(|_| angle()).collect();
        Self {
            name: path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
            path: path.to_path_buf(),
            sha256: numbers.sha256,
            time,
            x,
            y,
            heading,
            trailer_headings,
            inputs: found.inputs.iter().map(|_| next()).collect(),
            roles: found.inputs.into_iter().map(|input| input.role).collect(),
            rows_dropped: numbers.dropped.values().sum(),
            why_dropped: numbers.dropped,
            warnings,
            apart: None,
        }
    }
}

/// The columns to read, in the order [`Run::build`] takes them.
pub(crate) fn wanted(found: &Resolved) -> Vec<usize> {
    let mut wanted = vec![found.time, found.x, found.y];
    wanted.extend(found.heading);
    wanted.extend(&found.trailer_headings);
    wanted.extend(found.inputs.iter().map(|input| input.index));
    wanted
}

/// The columns of times and inputs.
fn driven(found: &Resolved) -> Vec<usize> {
    std::iter::once(found.time).chain(found.inputs.iter().map(|input| input.index)).collect()
}

/// Sorts rows and settles repeated times; gives warnings.
pub(crate) fn arrange(numbers: &mut Numbers) -> Vec<String> {
    let back = row_order::sort(&mut numbers.columns);
    let repeats = row_order::merge(&mut numbers.columns);
    let mut drop_for = |why: &str, rows: usize| {
        if rows > 0 {
            numbers.dropped.insert(why.into(), rows);
        }
    };
    drop_for("repeated row", repeats.identical);
    drop_for("repeated time with conflicting values", repeats.conflicting);
    match back {
        0 => Vec::new(),
        _ => vec![format!("rows were out of order ({back} steps back in time) and have been sorted")],
    }
}

pub(crate) fn enough(numbers: &Numbers) -> Result<()> {
    let usable = numbers.columns[0].len();
    if usable >= MIN_ROWS {
        return Ok(());
    }
    let why: Vec<String> = numbers.dropped.iter().map(|(why, rows)| format!("{why}: {rows}")).collect();
    let why = if why.is_empty() { String::new() } else { format!(" (left out: {})", why.join(", ")) };
    let message = format!("usable rows: {usable} of {}{why}, but at least {MIN_ROWS} are needed", numbers.rows);
    Err(Error::input(message).help("check the log, or give a longer one"))
}
