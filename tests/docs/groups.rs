//! Files of tests stand in folders, each one program: what its `main.rs` does not name is never run.

use super::documents::root;
use std::path::{Path, PathBuf};

/// Files of tests that no program has.
pub fn left_out() -> Vec<String> {
    let folders = listed(&root().join("tests")).into_iter().filter(|f| f.join("main.rs").is_file());
    folders.flat_map(|folder| left_out_of(&folder)).collect()
}

fn left_out_of(folder: &Path) -> Vec<String> {
    let files: Vec<PathBuf> = listed(folder).into_iter().filter(|f| f.extension().is_some_and(|e| e == "rs")).collect();
    assert!(files.len() > 1, "{} has no file of tests", folder.display());
    let text: String = files.iter().map(|f| std::fs::read_to_string(f).unwrap()).collect();
    let runs = |file: &PathBuf| {
        let name = file.file_stem().unwrap().to_str().unwrap();
        name == "main" || text.lines().any(|line| line == format!("mod {name};"))
    };
    files.iter().filter(|f| !runs(f)).map(|f| format!("no program runs {}", f.display())).collect()
}

fn listed(folder: &Path) -> Vec<PathBuf> {
    std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()).collect()
}
