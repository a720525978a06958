//! What a person has read and accepted, in `snapshots/`; numbers are rounded so that they stand still.

use serde_json::Value;

/// Demands that a text is as it was when somebody accepted it.
pub fn reviewed(name: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, text));
}

/// Every number that is not whole with three digits, one too small to matter as zero.
pub fn rounded(value: &mut Value) {
    match value {
        Value::Number(n) if !n.is_u64() && !n.is_i64() => {
            let x = n.as_f64().unwrap();
            *value = if x.abs() < 1e-12 { Value::from(0.0) } else { format!("{x:.2e}").parse::<f64>().unwrap().into() };
        }
        Value::Array(items) => items.iter_mut().for_each(rounded),
        Value::Object(entries) => entries.values_mut().for_each(rounded),
        _ => {}
    }
}
