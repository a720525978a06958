//! Effects written into the text of a model file, and nothing else touched.

use super::effect_entry::EffectEntry;
use crate::files::toml::spanned_table::{Section, Source, Value};
use std::ops::Range;
use std::path::Path;

/// A piece of the text to be replaced.
type Edit = (Range<usize>, String);

/// The text with effects added or replaced; see [`ModelFile::patched`](crate::files::ModelFile::patched).
pub(crate) fn patched(text: &str, added: &[EffectEntry]) -> String {
    let source = Source { path: Path::new(""), text };
    // The text of a `ModelFile` has been parsed before; a caller who changed it gets it back as it is.
    let Ok(document) = source.parse() else { return text.to_string() };
    let top = Section::top(source, &document);
    let list = top.get("effects");
    let present = list.as_ref().and_then(|value| value.list("").ok()).unwrap_or_default();
    let (mut edits, mut new) = (Vec::new(), Vec::new());
    for entry in last_of_each(added) {
        match present.iter().find(|value| speaks_of(value, entry)) {
            Some(value) => edits.extend(replace(value, entry)),
            None => new.push(entry),
        }
    }
    match list.filter(|value| is_inline(text, value)) {
        Some(value) => {
            let line = text[..value.key_at].rfind('\n').map_or(0, |at| at + 1);
            let notes = new.iter().filter_map(|entry| note(entry)).map(|note| note + newline(text));
            edits.extend(notes.map(|note| (line..line, note)));
            edits.extend(extend_list(&value, present.last(), &new));
        }
        None => edits.push((text.len()..text.len(), blocks(text, &new))),
    }
    apply(text, edits)
}

/// What the file of a user's own vehicles is called beside a patched model.
pub const VEHICLES_FILE: &str = "model.vehicles.toml";

/// The text with the file of its vehicle named as it lies beside a patched model; see
/// [`ModelFile::patched`](crate::files::ModelFile::patched).
pub(crate) fn with_vehicles(text: &str) -> String {
    let source = Source { path: Path::new(""), text };
    let Ok(document) = source.parse() else { return text.to_string() };
    let top = Section::top(source, &document);
    let edit = match (top.get("vehicles"), top.get("vehicle")) {
        (Some(named), _) => (named.span(), quote(VEHICLES_FILE)),
        (None, Some(vehicle)) => {
            let at = vehicle.key_at;
            (at..at, format!("vehicles = {}{}", quote(VEHICLES_FILE), newline(text)))
        }
        (None, None) => return text.to_string(),
    };
    apply(text, vec![edit])
}

/// Later entries win over earlier ones for the same target.
fn last_of_each(added: &[EffectEntry]) -> impl Iterator<Item = &EffectEntry> {
    added.iter().enumerate().filter(|(i, e)| !added[i + 1..].iter().any(|later| later.same_target(e))).map(|(_, e)| e)
}

fn speaks_of(value: &Value, entry: &EffectEntry) -> bool {
    let Ok(section) = value.section(String::new()) else { return false };
    let id = section.get("id").is_some_and(|id| id.text().is_ok_and(|id| id == entry.id));
    id && section.get("trailer").and_then(|t| t.count().ok()) == entry.trailer
}

/// New values in an entry that is there; a parameter it lacks goes before its id.
fn replace(value: &Value, entry: &EffectEntry) -> Vec<Edit> {
    let Ok(section) = value.section(String::new()) else { return Vec::new() };
    let text = value.source.text;
    let end = if text[value.span()].starts_with('{') { ", " } else { newline(text) };
    let edit = |(name, number): (&String, &f64)| match section.get(name) {
        Some(old) => Some((old.span(), spell(*number))),
        None => {
            let at = section.get("id")?.key_at;
            Some((at..at, format!("{} = {}{end}", key(name), spell(*number))))
        }
    };
    entry.parameters.iter().filter_map(edit).collect()
}

/// The user wrote `effects = [{…}]`, where `[[effects]]` may not follow.
fn is_inline(text: &str, value: &Value) -> bool {
    let list = &text[value.span()];
    list.starts_with('[') && !list.starts_with("[[") && list.ends_with(']') && !list.starts_with("[effects")
}

fn extend_list(list: &Value, last: Option<&Value>, new: &[&EffectEntry]) -> Vec<Edit> {
    let tables = new.iter().map(|entry| format!("{{ {} }}", lines(entry).join(", ")));
    let (at, added) = match last {
        Some(last) => (last.span().end, tables.map(|table| format!(", {table}")).collect()),
        None => (list.span().start + 1, tables.collect::<Vec<_>>().join(", ")),
    };
    vec![(at..at, added)]
}

fn blocks(text: &str, new: &[&EffectEntry]) -> String {
    let end = newline(text);
    let mut added = String::new();
    if !new.is_empty() && !text.is_empty() && !text.ends_with('\n') {
        added.push_str(end);
    }
    for entry in new {
        let note = note(entry).map_or_else(String::new, |note| note + end);
        added.push_str(&format!("{end}{note}[[effects]]{end}{}{end}", lines(entry).join(end)));
    }
    added
}

/// A comment that says where an effect of the user's own is defined.
fn note(entry: &EffectEntry) -> Option<String> {
    let path = entry.defined_in.as_ref()?.display().to_string();
    // A path may hold anything but must not end the comment.
    let path: String = path.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    Some(format!("# \"{}\" is defined in {path}: wherever this model is used, add --effects {path}", entry.id))
}

