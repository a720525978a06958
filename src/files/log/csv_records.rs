//! Comma-separated records (RFC 4180), read by `csv-core`, that know the line and column of every cell.
//!
//! The quoting and splitting are those of `csv-core`, the reader inside the crate `csv`. What is here besides is what that
//! reader does not keep: it is given the lines one by one and asked for one cell at a time, so that an error can name the
//! line and column where a cell begins, with Windows line ends and blank lines too; and blanks before an opening quote are
//! skipped, as spreadsheets do.

use crate::files::toml::text::place;
use csv_core::{ReadFieldResult, Reader, ReaderBuilder, Terminator};
use std::io::{self, BufRead};
use std::ops::Range;

/// A reader of records; one is held at a time, so memory does not grow with the file.
pub(crate) struct Records<R> {
    input: R,
    splitter: Reader,
    /// The bytes of the current record, line ends included.
    raw: Vec<u8>,
    /// The text of its cells, one behind the other.
    text: Vec<u8>,
    cells: Vec<Place>,
    line: usize,
    next_line: usize,
    separator: u8,
}

/// Where a cell begins in the bytes of the record, and what it holds in the text of the cells.
struct Place {
    start: usize,
    text: Range<usize>,
}

impl<R: BufRead> Records<R> {
    /// Cells parted by a mark; a blank stands for any number of blanks and tabs.
    pub fn new(input: R, separator: u8) -> Self {
        // A carriage return before the line feed is a blank at the end of a cell; a bare one ends no line.
        let splitter = ReaderBuilder::new().terminator(Terminator::Any(b'\n')).delimiter(separator).build();
        Self { input, splitter, raw: vec![], text: vec![], cells: vec![], line: 0, next_line: 1, separator }
    }

    /// Passes over lines.
    pub fn skip(&mut self, lines: usize) -> io::Result<()> {
        for _ in 0..lines {
            self.raw.clear();
            self.read_line()?;
        }
        Ok(())
    }

    /// Goes to the next record that is not blank; false at the end of the input.
    pub fn advance(&mut self) -> io::Result<bool> {
        loop {
            self.raw.clear();
            self.cells.clear();
            self.line = self.next_line;
            if !self.read_line()? {
                return Ok(false);
            }
            self.skip_mark();
            if !self.raw.iter().all(u8::is_ascii_whitespace) {
                self.split()?;
                return Ok(true);
            }
        }
    }

    /// How many cells the record has.
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// The line where the record begins, from one.
    pub fn line(&self) -> usize {
        self.line
    }

    /// The record holds a line end: a quoted cell goes over several lines, or a quote was never closed.
    pub fn spans_lines(&self) -> bool {
        self.next_line - self.line > 1
    }

    /// A cell without quotes and without blanks around it.
    pub fn cell(&self, index: usize) -> &[u8] {
        self.text[self.cells[index].text.clone()].trim_ascii()
    }

    /// Line and column, from one and in characters, where a cell begins.
    pub fn place(&self, index: usize) -> (usize, usize) {
        let before = String::from_utf8_lossy(&self.raw[..self.cells[index].start]);
        let (line, column) = place(&before, usize::MAX);
        (self.line + line - 1, column)
    }

    fn read_line(&mut self) -> io::Result<bool> {
        let from = self.raw.len();
        let read = self.input.read_until(b'\n', &mut self.raw)? > 0;
        self.next_line += usize::from(read);
        if self.separator == b' ' {
            self.raw[from..].iter_mut().filter(|b| **b == b'\t').for_each(|b| *b = b' ');
        }
        Ok(read)
    }

    /// Drops the byte order mark of the first line.
    fn skip_mark(&mut self) {
        if self.line == 1 && self.raw.starts_with(b"\xef\xbb\xbf") {
            self.raw.drain(..3);
        }
    }

    /// Splits the record into its cells; a quoted one may take in further lines.
    fn split(&mut self) -> io::Result<()> {
        let (mut at, mut written) = (0, 0);
        let tabs = self.separator != b'\t';
        let blank = |b: &&u8| **b == b' ' || **b == b'\t' && tabs;
        loop {
            at += self.raw[at..].iter().take_while(blank).count();
            let (start, begun) = (at, written);
            loop {
                // The text of the cells is never longer than the record.
                self.text.resize(self.text.len().max(self.raw.len()), 0);
                let (found, read, wrote) = self.splitter.read_field(&self.raw[at..], &mut self.text[written..]);
                (at, written) = (at + read, written + wrote);
                match found {
                    ReadFieldResult::Field { record_end } => {
                        self.cells.push(Place { start, text: begun..written });
                        if record_end {
                            self.drop_last_blank();
                            return Ok(());
                        }
                        break;
                    }
                    // At the end of the input nothing is added, which ends the cell.
                    ReadFieldResult::InputEmpty => _ = self.read_line()?,
                    ReadFieldResult::OutputFull | ReadFieldResult::End => return Ok(()),
                }
            }
        }
    }
}

