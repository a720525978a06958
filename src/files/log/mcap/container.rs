//! The messages of an MCAP file, one after another.

use super::recorded::{Recorded, Source};
use crate::error::{Error, Result};
use crate::files::toml::suggestions;
use crate::files::toml::text::open;
use mcap::io::MessageReader;
use mcap::sans_io::LinearReaderOptions;
use mcap::{McapError, Message};
use std::collections::BTreeMap;
use std::io::BufReader;
use std::path::Path;

/// The largest record, in bytes, of a file that is smaller than this; that of a larger one is as large as the file.
const MAX_RECORD_BYTES: u64 = 64 << 20;

/// Puts every message to a reader, with how many came before it.
pub(super) fn each(path: &Path, read: &mut dyn FnMut(usize, &Recorded) -> Result<()>) -> Result<()> {
    let file = open(path)?;
    let size = file.metadata().map_or(0, |m| m.len());
    let limit = usize::try_from(size.max(MAX_RECORD_BYTES)).unwrap_or(usize::MAX);
    let options = LinearReaderOptions::default().with_record_length_limit(limit);
    let mut sources: BTreeMap<u16, Source> = BTreeMap::new();
    for (n, message) in MessageReader::new_with_options(BufReader::new(file), options).enumerate() {
        let message = message.map_err(|e| unreadable(path, n, &e))?;
        let source = sources.entry(message.channel.id).or_insert_with(|| source(&message));
        read(n, &Recorded { source, log_time: message.log_time, data: &message.data })?;
    }
    Ok(())
}

fn source(message: &Message) -> Source {
    let channel = &message.channel;
    let schema = channel.schema.as_ref();
    let definition = schema.filter(|s| s.encoding == "ros2msg").and_then(|s| std::str::from_utf8(&s.data).ok());
    Source {
        id: u64::from(channel.id),
        topic: channel.topic.clone(),
        kind: schema.map_or_else(String::new, |s| s.name.clone()),
        encoding: channel.message_encoding.clone(),
        definition: definition.map(String::from),
    }
}

fn unreadable(path: &Path, n: usize, e: &McapError) -> Error {
    Error::input(format!("cannot be read as MCAP behind message {n}: {}", suggestions::reason(&e.to_string())))
        .at_file(path)
        .help("the recording may be cut off; `mcap recover` saves what is whole")
}
