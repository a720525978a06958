//! The unit of a column, by what its name ends in and by its values.

use super::samples::Sample;

/// What names end in, and the unit it means.
const SUFFIXES: &[(&str, &str)] = &[
    ("km h", "km/h"),
    ("m s", "m/s"),
    ("deg s", "deg/s"),
    ("rad s", "rad/s"),
    ("turns s", "turns/s"),
    ("mm", "mm"),
    ("cm", "cm"),
    ("km", "km"),
    ("ft", "ft"),
    ("feet", "ft"),
    ("m", "m"),
    ("deg", "deg"),
    ("degs", "deg"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("rad", "rad"),
    ("turns", "turns"),
    ("rads", "rad/s"),
    ("radps", "rad/s"),
    ("dps", "deg/s"),
    ("degps", "deg/s"),
    ("rpm", "rpm"),
    ("rps", "turns/s"),
    ("mps", "m/s"),
    ("kmh", "km/h"),
    ("kph", "km/h"),
    ("mph", "mph"),
    ("s", "s"),
    ("ms", "ms"),
    ("msec", "ms"),
    ("us", "us"),
    ("usec", "us"),
    ("ns", "ns"),
    ("nsec", "ns"),
];

/// The unit that the words of a name end in, and how many of them it takes.
pub(crate) fn suffix(words: &[String]) -> Option<(&'static str, usize)> {
    [2, 1].into_iter().filter(|n| words.len() > *n).find_map(|n| {
        let end = words[words.len() - n..].join(" ");
        SUFFIXES.iter().find(|(name, _)| *name == end).map(|(_, unit)| (*unit, n))
    })
}

/// The unit of times, by how large they are and how far apart.
pub(crate) fn of_times(sample: &Sample) -> Option<&'static str> {
    let first = sample.numbers.first()?.abs();
    match first {
        1e17.. => return Some("ns"),
        1e14.. => return Some("us"),
        1e11.. => return Some("ms"),
        1e8.. => return None,
        _ => {}
    }
    // Rows of a robot are some milliseconds apart, and whole seconds are seldom.
    match sample.step() {
        _ if !sample.is_whole() => None,
        2e6.. => Some("ns"),
        2e3.. => Some("us"),
        5.0.. => Some("ms"),
        _ => None,
    }
}

/// Whether angles are in degrees: beyond a turn in radians and within one in degrees.
pub(crate) fn in_degrees(sample: &Sample) -> bool {
    let spread = sample.numbers.windows(2).all(|w| (w[1] - w[0]).abs() < 400.0);
    let largest = sample.largest();
    // A heading that goes on beyond a turn in radians moves less from row to row than one that is wrapped at 180.
    let wraps = sample.numbers.windows(2).any(|w| (w[1] - w[0]).abs() > 180.0);
    spread && largest <= 360.5 && (wraps || largest > 40.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(values: &[f64]) -> Sample {
        let rows: Vec<Vec<String>> = values.iter().map(|v| vec![v.to_string()]).collect();
        Sample::of(1, &rows).remove(0)
    }

    #[test]
    fn units_are_told_from_the_end_of_a_name() {
        let words = |name: &str| name.split(' ').map(str::to_string).collect::<Vec<_>>();
        for (name, unit) in [
            ("yaw deg", Some(("deg", 1))),
            ("wheel speed km h", Some(("km/h", 2))),
            ("v m s", Some(("m/s", 2))),
            ("left rpm", Some(("rpm", 1))),
            ("stamp ns", Some(("ns", 1))),
            ("m", None),
            ("yaw", None),
        ] {
            assert_eq!(suffix(&words(name)), unit, "{name}");
        }
    }

    #[test]
    fn times_tell_their_unit_by_size_or_spacing() {
        for (values, unit) in [
            ([1.7e18, 1.7e18 + 2e7, 1.7e18 + 4e7], Some("ns")),
            ([1.7e15, 1.7e15 + 2e4, 1.7e15 + 4e4], Some("us")),
            ([1.7e12, 1.7e12 + 20.0, 1.7e12 + 40.0], Some("ms")),
            ([1.7e9, 1.7e9 + 0.02, 1.7e9 + 0.04], None),
            ([0.0, 20.0, 40.0], Some("ms")),
            ([0.0, 20_000.0, 40_000.0], Some("us")),
            ([0.0, 0.02, 0.04], None),
            ([0.0, 1.0, 2.0], None),
        ] {
            assert_eq!(of_times(&sample(&values)), unit, "{values:?}");
        }
    }

    #[test]
    fn degrees_reach_beyond_a_turn_of_radians() {
        assert!(in_degrees(&sample(&[0.0, 90.0, 179.0, -179.0])) && in_degrees(&sample(&[359.0, 1.0, 2.0])));
        assert!(!in_degrees(&sample(&[3.1, -3.1, 0.0])) && !in_degrees(&sample(&[0.0, 3.0, 6.2, 9.0])));
        assert!(!in_degrees(&sample(&[0.0, 700.0])));
    }
}
