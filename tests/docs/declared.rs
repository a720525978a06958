//! Declared, not assumed: what an input or an effect is stands in a catalogue, and no stage of the statistics knows one by
//! its name.

use super::sentences::{bare, files};
use creepage::{effects, vehicles};
use std::collections::BTreeSet;
use std::path::Path;

/// Roles of inputs and ids of effects.
fn names() -> BTreeSet<String> {
    let inputs = vehicles::all().iter().flat_map(|v| &v.inputs);
    let roles =
        inputs.flat_map(|(role, input)| [role.clone()].into_iter().chain(input.instead.iter().map(|i| i.role.clone())));
    roles.chain(effects::all().iter().map(|e| e.id.clone())).collect()
}

/// The names that stand as literals in some code.
fn known(code: &str, names: &BTreeSet<String>) -> Vec<String> {
    code.split('"').skip(1).step_by(2).filter(|literal| names.contains(*literal)).map(String::from).collect()
}

#[test]
fn statistics_know_no_input_and_no_effect_by_its_name() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut all = vec![root.join("src/model/terms.rs")];
    files(&root.join("src/discrepancy"), &mut all);
    all.retain(|path| !path.ends_with("fixtures.rs"));
    let names = names();
    let mut found = vec![];
    for path in all {
        let code = bare(&std::fs::read_to_string(&path).unwrap());
        found.extend(known(&code, &names).into_iter().map(|name| format!("{}: {name}", path.display())));
    }
    assert!(found.is_empty(), "these are declared by a catalogue, ask it:\n{}", found.join("\n"));
}

#[test]
fn a_name_is_told_from_another_word() {
    let names = names();
    assert!(names.len() > 30 && names.contains("speed"));
    let code = r#"if role == "yaw_rate" || id == "track-width" { unit("rad") } else { "yaw-rate" }"#;
    assert_eq!(known(code, &names), ["yaw_rate", "track-width"]);
}
