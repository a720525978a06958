//! Some columns of a CSV file as numbers, in one pass.

use super::csv_cell::{Cell, advice};
use super::csv_dialect::{Beginning, Dialect, decimal};
use super::csv_records::Records;
use super::place::{Form, Place};
use super::stream::{Bytes, Hash, unpacked};
use super::time_stamp::{Origin, iso_8601, nanoseconds};
use crate::error::{Error, Result};
use crate::files::toml::suggestions::shown;
use crate::files::toml::text::{not_text, not_utf8, open, unreadable};
use std::collections::BTreeMap;
use std::io::{self, BufRead, Chain, Cursor, Read};
use std::path::{Path, PathBuf};

/// An open table of text whose header has been read.
pub(crate) struct Sheet {
    path: PathBuf,
    records: Records<Chain<Cursor<Vec<u8>>, Bytes>>,
    hash: Hash,
    separator: u8,
    /// The record last read is the first row.
    at_first_row: bool,
    pub header: Vec<String>,
    /// What times are counted from, where they are whole numbers or dates.
    pub origin: Origin,
}

/// The usable rows of some columns.
pub(crate) struct Numbers {
    /// One per column asked for, all of one length.
    pub columns: Vec<Vec<f64>>,
    /// Rows in the file.
    pub rows: usize,
    /// How many rows were left out, and why.
    pub dropped: BTreeMap<String, usize>,
    /// SHA-256 of the whole file, hexadecimal.
    pub sha256: String,
    /// What times are counted from.
    pub origin: Origin,
}

impl Sheet {
    /// Opens a file and reads its header.
    pub fn open(path: &Path) -> Result<Self> {
        Self::new(open(path)?, path)
    }

    /// Reads the header of what a reader gives; errors speak of the path.
    pub fn new(input: impl Read + Send + 'static, path: &Path) -> Result<Self> {
        let (mut input, hash) = unpacked(input, path)?;
        let start = input.fill_buf().map_err(|e| unreadable(path, &e))?;
        if let Some(error) = bag_of_another_kind(start) {
            return Err(error.at_file(path));
        }
        if start.contains(&0) || start.starts_with(b"\xff\xfe") || start.starts_with(b"\xfe\xff") {
            return Err(not_text(start).at_file(path));
        }
        let (beginning, read) = beginning(&mut input).map_err(|e| unreadable(path, &e))?;
        let Dialect { separator, skipped, names } = beginning.dialect();
        let mut sheet = Self {
            path: path.to_path_buf(),
            records: Records::new(Cursor::new(read).chain(input), separator),
            hash,
            separator,
            at_first_row: names.is_some(),
            header: Vec::new(),
            origin: Origin::default(),
        };
        sheet.records.skip(skipped).map_err(|e| unreadable(path, &e))?;
        if !sheet.next_record()? {
            return Err(Error::input("is empty").help("check that this is the file you meant").at_file(path));
        }
        match names {
            Some(names) => sheet.header = names,
            None => sheet.read_header()?,
        }
        Ok(sheet)
    }

    /// An error about the header, while it is the record last read.
    pub fn at_header(&self, error: Error) -> Error {
        error.at_file(&self.path).at(self.records.line(), 1)
    }

    /// Reads all rows; `wanted` are places in the header.
    #[cfg(test)]
    pub fn numbers(self, wanted: &[usize]) -> Result<Numbers> {
        let wanted: Vec<Place> = wanted.iter().map(|&index| Place { index, form: Form::Number }).collect();
        self.numbers_and(&wanted, &[])
    }

    /// Reads all rows, and with them columns for which no row is left out: a cell without a finite number is NaN there.
    pub fn numbers_and(mut self, wanted: &[Place], more: &[Place]) -> Result<Numbers> {
        let all = [wanted, more].concat();
        let mut columns = vec![Vec::new(); all.len()];
        let mut row = vec![0.0; all.len()];
        let (mut rows, mut dropped) = (0, BTreeMap::new());
        while self.advance()? {
            rows += 1;
            self.check_length()?;
            match self.read_row(&all, wanted.len(), &mut row)? {
                None => columns.iter_mut().zip(&row).for_each(|(column, value)| column.push(*value)),
                Some(why) => *dropped.entry(why).or_insert(0) += 1,
            }
        }
        Ok(Numbers { columns, rows, dropped, sha256: self.hash.finish(), origin: self.origin })
    }

