//! Vehicles of the table of growth vectors, written as descriptions, and points at which they are looked at.

use creepage::formula::{Exact, Symbol};
use creepage::mechanism::{Mechanism, Point};
use creepage::model::mechanism;
use creepage::vehicles::Vehicle;

/// A description: wheels, what is measured, and formulas of angles.
pub fn vehicle(text: &str) -> Vehicle {
    let head = "id = \"test\"\ntitle = \"test\"\n";
    toml::from_str(&format!("{head}{text}")).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// `[define]` and `[inputs]` for rates and angles that are measured, by name.
pub fn measured(names: &[&str]) -> String {
    let input = |n: &&str| format!("[inputs.{0}_in]\nunit = \"1\"\nmeaning = \"\"\n", n.trim_end_matches('\''));
    let formula = |n: &&str| format!("formula = \"{}_in\"\nunit = \"1\"\nmeaning = \"\"\n", n.trim_end_matches('\''));
    let define = |n: &&str| format!("[define.\"{n}\"]\n{}", formula(n));
    names.iter().map(input).chain(names.iter().map(define)).collect()
}

pub const SINGLE_WHEEL: &str = r#"
[[wheels]]
name = "wheel"
radius = "r"
rate = "theta'"
rotation_creep = "e_rc"
traverse_creep = "e_tc"
"#;

/// A direction without a wheel angle: what trailers are usually hung on.
pub const AXLE: &str = r#"
[[wheels]]
name = "axle"
traverse_creep = "e_tc"
"#;

pub const TWO_WHEEL: &str = r#"
[[wheels]]
name = "right"
left = "-a/2"
radius = "r"
rate = "theta_1'"
rotation_creep = "e_rc_1"
[[wheels]]
name = "left"
left = "a/2"
radius = "r"
rate = "theta_2'"
rotation_creep = "e_rc_2"
[[wheels]]
name = "axle"
traverse_creep = "e_tc"
"#;

pub const CASTOR: &str = r#"
[[wheels]]
name = "castor"
forward = "l"
steering = "psi"
trail = "c"
radius = "r_c"
rate = "theta_3'"
rotation_creep = "e_rc_3"
traverse_creep = "e_c"
"#;

pub const FRONT_STEERED: &str = r#"
[[wheels]]
name = "front"
forward = "L"
steering = "delta"
radius = "r"
rate = "theta'"
rotation_creep = "e_rc"
traverse_creep = "e_f"
"#;

/// Rear wheels that only roll along, with the direction of their axle.
pub const REAR_WHEELS: &str = r#"
[[wheels]]
name = "rear right"
left = "-a/2"
radius = "R"
rate = "theta_1'"
rotation_creep = "e_rc_1"
[[wheels]]
name = "rear left"
left = "a/2"
radius = "R"
rate = "theta_2'"
rotation_creep = "e_rc_2"
[[wheels]]
name = "rear axle"
traverse_creep = "e_r"
"#;

pub const ACKERMANN_FRONT: &str = r#"
[[wheels]]
name = "front right"
forward = "L"
left = "-a/2"
steering = "delta_r"
radius = "r"
rate = "theta_3'"
rotation_creep = "e_rc_3"
traverse_creep = "e_fr"
[[wheels]]
name = "front left"
forward = "L"
left = "a/2"
steering = "delta_l"
radius = "r"
rate = "theta_4'"
rotation_creep = "e_rc_4"
traverse_creep = "e_fl"
[define.L]
formula = "wheelbase"
unit = "m"
meaning = ""
[define.a]
formula = "track_width"
unit = "m"
meaning = ""
[define.delta_r]
formula = "atan(L*tan(delta)/(L + a/2*tan(delta)))"
unit = "rad"
meaning = ""
[define.delta_l]
formula = "atan(L*tan(delta)/(L - a/2*tan(delta)))"
unit = "rad"
meaning = ""
"#;

/// The front axle of a car without wheels that turn.
pub const FRONT_AXLE: &str = r#"
[[wheels]]
name = "front axle"
forward = "L"
steering = "delta"
traverse_creep = "e_f"
"#;

/// Wheels in given places, all steered by `steering` (nothing for fixed ones).
pub fn wheels_at(places: &[(&str, &str)], steering: Option<&str>) -> String {
    let steering = steering.map_or(String::new(), |s| format!("steering = \"{s}\"\n"));
    let wheel = |(i, (forward, left)): (usize, &(&str, &str))| {
        let k = i + 1;
        format!(
            "[[wheels]]\nname = \"wheel {k}\"\nforward = \"{forward}\"\nleft = \"{left}\"\n{steering}radius = \"r\"\n\
             rate = \"theta_{k}'\"\nrotation_creep = \"e_rc_{k}\"\ntraverse_creep = \"e_tc_w{k}\"\n"
        )
    };
    places.iter().enumerate().map(wheel).collect()
}

pub const SKID_PLACES: [(&str, &str); 4] = [("L", "-a/2"), ("L", "a/2"), ("-L", "-a/2"), ("-L", "a/2")];

/// A direction with whole components, (3, 4) for an angle of sine 4/5.
pub fn toward(x: i64, y: i64) -> Exact {
    Exact::direction(x.into(), y.into())
}

/// Lengths for every parameter of these tests.
pub fn lengths() -> Point {
    let values = [("r", 1, 2), ("R", 2, 3), ("r_c", 1, 5), ("a", 3, 2), ("L", 2, 1), ("l", 1, 1), ("c", 1, 4)];
    values.iter().fold(Point::default(), |p, (name, a, b)| p.with(*name, Exact::ratio(*a, *b)))
}

/// A general configuration; steering and castor angles included.
pub fn general() -> Point {
    lengths().with("phi", toward(4, 3)).with("psi", toward(12, 5)).with("delta", toward(12, 5))
}

/// A configuration of an Ackermann axle: both front wheels have rational sines.
///
/// With cot δ_l = c − h and cot δ_r = c + h, h = a/(2L), both are chosen and c and h follow: no search is needed.
pub fn ackermann() -> Point {
    // Inner wheel toward (4, 3), outer toward (12, 5): c = (4/3 + 12/5)/2 = 28/15, h = (12/5 − 4/3)/2 = 8/15.
    general().with("delta", toward(28, 15)).with("L", Exact::ratio(15, 8)).with("a", Exact::ratio(2, 1))
}

/// Trailers on the axle of a tractor of heading `phi`, each at an angle β behind the one ahead.
pub fn trailers(at: Point, headings: &[Exact]) -> Point {
    headings.iter().enumerate().fold(at, |p, (i, heading)| {
        let k = i + 1;
        p.with(Symbol::new(&format!("phi_{k}")), heading.clone())
            .with(Symbol::new(&format!("d_{k}")), Exact::ratio(1, 1))
            .with(Symbol::new(&format!("c_{k}")), Exact::ratio(0, 1))
    })
}

/// Headings of trailers that follow at angles β.
pub fn headings(phi: &Exact, betas: &[Exact]) -> Vec<Exact> {
    use creepage::formula::Scalar;
    let behind = |heading: &mut Exact, beta: &Exact| {
        *heading = heading.sub(beta);
        Some(heading.clone())
    };
    betas.iter().scan(phi.clone(), behind).collect()
}

/// A vehicle with trailers as a mechanism.
pub fn of(text: &str, trailers: usize) -> Mechanism {
    mechanism(&vehicle(text), trailers)
}
