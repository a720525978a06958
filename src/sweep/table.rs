//! The table of a sweep: rows of numbers, and their text as CSV.

use super::prepared_sweep::Sweep;
use crate::error::{Error, Result};
use crate::motion::Case;
use std::path::Path;

/// The format of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Text, numbers in the shortest form that reads back.
    Csv,
    /// Apache Parquet.
    Parquet,
}

/// What became of a case, by its code in a row.
pub(super) const STATUS: [&str; 3] = ["ok", "not-converged", "undefined"];

impl Format {
    /// The format of a path, by its extension: Parquet for `.parquet`, CSV for any other.
    ///
    /// # Errors
    /// When it is `.parquet`, and Parquet was left out of this program.
    pub fn of(path: &Path) -> Result<Self> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("parquet") if cfg!(feature = "parquet") => Ok(Format::Parquet),
            Some("parquet") => Err(Error::input("this program was built without Parquet")
                .at_file(path)
                .help("build it with --features parquet, or write to a .csv file")),
            _ => Ok(Format::Csv),
        }
    }
}

impl Sweep {
    /// Names of the columns.
    ///
    /// | column | unit | meaning |
    /// |---|---|---|
    /// | `case` | | number of the case, from 0 |
    /// | what varies, by its name | SI | value in the case |
    /// | `time` … | | as [`Ensemble::columns`](crate::motion::Ensemble::columns) |
    /// | `error` | | estimated error of the case |
    /// | `status` | | `ok`, `not-converged`: the error asked for was not reached, or `undefined`: so is the motion |
    pub fn columns(&self) -> Vec<String> {
        let case = std::iter::once("case".to_string()).chain(self.names.iter().cloned());
        case.chain(self.ensemble.columns()).chain(["error", "status"].map(String::from)).collect()
    }

    /// The rows of a case, number by number; what is undefined is NaN.
    pub(super) fn push_rows(&self, number: usize, values: &[f64], case: &Case, rows: &mut Vec<f64>) {
        let status = if case.is_defined() { f64::from(u8::from(!case.converged)) } else { 2.0 };
        let end = [case.error.unwrap_or(f64::NAN), status];
        let mut push = |time: f64, own: &[f64]| {
            rows.extend_from_slice(&[number as f64]);
            [values, &[time], own, &end].into_iter().for_each(|part| rows.extend_from_slice(part));
        };
        if !case.is_defined() {
            return push(f64::NAN, &vec![f64::NAN; self.width - self.names.len() - 4]);
        }
        for (i, time) in self.ensemble.times().iter().enumerate() {
            push(*time, case.row(i));
        }
    }
}

/// The header of a CSV file.
pub(super) fn header(columns: &[String]) -> Vec<u8> {
    let mut text = columns.join(",");
    text.push('\n');
    text.into_bytes()
}

/// Rows as CSV.
pub(super) fn csv(rows: &[f64], columns: usize) -> Vec<u8> {
    let mut text = Vec::with_capacity(rows.len() * 20);
    let (mut number, mut whole) = (ryu::Buffer::new(), itoa::Buffer::new());
    for row in rows.chunks_exact(columns) {
        text.extend_from_slice(whole.format(row[0] as u64).as_bytes());
        for value in &row[1..columns - 1] {
            text.push(b',');
            if value.is_finite() {
                text.extend_from_slice(number.format_finite(*value).as_bytes());
            }
        }
        text.push(b',');
        text.extend_from_slice(STATUS[row[columns - 1] as usize].as_bytes());
        text.push(b'\n');
    }
    text
}
