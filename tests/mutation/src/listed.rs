//! The mutants as `cargo mutants` lists them.

use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// Line and column, both from 1, as `cargo mutants` counts them.
pub type Place = (usize, usize);

/// One mutant.
#[derive(Clone, Debug)]
pub struct Mutant {
    pub file: String,
    pub name: String,
    pub genre: String,
    pub replacement: String,
    pub start: Place,
    pub end: Place,
}

/// Every mutant of the package, or of the files that begin with one of some paths. The number of a mutant is its index
/// here: mutants of one place follow each other.
pub fn list(root: &Path, files: &[String]) -> Vec<Mutant> {
    let made = Command::new("cargo").args(["mutants", "--list", "--json"]).current_dir(root).output().unwrap();
    let all: Value = serde_json::from_slice(&made.stdout).expect("cargo mutants --list --json");
    let wanted = |m: &Mutant| files.is_empty() || files.iter().any(|f| m.file.starts_with(f));
    let mut mutants: Vec<Mutant> = all.as_array().unwrap().iter().map(read).filter(wanted).collect();
    mutants.sort_by(|a, b| (&a.file, &a.genre, a.start).cmp(&(&b.file, &b.genre, b.start)));
    mutants
}

fn read(v: &Value) -> Mutant {
    let text = |v: &Value| v.as_str().unwrap_or_default().to_string();
    let place = |v: &Value| (v["line"].as_u64().unwrap() as usize, v["column"].as_u64().unwrap() as usize);
    Mutant {
        file: text(&v["file"]),
        name: text(&v["name"]),
        genre: text(&v["genre"]),
        replacement: text(&v["replacement"]),
        start: place(&v["span"]["start"]),
        end: place(&v["span"]["end"]),
    }
}
