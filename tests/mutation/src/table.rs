//! The counts by group of files, and the mutants that are left.

use crate::Places;
use crate::run::results;
use std::collections::BTreeMap;

/// Prints a table in Markdown and, below it, what is alive.
pub fn print(at: &Places) {
    let known = results(at);
    let mut counts: BTreeMap<String, BTreeMap<&str, usize>> = BTreeMap::new();
    let mut left = String::new();
    for line in at.read("fates.tsv").lines() {
        let cells: Vec<&str> = line.split('\t').collect();
        let id: usize = cells[0].parse().unwrap();
        let outcome = match (cells[1], known.get(&id)) {
            ("Written" | "Cloned", Some(r)) => r.outcome.as_str(),
            ("Written" | "Cloned", None) => "not run",
            ("Unviable", _) => "unviable",
            _ => "not switched",
        };
        if ["alive", "not switched"].contains(&outcome) {
            left += &format!("{outcome}\t{id}\t{}\n", cells[3]);
        }
        let group = group(cells[2]);
        let column = COLUMNS.iter().find(|c| **c == outcome).unwrap();
        for row in [group, "all".to_string()] {
            *counts.entry(row).or_default().entry(column).or_default() += 1;
        }
    }
    println!("| files | listed | {} |\n|---|---|{}", COLUMNS.join(" | "), "---|".repeat(COLUMNS.len()));
    for (group, row) in &counts {
        let cells: Vec<String> = COLUMNS.iter().map(|c| row.get(c).unwrap_or(&0).to_string()).collect();
        println!("| {group} | {} | {} |", row.values().sum::<usize>(), cells.join(" | "));
    }
    println!("\n{left}");
}

const COLUMNS: [&str; 6] = ["unviable", "killed", "timeout", "alive", "not switched", "not run"];

/// The folder, for files of a layer itself their layer.
fn group(file: &str) -> String {
    let folder = file.rsplit_once('/').map_or(file, |f| f.0);
    format!("`{}`", folder.strip_prefix("src/").unwrap_or(folder))
}
