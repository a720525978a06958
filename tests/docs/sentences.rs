//! Numbers from statistics, sentences from rendering: no stage of the discrepancy workflow, and none of a fleet, writes English.

use std::path::Path;

/// Words of a literal that make it a sentence.
const WORDS: usize = 4;

/// Code without comments and unit tests.
pub fn bare(text: &str) -> String {
    // A file of tests alone has no other code.
    let text = if text.contains("#![cfg(test)]") { "" } else { text };
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    lines.collect::<Vec<_>>().join("\n")
}

/// The string literals of a statement that are sentences. Messages of errors are no part of an answer.
fn sentences(statement: &str) -> Vec<String> {
    if ["Error::", "let message", ".expect("].iter().any(|word| statement.contains(word)) {
        return vec![];
    }
    let literals = statement.split('"').skip(1).step_by(2);
    let is_word = |w: &&str| w.chars().filter(|c| c.is_alphabetic()).count() > 1;
    literals.filter(|l| l.split_whitespace().filter(is_word).count() >= WORDS).map(String::from).collect()
}

pub fn files(folder: &Path, found: &mut Vec<std::path::PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true if path.ends_with("rendering") => {}
            true => files(&path, found),
            false => found.push(path),
        }
    }
}

#[test]
fn statistics_return_numbers() {
    let mut all = vec![];
    for folder in ["src/discrepancy", "src/fleet"] {
        files(&Path::new(env!("CARGO_MANIFEST_DIR")).join(folder), &mut all);
    }
    all.sort();
    assert!(all.len() > 60, "{}", all.len());
    let mut found = vec![];
    for path in all {
        let code = bare(&std::fs::read_to_string(&path).unwrap());
        found.extend(code.split(';').flat_map(sentences).map(|s| format!("{}: {s}", path.display())));
    }
    assert!(found.is_empty(), "sentences belong to rendering/:\n{}", found.join("\n"));
}

#[test]
fn a_sentence_is_told_from_a_label_and_from_a_message() {
    let count = |statement: &str| sentences(statement).len();
    assert_eq!(count(r#"let says = "the runs are too short to tell""#), 1);
    assert_eq!(count(r#"let places = ["rotation constraint", "traverse constraint"]"#), 0);
    assert_eq!(count(r#"return Err(Error::input("no run was given at all"))"#), 0);
}
