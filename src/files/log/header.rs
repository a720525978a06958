//! The names of a log's columns.

use super::log_file::Log;
use crate::error::Result;
use std::path::Path;

/// The header of a log.
///
/// # Errors
/// When the file cannot be read or is no log.
pub fn read_header(path: impl AsRef<Path>) -> Result<Vec<String>> {
    Ok(Log::open(path.as_ref())?.header().to_vec())
}

/// The first rows of a table of text, for someone to look at; none of a log in another format.
///
/// # Errors
/// When the file cannot be read or is no log.
pub fn read_texts(path: impl AsRef<Path>, rows: usize) -> Result<Vec<Vec<String>>> {
    match Log::open(path.as_ref())? {
        Log::Csv(sheet) => sheet.texts(rows),
        _ => Ok(vec![]),
    }
}
