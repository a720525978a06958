//! TOML tables and values with their spans (`toml::Spanned`), so that every error names line and column.

use super::suggestions;
use super::text::place;
use crate::error::{Error, Result};
use std::ops::Range;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The text values come from.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub path: &'a Path,
    pub text: &'a str,
}

impl<'a> Source<'a> {
    /// The whole document.
    pub fn parse(self) -> Result<Spanned<DeTable<'a>>> {
        self.parse_as("a model file holds lines like wheel_radius = 0.5 under headings like [parameters]")
    }

    /// The whole document; `advice` says what it should look like.
    pub fn parse_as(self, advice: &str) -> Result<Spanned<DeTable<'a>>> {
        DeTable::parse(self.text).map_err(|e| {
            let message = e.message().replace('\n', ", ");
            let at = e.span().map_or(0, |span| span.start);
            self.error(at, format!("is not valid TOML: {message}")).help(advice)
        })
    }

    /// An error at a byte offset.
    pub fn error(self, at: usize, message: impl Into<String>) -> Error {
        let (line, column) = place(self.text, at);
        Error::input(message).at_file(self.path).at(line, column)
    }

    /// The line of a byte offset.
    pub fn line(self, at: usize) -> usize {
        place(self.text, at).0
    }

    /// Line and column of a byte offset.
    pub fn line_and_column(self, at: usize) -> (usize, usize) {
        place(self.text, at)
    }
}

/// A table, and what the user calls it: `[parameters]`, or nothing for the top level.
#[derive(Clone)]
pub(crate) struct Section<'a, 'd> {
    pub source: Source<'a>,
    pub heading: String,
    pub at: usize,
    table: &'d DeTable<'a>,
}

/// A value, and the key it stands under.
#[derive(Clone)]
pub(crate) struct Value<'a, 'd> {
    pub source: Source<'a>,
    pub name: String,
    pub key_at: usize,
    value: &'d Spanned<DeValue<'a>>,
}

impl<'a, 'd> Section<'a, 'd> {
    /// The top level of a document.
    pub fn top(source: Source<'a>, document: &'d Spanned<DeTable<'a>>) -> Self {
        Self { source, heading: String::new(), at: 0, table: document.get_ref() }
    }

    /// The value of a key, if it is there.
    pub fn get(&self, key: &str) -> Option<Value<'a, 'd>> {
        let (name, value) = self.table.iter().find(|(name, _)| name.get_ref() == key)?;
        Some(Value { source: self.source, name: key.into(), key_at: name.span().start, value })
    }

    /// Every key with its value, in the order of the file.
    pub fn entries(&self) -> Vec<Value<'a, 'd>> {
        let value = |(key, value): (&Spanned<_>, &'d Spanned<DeValue<'a>>)| Value {
            source: self.source,
            name: AsRef::<str>::as_ref(key.get_ref()).to_string(),
            key_at: key.span().start,
            value,
        };
        let mut found: Vec<_> = self.table.iter().map(value).collect();
        found.sort_by_key(|v| v.key_at);
        found
    }

    /// The value of a key that must be there; `example` shows how to write it.
    pub fn need(&self, key: &str, example: &str) -> Result<Value<'a, 'd>> {
        self.get(key).ok_or_else(|| {
            self.error(format!("key \"{key}\"{} is missing", self.place())).help(format!("write {example}"))
        })
    }

    /// The table under a key, if it is there.
    pub fn section(&self, key: &str) -> Result<Option<Section<'a, 'd>>> {
        self.get(key).map(|value| value.section(format!("[{key}]"))).transpose()
    }

    /// Refuses the first key, in the order of the file, that is not among these.
    pub fn only(&self, keys: &[&str]) -> Result<()> {
        let stray = self.table.keys().filter(|k| !keys.contains(&k.get_ref().as_ref())).min_by_key(|k| k.span().start);
        match stray {
            Some(key) => Err(self
                .source
                .error(
                    key.span().start,
                    format!("unknown key \"{}\"{}", suggestions::shown(key.get_ref()), self.place()),
                )
                .help(suggestions::advice(key.get_ref(), "known keys", keys))),
            None => Ok(()),
        }
    }

