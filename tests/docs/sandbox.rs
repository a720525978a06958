//! A folder in which commands of the documents run: the examples, and the files of one of them as a log at hand.

use super::commands::Command;
use super::documents::root;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A temporary folder with the bundled data.
pub struct Sandbox(TempDir);

/// What lies at the top as the reader's own log.
const OWN: &str = "examples/runs/cornering";

impl Sandbox {
    /// A fresh folder.
    pub fn new() -> Self {
        let dir = tempfile::tempdir().unwrap();
        copy(&root().join("examples"), &dir.path().join("examples"));
        copy(&root().join(OWN), dir.path());
        // The names that stand for a reader's own files.
        for (own, name) in [("eights.csv", "RUN.csv"), ("model.toml", "MODEL.toml")] {
            std::fs::copy(dir.path().join(own), dir.path().join(name)).unwrap();
        }
        Self(dir)
    }

    /// Runs a command; what is wrong with it.
    pub fn faults(&self, command: &Command) -> Vec<String> {
        if let Some(text) = &command.mine {
            std::fs::write(self.0.path().join("mine.toml"), text).unwrap();
        }
        let binary = PathBuf::from(env!("CARGO_BIN_EXE_creepage"));
        let others = std::env::var("PATH").unwrap_or_default();
        let path = format!("{}:{others}", binary.parent().unwrap().display());
        let mut shell = std::process::Command::new("sh");
        shell.args(["-c", &command.text]).current_dir(self.0.path()).env("PATH", path);
        let output = shell.output().unwrap();
        let at = |what: String| format!("line {}: {}: {what}", command.line, command.text);
        if !output.status.success() {
            return vec![at(format!("{}\n{}", output.status, String::from_utf8_lossy(&output.stderr)))];
        }
        let printed = String::from_utf8_lossy(&output.stdout);
        missing(&command.shown, &printed)
            .map(|line| at(format!("does not print {line:?}, but\n{printed}")))
            .into_iter()
            .collect()
    }
}

/// The first of the lines shown that is not printed behind the ones before it.
fn missing<'a>(shown: &'a [String], printed: &str) -> Option<&'a str> {
    let plain = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut rest = printed.lines();
    let wanted = shown.iter().filter(|line| !plain(line).is_empty() && line.trim() != "...");
    wanted.into_iter().find(|line| !rest.any(|p| plain(p) == plain(line))).map(String::as_str)
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap().map(Result::unwrap) {
        let target = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            copy(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).unwrap();
        }
    }
}
