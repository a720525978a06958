//! The inputs of a simulation: times, inputs, and perhaps the pose it begins with.

use super::columns::Resolved;
use super::log::Log;
use super::{Initial, ModelFile, order};
use crate::error::{Error, Result};
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
    /// The measured pose in the first row, where the file has one.
    pub pose: Option<Initial>,
}

impl Inputs {
    /// Reads inputs by the columns of a model file; the pose may be left out.
    ///
    /// # Errors
    /// When an input is missing, a cell holds a word, or fewer than two rows are usable.
    pub fn read(path: impl AsRef<Path>, model: &ModelFile) -> Result<Self> {
        let path = path.as_ref();
        let sheet = Log::open(path)?;
        let mut columns = model.columns.clone();
        // Under forces the motion of the wheels is what comes out.
        columns.inputs = model.dynamics.as_ref().map_or(columns.inputs, |d| d.inputs.clone());
        let whole = columns.resolve(sheet.header()).ok().filter(|r| r.heading.is_some() && !sheet.has_topics());
        let (time, inputs) = columns.resolve_inputs(sheet.header()).map_err(|e| sheet.at_header(e))?;
        let mut wanted = vec![time];
        wanted.extend(inputs.iter().map(|i| i.index));
        wanted.extend(whole.iter().flat_map(pose_columns));
        let mut numbers = sheet.numbers(&wanted)?;
        order::sort(&mut numbers.columns);
        order::merge(&mut numbers.columns);
        let rows = numbers.columns[0].len();
        if rows < 2 {
            let message = format!("usable rows: {rows} of {}, but at least 2 are needed", numbers.rows);
            return Err(Error::input(message).at_file(path).help("check the file, or give a longer one"));
        }
        let poses = numbers.columns.split_off(1 + inputs.len());
        let first: Vec<f64> = poses.iter().map(|c| c[0]).collect();
        let pose = whole.map(|_| Initial {
            x: first[0],
            y: first[1],
            heading: first[2],
            trailer_headings: match first.len() - 3 {
                0 => vec![first[2]; model.trailers()],
                _ => first[3..].to_vec(),
            },
        });
        let mut columns = numbers.columns;
        let time = columns.remove(0);
        Ok(Self { time, roles: inputs.into_iter().map(|i| i.role).collect(), columns, pose })
    }
}

fn pose_columns(r: &Resolved) -> Vec<usize> {
    let mut wanted = vec![r.x, r.y];
    wanted.extend(r.heading);
    wanted.extend(&r.trailer_headings);
    wanted
}