    /// Line and column of the table.
    pub fn place_of(&self) -> (usize, usize) {
        self.source.line_and_column(self.at)
    }

    /// An error about the table as a whole.
    pub fn error(&self, message: impl Into<String>) -> Error {
        self.source.error(self.at, message)
    }

    fn place(&self) -> String {
        if self.heading.is_empty() { String::new() } else { format!(" in {}", self.heading) }
    }
}

impl<'a, 'd> Value<'a, 'd> {
    /// The bytes of the value.
    pub fn span(&self) -> Range<usize> {
        self.value.span()
    }

    /// An error about the value.
    pub fn error(&self, message: impl Into<String>) -> Error {
        self.source.error(self.value.span().start, message)
    }

    /// An error about the key.
    pub fn key_error(&self, message: impl Into<String>) -> Error {
        self.source.error(self.key_at, message)
    }

    /// Whether it is a table.
    pub fn is_table(&self) -> bool {
        matches!(self.value.get_ref(), DeValue::Table(_))
    }

    /// True or false.
    pub fn truth(&self) -> Result<bool> {
        self.value.get_ref().as_bool().ok_or_else(|| self.wrong("true or false", &format!("{} = true", self.name)))
    }

    fn wrong(&self, wanted: &str, example: &str) -> Error {
        let is = match self.value.get_ref() {
            DeValue::String(_) => "a text",
            DeValue::Integer(_) | DeValue::Float(_) => "a number",
            DeValue::Boolean(_) => "true or false",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "a list",
            DeValue::Table(_) => "a table",
        };
        self.error(format!("{} must be {wanted}, not {is}", self.name)).help(format!("write {example}"))
    }