    /// The texts of the first rows, a row each, for someone to look at.
    pub fn texts(mut self, rows: usize) -> Result<Vec<Vec<String>>> {
        let mut found = Vec::new();
        while found.len() < rows && self.advance()? {
            let cell = |i: usize| {
                let cell = self.records.cell(i);
                String::from_utf8_lossy(&decimal(cell, self.separator)).into_owned()
            };
            found.push((0..self.records.len()).map(cell).collect());
        }
        Ok(found)
    }

    fn next_record(&mut self) -> Result<bool> {
        self.records.advance().map_err(|e| unreadable(&self.path, &e))
    }

    /// Goes to the next row.
    fn advance(&mut self) -> Result<bool> {
        if std::mem::take(&mut self.at_first_row) { Ok(true) } else { self.next_record() }
    }

    fn read_header(&mut self) -> Result<()> {
        for index in 0..self.records.len() {
            let name = std::str::from_utf8(self.records.cell(index)).map_err(|_| {
                let (line, column) = self.records.place(index);
                not_utf8(line, column).at_file(&self.path)
            })?;
            self.header.push(name.trim().to_string());
        }
        match no_header(&self.header) {
            Some((message, advice)) => Err(self.at_header(Error::input(message).help(advice))),
            None => Ok(()),
        }
    }

    fn check_length(&self) -> Result<()> {
        let (found, expected) = (self.records.len(), self.header.len());
        if found == expected {
            return Ok(());
        }
        let help = match self.records.spans_lines() {
            true => "a quote that opens in this row is not closed in it",
            false => "give every row as many cells as the header; remove a last row that was cut off",
        };
        let message = format!("the row has {found} cells, the header has {expected}");
        Err(Error::input(message).at_file(&self.path).at(self.records.line(), 1).help(help))
    }

    /// Fills the row, or says why it must be left out: for one of the first cells, so many as are needed.
    fn read_row(&mut self, places: &[Place], needed: usize, row: &mut [f64]) -> Result<Option<String>> {
        let mut why = None;
        for (i, (value, &place)) in row.iter_mut().zip(places).enumerate() {
            let index = place.index;
            match self.cell(place) {
                Cell::Number(number) => *value = number,
                Cell::Word => return Err(self.word(index)),
                Cell::Blank | Cell::Infinite if i >= needed => *value = f64::NAN,
                // A word further on must still be found, so the row is read to its end.
                Cell::Blank if why.is_none() => why = Some(("blank or NaN cell", index)),
                Cell::Infinite if why.is_none() => why = Some(("infinite value", index)),
                Cell::Blank | Cell::Infinite => {}
            }
        }
        Ok(why.map(|(why, index)| format!("{why} in column \"{}\"", self.header[index])))
    }

    fn cell(&mut self, place: Place) -> Cell {
        let cell = decimal(self.records.cell(place.index), self.separator);
        let stamp = |text: &str| match place.form {
            Form::Stamp(digits) => nanoseconds(text, digits),
            _ => iso_8601(text),
        };
        match (place.form, Cell::read(&cell)) {
            (Form::Time, Cell::Word) | (Form::Stamp(_), Cell::Number(_)) => {
                let found = std::str::from_utf8(&cell).ok().and_then(stamp);
                found.map_or(Cell::Word, |ns| Cell::Number(self.origin.seconds(ns)))
            }
            (_, cell) => cell,
        }
    }

    fn word(&self, index: usize) -> Error {
        let word = String::from_utf8_lossy(self.records.cell(index));
        let (line, column) = self.records.place(index);
        Error::input(format!("\"{}\" in column \"{}\" is not a number", shown(&word), self.header[index]))
            .at_file(&self.path)
            .at(line, column)
            .help(advice(&word))
    }
}

/// The first lines up to one that is no comment, and their bytes.
fn beginning(input: &mut Bytes) -> io::Result<(Beginning, Vec<u8>)> {
    let (mut lines, mut all) = (vec![], vec![]);
    loop {
        let mut line = vec![];
        let read = input.read_until(b'\n', &mut line)?;
        all.extend(&line);
        let comment = Beginning::is_comment(&line);
        if read > 0 {
            lines.push(line);
        }
        if read == 0 || !comment {
            return Ok((Beginning::new(lines), all));
        }
    }
}

/// What an SQLite database begins with.
pub(crate) const SQLITE: &[u8; 16] = b"SQLite format 3\0";

/// What is a bag of messages that is not read here, and how it becomes one that is.
fn bag_of_another_kind(start: &[u8]) -> Option<Error> {
    let (what, how) = match () {
        () if start.starts_with(SQLITE) => ("a ROS 2 bag in SQLite (.db3)", "mcap convert BAG.db3 BAG.mcap"),
        () if start.starts_with(b"#ROSBAG V2.0") => ("a ROS 1 bag", "mcap convert BAG.bag BAG.mcap"),
        () => return None,
    };
    let help = format!("convert it with `{how}` (the tool of mcap.dev) and give the MCAP file");
    Some(Error::input(format!("is {what}, which is not read as it stands")).help(help))
}

