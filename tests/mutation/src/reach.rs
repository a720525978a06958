//! Which test meets which mutants, and how long it takes.

use crate::Places;
use crate::units::{CLAIM, DOCTESTS, End, ONE_IN, binaries, claims, doctests, is_asked, is_one_of, run, tests};
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Mutex;

/// One test.
#[derive(Clone, Debug)]
pub struct Test {
    pub binary: String,
    pub path: String,
    pub name: String,
    /// Properties try one in so many of their cases.
    pub one_in: u32,
    pub seconds: f64,
    pub met: BTreeSet<u32>,
}

/// Runs every test alone, twice: for the time and for the mutants. Leaves a line for each in `reach.tsv`; of some files
/// of tests it puts their lines in place of those before.
pub fn measure(at: &Places, only: &[&str]) {
    let old = at.read("reach.tsv");
    let named = |l: &str| {
        let cells: Vec<&str> = l.split('\t').collect();
        is_one_of(&format!("{}::{}", cells[0], cells[2]), only)
    };
    let kept = |l: &&str| !only.is_empty() && !named(l);
    let mut out: String = old.lines().filter(kept).map(|l| format!("{l}\n")).collect();
    let tested = |(binary, path): (String, String)| {
        let asked = |name: &String| is_asked(at, only, &format!("{binary}::{name}"));
        let names = tests(at, &path).into_iter().filter(asked).collect();
        (binary, path, names)
    };
    let mut all: Vec<_> = binaries(at, only).into_iter().map(tested).collect();
    for (what, made) in [(DOCTESTS, doctests as fn(&Places) -> (String, Vec<String>)), (CLAIM, claims)] {
        if only.is_empty() || only.contains(&what) {
            let (path, names) = made(at);
            all.push((what.into(), path, names));
        }
    }
    let each: Vec<[&str; 3]> =
        all.iter().flat_map(|(binary, path, names)| names.iter().map(|n| [&**binary, &**path, &**n])).collect();
    let (waiting, lines) = (Mutex::new(each.iter().enumerate()), Mutex::new(vec![None; each.len()]));
    let next = || waiting.lock().unwrap().next();
    // Many tests leave a core idle.
    std::thread::scope(|scope| {
        for worker in 0..WORKERS {
            let (next, lines) = (&next, &lines);
            scope.spawn(move || {
                let met = at.file(&format!("met-{worker}"));
                while let Some((i, test)) = next() {
                    let line = line(at, *test, &met);
                    lines.lock().unwrap()[i] = line;
                }
            });
        }
    });
    for (test, line) in each.iter().zip(lines.into_inner().unwrap()) {
        match line {
            Some(line) => out += &line,
            None => println!("left out, does not pass or takes long: {} {}", test[0], test[2]),
        }
    }
    std::fs::write(at.file("reach.tsv"), out).unwrap();
}

/// Shares of the cases of a property, tried in turn.
const SHARES: [u32; 2] = [20, 1];

/// Tests side by side.
const WORKERS: usize = 2;

/// Processor time after which a test is left out, in seconds.
const MAX_SECONDS: u64 = 60;

/// The line of a test; nothing when it does not pass.
fn line(at: &Places, [binary, path, name]: [&str; 3], met: &Path) -> Option<String> {
    // What counts its cases does not pass with few.
    let (share, (took, ids)) =
        SHARES.into_iter().find_map(|share| Some((share, alone(at, path, name, share, met)?)))?;
    Some(format!("{binary}\t{path}\t{name}\t{share}\t{took:.4}\t{ids}\n"))
}

/// The time that a test takes alone and the mutants that it meets; nothing when it does not pass.
fn alone(at: &Places, path: &str, name: &str, one_in: u32, met: &Path) -> Option<(f64, String)> {
    let share = (ONE_IN, one_in.to_string());
    let run = |variable: (&str, &str), limit| run(at, path, &[name], &[variable, (share.0, &share.1)], limit);
    let _ = std::fs::remove_file(met);
    let note = |limit| run(("MUTANT_REACH", met.to_str().unwrap()), limit);
    // The switches of a shard are far between: noting them takes no time.
    let few = at.shard.1 > 1;
    let (ended, took) = if few { note(MAX_SECONDS) } else { run(("MUTANT", "1000000"), MAX_SECONDS) };
    if ended != End::Passed || !few && note(20 * MAX_SECONDS).0 != End::Passed {
        return None;
    }
    let text = std::fs::read_to_string(met).unwrap_or_default();
    let ids: BTreeSet<&str> = text.split_whitespace().collect();
    Some((took.as_secs_f64(), ids.into_iter().collect::<Vec<_>>().join(" ")))
}

/// What [`measure`] left.
pub fn read(at: &Places) -> Vec<Test> {
    let line = |l: &str| {
        let cells: Vec<&str> = l.split('\t').collect();
        Test {
            binary: cells[0].into(),
            path: cells[1].into(),
            name: cells[2].into(),
            one_in: cells[3].parse().unwrap(),
            seconds: cells[4].parse().unwrap(),
            met: cells[5].split_whitespace().map(|i| i.parse().unwrap()).collect(),
        }
    };
    at.read("reach.tsv").lines().map(line).collect()
}
