//! The arrows between files: a stage imports only itself and stages before it, and no files import one another in a circle.

mod source;
mod stages;

use source::{Source, module_of};
use stages::stage;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The one circle that stays: a fraction holds polynomials of atoms, and an atom may hold a fraction.
const OF_THE_DATA: &str = "formula/normal";

/// Sources by their path below `src`, without the ending.
pub struct Sources {
    files: BTreeMap<String, Source>,
}

impl Sources {
    /// All of `src`.
    pub fn read(src: &Path) -> Self {
        let mut texts = BTreeMap::new();
        collect(src, src, &mut texts);
        Self::of(&texts)
    }

    /// Sources at hand as text.
    pub fn of(texts: &BTreeMap<String, String>) -> Self {
        let modules: BTreeSet<Vec<String>> = texts.keys().map(|f| module_of(f)).collect();
        let files = texts.iter().map(|(file, text)| (file.clone(), Source::of(file, text, &modules)));
        Self { files: files.collect() }
    }

    /// Every file with the files it imports.
    fn arrows(&self) -> BTreeMap<&str, BTreeSet<&str>> {
        let by_module: BTreeMap<&[String], &str> =
            self.files.iter().map(|(file, s)| (s.module.as_slice(), file.as_str())).collect();
        let of = |(file, source): (&'_ String, &Source)| -> BTreeSet<&str> {
            let targets = source.paths.iter().filter_map(|p| self.definer(p, &by_module, 0));
            targets.filter(|t| *t != file.as_str() && *t != "lib").collect()
        };
        self.files.iter().map(|(file, source)| (file.as_str(), of((file, source)))).collect()
    }

    /// The file that defines what a path names, re-exports followed.
    fn definer<'s>(&'s self, path: &[String], by: &BTreeMap<&[String], &'s str>, depth: usize) -> Option<&'s str> {
        let length = (0..=path.len()).rev().find(|n| by.contains_key(&path[..*n]))?;
        let file = by[&path[..length]];
        let (name, rest) = match path[length..].split_first() {
            Some((name, rest)) if depth < 20 => (name, rest),
            _ => return Some(file),
        };
        match self.files[file].given_on.get(name) {
            Some(truth) => self.definer(&[truth.as_slice(), rest].concat(), by, depth + 1),
            None => Some(file),
        }
    }

    /// Files that are in no stage.
    pub fn homeless(&self) -> Vec<String> {
        let homeless = self.files.keys().filter(|f| stage(f).is_none());
        homeless.map(|f| format!("src/{f}.rs stands in no stage")).collect()
    }

    /// Imports of a stage that comes later, or stands beside.
    pub fn upward(&self) -> Vec<String> {
        let mut faults = Vec::new();
        for (file, targets) in self.arrows() {
            for target in targets {
                if let (Some(own), Some(other)) = (stage(file), stage(target))
                    && other.0 >= own.0
                    && other != own
                {
                    faults.push(format!("src/{file}.rs imports src/{target}.rs, of a later stage"));
                }
            }
        }
        faults
    }

    /// Files that import one another in a circle.
    pub fn circles(&self) -> Vec<String> {
        let arrows = self.arrows();
        let reached: BTreeMap<&str, BTreeSet<&str>> = arrows.keys().map(|f| (*f, reached(f, &arrows))).collect();
        let circle = |f: &&str| -> Vec<&str> {
            reached[*f].iter().filter(|o| reached.get(*o).is_some_and(|r| r.contains(*f))).copied().collect()
        };
        let all: BTreeSet<Vec<&str>> = arrows.keys().map(circle).filter(|c| c.len() > 1).collect();
        let other = all.into_iter().filter(|c| !c.iter().all(|f| f.starts_with(OF_THE_DATA)));
        other.map(|c| format!("in a circle: {}", c.join(", "))).collect()
    }
}

fn collect(dir: &Path, src: &Path, texts: &mut BTreeMap<String, String>) {
    for entry in std::fs::read_dir(dir).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, src, texts);
        } else if path.extension().is_some_and(|e| e == "rs") {
            let name = path.strip_prefix(src).unwrap().with_extension("");
            texts.insert(name.to_string_lossy().replace('\\', "/"), std::fs::read_to_string(&path).unwrap());
        }
    }
}

