//! The inputs of a simulation: times, inputs, and perhaps the pose it begins with.

use super::cells::Cells;
use super::columns::Resolved;
use super::csv_table::Numbers;
use super::log_file::Log;
use super::reading;
use super::run::{self, arrange, enough};
use crate::error::Result;
use crate::files::{Initial, ModelFile};
use std::path::Path;

/// The usable rows of an inputs file, in the order of time.
#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    /// Strictly increasing times, s.
    pub time: Vec<f64>,
    /// What each of the inputs is.
    pub roles: Vec<String>,
    /// The inputs, one `Vec` per role.
    pub columns: Vec<Vec<f64>>,
    /// As in a [`Run`](crate::files::Run): of an input that is read as differences, the least of them.
    pub differences: Vec<Option<f64>>,
    /// The measured pose in the first row, where it has one.
    pub pose: Option<Initial>,
    /// SHA-256 of the file's bytes, hexadecimal.
    pub sha256: String,
    /// What a user should know of the file: rows sorted or left out, a motion that begins at the origin.
    pub warnings: Vec<String>,
}

impl Inputs {
    /// Reads inputs by the columns of a model file; the pose may be left out.
    ///
    /// A row is used when it has its time and its inputs; of the measured poses only that of the first row is looked at.
    ///
    /// # Errors
    /// When an input is missing, a cell holds a word, or fewer than two rows are usable.
    ///
    /// ```
    /// use creepage::files::{Inputs, ModelFile};
    /// let text = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n";
    /// let model = ModelFile::parse(text, "model.toml", &creepage::model::known(&[])).unwrap();
    /// # let path = std::env::temp_dir().join("creepage-inputs-read.csv");
    /// std::fs::write(&path, "time,wheel_rate,yaw_rate\n1,2,0\n0,2,0\n2,,0\n").unwrap();
    /// let inputs = Inputs::read(&path, &model).unwrap();
    /// assert_eq!(inputs.time, [0.0, 1.0]);
    /// assert_eq!(inputs.warnings[1], "1 of 3 rows is left out (blank or NaN cell in column \"wheel_rate\": 1)");
    /// ```
    pub fn read(path: impl AsRef<Path>, model: &ModelFile) -> Result<Self> {
        let path = path.as_ref();
        let sheet = Log::open(path)?;
        let columns = &model.columns;
        let is_whole = |r: &Resolved| r.y.is_some() && r.heading.is_some() && !sheet.has_topics();
        let whole = columns.resolve(sheet.header()).ok().filter(is_whole);
        let (time, inputs) = columns.resolve_inputs(sheet.header()).map_err(|e| sheet.at_header(e))?;
        let driven: Vec<&Cells> = std::iter::once(&time).chain(inputs.iter().map(|i| &i.cells)).collect();
        let measured: Vec<&Cells> = whole.iter().flat_map(Resolved::pose).collect();
        let mut numbers = reading::read(sheet, &driven, &measured)?;
        let poses = numbers.columns.split_off(driven.len());
        let times = numbers.columns[0].clone();
        let mut warnings = arrange(&mut numbers);
        enough(&numbers).map_err(|e| e.at_file(path))?;
        warnings.extend(left_out(&numbers));
        let mut first = whole.and_then(|_| first_pose(&times, numbers.columns[0][0], &poses));
        if let (true, Some([x, y, ..])) = (columns.geographic, first.as_deref_mut()) {
            // The plane touches the globe where the run begins.
            (*x, *y) = (0.0, 0.0);
        }
        if !poses.is_empty() && first.is_none() && model.initial.is_none() {
            warnings
                .push("the first row has no whole pose, and no other row's is used: it begins at the origin".into());
        }
        let mut columns = numbers.columns.into_iter();
        let time = columns.next().unwrap_or_default();
        Ok(Self {
            columns: run::inputs(&time, columns, &driven[1..]),
            differences: driven[1..].iter().map(|cells| run::difference(cells)).collect(),
            time,
            roles: inputs.iter().map(|i| i.role.clone()).collect(),
            pose: first.map(|pose| initial(&pose, model.trailers())),
            sha256: numbers.sha256,
            warnings,
        })
    }
}

/// How many rows are not used, and why.
fn left_out(numbers: &Numbers) -> Option<String> {
    let left: usize = numbers.dropped.values().sum();
    let why: Vec<String> = numbers.dropped.iter().map(|(why, rows)| format!("{why}: {rows}")).collect();
    let are = if left == 1 { "is" } else { "are" };
    (left > 0).then(|| format!("{left} of {} rows {are} left out ({})", numbers.rows, why.join(", ")))
}

/// The pose in the row of a time; none where it is not whole, or rows of that time contradict each other.
fn first_pose(times: &[f64], first: f64, poses: &[Vec<f64>]) -> Option<Vec<f64>> {
    let rows = times.iter().enumerate().filter(|(_, t)| **t == first).map(|(i, _)| i);
    let of = |i: usize| poses.iter().map(|c| c[i]).collect::<Vec<f64>>();
    let mut whole = rows.map(of).filter(|pose| pose.iter().all(|v| v.is_finite()));
    let pose = whole.next()?;
    whole.all(|other| other == pose).then_some(pose)
}

/// Trailers whose headings are not measured begin in line with the tractor.
fn initial(pose: &[f64], trailers: usize) -> Initial {
    Initial {
        x: pose[0],
        y: pose[1],
        heading: pose[2],
        trailer_headings: match pose.len() - 3 {
            0 => vec![pose[2]; trailers],
            _ => pose[3..].to_vec(),
        },
    }
}
