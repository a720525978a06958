//! How a table of text is written: what parts its cells, which line names its columns.

use super::csv_cell::Cell;
use super::time_stamp::iso_8601;

/// How a table is written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Dialect {
    /// What parts the cells; a blank stands for any number of blanks and tabs.
    pub separator: u8,
    /// Lines before the one with names, or before the first row where there are none.
    pub skipped: usize,
    /// Names of columns, where the table does not begin with them: of a comment, or places from one.
    pub names: Option<Vec<String>>,
}

/// Lines that begin a table: comments, blank lines, and the first line that is neither.
pub(crate) struct Beginning {
    lines: Vec<Vec<u8>>,
}

impl Beginning {
    pub fn new(lines: Vec<Vec<u8>>) -> Self {
        Self { lines }
    }

    /// Whether a line says nothing but a comment.
    pub fn is_comment(line: &[u8]) -> bool {
        let line = line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line).trim_ascii();
        line.is_empty() || line.starts_with(b"#")
    }

    /// The dialect, told from the first line that is no comment and the comment before it.
    pub fn dialect(&self) -> Dialect {
        let text = |line: &Vec<u8>| String::from_utf8_lossy(line).trim_start_matches('\u{feff}').trim().to_string();
        let Some(first) = self.lines.last().map(text) else { return Dialect::commas() };
        let separator = separator(&first);
        let cells = cells(&first, separator);
        let comment = self.lines.iter().rev().skip(1).map(text).find(|line| line.starts_with('#'));
        let skipped = self.lines.len() - 1;
        let has_number = cells.iter().any(|c| is_number(c, separator));
        if let Some(names) =
            comment.filter(|_| has_number).map(|c| named(&c, separator)).filter(|n| n.len() == cells.len())
        {
            return Dialect { separator, skipped, names: Some(names) };
        }
        let names = is_row(&cells, separator).then(|| (1..=cells.len()).map(|n| n.to_string()).collect());
        Dialect { separator, skipped: if self.commented() { skipped } else { 0 }, names }
    }

    /// Whether a comment stands before the first line; blank lines alone are passed over by the reader.
    fn commented(&self) -> bool {
        self.lines.iter().rev().skip(1).any(|line| !line.trim_ascii().is_empty())
    }
}

impl Dialect {
    fn commas() -> Self {
        Self { separator: b',', skipped: 0, names: None }
    }
}

/// Names of columns in a comment.
fn named(comment: &str, separator: u8) -> Vec<String> {
    let line = comment.trim_start_matches('#').trim();
    let own = if separator == b' ' && line.contains(',') { b',' } else { separator };
    cells(line, own).iter().map(|c| c.trim_matches('"').trim().to_string()).collect()
}

/// Cells of a line, without heed of quotes.
fn cells(line: &str, separator: u8) -> Vec<String> {
    match separator {
        b' ' => line.split_whitespace().map(str::to_string).collect(),
        other => line.split(char::from(other)).map(|c| c.trim().to_string()).collect(),
    }
}

/// What parts the cells of a line: a comma where it stands, unless it is the decimal mark of cells parted otherwise.
fn separator(line: &str) -> u8 {
    let count = |mark: char| line.matches(mark).count();
    let decimals = || cells(line, b';').iter().all(|c| c.is_empty() || is_number(c, b';'));
    let (commas, semicolons) = (count(','), count(';'));
    if semicolons > 0 && (semicolons > commas || decimals()) {
        return b';';
    }
    if count('\t') > 0 && (commas == 0 || cells(line, b'\t').iter().all(|c| c.is_empty() || is_number(c, b'\t'))) {
        return b'\t';
    }
    let blanks = cells(line, b' ');
    match () {
        () if commas > 0 && !(blanks.len() > 2 && blanks.iter().all(|c| is_number(c, b' '))) => b',',
        () if count('|') > 0 => b'|',
        () if blanks.len() > 1 && !line.contains('=') && !line.contains('"') => b' ',
        () => b',',
    }
}

/// Whether cells are a row of numbers, times and blanks.
fn is_row(cells: &[String], separator: u8) -> bool {
    let numbers = cells.iter().filter(|c| is_number(c, separator)).count();
    let blank = |c: &String| Cell::read(c.as_bytes()) == Cell::Blank;
    numbers >= 2 && cells.iter().all(|c| is_number(c, separator) || blank(c) || iso_8601(c).is_some())
}

fn is_number(cell: &str, separator: u8) -> bool {
    matches!(Cell::read(decimal(cell.as_bytes(), separator).as_ref()), Cell::Number(_) | Cell::Infinite)
}

/// A cell with a point as its decimal mark, where a comma can be one.
pub(crate) fn decimal(cell: &[u8], separator: u8) -> std::borrow::Cow<'_, [u8]> {
    let one = separator != b',' && cell.iter().filter(|b| **b == b',').count() == 1 && !cell.contains(&b'.');
    match one {
        true => cell.iter().map(|b| if *b == b',' { b'.' } else { *b }).collect::<Vec<u8>>().into(),
        false => cell.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dialect(text: &str) -> (char, usize, Option<String>) {
        let lines = text.lines().map(|l| l.as_bytes().to_vec()).collect();
        let found = Beginning::new(lines).dialect();
        (char::from(found.separator), found.skipped, found.names.map(|n| n.join("|")))
    }

    #[test]
    fn separators_are_told_from_the_first_line() {
        for (line, mark) in [
            ("t,x,y", ','),
            ("t;x;y", ';'),
            ("t\tx\ty", '\t'),
            ("t x  y", ' '),
            ("t|x|y", '|'),
            ("0,0;1,5;2,25", ';'),
            ("time [s],x [m],y", ','),
            ("Time [s];x, in m;y", ';'),
            ("wheel_radius = 0.5", ','),
            ("\"t 1\"", ','),
            ("t", ','),
        ] {
            assert_eq!(dialect(line).0, mark, "{line}");
        }
    }

    #[test]
    fn names_stand_in_the_first_line_in_a_comment_or_nowhere() {
        let one = |names: &str| Some(names.to_string());
        assert_eq!(dialect("t,x"), (',', 0, None));
        assert_eq!(dialect("# made by me\n\nt,x"), (',', 2, None));
        assert_eq!(dialect("#t,x\n0,1"), (',', 1, one("t|x")));
        assert_eq!(dialect("# a log\n# t x\n0 1"), (' ', 2, one("t|x")));
        assert_eq!(dialect("# made on, Monday\n0,1,2"), (',', 1, one("1|2|3")));
        assert_eq!(dialect("0,1,,nan"), (',', 0, one("1|2|3|4")));
        assert_eq!(dialect("0,0;1,5"), (';', 0, one("1|2")));
        assert_eq!(dialect("2026-01-01T00:00:00,1,2"), (',', 0, one("1|2|3")));
        assert_eq!(dialect("0,x"), (',', 0, None), "a word is a name");
        assert_eq!(dialect("5"), (',', 0, None), "one number tells too little");
    }

    #[test]
    fn a_comma_is_a_decimal_mark_where_it_parts_no_cells() {
        assert_eq!((decimal(b"1,5", b';').as_ref(), decimal(b"1,5", b',').as_ref()), (&b"1.5"[..], &b"1,5"[..]));
        assert_eq!(decimal(b"1,234.5", b';').as_ref(), b"1,234.5");
    }
}
