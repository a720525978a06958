//! Numbers of a JSON value, rounded so that they stand still.

use serde_json::Value;

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
