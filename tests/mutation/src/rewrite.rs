//! A source file with all its mutants written in, each behind a switch.

use crate::listed::{Mutant, Place};
use crate::places::{Key, Switch, find};
use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

/// What became of a mutant before anything was compiled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fate {
    /// Written into the copy.
    Written,
    /// Written with a clone: a sign before a reference.
    Cloned,
    /// Cannot compile.
    Unviable,
    /// Cannot be switched at run time.
    Inexpressible,
}

impl Fate {
    /// Whether it is in the copy.
    pub fn is_written(self) -> bool {
        matches!(self, Self::Written | Self::Cloned)
    }
}

/// Text put around a range of the file.
struct Around {
    range: Range<usize>,
    /// Of two with the same range the lower is outside.
    depth: usize,
    open: String,
    close: String,
}

/// The module with the switch itself.
pub const SWITCH: &str = include_str!("switch.in");

/// The file with the mutants of these numbers written in.
///
/// The `cloned` ones are signs before a reference: without the sign it is cloned, so that both branches have one type.
pub fn rewrite(
    text: &str,
    mutants: &[(usize, &Mutant)],
    cloned: &dyn Fn(usize) -> bool,
) -> (String, Vec<(usize, Fate)>) {
    let found = find(text);
    let bytes = Bytes::new(text);
    let mut places: BTreeMap<(&str, Place), Vec<(usize, &Mutant)>> = BTreeMap::new();
    for (id, m) in mutants {
        places.entry((&m.genre, m.start)).or_default().push((*id, m));
    }
    let mut arounds = Vec::new();
    let mut fates = Vec::new();
    for ((genre, start), group) in places {
        // `Once<&mut T>` is no iterator over `&T`.
        let (unviable, group): (Vec<_>, Vec<_>) =
            group.into_iter().partition(|(_, m)| m.replacement.starts_with("::std::iter::once(Box::leak("));
        fates.extend(unviable.iter().map(|(id, _)| (*id, Fate::Unviable)));
        if group.is_empty() {
            continue;
        }
        let fate = match lookup(&found, genre, start) {
            Some(Switch::Expression(range)) => {
                arounds.push(expression(text, &bytes, range, &group, cloned));
                Fate::Written
            }
            Some(Switch::Arm(end, guard)) => {
                arounds.push(arm(*end, guard.as_ref(), group[0].0));
                Fate::Written
            }
            Some(Switch::Body(inside, iterates)) => {
                arounds.push(if *iterates { iterator(inside, &group) } else { body(inside, &group) });
                Fate::Written
            }
            Some(Switch::LetChain) => Fate::Unviable,
            Some(Switch::Constant) | None => Fate::Inexpressible,
        };
        fates.extend(group.iter().map(|(id, _)| (*id, fate)));
    }
    (assemble(text, arounds), fates)
}

fn lookup<'a>(found: &'a HashMap<Key, Switch>, genre: &str, start: (usize, usize)) -> Option<&'a Switch> {
    let genres = ["BinaryOperator", "UnaryOperator", "MatchArm", "MatchArmGuard", "StructField", "FnValue"];
    let genre = genres.into_iter().find(|g| *g == genre)?;
    found.get(&(genre, start.0, start.1))
}

/// `(if off(first, last) { as written } else if on(first) { a mutant } else { another })`
fn expression(
    text: &str,
    bytes: &Bytes,
    range: &Range<usize>,
    group: &[(usize, &Mutant)],
    cloned: &dyn Fn(usize) -> bool,
) -> Around {
    let (first, last) = (group[0].0, group[group.len() - 1].0);
    let ids: Vec<String> = group.iter().map(|g| g.0.to_string()).collect();
    let open = format!("/*W{}{{*/(if crate::mutant::off({first}, {last}) {{ ", ids.join(","));
    let mut close = String::from(" }");
    for (k, (id, m)) in group.iter().enumerate() {
        let condition = if k + 1 == group.len() { String::new() } else { format!("if crate::mutant::on({id}) ") };
        let mut changed = spliced(text, bytes, range, m);
        if cloned(*id) {
            changed = format!("::std::clone::Clone::clone({changed})");
        }
        close += &format!("\nelse {condition}{{\n/*M{id}{{*/ {changed}\n/*M}}*/ }}");
    }
    close += ")/*W}*/";
    // A deleted field has the whole literal around it, as may an operator: the order among them is free.
    Around { range: range.clone(), depth: 1, open, close }
}

