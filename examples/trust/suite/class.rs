//! The same physics under another name, as the contract lists it.

use super::make::Target;

/// The name that stands for all effects of the same physics.
pub fn of(id: &str) -> &str {
    match id {
        "wheel-radius" => "rotation-creep",
        "heading-misalignment" => "traverse-creep",
        "wheel-radius-mismatch" => "unequal-rotation-creep",
        "front-traverse-creep" => "steering-offset",
        other => other,
    }
}

/// Whether two targets are the same physics.
pub fn same(a: Target, b: Target) -> bool {
    of(a.0) == of(b.0) && a.1 == b.1
}

/// Whether `wide` can do all that `narrow` does, with more parameters: then the data decide by parsimony.
pub fn contains(wide: &str, narrow: &str) -> bool {
    match wide {
        "unequal-rotation-creep" => matches!(of(narrow), "rotation-creep" | "unequal-rotation-creep"),
        "relaxation-length" => of(narrow) == "traverse-creep",
        _ => false,
    }
}

/// A parameter of a class by the class' own parameter: its name, the value and the factor on a deviation.
///
/// A turned heading and a constant traverse creep differ at second order; across the vehicle the speed is
/// −v·sin(offset).
pub fn converted(id: &str, name: &str, value: f64) -> (&'static str, f64, f64) {
    match (id, name) {
        ("wheel-radius", "scale") => ("e_rc", -value, 1.0),
        ("heading-misalignment", "offset") => ("e_tc", -value.sin(), value.cos()),
        ("wheel-radius-mismatch", "scale") => ("e_left", -value, 1.0),
        ("front-traverse-creep", "e_tc") => ("offset", value.atan(), 1.0 / (1.0 + value * value)),
        _ => (plain(name), value, 1.0),
    }
}

/// The parameters of the contract by their lasting names.
fn plain(name: &str) -> &'static str {
    const NAMES: [&str; 20] = [
        "k",
        "limit",
        "e_rc",
        "e_tc",
        "e_left",
        "e_right",
        "mass_over_bR",
        "mass_over_bT",
        "c",
        "length",
        "bias",
        "scale",
        "offset",
        "gradient",
        "delay",
        "a",
        "b",
        "vx",
        "vy",
        "rate",
    ];
    NAMES.into_iter().find(|n| *n == name).unwrap_or("direction")
}
