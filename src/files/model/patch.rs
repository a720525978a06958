//! Format-preserving edits of a model file by `toml_edit`: effects are added or updated, comments and order are kept.
//!
//! What is here besides: Windows line ends, and whole numbers of more than 64 bits, neither of which `toml_edit` keeps.

use super::effect_entry::EffectEntry;
use super::measurement::PoseFilter;
use super::scope_entry::{CourseEntry, Motion};
use crate::effects::Scope;
use toml_edit::{Array, ArrayOfTables, Decor, DocumentMut, InlineTable, Item, Key, Table, TableLike, Value};

/// The key of the list of effects.
const EFFECTS: &str = "effects";

/// The text with effects added or replaced; see [`ModelFile::patched`](crate::files::ModelFile::patched).
pub(crate) fn patched(text: &str, added: &[EffectEntry]) -> String {
    // The text of a `ModelFile` has been parsed before; a caller who changed it gets it back as it is.
    let Some(mut document) = parse(text).filter(|_| !added.is_empty()) else { return text.to_string() };
    for entry in last_of_each(added) {
        if !update(&mut document, entry) {
            add(&mut document, entry);
        }
    }
    printed(&document, text)
}

/// The lines that effects are in a model file.
pub(crate) fn lines_of(added: &[EffectEntry]) -> String {
    patched("", added).trim_start().to_string()
}

/// The text with a filter of the measured pose.
pub(crate) fn with_pose_filter(text: &str, filter: PoseFilter) -> String {
    let Some(mut document) = parse(text) else { return text.to_string() };
    let sensor = document.entry("sensor").or_insert_with(|| Item::Table(Table::new()));
    if let Some(table) = sensor.as_table_like_mut() {
        let (name, value) = filter.entry();
        set(table, name, value);
    }
    printed(&document, text)
}

/// What the file of a user's own vehicles is called beside a patched model.
pub const VEHICLES_FILE: &str = "model.vehicles.toml";

/// The text with the file of its vehicle named as it lies beside a patched model; see
/// [`ModelFile::patched`](crate::files::ModelFile::patched).
pub(crate) fn with_vehicles(text: &str) -> String {
    let Some(mut document) = parse(text) else { return text.to_string() };
    if let Some(named) = document.get_mut("vehicles").and_then(Item::as_value_mut) {
        replace(named, VEHICLES_FILE.into());
    } else if document.contains_key("vehicle") {
        insert_before(&mut document, "vehicle", "vehicles", VEHICLES_FILE.into());
    }
    printed(&document, text)
}

/// The document. A whole number of more than 64 bits, which `toml_edit` refuses, becomes one with a decimal point.
fn parse(text: &str) -> Option<DocumentMut> {
    let mut text = text.to_string();
    loop {
        let span = match text.parse::<DocumentMut>() {
            Ok(document) => return Some(document),
            Err(e) => e.span()?,
        };
        let digits = text.get(span.clone()).filter(|written| !written.is_empty())?;
        if !digits.chars().all(|c| c.is_ascii_digit() || matches!(c, '_' | '+' | '-')) {
            return None;
        }
        text.insert_str(span.end, ".0");
    }
}

/// The document as text, with the line ends of the text that it was.
fn printed(document: &DocumentMut, text: &str) -> String {
    let printed = document.to_string();
    match text.contains("\r\n") {
        true => printed.replace("\r\n", "\n").replace('\n', "\r\n"),
        false => printed,
    }
}

/// Later entries win over earlier ones for the same target.
fn last_of_each(added: &[EffectEntry]) -> impl Iterator<Item = &EffectEntry> {
    added.iter().enumerate().filter(|(i, e)| !added[i + 1..].iter().any(|later| later.same_target(e))).map(|(_, e)| e)
}