/// The text of the range with the mutant in it.
fn spliced(text: &str, bytes: &Bytes, range: &Range<usize>, m: &Mutant) -> String {
    let (from, mut to) = (bytes.of(m.start), bytes.of(m.end));
    if m.genre == "StructField" {
        let rest = &text[to..range.end];
        let blank = rest.len() - rest.trim_start().len();
        to += if rest.trim_start().starts_with(',') { blank + 1 } else { 0 };
    }
    // A replaced sign must not stick to the next one.
    format!("{}{} {}", &text[range.start..from], m.replacement, &text[to..range.end])
}

/// A deleted arm never matches.
fn arm(end: usize, guard: Option<&Range<usize>>, id: usize) -> Around {
    let open = format!("/*W{id}{{*/ crate::mutant::off({id}, {id}) /*W}}*/");
    match guard {
        Some(g) => Around { range: g.clone(), depth: 0, open: format!("{open} && ("), close: ")".into() },
        None => Around { range: end..end, depth: 0, open: format!(" if {open}"), close: String::new() },
    }
}

fn body(inside: &Range<usize>, group: &[(usize, &Mutant)]) -> Around {
    let returned = |(id, m): &(usize, &Mutant)| {
        format!("\nif crate::mutant::on({id}) {{\n/*M{id}{{*/ return {};\n/*M}}*/ }}", m.replacement)
    };
    let open = group.iter().map(returned).collect::<String>() + "\n";
    Around { range: inside.clone(), depth: 0, open, close: String::new() }
}

/// `impl Iterator` is one type: the mutants and the body are alternatives of an enum.
fn iterator(inside: &Range<usize>, group: &[(usize, &Mutant)]) -> Around {
    let mut open = String::new();
    let mut wraps = String::new();
    let mut ends = String::new();
    for (id, m) in group {
        let value = format!("{wraps}crate::mutant::Either::A({}){ends}", m.replacement);
        open += &format!("\nif crate::mutant::on({id}) {{\n/*M{id}{{*/ {value}\n/*M}}*/ }} else ");
        wraps += "crate::mutant::Either::B(";
        ends += ")";
    }
    Around { range: inside.clone(), depth: 0, open: format!("{open}{{ {wraps}{{\n"), close: format!("\n}}{ends} }}") }
}

fn assemble(text: &str, arounds: Vec<Around>) -> String {
    // At one place what ends comes before what begins; the wider range is outside, then the lower depth.
    let mut pieces: Vec<((usize, u8, isize, isize), String)> = Vec::new();
    for (k, a) in arounds.into_iter().enumerate() {
        let (length, inner) = ((a.range.end - a.range.start) as isize, (a.depth * 100_000 + k) as isize);
        if length == 0 {
            pieces.push(((a.range.start, 1, 0, 0), a.open));
            continue;
        }
        pieces.push(((a.range.start, 2, -length, inner), a.open));
        pieces.push(((a.range.end, 0, length, -inner), a.close));
    }
    pieces.sort_by_key(|a| a.0);
    let mut out = String::new();
    let mut done = 0;
    for ((at, ..), piece) in pieces {
        out += &text[done..at];
        out += &piece;
        done = at;
    }
    out + &text[done..]
}

/// Byte offsets of lines and columns.
struct Bytes<'a> {
    text: &'a str,
    lines: Vec<usize>,
}

impl<'a> Bytes<'a> {
    fn new(text: &'a str) -> Self {
        let lines = std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        Self { text, lines }
    }

    fn of(&self, (line, column): (usize, usize)) -> usize {
        let start = self.lines[line - 1];
        let characters = self.text[start..].char_indices().nth(column - 1);
        start + characters.map_or(self.text.len() - start, |(i, _)| i)
    }
}
