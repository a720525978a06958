//! Some columns of a CSV file as numbers, in one pass.

use super::csv_cell::{Cell, advice};
use super::csv_records::Records;
use crate::error::{Error, Result};
use crate::files::toml::suggestions::shown;
use crate::files::toml::text::{hex, not_text, not_utf8, open, unreadable};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

/// Bytes read at a time.
const BUFFER: usize = 1 << 16;

/// An open CSV file whose header has been read.
pub(crate) struct Sheet<R: Read = File> {
    path: PathBuf,
    records: Records<BufReader<Hashing<R>>>,
    pub header: Vec<String>,
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
}

/// A reader that takes the hash of what passes.
struct Hashing<R> {
    input: R,
    hash: Sha256,
}

impl<R: Read> Read for Hashing<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            match self.input.read(buffer) {
                // A signal on the way is no fault of the file.
                Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
                read => return read.inspect(|&read| self.hash.update(&buffer[..read])),
            }
        }
    }
}

impl Sheet {
    /// Opens a file and reads its header.
    pub fn open(path: &Path) -> Result<Self> {
        Self::new(open(path)?, path)
    }
}

impl<R: Read> Sheet<R> {
    /// Reads the header of what a reader gives; errors speak of the path.
    pub fn new(input: R, path: &Path) -> Result<Self> {
        let mut input = BufReader::with_capacity(BUFFER, Hashing { input, hash: Sha256::new() });
        let start = input.fill_buf().map_err(|e| unreadable(path, &e))?;
        if start.contains(&0) || start.starts_with(b"\xff\xfe") || start.starts_with(b"\xfe\xff") {
            return Err(not_text(start).at_file(path));
        }
        let mut sheet = Self { path: path.to_path_buf(), records: Records::new(input), header: Vec::new() };
        if !sheet.advance()? {
            return Err(Error::input("is empty").help("check that this is the file you meant").at_file(path));
        }
        sheet.read_header()?;
        Ok(sheet)
    }

    /// An error about the header, while it is the record last read.
    pub fn at_header(&self, error: Error) -> Error {
        error.at_file(&self.path).at(self.records.line(), 1)
    }

    /// Reads all rows; `wanted` are places in the header.
    pub fn numbers(self, wanted: &[usize]) -> Result<Numbers> {
        self.numbers_and(wanted, &[])
    }

    /// Reads all rows, and with them columns for which no row is left out: a cell without a finite number is NaN there.
    pub fn numbers_and(mut self, wanted: &[usize], more: &[usize]) -> Result<Numbers> {
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
        let sha256 = hex(&self.records.into_input().into_inner().hash.finalize());
        Ok(Numbers { columns, rows, dropped, sha256 })
    }

    fn advance(&mut self) -> Result<bool> {
        self.records.advance().map_err(|e| unreadable(&self.path, &e))
    }

    fn read_header(&mut self) -> Result<()> {
        for index in 0..self.records.len() {
            let name = std::str::from_utf8(self.records.cell(index)).map_err(|_| {
                let (line, column) = self.records.place(index);
                not_utf8(line, column).at_file(&self.path)
            })?;
            self.header.push(name.trim().to_string());
        }
        match separator(&self.header) {
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
    fn read_row(&self, places: &[usize], needed: usize, row: &mut [f64]) -> Result<Option<String>> {
        let mut why = None;
        for (i, (value, &index)) in row.iter_mut().zip(places).enumerate() {
            match Cell::read(self.records.cell(index)) {
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

    fn word(&self, index: usize) -> Error {
        let word = String::from_utf8_lossy(self.records.cell(index));
        let (line, column) = self.records.place(index);
        Error::input(format!("\"{}\" in column \"{}\" is not a number", shown(&word), self.header[index]))
            .at_file(&self.path)
            .at(line, column)
            .help(advice(&word))
    }
}

/// Another separator of cells than a comma, or of lines than a line feed.
fn separator(header: &[String]) -> Option<(String, &'static str)> {
    if header.iter().any(|name| name.contains('\r') && !name.contains('\n')) {
        return Some(("lines end in bare carriage returns".into(), "save it with Unix or Windows line ends"));
    }
    let [only] = header else { return None };
    if only.contains('=') {
        return Some((
            "the first line is not the header of a CSV file".into(),
            "give a log with a column for each quantity",
        ));
    }
    let marks = [(';', "semicolons"), ('\t', "tabs"), ('|', "bars"), (' ', "blanks")];
    let (mark, name) = marks.into_iter().find(|(mark, _)| only.contains(*mark))?;
    let advice = "save it with commas between the cells, and points in the decimals";
    Some((format!("the header is separated by {name} ({mark:?}), not commas"), advice))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, wanted: &[usize]) -> Result<Numbers> {
        Sheet::new(text.as_bytes(), Path::new("run.csv"))?.numbers(wanted)
    }

    /// Every other read is interrupted by a signal.
    struct Disturbed<'a>(&'a [u8], bool);

    impl Read for Disturbed<'_> {
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
        let sheet = Sheet::new(bytes.as_slice(), Path::new("run.csv")).unwrap();
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
        struct Faulty<'a>(&'a [io::ErrorKind], &'a [u8]);
        impl Read for Faulty<'_> {
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
