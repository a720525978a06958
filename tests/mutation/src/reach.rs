//! Which test meets which mutants, and how long it takes.

use crate::Places;
use crate::units::{End, binaries, run, tests};
use std::collections::BTreeSet;

/// One test.
#[derive(Clone, Debug)]
pub struct Test {
    pub binary: String,
    pub path: String,
    pub name: String,
    pub seconds: f64,
    pub met: BTreeSet<u32>,
}

/// Runs every test alone, twice: for the time and for the mutants. Leaves a line for each in `reach.tsv`; of some files
/// of tests it puts their lines in place of those before.
pub fn measure(at: &Places, only: &[&str]) {
    let old = at.read("reach.tsv");
    let kept = |l: &&str| !only.is_empty() && !only.iter().any(|o| l.starts_with(&format!("{o}\t")));
    let mut out: String = old.lines().filter(kept).map(|l| format!("{l}\n")).collect();
    for (binary, path) in binaries(at, only) {
        for name in tests(at, &path) {
            let met = at.file("met");
            let _ = std::fs::remove_file(&met);
            let (ended, _) = run(at, &path, &[&name], ("MUTANT_REACH", met.to_str().unwrap()), 1000);
            let (again, took) = run(at, &path, &[&name], ("MUTANT", "1000000"), 1000);
            if ended != End::Passed || again != End::Passed {
                println!("left out, does not pass: {binary} {name}");
                continue;
            }
            let text = at.read("met");
            let ids: BTreeSet<&str> = text.split_whitespace().collect();
            let ids: Vec<&str> = ids.into_iter().collect();
            out += &format!("{binary}\t{path}\t{name}\t{:.4}\t{}\n", took.as_secs_f64(), ids.join(" "));
        }
    }
    std::fs::write(at.file("reach.tsv"), out).unwrap();
}

/// What [`measure`] left.
pub fn read(at: &Places) -> Vec<Test> {
    let line = |l: &str| {
        let cells: Vec<&str> = l.split('\t').collect();
        Test {
            binary: cells[0].into(),
            path: cells[1].into(),
            name: cells[2].into(),
            seconds: cells[3].parse().unwrap(),
            met: cells[4].split_whitespace().map(|i| i.parse().unwrap()).collect(),
        }
    };
    at.read("reach.tsv").lines().map(line).collect()
}
