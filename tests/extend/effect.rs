use creepage::effects::{Effect, Parameter};
use creepage::formula::Expr;
use std::collections::BTreeMap;

/// The vehicle slides outwards by the square of its yaw rate: v_t loses q·φ̇·|φ̇|, q in m·s.
pub fn yaw_slip() -> Effect {
    let q = Parameter {
        unit: "m*s".into(),
        range: [-10.0, 10.0],
        size: 0.03,
        start: vec![0.0],
        positive: false,
        periodic: false,
    };
    Effect {
        id: "yaw-slip".into(),
        place: "traverse constraint".into(),
        says: "the vehicle slides outwards by the square of its yaw rate".into(),
        source: "a scrubbing castor".into(),
        parameters: BTreeMap::from([("q".into(), q)]),
        changes: BTreeMap::from([("v_t".into(), Expr::parse("it - q*phi'*abs(phi')").unwrap())]),
        ..Effect::default()
    }
}
