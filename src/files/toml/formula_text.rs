//! A formula of a TOML file, every character of which has its line and column.

use super::spanned_table::Value;
use crate::error::{Error, Result};
use crate::formula::{Expr, Size, Symbol, caret, column_of};
use std::ops::Range;
use std::path::PathBuf;

/// The longest formula of a file, in characters: it stays on a few lines, and a caret below it can be seen.
const MAX_CHARACTERS: usize = 400;
/// The most factors in a product of a formula: larger powers of powers fill any memory with exact numbers.
const MAX_FACTORS: usize = 64;

/// The complaint about a formula whose exact numbers would fill any memory.
pub(crate) fn too_large(formula: &Expr) -> Option<String> {
    let degree = Size::of(formula, &|_| Size::SYMBOL).degree;
    (degree > MAX_FACTORS).then(|| format!("the formula has a product of more than {MAX_FACTORS} factors"))
}

/// A formula, and where it stands in a file.
#[derive(Clone, Debug)]
pub struct FormulaText {
    /// As it was read.
    pub formula: Expr,
    /// As it was written.
    pub text: String,
    path: PathBuf,
    line: usize,
    /// The column of every character, and of the end.
    columns: Vec<usize>,
}

impl FormulaText {
    /// Reads a formula.
    ///
    /// # Errors
    /// At the place where it is malformed, with a caret.
    pub(crate) fn read(value: &Value) -> Result<Self> {
        let text = value.text()?;
        let length = text.chars().count();
        if length > MAX_CHARACTERS {
            return Err(value
                .error(format!("{} has {length} characters, and {MAX_CHARACTERS} are the most", value.name))
                .help("write a shorter formula"));
        }
        let source = value.source;
        let (line, first) = source.line_and_column(value.span().start);
        let column = |at: usize| first + source.text[value.span().start..at].chars().count();
        let columns = offsets(source.text, value.span(), text).into_iter().map(column).collect();
        let unread = Self { formula: Expr::int(0), text: text.into(), path: source.path.into(), line, columns };
        let formula = Expr::parse(text).map_err(|e| unread.placed(e))?;
        if let Some(complaint) = too_large(&formula) {
            return Err(unread.error(complaint).help("write smaller powers"));
        }
        Ok(Self { formula, ..unread })
    }

    /// An error that was found elsewhere, put where the formula begins.
    pub(crate) fn at_start(&self, e: Error) -> Error {
        e.moved_to(self.line, self.columns.first().copied().unwrap_or(1)).at_file(&self.path)
    }

    /// An error about the formula, with a caret at its start.
    pub fn error(&self, message: impl Into<String>) -> Error {
        self.placed(caret(&self.text, 0, message))
    }

    /// An error about a name of the formula, with a caret at its first use.
    pub fn error_at(&self, name: &Symbol, message: impl Into<String>) -> Error {
        self.placed(caret(&self.text, column_of(&self.text, name).unwrap_or(0), message))
    }

    /// An error that knows its column in the formula, put where the formula stands.
    fn placed(&self, e: Error) -> Error {
        let inside = e.place().map_or(0, |(_, column)| column - 1);
        let column = self.columns.get(inside).or(self.columns.last()).copied().unwrap_or(1);
        e.moved_to(self.line, column).at_file(&self.path)
    }
}

/// The byte offset in a file of every character of a text, and of its end; all at the start where the text is
/// written in a way that is not understood.
fn offsets(file: &str, span: Range<usize>, text: &str) -> Vec<usize> {
    let count = text.chars().count();
    let unknown = || vec![span.start; count + 1];
    let Some(mut all) = characters(&file[span.clone()]) else { return unknown() };
    let lead = all.iter().take_while(|(_, c)| c.is_some_and(char::is_whitespace)).count();
    all.drain(..lead);
    all.truncate(count + 1);
    let same = all.len() == count + 1 && all.iter().zip(text.chars()).all(|((_, c), wanted)| *c == Some(wanted));
    if same { all.into_iter().map(|(at, _)| span.start + at).collect() } else { unknown() }
}

/// The characters of a TOML string as it is written, each with its offset; the last is its end.
fn characters(raw: &str) -> Option<Vec<(usize, Option<char>)>> {
    let mark = ["\"\"\"", "'''", "\"", "'"].into_iter().find(|m| raw.starts_with(m))?;
    let end = raw.len().checked_sub(mark.len())?;
    let inner = raw.get(mark.len()..end)?;
    let mut found = Vec::new();
    let mut rest = inner;
    while let Some(c) = rest.chars().next() {
        let at = end - rest.len();
        let (value, length) = if c == '\\' && mark.starts_with('"') { escaped(rest)? } else { (c, c.len_utf8()) };
        found.push((at, Some(value)));
        rest = rest.get(length..)?;
    }
    found.push((end, None));
    Some(found)
}

/// The character of an escape, and how long it is written.
fn escaped(rest: &str) -> Option<(char, usize)> {
    let digits = match rest.chars().nth(1)? {
        'x' => 2,
        'u' => 4,
        'U' => 8,
        '"' => return Some(('"', 2)),
        '\\' => return Some(('\\', 2)),
        // A line feed or another control character: no formula holds any.
        _ => return None,
    };
    let code = u32::from_str_radix(rest.get(2..2 + digits)?, 16).ok()?;
    Some((char::from_u32(code)?, 2 + digits))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(file: &str, text: &str) -> Vec<usize> {
        offsets(file, 0..file.len(), text)
    }

    #[test]
    fn every_spelling_of_a_string_keeps_its_places() {
        assert_eq!(at("\"a·b\"", "a·b"), [1, 2, 4, 5]);
        assert_eq!(at("'a\\b'", "a\\b"), [1, 2, 3, 4]);
        assert_eq!(at("\"\"\"  ab \"\"\"", "ab"), [5, 6, 7]);
        assert_eq!(at("\"a\\u0027 + b\"", "a' + b"), [1, 2, 8, 9, 10, 11, 12]);
        assert_eq!(at("\"a\\tb\"", "a\tb"), [0; 4], "not understood");
        assert_eq!(at("\"a\\\"b\\\\c\"", "a\"b\\c"), [1, 2, 4, 5, 7, 8], "a quotation mark and a backslash");
        assert_eq!(at("\"a\\u00", "a"), [0; 2], "cut off");
    }
}
