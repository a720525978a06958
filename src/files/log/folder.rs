//! A run in a folder: tables of text with times of their own, by one clock.
//!
//! A column is called `FILE:COLUMN`, such as `imu.csv:gyro_z`. The time has one name in all files that are used, and stands
//! without the name of a file.

use super::cells::{self, Cells};
use super::csv_table::{Numbers, Sheet};
use super::own_times::at_times;
use super::place::Place;
use super::row_order;
use super::time_stamp::Origin;
use crate::error::{Error, Result};
use crate::files::toml::text::{hex, unreadable};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Endings of tables of text.
const ENDINGS: [&str; 3] = ["csv", "tsv", "txt"];
/// More files than these are no run.
const MOST_FILES: usize = 200;

/// A folder whose files have been looked into.
pub(crate) struct Folder {
    pub path: PathBuf,
    /// Names that stand in more than one file, then `FILE:COLUMN` for every column.
    pub header: Vec<String>,
    pub origin: Origin,
    files: Vec<(PathBuf, Vec<String>)>,
    /// How many names stand without a file.
    bare: usize,
    /// File and column of each place behind those.
    places: Vec<(usize, usize)>,
}

impl Folder {
    /// Looks into the tables of a folder; none where it has none.
    pub fn open(path: &Path) -> Result<Option<Self>> {
        let entries = std::fs::read_dir(path).map_err(|e| unreadable(path, &e))?;
        let mut found: Vec<PathBuf> =
            entries.filter_map(|e| Some(e.ok()?.path())).filter(|p| p.is_file() && is_table(p)).collect();
        found.sort();
        found.truncate(MOST_FILES);
        if found.is_empty() {
            return Ok(None);
        }
        let headers = found.into_iter().map(|file| Sheet::open(&file).map(|sheet| (file, sheet.header)));
        let (files, others): (Vec<_>, Vec<_>) = headers.partition(Result::is_ok);
        // A file that is no table has no column to be named; where all are so, the first one says why.
        if let (true, Some(Err(error))) = (files.is_empty(), others.into_iter().next()) {
            return Err(error);
        }
        let files: Vec<(PathBuf, Vec<String>)> = files.into_iter().flatten().collect();
        let mut times: BTreeMap<&String, usize> = BTreeMap::new();
        files.iter().flat_map(|(_, header)| header).for_each(|name| *times.entry(name).or_default() += 1);
        let shared = times.into_iter().filter(|(_, n)| *n > 1 || files.len() == 1).map(|(name, _)| name.clone());
        let mut header: Vec<String> = shared.collect();
        let bare = header.len();
        let mut places = vec![];
        for (f, (file, names)) in files.iter().enumerate() {
            let file = file.file_name().unwrap_or_default().to_string_lossy();
            for (c, name) in names.iter().enumerate() {
                header.push(format!("{file}:{name}"));
                places.push((f, c));
            }
        }
        Ok(Some(Self { path: path.to_path_buf(), header, origin: Origin::default(), files, bare, places }))
    }

    /// Reads quantities, the time first: those of the file with the most rows stay as they are, others are interpolated to
    /// its times.
    pub fn read(mut self, wanted: &[&Cells]) -> Result<Numbers> {
        let Some((time, quantities)) = wanted.split_first() else { return Err(self.error("names no time")) };
        let mut of_file: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (q, cells) in quantities.iter().enumerate() {
            let files: Vec<usize> = cells.places.iter().map(|p| self.file_of(*p)).collect::<Result<_>>()?;
            if files.windows(2).any(|w| w[0] != w[1]) {
                return Err(self.error("has the columns of one quantity in two files"));
            }
            of_file.entry(files[0]).or_default().push(q);
        }
        let mut all =
            Numbers { columns: vec![], rows: 0, dropped: BTreeMap::new(), sha256: String::new(), origin: self.origin };
        let mut hash = Sha256::new();
        let mut read: Vec<(Vec<Vec<f64>>, Vec<usize>)> = vec![];
        for (file, mine) in of_file {
            let own: Vec<Cells> = mine.iter().map(|q| self.own_cells(quantities[*q])).collect();
            let time = self.time_in(file, time)?;
            let mut sheet = Sheet::open(&self.files[file].0)?;
            sheet.origin = self.origin;
            let needed: Vec<&Cells> = std::iter::once(&time).chain(&own).collect();
            let places: Vec<Place> = needed.iter().flat_map(|c| c.places()).collect();
            let names: Vec<String> = needed.iter().map(|c| sheet.header[c.places[0]].clone()).collect();
            let mut numbers = cells::joined(sheet.numbers_and(&places, &[])?, &needed);
            cells::drop_rows_without(&mut numbers, &names);
            self.origin = numbers.origin;
            row_order::sort(&mut numbers.columns);
            row_order::merge(&mut numbers.columns);
            hash.update(numbers.sha256.as_bytes());
            all.rows = all.rows.max(numbers.rows);
            numbers.dropped.into_iter().for_each(|(why, n)| *all.dropped.entry(why).or_default() += n);
            read.push((numbers.columns, mine));
        }
        all.sha256 = hex(&hash.finalize());
        all.origin = self.origin;
        all.columns = on_one_time(&read, quantities);
        Ok(all)
    }