/// A first line that heads no table, or another mark of the ends of lines than a line feed.
fn no_header(header: &[String]) -> Option<(&'static str, &'static str)> {
    if header.iter().any(|name| name.contains('\r') && !name.contains('\n')) {
        return Some(("lines end in bare carriage returns", "save it with Unix or Windows line ends"));
    }
    match header {
        [only] if only.contains('=') => {
            Some(("the first line is not the header of a CSV file", "give a log with a column for each quantity"))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::toml::text::hex;
    use sha2::{Digest, Sha256};

    fn read(text: &str, wanted: &[usize]) -> Result<Numbers> {
        Sheet::new(Cursor::new(text.to_string()), Path::new("run.csv"))?.numbers(wanted)
    }

    /// Every other read is interrupted by a signal.
    struct Disturbed(&'static [u8], bool);

    impl Read for Disturbed {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            self.1 = !self.1;
            if self.1 { Err(io::ErrorKind::Interrupted.into()) } else { self.0.read(buffer) }
        }
    }

    #[test]
    fn a_signal_is_no_fault_of_the_file() {
        let sheet = Sheet::new(Disturbed(b"a\n1\n2\n", false), Path::new("run.csv")).unwrap();
        assert_eq!(sheet.numbers(&[0]).unwrap().columns, [[1.0, 2.0]]);
    }

    #[test]
    fn the_hash_covers_the_whole_file() {
        let text = format!("\u{feff}a,b\r\n{}", "1,2\r\n".repeat(50_000));
        let numbers = read(&text, &[1]).unwrap();
        assert_eq!((numbers.rows, numbers.columns[0].len()), (50_000, 50_000));
        assert_eq!(numbers.sha256, hex(&Sha256::digest(text.as_bytes())));
    }

    #[test]
    fn columns_not_wanted_may_hold_anything() {
        let mut bytes = b"\"a \", 'b' ,c\n1,word,\n".to_vec();
        bytes.extend(b"2,\xff\xfe,\"x,\ny\"\n");
        let sheet = Sheet::new(Cursor::new(bytes), Path::new("run.csv")).unwrap();
        assert_eq!(sheet.header, ["a", "'b'", "c"]);
        assert_eq!(sheet.numbers(&[0]).unwrap().columns, [[1.0, 2.0]]);
    }

    #[test]
    fn a_word_behind_a_blank_cell_is_found() {
        let error = read("a,b\n1,2\n,fast\n", &[0, 1]).err().unwrap();
        assert!(error.to_string().starts_with("run.csv:3:2: \"fast\" in column \"b\" is not a number"), "{error}");
    }

    #[test]
    fn rows_are_dropped_for_their_first_reason() {
        let numbers = read("a,b\n1,2\n,inf\n1,inf\nNaN,2\n\n", &[0, 1]).unwrap();
        let expect = [("blank or NaN cell in column \"a\"", 2), ("infinite value in column \"b\"", 1)];
        assert_eq!(numbers.dropped, expect.map(|(why, n)| (why.to_string(), n)).into());
        assert_eq!((numbers.rows, numbers.columns), (4, vec![vec![1.0], vec![2.0]]));
    }

    /// A signal on the way is passed over; a disk that fails is told at once and not asked for ever.
    #[test]
    fn a_signal_is_passed_over_and_a_fault_is_not() {
        struct Faulty(&'static [io::ErrorKind], &'static [u8]);
        impl Read for Faulty {
            fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
                let Some((kind, rest)) = self.0.split_first() else { return self.1.read(buffer) };
                self.0 = rest;
                Err((*kind).into())
            }
        }
        let (text, path) = (b"a,b\n1,2\n".as_slice(), Path::new("log.csv"));
        let sheet = Sheet::new(Faulty(&[io::ErrorKind::Interrupted; 2], text), path).unwrap();
        let found = sheet.numbers(&[1]).unwrap();
        assert_eq!((found.columns, found.sha256), (vec![vec![2.0]], hex(&Sha256::digest(text))));
        let error = Sheet::new(Faulty(&[io::ErrorKind::TimedOut], text), path).map(|_| ()).unwrap_err();
        assert_eq!(error.to_string(), "log.csv: cannot be read: timed out; check the path and the file");
    }
}