impl<R> Records<R> {
    /// Blanks at the end of a line part no cell from another.
    fn drop_last_blank(&mut self) {
        let blank = |cell: &Place| self.text[cell.text.clone()].trim_ascii().is_empty();
        if self.separator == b' ' && self.cells.last().is_some_and(blank) {
            self.cells.pop();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn all(text: &[u8]) -> Vec<Vec<Vec<u8>>> {
        let mut records = Records::new(text, b',');
        let mut found = Vec::new();
        while records.advance().unwrap() {
            found.push((0..records.len()).map(|i| records.cell(i).to_vec()).collect());
        }
        found
    }

    fn oracle(text: &[u8]) -> Vec<Vec<Vec<u8>>> {
        let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text);
        reader.byte_records().map(|r| r.unwrap().iter().map(|cell| cell.trim_ascii().to_vec()).collect()).collect()
    }

    #[test]
    fn places_are_those_of_an_editor() {
        let mut records = Records::new("\u{feff}é, \"b\n\"\"c\" ,d\r\n\r\n1,2".as_bytes(), b',');
        assert!(records.advance().unwrap());
        assert_eq!((0..3).map(|i| records.place(i)).collect::<Vec<_>>(), [(1, 1), (1, 4), (2, 7)]);
        assert_eq!(records.cell(1), b"b\n\"c".as_slice());
        assert!(records.spans_lines());
        assert!(records.advance().unwrap());
        assert_eq!((records.line(), records.place(1), records.spans_lines()), (4, (4, 3), false));
        assert!(!records.advance().unwrap());
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, cases: 2000, ..Default::default() })]
        /// Bare carriage returns and blanks are left out: there the two differ on purpose.
        #[test]
        fn cells_are_those_of_the_csv_crate(pieces in proptest::collection::vec("[a,\"]|\r\n|\n|1", 0..24)) {
            let text = pieces.concat();
            prop_assume!(!text.contains("\"\r\n"));
            prop_assert_eq!(all(text.as_bytes()), oracle(text.as_bytes()), "{:?}", text);
        }
    }

    #[test]
    fn other_marks_part_cells_too() {
        let cells = |text: &str, mark: u8| {
            let mut records = Records::new(text.as_bytes(), mark);
            let mut found = vec![];
            while records.advance().unwrap() {
                let row = (0..records.len()).map(|i| String::from_utf8_lossy(records.cell(i)).into_owned());
                found.push(row.collect::<Vec<_>>().join("/"));
            }
            found
        };
        assert_eq!(cells("a;b,c;\n1,5;;2\r\n", b';'), ["a/b,c/", "1,5//2"]);
        assert_eq!(cells("a\tb c\t\n\t\t2\r\n", b'\t'), ["a/b c/", "//2"]);
        assert_eq!(cells("  a  b\tc \r\n1 2 3\n", b' '), ["a/b/c", "1/2/3"]);
        let mut records = Records::new(b"#\n# \"a\n1 22\n".as_slice(), b' ');
        records.skip(2).unwrap();
        assert!(records.advance().unwrap());
        assert_eq!((records.line(), records.place(1), records.len()), (3, (3, 3), 2));
    }

    /// A doubled quote is one, wherever it stands: beside each other, at an end, before a line end within the cell.
    #[test]
    fn doubled_quotes_do_not_end_a_cell() {
        let cells = |text: &str| all(text.as_bytes()).concat();
        assert_eq!(cells("\"a\"\"b\",c"), [b"a\"b".to_vec(), b"c".to_vec()]);
        assert_eq!(cells("\"\"\"\"\"\",c"), [b"\"\"".to_vec(), b"c".to_vec()]);
        assert_eq!(cells("\"x\"\"\ny\"\",\",c"), [b"x\"\ny\",".to_vec(), b"c".to_vec()]);
        let mut records = Records::new(b"1\n\"a\nb\"\n2\n".as_slice(), b',');
        let spans = std::iter::from_fn(|| records.advance().unwrap().then(|| (records.line(), records.spans_lines())));
        assert_eq!(spans.collect::<Vec<_>>(), [(1, false), (2, true), (4, false)]);
    }
}
