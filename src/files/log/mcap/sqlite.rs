//! Bags in SQLite (`.db3`), as `ros2 bag record` wrote them before MCAP: the tables `topics` and `messages`, and from ROS 2
//! Iron on `message_definitions`.

use super::recorded::{Recorded, Source};
use crate::error::{Error, Result};
use crate::files::log::csv_table::SQLITE;
use crate::files::toml::suggestions;
use rusqlite::{Connection, OpenFlags, Row};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

const TOPICS: &str = "SELECT id, name, type, serialization_format FROM topics";
const DEFINITIONS: &str = "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions";
const MESSAGES: &str = "SELECT topic_id, timestamp, data FROM messages ORDER BY timestamp, id";

/// Whether a file is an SQLite database.
pub(super) fn is_one(path: &Path) -> bool {
    let mut start = [0; SQLITE.len()];
    File::open(path).and_then(|mut file| file.read_exact(&mut start)).is_ok() && start == *SQLITE
}

/// Puts every message to a reader, in the order of their times.
pub(super) fn each(path: &Path, read: &mut dyn FnMut(usize, &Recorded) -> Result<()>) -> Result<()> {
    let wrong = |n: usize| move |e: rusqlite::Error| unreadable(path, n, &e);
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let bag = Connection::open_with_flags(path, flags).map_err(wrong(0))?;
    let sources = sources(&bag).map_err(wrong(0))?;
    let mut messages = bag.prepare(MESSAGES).map_err(wrong(0))?;
    let mut rows = messages.query([]).map_err(wrong(0))?;
    let mut n = 0;
    while let Some(row) = rows.next().map_err(wrong(n))? {
        let of = |row: &Row| Ok((row.get::<_, i64>(0)?, row.get::<_, i64>(1)?, row.get::<_, Vec<u8>>(2)?));
        let (topic, time, data) = of(row).map_err(wrong(n))?;
        if let Some(source) = sources.get(&topic) {
            read(n, &Recorded { source, log_time: u64::try_from(time).unwrap_or(0), data: &data })?;
        }
        n += 1;
    }
    Ok(())
}

fn sources(bag: &Connection) -> rusqlite::Result<BTreeMap<i64, Source>> {
    let mut definitions: BTreeMap<String, String> = BTreeMap::new();
    // Older recordings have no such table.
    if bag.table_exists(None, "message_definitions")? {
        let mut all = bag.prepare(DEFINITIONS)?;
        let of = |row: &Row| Ok((row.get::<_, String>(0)?, row.get::<_, String>(1)?, row.get::<_, String>(2)?));
        for found in all.query_map([], of)? {
            let (kind, encoding, text) = found?;
            if encoding == "ros2msg" {
                definitions.insert(kind, text);
            }
        }
    }
    let mut topics = bag.prepare(TOPICS)?;
    let of = |row: &Row| {
        let (id, topic, kind, encoding) = (row.get::<_, i64>(0)?, row.get(1)?, row.get::<_, String>(2)?, row.get(3)?);
        let definition = definitions.get(&kind).cloned();
        Ok((id, Source { id: u64::try_from(id).unwrap_or(u64::MAX), topic, kind, encoding, definition }))
    };
    topics.query_map([], of)?.collect()
}

fn unreadable(path: &Path, n: usize, e: &rusqlite::Error) -> Error {
    Error::input(format!(
        "cannot be read as a bag in SQLite behind message {n}: {}",
        suggestions::reason(&e.to_string())
    ))
    .at_file(path)
    .help("a recording that was not closed is mended by `ros2 bag reindex FOLDER sqlite3`")
}
