//! The copy of the package with every mutant that compiles, built once.

use crate::Places;
use crate::listed::{Mutant, list};
use crate::rewrite::{Fate, SWITCH, rewrite};
use crate::units::ONE_IN;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::{Command, Output};

/// Optimised as far as the runs, not the build, gain from it; panics on overflow as the tests expect.
const PROFILE: &str = "\n[profile.schemata]\ninherits = \"dev\"\nopt-level = 1\ndebug = false\nincremental = false\n\
                       \n[profile.schemata.package.\"*\"]\nopt-level = 3\n";

/// The most mutants of one build: the switch can note so many numbers.
const MAX_MUTANTS: usize = 8192;

/// What the mutants were found in is left out of the search for errors after this many rounds.
const ROUNDS: usize = 25;

/// Copies, rewrites and builds; leaves `fates.tsv` with a line for every mutant.
pub fn make(at: &Places) {
    let mutants = list(at);
    assert!(mutants.len() <= MAX_MUTANTS, "{} mutants are more than {MAX_MUTANTS}: take a --shard of them", mutants.len());
    std::fs::create_dir_all(at.copy()).unwrap();
    copy(at);
    let mut fates: BTreeMap<usize, Fate> = BTreeMap::new();
    for round in 1..=ROUNDS {
        write(at, &mutants, &mut fates);
        let (errors, bad) = check(at, &mutants, &fates);
        println!("round {round}: {errors} errors, {} mutants left out", bad.len());
        if errors == 0 {
            break;
        }
        assert!(!bad.is_empty() && round < ROUNDS, "errors that no mutant explains; see check.json");
        fates.extend(bad);
    }
    let line = |(id, m): (usize, &Mutant)| format!("{id}\t{:?}\t{}\t{}\n", fates[&id], m.file, m.name);
    std::fs::write(at.file("fates.tsv"), mutants.iter().enumerate().map(line).collect::<String>()).unwrap();
}

/// `cargo` in the copy.
pub fn cargo(at: &Places, arguments: &[&str]) -> Output {
    command(at, arguments).arg("--message-format=json").output().unwrap()
}

/// How `cargo` is called in the copy.
pub fn command(at: &Places, arguments: &[&str]) -> Command {
    let mut command = Command::new("cargo");
    command.args(arguments).args(["--profile=schemata", "--quiet", "--all-features"]).current_dir(at.copy());
    command.env("CARGO_TARGET_DIR", at.file("target"));
    command.env("RUSTFLAGS", "--cap-lints=allow").env("RUSTDOCFLAGS", "--cap-lints=allow");
    command
}

/// The files of the package as they stand, not those of this tool.
fn copy(at: &Places) {
    let arguments = ["ls-files", "-co", "--exclude-standard"];
    let files = Command::new("git").args(arguments).current_dir(&at.root).output().unwrap();
    for file in String::from_utf8(files.stdout).unwrap().lines().filter(|f| !f.starts_with("tests/mutation/")) {
        let Ok(mut bytes) = std::fs::read(at.root.join(file)) else { continue };
        match file {
            "Cargo.toml" => bytes.extend_from_slice(PROFILE.as_bytes()),
            "tests/support/mod.rs" => bytes = fewer_cases(&bytes),
            _ => bytes.extend_from_slice(names_switch(file).as_bytes()),
        }
        put(&at.copy().join(file), &bytes);
    }
    put(&at.copy().join("src/mutant.rs"), SWITCH.as_bytes());
}

/// How a file that begins a crate names the switch.
fn names_switch(file: &str) -> &'static str {
    match file {
        "src/lib.rs" => "\n#[doc(hidden)]\n#[allow(missing_docs)]\npub mod mutant;\n",
        "src/main.rs" => "\nuse creepage::mutant;\n",
        _ => "",
    }
}

/// Properties with a share of their cases, the first ones; they stop at the first that fails and keep nothing of it.
fn fewer_cases(bytes: &[u8]) -> Vec<u8> {
    let text = String::from_utf8(bytes.to_vec()).unwrap();
    let share = format!("(cases / std::env::var(\"{ONE_IN}\").map_or(1, |n| n.parse().unwrap())).max(1)");
    let changes = [
        ("        cases,\n", format!("        cases: {share},\n")),
        ("max_shrink_iters: 4000", "max_shrink_iters: 0".into()),
        ("Some(Box::new(FileFailurePersistence::Direct(kept(Location::caller().file()))))", "None".into()),
    ];
    let change = |text: String, (old, new): (&str, String)| {
        assert!(text.contains(old), "tests/support/mod.rs lacks {old}");
        text.replace(old, &new)
    };
    changes.into_iter().fold(text, change).into_bytes()
}

/// Writes only what differs, so that cargo sees what is new.
fn put(path: &Path, bytes: &[u8]) {
    if std::fs::read(path).is_ok_and(|old| old == bytes) {
        return;
    }
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, bytes).unwrap();
}

