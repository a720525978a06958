//! Repairs of logged data: what its writer may have meant by a column.

use super::signed_ratios::SignedRatios;
use crate::files::{InputTiming, Run};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Data that one repair brings into line with the model.
#[derive(Clone, Debug, PartialEq)]
pub struct Repaired {
    /// Measured beside reckoned as the data are.
    pub ratios: SignedRatios,
    /// Names of the columns of x, y and the heading.
    pub pose: [String; 3],
    /// The simplest repair, and others that these data do not tell from it.
    pub repairs: Vec<Repair>,
}

/// What is to be read otherwise.
#[derive(Clone, Debug, PartialEq)]
pub enum Repair {
    /// Some inputs.
    Inputs(Vec<InputRepair>),
    /// The measured pose.
    Pose(PoseRepair),
}

/// An input that is to be read otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct InputRepair {
    /// The input.
    pub role: String,
    /// The input whose column holds it.
    pub source: String,
    /// Name of that column.
    pub column: String,
    /// What its numbers are.
    pub change: Change,
}

/// What the numbers of a column are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// So many times too small.
    Scale(f64, Unit),
    /// The integral of what is wanted, such as an angle or counts, so many times too small.
    Difference(f64),
    /// What is wanted times the time between rows, such as counts since the row before, so many times too small; and how many
    /// rows there are in a second.
    PerRow(f64, f64),
    /// The way driven in the place of a speed, of a vehicle whose wheel has this radius.
    Odometer(f64),
    /// A straight line of what is wanted: scale and offset.
    Line([f64; 2]),
}

/// Where a factor comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// The sign alone.
    Sign,
    /// A unit of the model file.
    Named(&'static str),
    /// Counts per turn, or a diameter in the place of a radius.
    Counts,
    /// A speed in the place of a wheel's rate, or the reverse.
    Radius,
}

/// How a measured pose is to be read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PoseRepair {
    /// The heading is turned by an angle, rad.
    HeadingTurned(f64),
    /// The heading counts clockwise from a direction, rad from x.
    HeadingClockwise(f64),
    /// x and y are exchanged.
    AxesExchanged,
    /// One of both has the wrong sign.
    AxisReversed(usize),
    /// Both are exchanged with their signs reversed.
    AxesExchangedReversed,
    /// The world is seen from below: y counts to the right, and the heading clockwise.
    FromBelow,
    /// The position has another unit: its name, and what it is in metres.
    PositionUnit(&'static str, f64),
    /// The heading is in degrees.
    HeadingInDegrees,
}

impl PoseRepair {
    /// Every one, and how far-fetched it is; without a heading those that the path alone shows.
    pub fn all(has_heading: bool) -> Vec<(Self, u32)> {
        let units = [("mm", 1e-3), ("cm", 1e-2), ("ft", 0.3048)];
        let mut found: Vec<(Self, u32)> = units.map(|(name, metres)| (Self::PositionUnit(name, metres), 12)).to_vec();
        // Without a heading there is none to count clockwise.
        found.push((if has_heading { Self::FromBelow } else { Self::AxisReversed(1) }, 11));
        if has_heading {
            found.extend([
                (Self::HeadingTurned(PI), 11),
                (Self::HeadingTurned(FRAC_PI_2), 11),
                (Self::HeadingTurned(-FRAC_PI_2), 11),
                (Self::HeadingClockwise(0.0), 10),
                (Self::HeadingClockwise(FRAC_PI_2), 10),
                (Self::HeadingClockwise(PI), 12),
                (Self::HeadingClockwise(-FRAC_PI_2), 12),
                (Self::AxesExchanged, 10),
                (Self::AxisReversed(0), 10),
                (Self::AxisReversed(1), 10),
                (Self::AxesExchangedReversed, 12),
                (Self::HeadingInDegrees, 10),
            ]);
        }
        found
    }

    /// What a unit of the positions is, m.
    pub fn metres(self) -> f64 {
        if let Self::PositionUnit(_, metres) = self { metres } else { 1.0 }
    }

    /// The pose as it is meant.
    pub fn applied(self, [x, y]: [&[f64]; 2], heading: Option<&[f64]>) -> ([Vec<f64>; 2], Option<Vec<f64>>) {
        let times = |column: &[f64], factor: f64| column.iter().map(|v| factor * v).collect::<Vec<f64>>();
        let place = match self {
            Self::AxesExchanged => [times(y, 1.0), times(x, 1.0)],
            Self::AxesExchangedReversed => [times(y, -1.0), times(x, -1.0)],
            Self::AxisReversed(0) => [times(x, -1.0), times(y, 1.0)],
            Self::AxisReversed(_) | Self::FromBelow => [times(x, 1.0), times(y, -1.0)],
            Self::PositionUnit(_, metres) => [times(x, metres), times(y, metres)],
            _ => [times(x, 1.0), times(y, 1.0)],
        };
        let angle = |h: &f64| match self {
            Self::HeadingTurned(by) => h - by,
            Self::HeadingClockwise(from) => from - h,
            Self::FromBelow => -h,
            Self::HeadingInDegrees => h.to_radians(),
            _ => *h,
        };
        (place, heading.map(|h| h.iter().map(angle).collect()))
    }
}

