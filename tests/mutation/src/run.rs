//! Puts every mutant to the tests that meet it, quickest and likeliest first, until one fails.

use crate::Places;
use crate::reach::{self, Test};
use crate::units::{CLAIM, End, ONE_IN, run as run_tests};
use std::collections::{BTreeMap, HashMap};
use std::io::Write;

/// Longest test of each round, in seconds: most mutants never meet a slow one.
pub const ROUNDS: [f64; 4] = [0.2, 1.0, 4.0, 1e9];

/// What is known of a mutant so far.
#[derive(Clone, Debug, PartialEq)]
pub struct Result {
    pub outcome: String,
    pub by: String,
    pub up_to: f64,
}

/// The last word on every mutant.
pub fn results(at: &Places) -> BTreeMap<usize, Result> {
    let mut last = BTreeMap::new();
    for line in at.read("results.tsv").lines() {
        let cells: Vec<&str> = line.split('\t').collect();
        let up_to = cells[3].parse().unwrap();
        last.insert(cells[0].parse().unwrap(), Result { outcome: cells[1].into(), by: cells[2].into(), up_to });
    }
    last
}

/// Number, file and name of every mutant that was written.
pub fn written(at: &Places) -> Vec<(usize, String, String)> {
    let line = |l: &str| {
        let cells: Vec<&str> = l.split('\t').collect();
        ["Written", "Cloned"]
            .contains(&cells[1])
            .then(|| (cells[0].parse().unwrap(), cells[2].to_string(), cells[3].to_string()))
    };
    at.read("fates.tsv").lines().filter_map(line).collect()
}

/// One process: tests of a binary.
struct Unit<'a> {
    path: &'a str,
    key: String,
    tests: Vec<&'a str>,
    one_in: u32,
    seconds: f64,
}

/// Runs what is not yet decided with tests of up to so many seconds; of the mutants every `of`-th from `part`.
pub fn run(at: &Places, up_to: f64, part: usize, of: usize) {
    let known = results(at);
    let tests = reach::read(at);
    let mut file = std::fs::OpenOptions::new().append(true).create(true).open(at.file("results.tsv")).unwrap();
    let mut kills: HashMap<(String, String), f64> = HashMap::new();
    let open = |id: &usize| known.get(id).is_none_or(|r| r.outcome == "alive" && r.up_to < up_to);
    let mut todo: Vec<_> = written(at).into_iter().filter(|(id, ..)| open(id)).collect();
    todo.sort_by_key(|(id, f, _)| (priority(f), *id));
    for (id, source, _) in todo.into_iter().skip(part).step_by(of) {
        let from = known.get(&id).map_or(0.0, |r| r.up_to);
        let mut units = units(&tests, id, from, up_to);
        let hits = |u: &Unit| 0.2 + kills.get(&(source.clone(), u.key.clone())).unwrap_or(&0.0);
        let cost = |u: &Unit| u.seconds * if is_far(u, &source) { 100.0 } else { 1.0 } / hits(u);
        units.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
        let (outcome, by) = judge(at, id, &units);
        if outcome != "alive" {
            *kills.entry((source.clone(), by.clone())).or_default() += 1.0;
        }
        // One write, so that two runs can share the file.
        file.write_all(format!("{id}\t{outcome}\t{by}\t{up_to}\n").as_bytes()).unwrap();
    }
}

/// The claims rest on everything: their tests are the last to ask about what lies below them.
fn is_far(unit: &Unit, source: &str) -> bool {
    unit.key.starts_with(CLAIM) && !source.starts_with("src/claims")
}

/// The layers in the order they are wanted in; the paper's claims are mostly data.
fn priority(file: &str) -> usize {
    const ORDER: [&str; 4] = ["src/mechanism", "src/claims/paper", "src/claims", "src/formula"];
    [0, 2, 1, 3][ORDER.iter().position(|p| file.starts_with(p)).unwrap_or(3)]
}

fn judge(at: &Places, id: usize, units: &[Unit]) -> (&'static str, String) {
    for unit in units {
        let limit = (10.0 * unit.seconds).max(8.0) as u64;
        let variables = [("MUTANT", &*id.to_string()), (ONE_IN, &*unit.one_in.to_string())];
        match run_tests(at, unit.path, &unit.tests, &variables, limit).0 {
            End::Passed => {}
            End::Failed => return ("killed", unit.key.clone()),
            End::TooLong => return ("timeout", unit.key.clone()),
        }
    }
    ("alive", String::new())
}

/// The file of tests, or the module of the crate, that a test is in.
fn file(test: &str) -> &str {
    test.rsplit_once("::").map_or(test, |(module, _)| module)
}

/// Quick tests of a file run together, the others alone; many claims a few at a time.
fn units<'a>(tests: &'a [Test], id: usize, from: f64, up_to: f64) -> Vec<Unit<'a>> {
    const TOGETHER: f64 = 0.1;
    const MIN_GROUPED_CLAIMS: usize = 20;
    let mut made: BTreeMap<(String, u32), Unit> = BTreeMap::new();
    let met = |t: &&Test| from <= t.seconds && t.seconds < up_to && t.met.contains(&(id as u32));
    let claims = tests.iter().filter(met).filter(|t| t.binary == CLAIM).count();
    for (i, t) in tests.iter().filter(met).enumerate() {
        let key = match t.binary == CLAIM && claims > MIN_GROUPED_CLAIMS && t.seconds < 1.0 {
            true => format!("{CLAIM} {}", i / 10),
            false if t.seconds < TOGETHER => format!("{} {}", t.binary, file(&t.name)),
            false => format!("{} {}", t.binary, t.name),
        };
        let empty = Unit { path: &t.path, key: key.clone(), tests: Vec::new(), one_in: t.one_in, seconds: 0.01 };
        let unit = made.entry((key, t.one_in)).or_insert(empty);
        unit.tests.push(&t.name);
        unit.seconds += t.seconds;
    }
    made.into_values().collect()
}
