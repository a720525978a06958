//! The public names: those that the documentation of the crate lists, few enough to be read.

use std::path::{Path, PathBuf};

/// Public names at most; with them the documentation is read through in an evening.
const FEWER_THAN: usize = 150;

/// Kinds of items that have a page of their own.
const ITEMS: [&str; 7] = ["fn", "struct", "enum", "trait", "type", "const", "static"];

/// The public names of a module's source and of the modules in it that are not hidden, each with its path.
pub fn names(file: &Path, module: &str) -> Vec<String> {
    let text = std::fs::read_to_string(file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let (own, modules) = of(&text);
    let mut all: Vec<String> = own.iter().map(|name| format!("{module}::{name}")).collect();
    for inner in modules {
        all.extend(names(&source_of(file, &inner), &format!("{module}::{inner}")));
    }
    all
}

/// Where the source of a module in another one stands.
fn source_of(file: &Path, inner: &str) -> PathBuf {
    let is_root = ["mod", "lib"].iter().any(|stem| file.file_stem().is_some_and(|s| s == *stem));
    let dir = if is_root { file.parent().unwrap().to_path_buf() } else { file.with_extension("") };
    let flat = dir.join(format!("{inner}.rs"));
    if flat.exists() { flat } else { dir.join(inner).join("mod.rs") }
}

/// The public names of a source, and its public modules that stand in files of their own; what is hidden left out.
fn of(text: &str) -> (Vec<String>, Vec<String>) {
    let (mut own, mut modules, mut is_hidden) = (vec![], vec![], false);
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if line.starts_with("#[") || line.starts_with("//") {
            is_hidden |= line == "#[doc(hidden)]";
            continue;
        }
        let was_hidden = std::mem::take(&mut is_hidden);
        let Some(item) = line.strip_prefix("pub ") else { continue };
        let mut item = item.to_string();
        while item.starts_with("use ") && !item.ends_with(';') {
            item.push_str(lines.next().unwrap_or(";").trim());
        }
        if was_hidden {
            continue;
        }
        match item.split_once(' ') {
            Some(("use", tree)) => own.extend(given_on(tree)),
            Some(("mod", name)) => modules.extend(name.strip_suffix(';').map(String::from)),
            Some((kind, rest)) if ITEMS.contains(&kind) => {
                own.extend(rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().map(String::from));
            }
            _ => {}
        }
    }
    (own, modules)
}

/// The names that a `use` gives on.
fn given_on(tree: &str) -> Vec<String> {
    let leaves = tree.trim_end_matches([';', '}']).rsplit('{').next().unwrap_or_default();
    let name = |leaf: &str| leaf.rsplit([':', ' ']).next().unwrap_or_default().to_string();
    leaves.split(',').map(str::trim).filter(|leaf| !leaf.is_empty()).map(name).collect()
}

#[test]
fn public_names_are_few() {
    let all = names(&crate::documents::root().join("src/lib.rs"), "creepage");
    for known in ["creepage::discover", "creepage::ErrorKind", "creepage::report::Gap", "creepage::formula::Expr"] {
        assert!(all.iter().any(|name| name == known), "{known} is not among them");
    }
    assert!(all.len() < FEWER_THAN, "{} public names:\n{}", all.len(), all.join("\n"));
}

#[test]
fn what_is_hidden_is_not_counted() {
    let text = "pub mod a;\n#[doc(hidden)]\npub mod b;\nmod c;\npub use c::{\n    One,\n    two as Two,\n};\n\
                #[doc(hidden)]\n/// Documented.\n#[derive(Debug)]\npub struct Three;\n/// Documented.\npub fn four() {\n    \
                pub fn five() {}\n}\npub(crate) fn six() {}\n";
    assert_eq!(of(text), (["One", "Two", "four"].map(String::from).to_vec(), vec!["a".to_string()]));
}