    /// A text that is not blank, without blanks around it.
    pub fn text(&self) -> Result<&'d str> {
        let text =
            self.value.get_ref().as_str().ok_or_else(|| self.wrong("a text", &format!("{} = \"…\"", self.name)))?;
        match text.trim() {
            "" => Err(self.error(format!("{} is blank", self.name)).help(format!("write {} = \"…\"", self.name))),
            text if text.contains(char::is_control) => {
                Err(self.error(format!("{} holds a control character", self.name)).help("remove it"))
            }
            text => Ok(text),
        }
    }

    /// A finite number.
    pub fn number(&self) -> Result<f64> {
        self.number_that(f64::is_finite)
    }

    /// A number, or `inf` or `-inf`: a time without an end.
    pub fn number_or_infinity(&self) -> Result<f64> {
        self.number_that(|number| !number.is_nan())
    }

    fn number_that(&self, is_meant: impl Fn(f64) -> bool) -> Result<f64> {
        let number = match self.value.get_ref() {
            DeValue::Float(float) => float.as_str().parse().ok(),
            // A whole number that is too long for a machine word is a number still.
            DeValue::Integer(int) if int.radix() == 10 => int.as_str().parse().ok(),
            _ => self.integer().map(|i| i as f64),
        };
        let number: f64 = number.ok_or_else(|| self.wrong("a number", &format!("{} = 0.5", self.name)))?;
        if is_meant(number) {
            return Ok(number);
        }
        Err(self.error(format!("{} must be a finite number", self.name)).help(format!("write {} = 0.5", self.name)))
    }

    /// A number greater than zero.
    pub fn positive(&self) -> Result<f64> {
        match self.number()? {
            value if value > 0.0 => Ok(value),
            value => Err(self
                .error(format!("{} = {value:?} is out of range", self.name))
                .help("it must be greater than zero, in SI units")),
        }
    }

    /// A number of things, counted from one.
    pub fn count(&self) -> Result<usize> {
        let count = self.integer().and_then(|i| usize::try_from(i).ok()).filter(|&n| n > 0);
        count.ok_or_else(|| self.wrong_count())
    }

    /// A whole number, decimal or not: its digits are kept without what tells their base.
    fn integer(&self) -> Option<i64> {
        let int = self.value.get_ref().as_integer()?;
        i64::from_str_radix(int.as_str(), int.radix()).ok()
    }

    fn wrong_count(&self) -> Error {
        self.error(format!("{} must be a whole number from 1", self.name)).help(format!("write {} = 1", self.name))
    }

    /// The elements of a list, each under the name of the list and its place in it.
    pub fn list(&self, example: &str) -> Result<Vec<Value<'a, 'd>>> {
        let list = self.value.get_ref().as_array().ok_or_else(|| self.wrong("a list", example))?;
        let element = |(i, value): (usize, &'d Spanned<DeValue<'a>>)| Value {
            source: self.source,
            name: format!("{}[{}]", self.name, i + 1),
            key_at: value.span().start,
            value,
        };
        Ok(list.iter().enumerate().map(element).collect())
    }

    /// A table, under the heading the user knows it by.
    pub fn section(&self, heading: String) -> Result<Section<'a, 'd>> {
        let example = format!("{heading} on a line of its own, and its keys below it");
        self.section_like(heading, &example)
    }

    /// A table that is usually written as in an example.
    pub fn section_like(&self, heading: String, example: &str) -> Result<Section<'a, 'd>> {
        match self.value.get_ref().as_table() {
            Some(table) => Ok(Section { source: self.source, heading, at: self.value.span().start, table }),
            None => Err(self.wrong("a table", example)),
        }
    }

    /// Whether it is a text.
    pub fn is_text(&self) -> bool {
        matches!(self.value.get_ref(), DeValue::String(_))
    }

    /// Whether it is a number.
    pub fn is_number(&self) -> bool {
        matches!(self.value.get_ref(), DeValue::Integer(_) | DeValue::Float(_))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(text: &str, look: impl Fn(Section) -> String) -> String {
        let source = Source { path: Path::new("m.toml"), text };
        match source.parse() {
            Ok(document) => look(Section::top(source, &document)),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn numbers_of_every_spelling() {
        let read = |text: &str| with(&format!("a = {text}"), |s| format!("{:?}", s.get("a").unwrap().number().ok()));
        for (text, value) in [("1", 1.0), ("-1_000", -1000.0), ("0x10", 16.0), ("1_0.5e-1_0", 10.5e-10), ("+.5e1", 0.0)]
        {
            let expect = if value == 0.0 { "not valid TOML".into() } else { format!("{:?}", Some(value)) };
            assert!(read(text).contains(&expect), "{text}: {}", read(text));
        }
        for text in ["inf", "-nan", "1e999", "true", "\"1\"", "[1]", "1979-05-27", "{}"] {
            assert_eq!(read(text), "None", "{text}");
        }
    }

    #[test]
    fn counts_of_every_base() {
        let read = |text: &str| with(&format!("a = {text}"), |s| format!("{:?}", s.get("a").unwrap().count().ok()));
        for (text, value) in [("10", 10), ("+1_0", 10), ("0x10", 16), ("0o10", 8), ("0b10", 2), ("0xff", 255)] {
            assert_eq!(read(text), format!("{:?}", Some(value)), "{text}");
        }
        for text in ["0", "0x0", "-1", "1.0", "99999999999999999999", "\"1\""] {
            assert_eq!(read(text), "None", "{text}");
        }
    }

    #[test]
    fn a_syntax_error_names_its_place() {
        let message = with("a = 1\nb = [1, 2\nc = 3\n", |_| String::new());
        assert!(message.starts_with("m.toml:3:") && message.contains("not valid TOML"), "{message}");
        assert!(with("[[[[[", |_| String::new()).starts_with("m.toml:1:"));
        assert!(
            with(&"a = ".chars().chain("[".repeat(100_000).chars()).collect::<String>(), |_| String::new())
                .contains("m.toml:1:")
        );
    }

    #[test]
    fn the_first_stray_key_of_the_file_is_named() {
        let message = with("zeta = 1\nalpha = 2\n", |s| s.only(&["zetta"]).unwrap_err().to_string());
        assert_eq!(message, "m.toml:1:1: unknown key \"zeta\"; did you mean \"zetta\"? known keys: zetta");
    }
}
