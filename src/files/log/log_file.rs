//! A log of whatever format: columns by name, rows of numbers.

use super::csv_table::{Numbers, SQLITE, Sheet};
use super::folder::Folder;
#[cfg(feature = "mcap")]
use super::mcap::bag::Bag;
#[cfg(feature = "parquet")]
use super::parquet::ParquetLog;
use super::place::Place;
use super::time_stamp::Origin;
use crate::error::{Error, Result};
use crate::files::toml::text::{is_folder, open};
use std::io::{Cursor, Read};
use std::path::Path;

/// An open log whose columns are known.
pub(crate) enum Log {
    /// A table of text.
    Csv(Box<Sheet>),
    /// Apache Parquet.
    #[cfg(feature = "parquet")]
    Parquet(Box<ParquetLog>),
    /// A bag of ROS 2 messages.
    #[cfg(feature = "mcap")]
    Bag(Bag),
    /// Tables of text in a folder.
    Folder(Box<Folder>),
}

/// What a file is, by its first bytes or its name.
#[derive(Clone, Copy, PartialEq)]
enum Format {
    Csv,
    Parquet,
    Bag,
    Folder,
}

/// What files begin with.
const PARQUET: &[u8] = b"PAR1";
const MCAP: &[u8] = b"\x89MCAP";

impl Log {
    /// Opens a log and reads the names of its columns.
    pub fn open(path: &Path) -> Result<Self> {
        match format(path)? {
            Format::Csv => Ok(Self::Csv(Box::new(Sheet::open(path)?))),
            Format::Parquet => parquet(path),
            Format::Bag => bag(path),
            Format::Folder => match Folder::open(path)? {
                Some(folder) => Ok(Self::Folder(Box::new(folder))),
                None => Err(is_folder(path)),
            },
        }
    }

    /// A table of text that is at hand.
    pub fn of_text(name: &Path, text: &str) -> Result<Self> {
        Ok(Self::Csv(Box::new(Sheet::new(Cursor::new(text.to_string()), name)?)))
    }

    /// The names of the columns.
    pub fn header(&self) -> &[String] {
        match self {
            Self::Csv(sheet) => &sheet.header,
            #[cfg(feature = "parquet")]
            Self::Parquet(log) => &log.header,
            #[cfg(feature = "mcap")]
            Self::Bag(bag) => &bag.header,
            Self::Folder(folder) => &folder.header,
        }
    }

    /// An error about the header.
    pub fn at_header(&self, error: Error) -> Error {
        match self {
            Self::Csv(sheet) => sheet.at_header(error),
            #[cfg(feature = "parquet")]
            Self::Parquet(log) => error.at_file(&log.path),
            #[cfg(feature = "mcap")]
            Self::Bag(bag) => error.at_file(&bag.path),
            Self::Folder(folder) => error.at_file(&folder.path),
        }
    }

    /// Whether columns come from topics or files that have times of their own.
    pub fn has_topics(&self) -> bool {
        match self {
            #[cfg(feature = "mcap")]
            Self::Bag(_) => true,
            Self::Folder(_) => true,
            _ => false,
        }
    }

    /// Counts times that are whole numbers or dates from where another file's are.
    pub fn counted_from(&mut self, origin: Origin) {
        match self {
            Self::Csv(sheet) => sheet.origin = origin,
            #[cfg(feature = "parquet")]
            Self::Parquet(log) => log.origin = origin,
            #[cfg(feature = "mcap")]
            Self::Bag(_) => {}
            Self::Folder(folder) => folder.origin = origin,
        }
    }

    /// Reads all rows, and with them columns for which no row is left out; `wanted` are cells of a row, the time first.
    /// Topics, with times of their own, have none.
    pub fn numbers_and(self, wanted: &[Place], more: &[Place]) -> Result<Numbers> {
        match self {
            Self::Csv(sheet) => sheet.numbers_and(wanted, more),
            #[cfg(feature = "parquet")]
            Self::Parquet(log) => log.numbers_and(wanted, more),
            #[cfg(feature = "mcap")]
            Self::Bag(bag) => bag.numbers(&wanted.iter().map(|place| place.index).collect::<Vec<_>>()),
            Self::Folder(folder) => Err(is_folder(&folder.path)),
        }
    }
}

fn format(path: &Path) -> Result<Format> {
    if path.is_dir() {
        return Ok(Format::Folder);
    }
    // What stands in a pipe can be read once.
    if std::fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir()) {
        return Ok(Format::Csv);
    }
    let mut file = open(path)?;
    let mut start = [0; SQLITE.len()];
    let known = file.read(&mut start).unwrap_or(0);
    let begins = |magic: &[u8]| known >= magic.len() && start.starts_with(magic);
    let ends = |name: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(name));
    Ok(match () {
        () if begins(PARQUET) || ends("parquet") => Format::Parquet,
        () if begins(MCAP) || ends("mcap") => Format::Bag,
        () if cfg!(feature = "db3") && begins(SQLITE) => Format::Bag,
        () => Format::Csv,
    })
}

#[cfg(feature = "parquet")]
fn parquet(path: &Path) -> Result<Log> {
    Ok(Log::Parquet(Box::new(ParquetLog::open(path)?)))
}

#[cfg(not(feature = "parquet"))]
fn parquet(path: &Path) -> Result<Log> {
    Err(without("a Parquet file", "parquet", path))
}

#[cfg(feature = "mcap")]
fn bag(path: &Path) -> Result<Log> {
    Ok(Log::Bag(Bag::open(path)?))
}

#[cfg(not(feature = "mcap"))]
fn bag(path: &Path) -> Result<Log> {
    Err(without("an MCAP file", "mcap", path))
}

/// The error of a format that was left out of this build.
#[cfg(not(all(feature = "parquet", feature = "mcap")))]
fn without(what: &str, feature: &str, path: &Path) -> Error {
    Error::input(format!("is {what}, which this build of creepage does not read"))
        .at_file(path)
        .help(format!("build it with `cargo install --path . --features {feature}`, or save the log as CSV"))
}
