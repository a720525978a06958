//! The output of commands: text or JSON, on standard output.

use clap::ValueEnum;
use creepage::{Error, Result};
use serde::Serialize;
use std::io::{ErrorKind, Write};

/// How an answer is printed, where a command knows no other formats.
#[derive(Clone, Copy, ValueEnum)]
pub enum Format {
    Text,
    Json,
}

/// JSON with a line for every value.
pub fn pretty(value: &serde_json::Value) -> String {
    format!("{value:#}\n")
}

/// An answer as JSON.
pub fn json<T: Serialize>(answer: &T) -> Result<String> {
    let json = serde_json::to_string_pretty(answer).map_err(|e| Error::run(format!("no JSON: {e}")))?;
    Ok(format!("{json}\n"))
}

/// An answer: as JSON, or as text unless nothing but errors is to be printed.
pub fn print_answer<T: Serialize>(
    answer: &T,
    format: Format,
    quiet: bool,
    text: impl FnOnce(&T) -> String,
) -> Result<()> {
    match format {
        Format::Json => print(&json(answer)?),
        Format::Text if !quiet => print(&text(answer)),
        Format::Text => Ok(()),
    }
}

/// Writes text to standard output; a reader that has gone away is no error, a full disk behind it is one.
pub fn print(text: &str) -> Result<()> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => {
            Err(Error::run(format!("standard output cannot be written: {e}")).help("free space and try again"))
        }
        _ => Ok(()),
    }
}