fn write(at: &Places, mutants: &[Mutant], fates: &mut BTreeMap<usize, Fate>) {
    let files: BTreeSet<&String> = mutants.iter().map(|m| &m.file).collect();
    for file in files {
        let text = std::fs::read_to_string(at.root.join(file)).unwrap();
        let left = |id: &usize| fates.get(id).is_none_or(|f| f.is_written());
        let here: Vec<(usize, &Mutant)> =
            mutants.iter().enumerate().filter(|(id, m)| &m.file == file && left(id)).collect();
        let cloned = |id| fates.get(&id) == Some(&Fate::Cloned);
        let (text, decided) = rewrite(&text, &here, &cloned);
        put(&at.copy().join(file), (text + names_switch(file)).as_bytes());
        decided.into_iter().for_each(|(id, fate)| _ = fates.entry(id).or_insert(fate));
    }
}

/// The number of errors, and the mutants they are in.
fn check(at: &Places, mutants: &[Mutant], fates: &BTreeMap<usize, Fate>) -> (usize, BTreeMap<usize, Fate>) {
    let made = cargo(at, &["check", "--lib", "--bins"]);
    std::fs::write(at.file("check.json"), &made.stdout).unwrap();
    let mut bad = BTreeMap::new();
    let mut errors = 0;
    for line in String::from_utf8_lossy(&made.stdout).lines() {
        let Ok(v) = serde_json::from_str::<Value>(line) else { continue };
        let message = &v["message"];
        let spans = message["spans"].as_array().filter(|s| !s.is_empty());
        if message["level"] != "error" {
            continue;
        }
        errors += usize::from(spans.is_some());
        let Some(spans) = spans else { continue };
        let (primary, other): (Vec<&Value>, Vec<&Value>) = spans.iter().partition(|s| s["is_primary"] == true);
        let inside = |spans: &[&Value], mark| spans.iter().find_map(|s| innermost(at, s, mark));
        // An error inside a mutant is its own; an error around one may come from the switch.
        let mutant = inside(&primary, "/*M").or_else(|| inside(&other, "/*M"));
        let found = match mutant {
            Some(ids) => ids.into_iter().map(|id| (id, next(&mutants[id], fates.get(&id)))).collect::<Vec<_>>(),
            None => {
                let around = inside(&primary, "/*W").or_else(|| inside(&other, "/*W"));
                // That no type fits all that a function may return is told of its signature.
                let around = around.unwrap_or_else(|| other.iter().flat_map(|s| returned(at, s)).collect());
                around.into_iter().map(|id| (id, Fate::Inexpressible)).collect()
            }
        };
        bad.extend(found.into_iter().filter(|(id, _)| fates.get(id).is_some_and(|f| f.is_written())));
    }
    let broken = !made.status.success() && errors == 0;
    assert!(!broken, "{}", String::from_utf8_lossy(&made.stderr));
    (errors, bad)
}

/// A deleted sign is tried once more with a clone.
fn next(mutant: &Mutant, fate: Option<&Fate>) -> Fate {
    let sign = mutant.name.contains(": delete - in ");
    if sign && fate == Some(&Fate::Written) { Fate::Cloned } else { Fate::Unviable }
}

/// The mutants within a span of the compiler's that return an iterator of another type.
fn returned(at: &Places, span: &Value) -> Vec<usize> {
    let within = || {
        let text = std::fs::read_to_string(at.copy().join(span["file_name"].as_str()?)).ok()?;
        Some(text.get(span["byte_start"].as_u64()? as usize..span["byte_end"].as_u64()? as usize)?.to_string())
    };
    let text = within().unwrap_or_default();
    let marked = text.split("/*M").skip(1).filter_map(|t| t.split_once("{*/ crate::mutant::Either::A("));
    marked.filter_map(|(id, _)| id.parse().ok()).collect()
}

/// The mutants of the innermost mark around a span of the compiler's.
fn innermost(at: &Places, span: &Value, mark: &str) -> Option<Vec<usize>> {
    let text = std::fs::read_to_string(at.copy().join(span["file_name"].as_str()?)).ok()?;
    let (from, to) = (span["byte_start"].as_u64()? as usize, span["byte_end"].as_u64()? as usize);
    let end = format!("{mark}}}*/");
    let mut open: Vec<(usize, &str)> = Vec::new();
    let mut best: Option<(usize, &str)> = None;
    for (i, _) in text.match_indices(mark) {
        if text[i..].starts_with(&end) {
            let (start, ids) = open.pop()?;
            if start <= from && to <= i && best.is_none_or(|(b, _)| b < start) {
                best = Some((start, ids));
            }
        } else {
            let rest = &text[i + mark.len()..];
            open.push((i, &rest[..rest.find('{')?]));
        }
    }
    Some(best?.1.split(',').map(|id| id.parse().unwrap()).collect())
}
