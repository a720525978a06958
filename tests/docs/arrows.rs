//! The arrows between files: a stage imports only itself and stages before it, and no files import one another in a circle.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The stages in their order, folders and files below `src`. Stages of one line are level: none of them imports another.
const STAGES: [&[&str]; 47] = [
    &["error"],
    &["provenance", "wording", "number_format", "progress"],
    &["formula"],
    &["mechanism"],
    &["vehicles"],
    &["effects"],
    &["files"],
    &["model"],
    &["motion"],
    &["energy_rule"],
    &["equivalence"],
    &["describe"],
    &["extensions"],
    &["connection"],
    &["dynamics"],
    &["scaffold"],
    &["sweep"],
    &["picture"],
    &["claims"],
    &["discrepancy/report"],
    &["discrepancy/request"],
    &["discrepancy/record"],
    &["discrepancy/initial_state"],
    &["discrepancy/shooting"],
    &["discrepancy/preprocessing"],
    &["discrepancy/estimation"],
    &["discrepancy/evidence"],
    &["discrepancy/localisation"],
    &["discrepancy/selection"],
    &["discrepancy/diagnosis"],
    &["discrepancy/experiment"],
    &["discrepancy/clock_alignment"],
    &["discrepancy/identifiability"],
    &["discrepancy/rendering"],
    &["discrepancy/discovery"],
    &["discrepancy/pipeline"],
    &["discrepancy/check", "discrepancy/discover"],
    &["discrepancy/fleet"],
    &["discrepancy/fixtures"],
    &["discrepancy"],
    &["figures"],
    &["theory"],
    &["report"],
    &["front_door"],
    &["lib"],
    &["command"],
    &["main"],
];

/// The one circle that stays: a fraction holds polynomials of atoms, and an atom may hold a fraction.
const OF_THE_DATA: &str = "formula/normal";

/// Sources by their path below `src`, without the ending.
pub struct Sources {
    files: BTreeMap<String, Source>,
}

struct Source {
    /// The path of the module.
    module: Vec<String>,
    /// Imported paths from the crate's root, those of unit tests left out.
    paths: Vec<Vec<String>>,
    /// Names that the module gives on, with the path each has in truth.
    given_on: BTreeMap<String, Vec<String>>,
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

/// The place of a file's stage in the order, and its place within the line: the longest prefix that is one counts.
fn stage(file: &str) -> Option<(usize, usize)> {
    let places =
        STAGES.iter().enumerate().flat_map(|(i, line)| line.iter().enumerate().map(move |(k, s)| ((i, k), *s)));
    let inside = |s: &str| file == s || file.strip_prefix(s).is_some_and(|rest| rest.starts_with('/'));
    // `discrepancy` itself is its mod.rs alone: what stands below it stands in a stage of its own.
    let own = |s: &str| s != "discrepancy" || file == "discrepancy/mod";
    places.filter(|(_, s)| inside(s) && own(s)).max_by_key(|(_, s)| s.len()).map(|(place, _)| place)
}

fn module_of(file: &str) -> Vec<String> {
    let mut parts: Vec<String> = file.split('/').map(String::from).collect();
    if parts.last().is_some_and(|p| ["mod", "lib"].contains(&p.as_str())) {
        parts.pop();
    }
    parts
}

/// Code without comments, strings and unit tests.
fn bare(text: &str) -> String {
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let lines = code.lines().map(|line| line.split("//").next().unwrap_or_default());
    lines.collect::<Vec<_>>().join("\n")
}

impl Source {
    fn of(file: &str, text: &str, modules: &BTreeSet<Vec<String>>) -> Self {
        let module = module_of(file);
        let mut source = Self { module, paths: vec![], given_on: BTreeMap::new() };
        let mut rest = String::new();
        for part in bare(text).split_inclusive(';') {
            let start = part.rfind("use ").filter(|at| starts_a_statement(&part[..*at]));
            match start {
                Some(at) => {
                    rest.push_str(&part[..at]);
                    let mut leaves = Vec::new();
                    tree(part[at + 4..].trim_end_matches(';').trim(), &[], &mut leaves);
                    leaves.into_iter().for_each(|(path, name)| source.import(&path, name, modules));
                }
                None => rest.push_str(part),
            }
        }
        for path in inline(&rest) {
            source.import(&path, String::new(), modules);
        }
        source
    }

    fn import(&mut self, path: &[String], name: String, modules: &BTreeSet<Vec<String>>) {
        let Some(absolute) = self.absolute(path, modules) else { return };
        if !name.is_empty() && name != "*" {
            self.given_on.insert(name, absolute.clone());
        }
        self.paths.push(absolute);
    }

    /// A path from the crate's root; `None` for one that leads to another crate.
    fn absolute(&self, path: &[String], modules: &BTreeSet<Vec<String>>) -> Option<Vec<String>> {
        let ups = path.iter().take_while(|p| *p == "super").count();
        let rest: Vec<String> =
            path.iter().skip(ups).filter(|p| !["*", "self"].contains(&p.as_str())).cloned().collect();
        match path.first()?.as_str() {
            "crate" => Some(rest[1..].to_vec()),
            "super" => Some([&self.module[..self.module.len().checked_sub(ups)?], &rest[..]].concat()),
            "self" => Some([self.module.clone(), rest].concat()),
            first => {
                let child = [self.module.clone(), vec![first.to_string()]].concat();
                modules.contains(&child).then(|| [self.module.clone(), rest].concat())
            }
        }
    }
}

/// Whether nothing but an item's visibility stands before a `use` on its line.
fn starts_a_statement(before: &str) -> bool {
    let line = before.rsplit('\n').next().unwrap_or_default().trim();
    line.is_empty() || line == "pub" || (line.starts_with("pub(") && line.ends_with(')'))
}

/// The paths of a `use` tree, each with the name it is known by.
fn tree(text: &str, prefix: &[String], leaves: &mut Vec<(Vec<String>, String)>) {
    let text = text.trim();
    if let Some(open) = text.find('{') {
        let head = segments(&text[..open]);
        let prefix = [prefix, &head].concat();
        let inside = &text[open + 1..text.rfind('}').unwrap_or(text.len())];
        let mut depth = 0;
        let parts = inside.split(|c| {
            depth += i32::from(c == '{') - i32::from(c == '}');
            c == ',' && depth == 0
        });
        parts.filter(|p| !p.trim().is_empty()).for_each(|p| tree(p, &prefix, leaves));
        return;
    }
    let (path, name) = text.split_once(" as ").unwrap_or((text, ""));
    let path = [prefix, &segments(path)].concat();
    let last = path.iter().rev().find(|p| *p != "self").cloned().unwrap_or_default();
    leaves.push((path, if name.is_empty() { last } else { name.trim().into() }));
}

fn segments(path: &str) -> Vec<String> {
    path.split("::").map(|p| p.trim().to_string()).filter(|p| !p.is_empty()).collect()
}

/// Paths that stand in code and begin at the crate's root or above the module.
fn inline(code: &str) -> Vec<Vec<String>> {
    let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let words = code.split(|c| !is_path(c));
    let paths = words.filter(|w| ["crate::", "super::", "self::"].iter().any(|root| w.starts_with(root)));
    paths.map(|w| segments(w.trim_end_matches(':'))).collect()
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
