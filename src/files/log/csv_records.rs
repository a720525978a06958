//! Comma-separated records (RFC 4180) that know the line and column of every cell.
//!
//! Own code, because errors must name the exact place: the reader of the `csv` crate knows neither the
//! column of a cell nor, with Windows line ends or blank lines, its line. That crate is the oracle of
//! the tests below.

use std::borrow::Cow;
use std::io::{self, BufRead};
use std::ops::Range;

/// A reader of records; one is held at a time, so memory does not grow with the file.
pub(crate) struct Records<R> {
    input: R,
    /// The bytes of the current record, line ends included.
    raw: Vec<u8>,
    cells: Vec<Range<usize>>,
    line: usize,
    next_line: usize,
}

impl<R: BufRead> Records<R> {
    pub fn new(input: R) -> Self {
        Self { input, raw: Vec::new(), cells: Vec::new(), line: 0, next_line: 1 }
    }

    /// The input back, read as far as the last record.
    pub fn into_input(self) -> R {
        self.input
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
    pub fn cell(&self, index: usize) -> Cow<'_, [u8]> {
        let cell = self.raw[self.cells[index].clone()].trim_ascii();
        if cell.first() == Some(&b'"') { Cow::Owned(unquote(cell)) } else { Cow::Borrowed(cell) }
    }

    /// Line and column, from one and in characters, where a cell begins.
    pub fn place(&self, index: usize) -> (usize, usize) {
        let cell = self.cells[index].clone();
        let blanks = self.raw[cell.clone()].iter().take_while(|b| matches!(b, b' ' | b'\t')).count();
        let before = String::from_utf8_lossy(&self.raw[..cell.start + blanks]);
        let (line, column) = crate::files::toml::text::place(&before, usize::MAX);
        (self.line + line - 1, column)
    }

    fn read_line(&mut self) -> io::Result<bool> {
        let read = self.input.read_until(b'\n', &mut self.raw)? > 0;
        self.next_line += usize::from(read);
        Ok(read)
    }

    /// Drops the byte order mark of the first line.
    fn skip_mark(&mut self) {
        if self.line == 1 && self.raw.starts_with(b"\xef\xbb\xbf") {
            self.raw.drain(..3);
        }
    }

    fn split(&mut self) -> io::Result<()> {
        let mut at = 0;
        loop {
            let end = self.cell_end(at)?;
            self.cells.push(at..end);
            if self.raw.get(end) != Some(&b',') {
                return Ok(());
            }
            at = end + 1;
        }
    }

    /// Where the cell that begins at `at` ends; a quoted one may take in further lines.
    fn cell_end(&mut self, at: usize) -> io::Result<usize> {
        let mut at = at;
        while matches!(self.raw.get(at), Some(b' ' | b'\t')) {
            at += 1;
        }
        if self.raw.get(at) == Some(&b'"') {
            at = self.quote_end(at + 1)?;
        }
        let rest = &self.raw[at..];
        let comma = rest.iter().position(|&b| b == b',' || b == b'\n');
        Ok(at + comma.unwrap_or(rest.len()))
    }

    /// Just behind the closing quote of a cell whose opening quote stands before `at`.
    fn quote_end(&mut self, mut at: usize) -> io::Result<usize> {
        loop {
            match self.raw[at..].iter().position(|&b| b == b'"') {
                Some(found) if self.raw.get(at + found + 1) == Some(&b'"') => at += found + 2,
                Some(found) => return Ok(at + found + 1),
                None => {
                    at = self.raw.len();
                    if !self.read_line()? {
                        return Ok(at);
                    }
                }
            }
        }
    }
}

/// The text of a quoted cell: a doubled quote is one, what follows the closing quote is kept, blanks around it are not.
fn unquote(cell: &[u8]) -> Vec<u8> {
    let mut text = Vec::with_capacity(cell.len());
    let mut inside = true;
    let mut bytes = cell[1..].iter().peekable();
    while let Some(&byte) = bytes.next() {
        let quote = inside && byte == b'"';
        if quote && bytes.next_if(|&&b| b == b'"').is_none() {
            inside = false;
        } else {
            text.push(byte);
        }
    }
    text.trim_ascii().to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn all(text: &[u8]) -> Vec<Vec<Vec<u8>>> {
        let mut records = Records::new(text);
        let mut found = Vec::new();
        while records.advance().unwrap() {
            found.push((0..records.len()).map(|i| records.cell(i).into_owned()).collect());
        }
        found
    }

    fn oracle(text: &[u8]) -> Vec<Vec<Vec<u8>>> {
        let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text);
        reader.byte_records().map(|r| r.unwrap().iter().map(|cell| cell.trim_ascii().to_vec()).collect()).collect()
    }

    #[test]
    fn places_are_those_of_an_editor() {
        let mut records = Records::new("\u{feff}é, \"b\n\"\"c\" ,d\r\n\r\n1,2".as_bytes());
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

    /// A doubled quote is one, wherever it stands: beside each other, at an end, before a line end within the cell.
    #[test]
    fn doubled_quotes_do_not_end_a_cell() {
        let cells = |text: &str| all(text.as_bytes()).concat();
        assert_eq!(cells("\"a\"\"b\",c"), [b"a\"b".to_vec(), b"c".to_vec()]);
        assert_eq!(cells("\"\"\"\"\"\",c"), [b"\"\"".to_vec(), b"c".to_vec()]);
        assert_eq!(cells("\"x\"\"\ny\"\",\",c"), [b"x\"\ny\",".to_vec(), b"c".to_vec()]);
        let mut records = Records::new(b"1\n\"a\nb\"\n2\n".as_slice());
        let spans = std::iter::from_fn(|| records.advance().unwrap().then(|| (records.line(), records.spans_lines())));
        assert_eq!(spans.collect::<Vec<_>>(), [(1, false), (2, true), (4, false)]);
    }
}
