//! A place in a file: path, line and column, for errors that are found after the file was read.

use super::spanned_table::Source;
use crate::error::Error;
use std::path::PathBuf;

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spot {
    path: PathBuf,
    line: usize,
    column: usize,
}

impl Spot {
    /// The place of a byte.
    pub(crate) fn at(source: Source, byte: usize) -> Self {
        let (line, column) = source.line_and_column(byte);
        Self { path: source.path.into(), line, column }
    }

    /// The line, from one.
    pub fn line(&self) -> usize {
        self.line
    }

    /// An error about a part of a file, moved to the place.
    pub fn here(&self, e: Error) -> Error {
        e.moved_to(self.line, self.column).at_file(&self.path)
    }

    /// An error at the place.
    pub fn error(&self, message: impl Into<String>) -> Error {
        self.told(Error::input(message))
    }

    /// An error without a place, at this one.
    pub(crate) fn told(&self, e: Error) -> Error {
        e.at_file(&self.path).at(self.line, self.column)
    }
}
