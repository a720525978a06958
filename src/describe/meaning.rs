//! Units and meanings of the names that every model has.

use super::symbol_entry::Kind;

/// Name, kind, unit, meaning.
pub(super) type Known = (&'static str, Kind, &'static str, &'static str);

/// Names of every model.
const NAMES: &[Known] = &[
    ("x", Kind::Coordinate, "m", "position of the reference point along x"),
    ("y", Kind::Coordinate, "m", "position of the reference point along y"),
    ("s", Kind::Coordinate, "m", "distance of the reference point along its line"),
    ("phi", Kind::Coordinate, "rad", "heading of the body, counter-clockwise from x"),
    ("x'", Kind::Rate, "m/s", "velocity of the reference point along x"),
    ("y'", Kind::Rate, "m/s", "velocity of the reference point along y"),
    ("s'", Kind::Rate, "m/s", "speed of the reference point along its line"),
    ("phi'", Kind::Rate, "rad/s", "yaw rate"),
    ("v_d", Kind::Defined, "m/s", "forward speed that the wheels ask for"),
    ("v_n", Kind::Defined, "m/s", "speed to the left that the direction constraints ask for"),
    ("v_l", Kind::Defined, "m/s", "forward speed of the reference point"),
    ("v_t", Kind::Defined, "m/s", "speed of the reference point to the left"),
    ("delay", Kind::Defined, "s", "how far back the logged inputs are looked up"),
    ("lever_a", Kind::Defined, "m", "tracked point ahead of the reference point"),
    ("lever_b", Kind::Defined, "m", "tracked point to the left of the reference point"),
    ("heading_offset", Kind::Defined, "rad", "measured heading minus body heading"),
    ("x_m", Kind::Measured, "m", "measured position along x"),
    ("y_m", Kind::Measured, "m", "measured position along y"),
    ("heading_m", Kind::Measured, "rad", "measured heading"),
    ("sensor.a", Kind::Sensor, "m", "tracked point ahead of the reference point, as stated"),
    ("sensor.b", Kind::Sensor, "m", "tracked point to the left of the reference point, as stated"),
    ("sensor.heading_offset", Kind::Sensor, "rad", "measured heading minus body heading, as stated"),
];

/// Names of every trailer, before `_1`, `_2` … and a prime.
const TRAILER: &[Known] = &[
    ("phi", Kind::Coordinate, "rad", "heading of trailer"),
    ("phi'", Kind::Rate, "rad/s", "yaw rate of trailer"),
    ("trailer_length", Kind::Parameter, "m", "from the hitch to the axle of trailer"),
    ("hitch_offset", Kind::Parameter, "m", "the hitch behind the axle ahead of trailer"),
    ("d", Kind::Defined, "m", "length from hitch to axle of trailer"),
    ("c", Kind::Defined, "m", "hitch behind the axle ahead of trailer"),
    ("e_tc", Kind::Creep, "1", "traverse creep of trailer"),
    ("v", Kind::Defined, "m/s", "forward speed of the axle of trailer"),
    ("vt", Kind::Defined, "m/s", "speed to the left of the axle of trailer"),
];

/// The unit of the rate of what has a unit.
pub(super) fn unit_of_rate(unit: &str) -> String {
    unit.strip_suffix("/s").map_or_else(|| format!("{unit}/s"), |of| format!("{of}/s^2"))
}

/// What a name means in every model with so many trailers.
pub(super) fn of(name: &str, trailers: usize) -> Option<(Kind, String, String)> {
    let row = |r: &Known, tail: String| (r.1, r.2.to_string(), format!("{}{tail}", r.3));
    if let Some(known) = NAMES.iter().find(|r| r.0 == name) {
        return Some(row(known, String::new()));
    }
    let bare = name.trim_end_matches('\'');
    let (stem, number) = bare.rsplit_once('_')?;
    let number = number.parse::<usize>().ok().filter(|n| (1..=trailers).contains(n))?;
    let primed = format!("{stem}{}", &name[bare.len()..]);
    TRAILER.iter().find(|r| r.0 == primed).map(|r| row(r, format!(" {number}")))
}

/// What a name means in every model, or of some trailer; `None` for a name that a vehicle may give.
///
/// ```
/// use creepage::describe::universal;
/// assert_eq!(universal("v_t").unwrap(), "speed of the reference point to the left");
/// assert!(universal("e_tc_2").is_some() && universal("e_tc_r").is_none());
/// ```
pub fn universal(name: &str) -> Option<String> {
    of(name, usize::MAX).map(|(_, _, meaning)| meaning)
}
