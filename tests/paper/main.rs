//! The paper in `paper/`: what is generated is what the program says, and its text names nothing that is not there.
//!
//! `PAPER=write cargo test --release --test paper` writes `paper/generated/` anew.

#[path = "../support/cornering.rs"]
mod cornering;
mod equations;
#[path = "../../examples/trust/interval.rs"]
#[allow(dead_code)] // the benchmark uses the rest
mod interval;
mod ledger;
mod markup;
mod numbers;
#[path = "../support/reviewed.rs"]
mod reviewed;
mod robots;
mod tables;
mod text;
mod trust;

use creepage::figures::{Options, draw};
use creepage::picture::theme::without_halo;
use creepage::progress::unheard;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// How the files are made anew, for messages.
const AGAIN: &str = "PAPER=write cargo test --release --test paper";

/// Figures of the paper.
const FIGURES: [&str; 6] = ["fig7", "creep-map", "ideal-limit", "planning", "parking", "gap"];

fn paper(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("paper").join(path)
}

/// Names and texts of all files in `paper/generated/`, made once.
static GENERATED: LazyLock<BTreeMap<String, String>> = LazyLock::new(|| {
    let names: Vec<String> = FIGURES.iter().map(ToString::to_string).collect();
    let drawn = draw(&names, &Options::default(), &unheard).unwrap();
    let mut files: BTreeMap<String, String> = drawn
        .into_iter()
        .map(|(figure, drawing)| (format!("{}.svg", figure.name), without_halo(&drawing.svg)))
        .collect();
    files.insert("ledger.typ".into(), ledger::file());
    files.insert("equations.typ".into(), equations::file());
    files.insert("numbers.typ".into(), numbers::file());
    files.insert("tables.typ".into(), tables::file());
    files.insert("trust.typ".into(), trust::file());
    files.insert("robots.typ".into(), robots::file());
    files
});

#[test]
fn nothing_generated_for_the_paper_is_stale() {
    let fresh = &*GENERATED;
    if std::env::var("PAPER").is_ok_and(|v| v == "write") {
        std::fs::create_dir_all(paper("generated")).unwrap();
        fresh.iter().for_each(|(name, text)| std::fs::write(paper("generated").join(name), text).unwrap());
    }
    let mut stale = String::new();
    for (name, text) in fresh {
        let stored = std::fs::read_to_string(paper("generated").join(name)).unwrap_or_default();
        stale += &difference(name, &stored, text);
    }
    for entry in std::fs::read_dir(paper("generated")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if !fresh.contains_key(&name) {
            let _ = writeln!(stale, "paper/generated/{name}: nothing makes this file any more");
        }
    }
    assert!(stale.is_empty(), "The paper is stale.\n{stale}Look at the differences, then run: {AGAIN}");
}

/// Lines that are told of a file.
const TOLD: usize = 4;

/// The lines in which two texts differ, with what surrounds the difference; nothing where they are the same.
fn difference(name: &str, stored: &str, fresh: &str) -> String {
    let (old, new) = (lines(stored), lines(fresh));
    let mut out = String::new();
    let mut told = 0;
    for i in 0..old.len().max(new.len()) {
        let (a, b) = (old.get(i).copied().unwrap_or("(no line)"), new.get(i).copied().unwrap_or("(no line)"));
        if a == b {
            continue;
        }
        told += 1;
        if told > TOLD {
            out += "  … and more\n";
            break;
        }
        let _ = writeln!(out, "paper/generated/{name}:{}", i + 1);
        let _ = writeln!(out, "  in the paper:      {}", around(a, b));
        let _ = writeln!(out, "  the program says:  {}", around(b, a));
    }
    out
}

/// Lines; elements of an SVG count as lines.
fn lines(text: &str) -> Vec<&str> {
    text.split_inclusive('>').flat_map(str::lines).filter(|l| !l.is_empty()).collect()
}

/// A line from shortly before the place where it leaves another.
fn around(line: &str, other: &str) -> String {
    let same = line.chars().zip(other.chars()).take_while(|(a, b)| a == b).count();
    let from = same.saturating_sub(60);
    let dots = if from > 0 { "…" } else { "" };
    let shown: String = line.chars().skip(from).take(140).collect();
    format!("{dots}{shown}")
}

#[test]
fn a_difference_is_told_so_that_a_person_understands() {
    let told = difference("numbers.typ", "#let n = (\n  claims: \"89\",\n)\n", "#let n = (\n  claims: \"90\",\n)\n");
    let wanted = "paper/generated/numbers.typ:2\n  in the paper:        claims: \"89\",\n  the program says:    claims: \"90\",\n";
    assert_eq!(told, wanted);
    assert_eq!(difference("a", "same\n", "same\n"), "");
}