impl Change {
    /// A column as it is meant.
    pub fn applied(self, time: &[f64], timing: InputTiming, column: &[f64]) -> Vec<f64> {
        let last = column.len() - 1;
        match self {
            Self::Scale(factor, _) => column.iter().map(|u| factor * u).collect(),
            Self::Line([scale, offset]) => column.iter().map(|u| scale * u + offset).collect(),
            Self::Odometer(_) => Self::Difference(1.0).applied(time, timing, column),
            Self::PerRow(factor, _) => {
                let step = |i: usize| time[i.max(1)] - time[i.max(1) - 1];
                column.iter().enumerate().map(|(i, u)| factor * u / step(i)).collect()
            }
            Self::Difference(factor) => {
                let ends = |i: usize| match timing {
                    InputTiming::Sample => (i.saturating_sub(1), (i + 1).min(last)),
                    InputTiming::IntervalMean => (i.max(1) - 1, i.max(1)),
                };
                let rate = |(a, b): (usize, usize)| (column[b] - column[a]) / (time[b] - time[a]);
                (0..column.len()).map(|i| factor * rate(ends(i))).collect()
            }
        }
    }

    /// Every usual one of an input of some unit, with so many rows in a second, and how far-fetched it is.
    pub fn usual(is_wheel: bool, unit: &str, radius: Option<f64>, rate: f64) -> Vec<(Self, u32)> {
        let named = |name, factor| (Self::Scale(factor, Unit::Named(name)), 12);
        let mut found = match unit {
            "m/s" => {
                let mut found =
                    vec![named("km/h", 1.0 / 3.6), named("mph", 0.447_04), named("mm/s", 1e-3), named("cm/s", 1e-2)];
                found.extend(radius.map(|r| (Self::Scale(r, Unit::Radius), 13)));
                found
            }
            "rad/s" => vec![named("deg/s", PI / 180.0), named("turns/s", TAU), named("rpm", TAU / 60.0)],
            "rad" => vec![named("deg", PI / 180.0), named("turns", TAU)],
            _ => vec![],
        };
        if is_wheel {
            found.extend([0.25, 0.5, 2.0, 4.0].map(|factor| (Self::Scale(factor, Unit::Counts), 13)));
            found.extend(radius.map(|r| (Self::Scale(1.0 / r, Unit::Radius), 13)));
        }
        // The way itself, or the angle, and what is added to it in a row.
        match unit {
            "m/s" => found.extend(radius.map(|r| (Self::Odometer(r), 12))),
            _ if unit.ends_with("/s") => found.push((Self::Difference(1.0), 12)),
            _ => (),
        }
        if unit.ends_with("/s") {
            found.push((Self::PerRow(1.0, rate), 13));
        }
        found
    }

    /// The usual ones, and those with a sign the other way round, which are more far-fetched.
    pub fn of_either_sign(is_wheel: bool, unit: &str, radius: Option<f64>, rate: f64) -> Vec<(Self, u32)> {
        let both = |(change, cost): (Self, u32)| [Some((change, cost)), change.reversed().map(|r| (r, cost + 3))];
        Self::usual(is_wheel, unit, radius, rate).into_iter().flat_map(both).flatten().collect()
    }

    /// The same with the sign reversed, of what has one.
    fn reversed(self) -> Option<Self> {
        match self {
            Self::Scale(factor, unit) => Some(Self::Scale(-factor, unit)),
            Self::Difference(factor) => Some(Self::Difference(-factor)),
            Self::PerRow(factor, rate) => Some(Self::PerRow(-factor, rate)),
            Self::Line(_) | Self::Odometer(_) => None,
        }
    }
}

/// The columns of a run as some inputs are meant.
pub(crate) fn inputs(run: &Run, timing: InputTiming, repairs: &[InputRepair]) -> Vec<Vec<f64>> {
    let index = |role: &str| run.roles.iter().position(|r| r == role);
    let mut found = run.inputs.clone();
    for repair in repairs {
        if let (Some(to), Some(from)) = (index(&repair.role), index(&repair.source)) {
            found[to] = repair.change.applied(run.input_time(), timing, &run.inputs[from]);
        }
    }
    found
}