/// New values in an entry that is there; false where there is none for the target.
fn update(document: &mut DocumentMut, entry: &EffectEntry) -> bool {
    let found: Option<&mut dyn TableLike> = match document.get_mut(EFFECTS) {
        Some(Item::ArrayOfTables(tables)) => {
            tables.iter_mut().find(|table| speaks_of(*table, entry)).map(|table| table as &mut dyn TableLike)
        }
        Some(Item::Value(Value::Array(list))) => {
            let mut tables = list.iter_mut().filter_map(Value::as_inline_table_mut);
            tables.find(|table| speaks_of(*table, entry)).map(|table| table as &mut dyn TableLike)
        }
        _ => None,
    };
    let Some(table) = found else { return false };
    entry.parameters.iter().for_each(|(name, value)| set(table, name, *value));
    for (name, value) in partly(entry) {
        match value {
            Some(value) => _ = table.insert(name, Item::Value(value)),
            None => _ = table.remove(name),
        }
    }
    true
}

fn speaks_of(table: &dyn TableLike, entry: &EffectEntry) -> bool {
    let id = table.get("id").and_then(Item::as_str).is_some_and(|id| id.trim() == entry.id);
    let trailer = table.get("trailer").and_then(Item::as_integer).and_then(|n| usize::try_from(n).ok());
    let input = table.get(key_of_target(entry)).and_then(Item::as_str).map(str::trim);
    id && trailer == entry.trailer && input == entry.input.as_deref()
}

fn set(table: &mut dyn TableLike, name: &str, number: f64) {
    if let Some(old) = table.get_mut(name).and_then(Item::as_value_mut) {
        return replace(old, spelled(number));
    }
    let end = take_blanks(table.iter_mut().last().and_then(|(_, last)| last.as_value_mut()));
    let mut value = spelled(number);
    end.into_iter().for_each(|end| value.decor_mut().set_suffix(end));
    table.insert(name, Item::Value(value));
}

/// A new value with the blanks and the comment of the old one.
fn replace(old: &mut Value, mut new: Value) {
    new.decor_mut().clone_from(old.decor());
    *old = new;
}

/// Adds an entry: to the list where the user wrote `effects = [{…}]`, else under `[[effects]]` at the end of the file.
fn add(document: &mut DocumentMut, entry: &EffectEntry) {
    if let Some(Item::Value(Value::Array(list))) = document.get_mut(EFFECTS) {
        push(list, entry);
        let key = document.key_mut(EFFECTS);
        if let (Some(mut key), Some(note)) = (key, note(entry)) {
            let decor = key.leaf_decor_mut();
            decor.set_prefix(format!("{}{note}", prefix(decor)));
        }
        return;
    }
    let mut before = document.trailing().as_str().unwrap_or_default().to_string();
    if !before.is_empty() && !before.ends_with('\n') {
        before.push('\n');
    }
    document.set_trailing("");
    let mut table = Table::new();
    fields(entry).into_iter().for_each(|(name, value)| _ = table.insert(&name, Item::Value(value)));
    table.decor_mut().set_prefix(format!("{before}\n{}", note(entry).unwrap_or_default()));
    table.set_position(Some(isize::MAX));
    let list = document.entry(EFFECTS).or_insert(Item::ArrayOfTables(ArrayOfTables::new()));
    if let Some(tables) = list.as_array_of_tables_mut() {
        tables.push(table);
    }
}

/// Adds an entry to a list in brackets; one that has a line for each element keeps it so.
fn push(list: &mut Array, entry: &EffectEntry) {
    let table: InlineTable = fields(entry).into_iter().collect();
    let last = list.iter_mut().last();
    let before = last.as_ref().map(|value| prefix(value.decor()).to_string()).filter(|before| before.contains('\n'));
    let end = take_blanks(last);
    list.push(table);
    if let Some(new) = list.iter_mut().last() {
        before.into_iter().for_each(|before| new.decor_mut().set_prefix(before));
        end.into_iter().for_each(|end| new.decor_mut().set_suffix(end));
    }
}

