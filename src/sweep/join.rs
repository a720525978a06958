//! The tables of a sweep's parts, joined into one.

use super::prepared_sweep::Sweep;
use super::table::{Format, header};
use crate::error::{Error, Result};
use crate::files::{unwritable, write_whole_with};
use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};

impl Sweep {
    /// Joins the tables of all parts, in their order, into that of the whole sweep.
    ///
    /// # Errors
    /// When a part is missing, cut off, out of order or of another sweep.
    pub fn join(&self, parts: &[PathBuf], out: &Path) -> Result<()> {
        crate::files::check_target(out)?;
        let format = Format::of(out)?;
        if let Some(part) = parts.iter().find(|p| Format::of(p).ok() != Some(format)) {
            return Err(Error::input("is of another format than the output").at_file(part).help("join parts of one"));
        }
        write_whole_with(out, |file| match format {
            Format::Csv => self.join_csv(parts, file, out),
            Format::Parquet => self.join_parquet(parts, file, out),
        })
    }

    fn join_csv(&self, parts: &[PathBuf], file: &File, out: &Path) -> Result<()> {
        let mut to = std::io::BufWriter::new(file);
        let head = header(&self.columns());
        let mut next = Expected { case: 0, rows: 0 };
        for (i, part) in parts.iter().enumerate() {
            let mut from = BufReader::new(crate::files::open(part)?);
            let (mut line, mut number) = (Vec::new(), 0);
            while from.read_until(b'\n', &mut line).map_err(|e| unwritable(part, &e))? > 0 {
                number += 1;
                let is_head = i == 0 && number == 1;
                let good = if is_head { line == head } else { line.ends_with(b"\n") && next.take(&line, self.rows) };
                if !good {
                    return Err(self.refused(part, number, &next));
                }
                to.write_all(&line).map_err(|e| unwritable(out, &e))?;
                line.clear();
            }
        }
        if next.case < self.cases() {
            return Err(self.refused(parts.last().map_or(out, |p| p.as_path()), 1, &next));
        }
        // Dropping the buffer would lose what the disk said to its last bytes.
        to.flush().map_err(|e| unwritable(out, &e))
    }

    fn refused(&self, part: &Path, line: usize, next: &Expected) -> Error {
        Error::input(format!("is not a part in its place: case {} of {} was to follow", next.case, self.cases()))
            .at_file(part)
            .at(line, 1)
            .help("give all parts of this sweep in their order, each finished")
    }

    #[cfg(feature = "parquet")]
    fn join_parquet(&self, parts: &[PathBuf], file: &File, out: &Path) -> Result<()> {
        let mut rows = super::parquet::Writer::new(file, out, &self.columns())?;
        let mut next = Expected { case: 0, rows: 0 };
        for part in parts {
            super::parquet::read(part, &self.columns(), &mut |row: &[f64]| {
                if !next.follows(row[0] as usize, row[row.len() - 1] == 2.0, self.rows) {
                    return Err(self.refused(part, 1, &next));
                }
                rows.push(row)
            })?;
        }
        if next.case < self.cases() {
            return Err(self.refused(parts.last().map_or(out, |p| p.as_path()), 1, &next));
        }
        rows.finish()
    }

    #[cfg(not(feature = "parquet"))]
    fn join_parquet(&self, _: &[PathBuf], _: &File, out: &Path) -> Result<()> {
        Format::of(out).map(|_| ())
    }
}

/// The case that must come next, and how many of its rows have come.
struct Expected {
    case: usize,
    rows: usize,
}

impl Expected {
    /// Takes a line of a table; false when it is not the next one.
    fn take(&mut self, line: &[u8], rows: usize) -> bool {
        let digits = line.split(|b| *b == b',').next().and_then(|c| std::str::from_utf8(c).ok());
        let Some(case) = digits.and_then(|d| d.parse().ok()) else { return false };
        self.follows(case, line.ends_with(b",undefined\n"), rows)
    }

    /// A case has all its rows, or one where it is undefined.
    fn follows(&mut self, case: usize, undefined: bool, rows: usize) -> bool {
        if case != self.case {
            return false;
        }
        self.rows += 1;
        if undefined || self.rows == rows {
            (self.case, self.rows) = (case + 1, 0);
        }
        true
    }
}
