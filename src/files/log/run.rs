//! A logged run: times, measured poses and inputs, ready to compute with.

use super::cells::{self, Cells};
use super::columns::Resolved;
use super::csv_table::Numbers;
use super::log_file::Log;
use super::reading;
use super::row_order;
use super::tangent_plane::tangent_plane;
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
    /// What is measured beside the pose, in the order of the model file, SI units.
    pub measured: Vec<Vec<f64>>,
    /// Which of them no sensor measures, and the line of the vehicle defines.
    pub defined: Defined,
    /// Standard deviations of the pose that the log gives.
    pub deviations: Deviations,
    /// What each of the inputs is.
    pub roles: Vec<String>,
    /// The inputs as logged, one `Vec` per role.
    pub inputs: Vec<Vec<f64>>,
    /// Of an input that is read as differences of a count or a position, and so is the mean since the row before: the least
    /// difference, in the input's unit times s, zero where it is not known. `None` for any other input.
    pub differences: Vec<Option<f64>>,
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

/// What of a pose is zero in every row by definition: a vehicle on a line has its place along it alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Defined {
    /// The position along y.
    pub y: bool,
    /// The heading.
    pub heading: bool,
}

/// Standard deviations of the measured pose, row by row, NaN where a row has none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Deviations {
    /// Of x, m.
    pub x: Option<Vec<f64>>,
    /// Of y, m.
    pub y: Option<Vec<f64>>,
    /// Of the heading, rad.
    pub heading: Option<Vec<f64>>,
}

impl Run {
    /// Reads a log by the columns of a model file, in one pass; a bag, whose topics have times of their own, in two.
    pub fn read(path: impl AsRef<Path>, model: &impl AsRef<ModelFile>) -> Result<Self> {
        let (path, model) = (path.as_ref(), model.as_ref());
        let log = Log::open(path)?;
        if log.has_topics() {
            return Self::read_bag(path, model);
        }
        Ok(Self::of(path, log, &|| Log::open(path), model)?.before_filter_of(&model.sensor))
    }

    /// A log that is at hand as text; `name` stands for its file.
    ///
    /// # Errors
    /// As [`Run::read`].
    pub fn parse(name: &str, text: &str, model: &ModelFile) -> Result<Self> {
        let path = Path::new(name);
        let open = || Log::of_text(path, text);
        Ok(Self::of(path, open()?, &open, model)?.before_filter_of(&model.sensor))
    }

    fn of(path: &Path, log: Log, again: &dyn Fn() -> Result<Log>, model: &ModelFile) -> Result<Self> {
        let found = model.columns.resolve(log.header()).map_err(|e| log.at_header(e))?;
        let mut numbers = reading::read(log, &found.needed(), &found.spare())?;
        cells::mark_absent(&mut numbers, found.needed().len());
        let whole = numbers.columns[0].len();
        if 2 * whole < numbers.rows
            && let Some(run) = Self::read_outer_join(path, again()?, &found, whole)?
        {
            return Ok(run);
        }
        let warnings = arrange(&mut numbers);
        enough(&numbers).map_err(|e| e.at_file(path))?;
        let driven: Vec<Cells> = found.driven().into_iter().cloned().collect();
        let run = Self::build(path, found, numbers, warnings);
        if !run.lacks_cells() {
            return Ok(run);
        }
        let driven: Vec<&Cells> = driven.iter().collect();
        Ok(run.with_inputs(reading::read(again()?, &driven, &[])?, &driven))
    }

    /// Whether rows were left out for what a cell of them holds.
    fn lacks_cells(&self) -> bool {
        self.why_dropped.keys().any(|why| why.contains("cell") || why.contains("value"))
    }

    /// The run with the inputs of all rows that have them. A row whose pose is blank says nothing of where the vehicle is,
    /// and still what was done to it: without its inputs those around it would be taken to go on.
    fn with_inputs(mut self, mut numbers: Numbers, driven: &[&Cells]) -> Self {
        arrange(&mut numbers);
        let mut columns = numbers.columns.into_iter();
        let time = columns.next().unwrap_or_default();
        if time.len() <= self.time.len() {
            return self;
        }
        self.inputs = inputs(&time, columns, &driven[1..]);
        self.apart = Some(Apart { time, truth: self.path.clone(), truth_sha256: self.sha256.clone(), one_clock: true });
        self
    }

    pub(crate) fn build(path: &Path, found: Resolved, numbers: Numbers, warnings: Vec<String>) -> Self {
        let mut columns = numbers.columns.into_iter();
        let mut next = || columns.next().unwrap_or_default();
        let (time, mut x) = (next(), next());
        let zeros = || vec![0.0; time.len()];
        let mut y = if found.y.is_some() { next() } else { zeros() };
        if found.geographic {
            (x, y) = tangent_plane(&y, &x);
        }
        let heading = found.heading.as_ref().map(|_| cells::unwrapped(next()));
        let defined = Defined { y: found.y.is_none(), heading: found.y.is_none() && heading.is_none() };
        let heading = heading.or_else(|| defined.heading.then(zeros));
        let trailer_headings = found.trailer_headings.iter().map(|_| cells::unwrapped(next())).collect();
        let measured = found.measured.iter().map(|cells| cells.central_rates(&time, cells.positions(next()))).collect();
        let driven: Vec<&Cells> = found.inputs.iter().map(|input| &input.cells).collect();
        let inputs = inputs(&time, columns.by_ref(), &driven);
        let mut deviation = |cells: &Option<Cells>| {
            let column = cells.as_ref().and_then(|_| columns.next())?;
            Some(cells::deviations(column))
        };
        let [x_of, y_of, heading_of] = &found.deviations;
        let deviations = Deviations { x: deviation(x_of), y: deviation(y_of), heading: deviation(heading_of) };
        Self {
            name: path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
            path: path.to_path_buf(),
            sha256: numbers.sha256,
            time,
            x,
            y,
            heading,
            trailer_headings,
            measured,
            defined,
            deviations,
            inputs,
            differences: found.inputs.iter().map(|input| difference(&input.cells)).collect(),
            roles: found.inputs.into_iter().map(|input| input.role).collect(),
            rows_dropped: numbers.dropped.values().sum(),
            why_dropped: numbers.dropped,
            warnings,
            apart: None,
        }
    }
}

/// Inputs at the times of their rows.
pub(crate) fn inputs(time: &[f64], columns: impl Iterator<Item = Vec<f64>>, cells: &[&Cells]) -> Vec<Vec<f64>> {
    cells.iter().zip(columns).map(|(cells, column)| cells.rates(time, cells.positions(column))).collect()
}

/// The resolution of an input that is the difference of counts or positions.
pub(crate) fn difference(cells: &Cells) -> Option<f64> {
    cells.reading.is_difference().then(|| cells.reading.resolution())
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
