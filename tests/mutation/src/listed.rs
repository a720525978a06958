//! The mutants as `cargo mutants` lists them.

use crate::Places;
use serde_json::Value;
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

/// Every mutant of the three layers, or of the files of the package that begin with one of some paths; of these the
/// ones in a shard. The number of a mutant is its index here: mutants of one place follow each other.
pub fn list(at: &Places) -> Vec<Mutant> {
    // The configuration names the three layers.
    let everywhere: &[&str] = if at.files.is_empty() { &[] } else { &["--no-config"] };
    let mut command = Command::new("cargo");
    command.args(["mutants", "--list", "--json"]).args(everywhere).current_dir(&at.root);
    let all: Value = serde_json::from_slice(&command.output().unwrap().stdout).expect("cargo mutants --list --json");
    let of_file = |m: &Mutant| at.files.is_empty() || at.files.iter().any(|f| m.file.starts_with(f));
    let wanted = |m: &Mutant| of_file(m) && hash(m) % at.shard.1 == at.shard.0;
    let mut mutants: Vec<Mutant> = all.as_array().unwrap().iter().map(read).filter(wanted).collect();
    mutants.sort_by(|a, b| (&a.file, &a.genre, a.start).cmp(&(&b.file, &b.genre, b.start)));
    mutants
}

/// `I/N`, I from 0.
pub fn shard(text: &str) -> Option<(u64, u64)> {
    let (part, of) = text.split_once('/')?;
    let shard: (u64, u64) = (part.parse().ok()?, of.parse().ok()?);
    (shard.0 < shard.1).then_some(shard)
}

/// A number that only file, place and change decide (FNV-1a, mixed once more): shards are drawn as if by lot, are the same for
/// everybody, and have no mutant in common.
fn hash(m: &Mutant) -> u64 {
    const SEED: u64 = 0xcbf2_9ce4_8422_2325;
    let step = |h: u64, b: u8| (h ^ u64::from(b)).wrapping_mul(0x0000_0100_0000_01b3);
    let h = m.file.bytes().chain([0]).chain(m.name.bytes()).fold(SEED, step);
    let h = (h ^ (h >> 32)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    h ^ (h >> 29)
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