fn lines(entry: &EffectEntry) -> Vec<String> {
    let mut lines = vec![format!("id = {}", quote(&entry.id))];
    lines.extend(entry.trailer.map(|trailer| format!("trailer = {trailer}")));
    lines.extend(entry.parameters.iter().map(|(name, value)| format!("{} = {}", key(name), spell(*value))));
    lines
}

/// The shortest spelling that reads back as the same number.
fn spell(number: f64) -> String {
    if number.is_nan() { "nan".into() } else { format!("{number:?}") }
}

fn key(name: &str) -> String {
    let bare = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if bare { name.into() } else { quote(name) }
}

fn quote(text: &str) -> String {
    toml::Value::String(text.into()).to_string()
}

fn newline(text: &str) -> &'static str {
    if text.contains("\r\n") { "\r\n" } else { "\n" }
}

fn apply(text: &str, mut edits: Vec<Edit>) -> String {
    edits.sort_by_key(|(span, _)| span.start);
    let mut result = String::with_capacity(text.len());
    let mut done = 0;
    for (span, new) in edits {
        result.push_str(&text[done..span.start]);
        result.push_str(&new);
        done = span.end;
    }
    result.push_str(&text[done..]);
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(id: &str, trailer: Option<usize>, values: &[(&str, f64)]) -> EffectEntry {
        let parameters = values.iter().map(|(name, value)| (name.to_string(), *value)).collect();
        EffectEntry { id: id.into(), trailer, parameters, ..EffectEntry::default() }
    }

    #[test]
    fn a_new_effect_goes_to_the_end() {
        let text = "vehicle = \"car\" # mine\r\n[noise]\r\nposition = 1 # last";
        let new = [entry("wheel-radius", None, &[("scale", 1e-7)])];
        let expect = format!("{text}\r\n\r\n[[effects]]\r\nid = \"wheel-radius\"\r\nscale = 1e-7\r\n");
        assert_eq!(patched(text, &new), expect);
        assert_eq!(patched(text, &[]), text);
    }

    #[test]
    fn values_are_replaced_in_place() {
        let text = "[[effects]]\nscale = 0.5   # guess\nid = \"a\"\n\n[[effects]] # b\nid = 'b'\ntrailer = 2\n";
        let new = [entry("a", None, &[("scale", 0.25)]), entry("b", Some(2), &[("e", -1.0)])];
        let expect =
            "[[effects]]\nscale = 0.25   # guess\nid = \"a\"\n\n[[effects]] # b\ne = -1.0\nid = 'b'\ntrailer = 2\n";
        assert_eq!(patched(text, &new), expect);
        assert!(patched(text, &[entry("b", Some(1), &[])]).ends_with("\n[[effects]]\nid = \"b\"\ntrailer = 1\n"));
    }

    #[test]
    fn a_list_on_one_line_stays_one() {
        let new = [entry("a", None, &[("scale", 0.25)]), entry("c", None, &[("e e", 1.0)])];
        let text = "effects = [ { id = \"a\", scale = 1 }, ] # end\n[noise]\n";
        let expect = "effects = [ { id = \"a\", scale = 0.25 }, { id = \"c\", \"e e\" = 1.0 }, ] # end\n[noise]\n";
        assert_eq!(patched(text, &new), expect);
        assert_eq!(patched("effects = []", &new[1..]), "effects = [{ id = \"c\", \"e e\" = 1.0 }]");
        assert_eq!(patched("effects = [{id = \"a\"}]", &new[..1]), "effects = [{scale = 0.25, id = \"a\"}]");
    }

    #[test]
    fn an_effect_of_the_users_own_says_where_it_is_defined() {
        let file = Some("mine\n.toml".into());
        let own = EffectEntry { defined_in: file, ..entry("a", None, &[("e", 1.0)]) };
        let note = "# \"a\" is defined in mine?.toml: wherever this model is used, add --effects mine?.toml\n";
        assert_eq!(patched("", std::slice::from_ref(&own)), format!("\n{note}[[effects]]\nid = \"a\"\ne = 1.0\n"));
        let list = "x = 1\neffects = []\n";
        assert_eq!(patched(list, &[own]), format!("x = 1\n{note}effects = [{{ id = \"a\", e = 1.0 }}]\n"));
    }

    #[test]
    fn the_file_of_a_vehicle_is_named_beside_the_model() {
        let bare = "# mine\r\nvehicle = \"bus\" # a bus\r\n[noise]\r\n";
        let named = "# mine\r\nvehicles = \"model.vehicles.toml\"\r\nvehicle = \"bus\" # a bus\r\n[noise]\r\n";
        assert_eq!(with_vehicles(bare), named);
        assert_eq!(with_vehicles(named), named);
        let other = named.replace("\"model.vehicles.toml\"", "'../my \"bus\".toml'");
        assert_eq!(with_vehicles(&other), named);
    }

    #[test]
    fn the_last_of_two_wins() {
        let new = [entry("a", None, &[("e", 1.0)]), entry("a", None, &[("e", 2.0)])];
        assert_eq!(patched("", &new), "\n[[effects]]\nid = \"a\"\ne = 2.0\n");
    }
}