/// Takes the blanks behind a value that is the last no longer.
fn take_blanks(value: Option<&mut Value>) -> Option<String> {
    let decor = value?.decor_mut();
    let blanks = decor.suffix()?.as_str().filter(|end| end.trim().is_empty())?.to_string();
    decor.set_suffix("");
    Some(blanks)
}

fn insert_before(document: &mut DocumentMut, there: &str, name: &str, value: Value) {
    let mut order: Vec<String> = document.iter().map(|(key, _)| key.to_string()).collect();
    let at = order.iter().position(|key| key == there).unwrap_or(order.len());
    order.insert(at, name.to_string());
    let mut key = Key::new(name);
    if let Some(mut next) = document.key_mut(there) {
        let before = prefix(next.leaf_decor_mut()).to_string();
        next.leaf_decor_mut().set_prefix("");
        key.leaf_decor_mut().set_prefix(before);
    }
    document.insert_formatted(&key, Item::Value(value));
    let place = |key: &Key| order.iter().position(|name| name == key.get());
    document.sort_values_by(|a, _, b, _| place(a).cmp(&place(b)));
}

fn prefix(decor: &Decor) -> &str {
    decor.prefix().and_then(|raw| raw.as_str()).unwrap_or_default()
}

/// The key by which an entry names the input or the quantity that it acts on.
fn key_of_target(entry: &EffectEntry) -> &'static str {
    if entry.of_sensor { "measured" } else { "input" }
}

/// What an entry says, by key.
fn fields(entry: &EffectEntry) -> Vec<(String, Value)> {
    let mut fields = vec![("id".to_string(), Value::from(&entry.id))];
    fields.extend(entry.trailer.and_then(|n| i64::try_from(n).ok()).map(|n| ("trailer".to_string(), n.into())));
    fields.extend(entry.input.iter().map(|role| (key_of_target(entry).to_string(), role.into())));
    fields.extend(entry.parameters.iter().map(|(name, value)| (name.clone(), spelled(*value))));
    fields.extend(partly(entry).into_iter().filter_map(|(name, value)| Some((name.to_string(), value?))));
    fields
}