    fn error(&self, message: &str) -> Error {
        Error::input(message)
            .at_file(&self.path)
            .help("name a column FILE:COLUMN under [columns], and the time without a file")
    }

    fn file_of(&self, place: usize) -> Result<usize> {
        let place = place.checked_sub(self.bare).and_then(|p| self.places.get(p));
        place.map(|(file, _)| *file).ok_or_else(|| self.error("has a name of several files for a quantity of one"))
    }

    /// Cells by the header of their own file.
    fn own_cells(&self, cells: &Cells) -> Cells {
        let place = |p: &usize| self.places.get(p - self.bare).map_or(0, |(_, column)| *column);
        Cells { places: cells.places.iter().map(place).collect(), ..cells.clone() }
    }

    /// The cells of the time in a file.
    fn time_in(&self, file: usize, time: &Cells) -> Result<Cells> {
        let (path, header) = &self.files[file];
        let place = |p: &usize| {
            let name = self.header[*p]
                .rsplit_once(':')
                .filter(|_| *p >= self.bare)
                .map_or(&*self.header[*p], |(_, name)| name);
            header.iter().position(|h| h == name).ok_or_else(|| {
                Error::input(format!("has no column \"{name}\" for the time"))
                    .at_file(path)
                    .help("the time must have one name in all files of a run")
            })
        };
        Ok(Cells { places: time.places.iter().map(place).collect::<Result<_>>()?, ..time.clone() })
    }
}

fn is_table(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    let name = name.strip_suffix(".gz").or_else(|| name.strip_suffix(".zst")).unwrap_or(&name);
    ENDINGS.iter().any(|ending| name.ends_with(&format!(".{ending}")))
}

/// The time of the file with the most rows, and all quantities at it; rows beyond the ends of another file are left out.
fn on_one_time(read: &[(Vec<Vec<f64>>, Vec<usize>)], quantities: &[&Cells]) -> Vec<Vec<f64>> {
    let Some(base) = (0..read.len()).max_by_key(|f| (read[*f].0[0].len(), std::cmp::Reverse(*f))) else {
        return vec![];
    };
    let time = &read[base].0[0];
    let mut found: Vec<Vec<f64>> = vec![vec![]; quantities.len()];
    for (f, (columns, mine)) in read.iter().enumerate() {
        for (q, column) in mine.iter().zip(&columns[1..]) {
            found[*q] = match f == base {
                true => column.clone(),
                false => at_times(&columns[0], &quantities[*q].continued(column.clone()), time),
            };
        }
    }
    found.insert(0, time.clone());
    let kept: Vec<usize> = (0..time.len()).filter(|i| found.iter().all(|c| c[*i].is_finite())).collect();
    found.iter().map(|c| kept.iter().map(|i| c[*i]).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::log::column_entry::{Kind, Reading};

    /// A heading of 3.1 and then −3.1 rad has passed π in between, and not zero.
    #[test]
    fn a_wrapped_heading_is_interpolated_the_short_way() {
        let cells = |wraps| Cells { places: vec![0], reading: Reading::plain(Kind::Number), wraps };
        let read =
            [(vec![vec![0.0, 0.1, 0.2], vec![1.0; 3]], vec![0]), (vec![vec![0.0, 0.2], vec![3.1, -3.1]], vec![1])];
        let between = |wraps| on_one_time(&read, &[&cells(false), &cells(wraps)])[2][1];
        assert!((between(true) - std::f64::consts::PI).abs() < 1e-12 && between(false).abs() < 1e-12);
    }
}
