//! The names of a log's columns.

use super::log_file::Log;
use crate::error::Result;
use std::path::Path;

/// The header of a log, and its first rows where it is a table of text, for someone to look at.
///
/// # Errors
/// When the file cannot be read or is no log.
pub fn read_beginning(path: impl AsRef<Path>, rows: usize) -> Result<(Vec<String>, Vec<Vec<String>>)> {
    let log = Log::open(path.as_ref())?;
    let header = log.header().to_vec();
    let texts = if let Log::Csv(sheet) = log { sheet.texts(rows)? } else { vec![] };
    Ok((header, texts))
}