fn reached<'f>(from: &'f str, arrows: &BTreeMap<&'f str, BTreeSet<&'f str>>) -> BTreeSet<&'f str> {
    let mut found = BTreeSet::new();
    let mut open: Vec<&str> = arrows[from].iter().copied().collect();
    while let Some(next) = open.pop() {
        if found.insert(next) {
            open.extend(arrows.get(next).into_iter().flatten());
        }
    }
    found
}

/// Sources by name and text, for trying the check out.
fn sources(texts: &[(&str, &str)]) -> Sources {
    Sources::of(&texts.iter().map(|(name, text)| (name.to_string(), text.to_string())).collect())
}

#[test]
fn an_upward_import_is_told() {
    let text = "use crate::discrepancy::rendering::summary::listed;\n";
    let summary = ("discrepancy/rendering/summary", "pub fn listed() {}\n");
    let told = |file: &str| sources(&[(file, text), summary]).upward();
    let fault = "src/discrepancy/selection/search.rs imports src/discrepancy/rendering/summary.rs, of a later stage";
    assert_eq!(told("discrepancy/selection/search"), [fault]);
    assert_eq!(told("discrepancy/pipeline"), [""; 0]);
    // Through a re-export, in a tree, and without a `use`.
    let re_export = ("discrepancy/rendering/mod", "mod summary;\npub use summary::listed;\n");
    for text in ["use crate::discrepancy::{rendering::{listed}};", "fn f() { super::super::rendering::listed() }"] {
        let all = sources(&[("discrepancy/selection/search", text), summary, re_export]);
        assert_eq!(all.upward(), [fault]);
    }
    // In a unit test it is no arrow.
    let test = format!("#[cfg(test)]\nmod tests {{\n    {text}}}\n");
    assert_eq!(sources(&[("discrepancy/selection/search", &test), summary]).upward(), [""; 0]);
}

#[test]
fn a_circle_is_told_and_that_of_the_normal_form_is_not() {
    let two = |a: &str, b: &str| {
        let module = |f: &str| f.replace('/', "::");
        let texts = [(a, format!("use crate::{}::X;", module(b))), (b, format!("use crate::{}::Y;", module(a)))];
        sources(&texts.each_ref().map(|(f, t)| (*f, t.as_str()))).circles()
    };
    assert_eq!(two("files/log/run", "files/log/rows"), ["in a circle: files/log/rows, files/log/run"]);
    assert_eq!(two("formula/normal/atom", "formula/normal/fraction"), [""; 0]);
}

#[test]
fn a_file_in_no_stage_is_told() {
    let told = sources(&[("gadgets/one", ""), ("discrepancy/walk", ""), ("discrepancy/record/record", "")]).homeless();
    assert_eq!(told, ["src/discrepancy/walk.rs stands in no stage", "src/gadgets/one.rs stands in no stage"]);
}

/// A file that says `mod part;` and calls `part::run()` imports it, so that the part may import none of the file's items.
#[test]
fn a_circle_of_parent_and_child_is_told() {
    let told = |parent: &str, child: &str| {
        sources(&[("command/mod", parent), ("command/check", child), ("command/print", "pub fn print() {}")]).circles()
    };
    let parent = "mod check;\nmod print;\nfn run() { check::run(1) }\npub fn helper() {}\n";
    assert_eq!(told(parent, "use super::helper;\n"), ["in a circle: command/check, command/mod"]);
    assert_eq!(told(parent, "use super::print::print;\n"), [""; 0]);
    // What the parent itself has by `use` is defined elsewhere.
    let given_on = format!("{parent}use print::print;\n");
    assert_eq!(told(&given_on, "use super::print;\n"), [""; 0]);
    // A parent that does nothing with its child but declare it is no circle.
    assert_eq!(told("mod check;\npub fn helper() {}\n", "use super::helper;\n"), [""; 0]);
}
