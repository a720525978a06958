//! The program as a process.

use std::path::Path;
use std::process::{Command, Output};

/// Runs it in a folder.
pub fn creepage(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_creepage")).current_dir(folder).args(arguments).output().unwrap()
}

/// What it said.
pub fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}
