//! A source file as the paths it imports: its `use` trees, and paths that stand in its code.

use std::collections::{BTreeMap, BTreeSet};

/// A file, its unit tests left out.
pub struct Source {
    /// The path of the module.
    pub module: Vec<String>,
    /// Imported paths from the crate's root, those of unit tests left out.
    pub paths: Vec<Vec<String>>,
    /// Names that the module gives on, with the path each has in truth.
    pub given_on: BTreeMap<String, Vec<String>>,
}

pub fn module_of(file: &str) -> Vec<String> {
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
    pub fn of(file: &str, text: &str, modules: &BTreeSet<Vec<String>>) -> Self {
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

/// Paths that stand in code without a `use`.
fn inline(code: &str) -> Vec<Vec<String>> {
    let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let paths = code.split(|c| !is_path(c)).map(|w| w.trim_end_matches(':')).filter(|w| w.contains("::"));
    paths.map(segments).filter(|p| !p.is_empty()).collect()
}