/// The scope and the course of an entry, where it has them.
fn partly(entry: &EffectEntry) -> [(&'static str, Option<Value>); 2] {
    [("scope", entry.scope.as_ref().map(scope)), ("course", entry.course.as_ref().map(course))]
}

fn scope(scope: &Scope) -> Value {
    let numbers = |values: &[f64]| Value::Array(values.iter().map(|v| spelled(*v)).collect());
    let one = |name: &'static str, value: Value| vec![(name, value)];
    let fields = match scope {
        Scope::Times(intervals) => match &intervals[..] {
            [[from, until]] => {
                let ends = [("from", from), ("until", until)].into_iter().filter(|(_, t)| t.is_finite());
                ends.map(|(name, t)| (name, spelled(*t))).collect()
            }
            several => one("intervals", Value::Array(several.iter().map(|ends| numbers(ends)).collect())),
        },
        Scope::Regime(regime) => one("regime", regime.name().into()),
        Scope::Above(speed) => one("above", Value::InlineTable([("speed", spelled(*speed))].into_iter().collect())),
        Scope::Disk(disk) => one("disk", numbers(disk)),
        Scope::Where(formula) => one("where", format!("{formula} > 0").into()),
    };
    Value::InlineTable(fields.into_iter().collect())
}

fn course(course: &CourseEntry) -> Value {
    let (kind, name, number) = match course.motion {
        Motion::Linear { per_s, .. } => ("linear", "per_s", per_s),
        Motion::RandomWalk { per_sqrt_s } => ("random-walk", "per_sqrt_s", per_sqrt_s),
    };
    let of = [("kind", kind.into()), ("parameter", course.parameter.as_str().into()), (name, spelled(number))];
    let mut table: InlineTable = of.into_iter().collect();
    if let Motion::Linear { since, .. } = course.motion
        && since != 0.0
    {
        table.insert("since", spelled(since));
    }
    Value::InlineTable(table)
}

/// A comment line that says where an effect of the user's own is defined.
fn note(entry: &EffectEntry) -> Option<String> {
    let path = entry.defined_in.as_ref()?.display().to_string();
    // A path may hold anything but must not end the comment.
    let path: String = path.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    Some(format!("# \"{}\" is defined in {path}: wherever this model is used, add --effects {path}\n", entry.id))
}

/// The shortest spelling that reads back as the same number; `toml_edit` would write 1e-7 in full.
fn spelled(number: f64) -> Value {
    let text = if number.is_nan() { "nan".into() } else { format!("{number:?}") };
    text.parse().unwrap_or_else(|_| number.into())
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
            "[[effects]]\nscale = 0.25   # guess\nid = \"a\"\n\n[[effects]] # b\nid = 'b'\ntrailer = 2\ne = -1.0\n";
        assert_eq!(patched(text, &new), expect);
        assert!(patched(text, &[entry("b", Some(1), &[])]).ends_with("\n[[effects]]\nid = \"b\"\ntrailer = 1\n"));
    }

    #[test]
    fn a_list_on_one_line_stays_one() {
        let new = [entry("a", None, &[("scale", 0.25)]), entry("c", None, &[("e e", 1.0)])];
        let text = "effects = [ { id = \"a\", scale = 1 }, ] # end\n[noise]\n";
        let expect = "effects = [ { id = \"a\", scale = 0.25 }, { id = \"c\", \"e e\" = 1.0 }, ] # end\n[noise]\n";
        assert_eq!(patched(text, &new), expect);
        assert_eq!(patched("effects = []", &new[1..]), "effects = [{ id = \"c\", \"e e\" = 1.0 }]\n");
        assert_eq!(patched("effects = [{id = \"a\"}]", &new[..1]), "effects = [{id = \"a\", scale = 0.25}]\n");
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

    /// A list with a line for each element gets another line, and blanks stay where they were.
    #[test]
    fn a_list_over_several_lines_stays_one() {
        let new = [entry("b", None, &[("e", 1.0)])];
        let text = "effects = [ # mine\n  { id = \"a\" },\n  { id = \"c\" }, # why\n]\n[noise]\n";
        let expect = text.replace(" }, # why", " },\n  { id = \"b\", e = 1.0 }, # why");
        assert_eq!(patched(text, &new), expect);
        let expect = "effects = [ { id = \"b\", e = 1.0 } ]\n";
        assert_eq!(patched("effects = [ { id = \"b\" } ]", &new), expect);
        let two = "effects = [ { id = \"a\" }, { id = \"b\", e = 1.0 } ]\n";
        assert_eq!(patched("effects = [ { id = \"a\" } ]", &new), two);
    }

    /// What stands between and behind the tables stays, and new effects go behind it.
    #[test]
    fn comments_and_order_are_kept() {
        let text = "# top\na.b = 1 # one\n\n[b]  # two\nx = 0x10\n[a.c]\n# three\ny = +1_0\n\n# end";
        let new = [entry("a", None, &[("e", 1.0)]), entry("b", Some(1), &[])];
        let added = "\n\n[[effects]]\nid = \"a\"\ne = 1.0\n\n[[effects]]\nid = \"b\"\ntrailer = 1\n";
        assert_eq!(patched(text, &new), format!("{text}{added}"));
    }

    /// A model file may hold a whole number that is too long for a machine word; it stays the same number.
    #[test]
    fn a_long_number_is_no_hindrance() {
        let text = "x = -12_345678901234567890 # long\n[b]\ny = 99999999999999999999\n";
        let found = patched(text, &[entry("a", None, &[])]);
        let expect =
            "x = -12_345678901234567890.0 # long\n[b]\ny = 99999999999999999999.0\n\n[[effects]]\nid = \"a\"\n";
        assert_eq!(found, expect);
        assert_eq!(patched("a = ", &[entry("a", None, &[])]), "a = ", "no TOML at all");
    }
}
