//! The names of a log's columns.

use super::sheet::Sheet;
use crate::error::Result;
use std::path::Path;

/// The header of a log.
///
/// # Errors
/// When the file cannot be read or is no CSV file.
pub fn read_header(path: impl AsRef<Path>) -> Result<Vec<String>> {
    Ok(Sheet::open(path.as_ref())?.header)
}
