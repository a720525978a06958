//! Units that a column may be in, and what they are in SI units.

use std::f64::consts::{PI, TAU};

/// What a unit measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Dimension {
    /// m
    Length,
    /// rad
    Angle,
    /// rad/s
    Rate,
    /// m/s
    Speed,
    /// m/s²
    Acceleration,
    /// s
    Time,
}

use Dimension::{Acceleration, Angle, Length, Rate, Speed, Time};

/// Name, dimension, SI units in one of it.
const UNITS: &[(&str, Dimension, f64)] = &[
    ("m", Length, 1.0),
    ("mm", Length, 1e-3),
    ("cm", Length, 1e-2),
    ("km", Length, 1e3),
    ("ft", Length, 0.3048),
    ("rad", Angle, 1.0),
    ("deg", Angle, PI / 180.0),
    ("turns", Angle, TAU),
    ("rad/s", Rate, 1.0),
    ("deg/s", Rate, PI / 180.0),
    ("rpm", Rate, TAU / 60.0),
    ("turns/s", Rate, TAU),
    ("m/s", Speed, 1.0),
    ("km/h", Speed, 1.0 / 3.6),
    ("mph", Speed, 0.44704),
    ("m/s^2", Acceleration, 1.0),
    ("g", Acceleration, 9.80665),
    ("s", Time, 1.0),
    ("ms", Time, 1e-3),
    ("us", Time, 1e-6),
    ("ns", Time, 1e-9),
];

impl Dimension {
    /// The dimension of a role's SI unit.
    pub fn of_si(unit: &str) -> Option<Self> {
        UNITS.iter().find(|(name, _, factor)| *name == unit && *factor == 1.0).map(|(_, dimension, _)| *dimension)
    }

    /// The dimension of a unit.
    pub fn of(unit: &str) -> Option<Self> {
        UNITS.iter().find(|(name, _, _)| *name == unit).map(|(_, dimension, _)| *dimension)
    }

    /// What it is called.
    pub fn noun(self) -> &'static str {
        match self {
            Length => "a length",
            Angle => "an angle",
            Rate => "an angular rate",
            Speed => "a speed",
            Acceleration => "an acceleration",
            Time => "time",
        }
    }

    /// SI units in one of a unit of this dimension.
    pub fn factor(self, unit: &str) -> Option<f64> {
        UNITS.iter().find(|(name, dimension, _)| *name == unit && *dimension == self).map(|(_, _, factor)| *factor)
    }

    /// The names of its units.
    pub fn units(self) -> Vec<&'static str> {
        UNITS.iter().filter(|(_, dimension, _)| *dimension == self).map(|(name, _, _)| *name).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_what_they_are_in_si() {
        for (dimension, unit, si) in [
            (Length, "ft", 0.3048),
            (Angle, "deg", 0.017453292519943295),
            (Rate, "rpm", 0.10471975511965977),
            (Rate, "turns/s", TAU),
            (Speed, "km/h", 0.2777777777777778),
            (Speed, "mph", 0.44704),
            (Time, "us", 1e-6),
        ] {
            assert_eq!(dimension.factor(unit), Some(si), "{unit}");
        }
        assert_eq!((Speed.factor("deg"), Dimension::of_si("rad/s"), Dimension::of_si("kg")), (None, Some(Rate), None));
        assert_eq!(Dimension::of_si("deg"), None, "a role is in SI units");
    }
}
