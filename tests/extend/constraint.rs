use creepage::formula::Expr;
use creepage::mechanism::{Constraint, ConstraintType};
use creepage::vehicles::{Coordinate, Definition, Input, Quantity, Vehicle, Wheel};
use std::collections::BTreeMap;

/// A type of its own: what a rope pays out is what a drum turns, less what slips.
pub fn cable() -> ConstraintType {
    ConstraintType::new("cable", 'C', "pays' - (1 - e)*drum*turns'").unwrap()
}

/// A cart that a drum pulls along a rope, its yaw rate logged.
pub fn rope_cart() -> Vehicle {
    let coordinate = |(name, unit, meaning): (&str, &str, &str)| Coordinate {
        name: name.into(),
        unit: unit.into(),
        meaning: meaning.into(),
    };
    let place = [("x", "m", "along x"), ("y", "m", "along y"), ("phi", "rad", "heading"), ("theta", "rad", "drum")];
    let radius = Quantity { unit: "m".into(), meaning: "radius of the drum".into(), optional: false };
    let input = |meaning: &str| Input { unit: "rad/s".into(), meaning: meaning.into(), moves: None, instead: None };
    let rate =
        |formula: &str| Definition { formula: Expr::sym(formula), unit: "rad/s".into(), meaning: formula.into() };
    let slots = [("pays'", "cos(phi)*x' + sin(phi)*y'"), ("drum", "drum_radius"), ("turns'", "theta'")];
    Vehicle {
        id: "rope-cart".into(),
        title: "a cart that a drum pulls along a rope".into(),
        parameters: BTreeMap::from([("drum_radius".into(), radius)]),
        inputs: ["drum_rate", "yaw_rate"].map(|role| (role.to_string(), input(role))).into(),
        define: [("theta'", "drum_rate"), ("phi'", "yaw_rate")].map(|(s, role)| (s.into(), rate(role))).into(),
        coordinates: place.map(coordinate).into(),
        heading: Some("phi".into()),
        wheels: vec![Wheel { name: "axle".into(), traverse_creep: Some("e_tc".into()), ..Wheel::default() }],
        constraints: vec![Constraint::new("rope", &cable(), &slots, "e_rc").unwrap()],
        ..Vehicle::default()
    }
}
