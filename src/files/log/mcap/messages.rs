//! The layouts of messages: those that are known by heart, as data, and those by a definition.

use super::cdr::{Cdr, Read};
use super::definition::Form;
use super::recorded::Source;
use crate::files::log::quaternion::yaw;
use std::collections::BTreeMap;

/// A piece of a message.
#[derive(Clone, Copy)]
pub(crate) enum Part {
    /// A text that is of no interest.
    Text,
    /// A number and its name.
    Number(&'static str),
    /// Numbers that are of no interest.
    Skip(usize),
    /// A quaternion x, y, z, w; its turn about z is `yaw`.
    Turn,
}

use Part::{Number, Skip, Text, Turn};

/// How a message is laid out behind its header's stamp.
#[derive(Clone)]
pub(crate) enum Layout {
    /// Piece by piece.
    Parts(&'static [Part]),
    /// Names of joints, then positions, velocities and efforts.
    Joints,
    /// As its definition says, the header among the rest.
    Defined(Form),
}

/// The layouts of the sources of a bag.
#[derive(Default)]
pub(crate) struct Layouts(BTreeMap<u64, Option<Layout>>);

impl Layouts {
    /// The layout of a source's messages, if it is known or defined.
    pub fn of(&mut self, source: &Source) -> Option<&Layout> {
        self.0.entry(source.id).or_insert_with(|| Layout::of(source)).as_ref()
    }
}

const ODOMETRY: &[Part] = &[
    Text,
    Text,
    Number("pose.pose.position.x"),
    Number("pose.pose.position.y"),
    Number("pose.pose.position.z"),
    Turn,
    Skip(36),
    Number("twist.twist.linear.x"),
    Number("twist.twist.linear.y"),
    Number("twist.twist.linear.z"),
    Number("twist.twist.angular.x"),
    Number("twist.twist.angular.y"),
    Number("twist.twist.angular.z"),
    Skip(36),
];
const IMU: &[Part] = &[
    Text,
    Turn,
    Skip(9),
    Number("angular_velocity.x"),
    Number("angular_velocity.y"),
    Number("angular_velocity.z"),
    Skip(9),
    Number("linear_acceleration.x"),
    Number("linear_acceleration.y"),
    Number("linear_acceleration.z"),
    Skip(9),
];
const POSE: &[Part] = &[Text, Number("pose.position.x"), Number("pose.position.y"), Number("pose.position.z"), Turn];
const POSE_WITH_COVARIANCE: &[Part] = &[
    Text,
    Number("pose.pose.position.x"),
    Number("pose.pose.position.y"),
    Number("pose.pose.position.z"),
    Turn,
    Skip(36),
];

/// The types of messages that are known by heart.
pub(crate) const NAMES: [&str; 5] = [
    "nav_msgs/Odometry",
    "sensor_msgs/JointState",
    "sensor_msgs/Imu",
    "geometry_msgs/PoseStamped",
    "geometry_msgs/PoseWithCovarianceStamped",
];

/// What joints say, each with its name behind.
const JOINT: [&str; 3] = ["position", "velocity", "effort"];

impl Layout {
    fn of(source: &Source) -> Option<Self> {
        if source.encoding != "cdr" {
            return None;
        }
        let name = source.kind.replace("/msg/", "/");
        let Some(known) = NAMES.iter().position(|n| *n == name) else {
            return Form::of(&source.kind, source.definition.as_ref()?).map(Self::Defined);
        };
        Some(match known {
            0 => Self::Parts(ODOMETRY),
            1 => Self::Joints,
            2 => Self::Parts(IMU),
            3 => Self::Parts(POSE),
            _ => Self::Parts(POSE_WITH_COVARIANCE),
        })
    }

    /// Whether one message may have other fields than the next.
    pub fn varies(&self) -> bool {
        match self {
            Self::Parts(_) => false,
            Self::Joints => true,
            Self::Defined(form) => form.varies(),
        }
    }

    /// Whether it is read by a definition.
    pub fn is_defined(&self) -> bool {
        matches!(self, Self::Defined(_))
    }

    /// The names of a message's fields.
    pub fn fields(&self, message: &[u8]) -> Read<Vec<String>> {
        let (_, found) = self.all(message, &[])?;
        Ok(found.into_iter().map(|(name, _)| name).collect())
    }

    /// The time of a message's header, s, and some of its fields; NaN where there is none.
    ///
    /// Within a list each element may have a header, and the one is taken that the first of the fields stands beside.
    pub fn values(&self, message: &[u8], wanted: &[&str]) -> Read<(f64, Vec<f64>)> {
        let (stamp, all) = self.all(message, wanted)?;
        let value = |w: &&str| all.iter().find(|(name, _)| name == w).map_or(f64::NAN, |(_, v)| *v);
        Ok((stamp, wanted.iter().map(value).collect()))
    }

    fn all(&self, message: &[u8], wanted: &[&str]) -> Read<(f64, Vec<(String, f64)>)> {
        if let Self::Defined(form) = self {
            let found = form.numbers(message)?;
            return Ok((stamp_of(&found, wanted.first().copied().unwrap_or_default()), found));
        }
        let mut cdr = Cdr::new(message)?;
        let stamp = cdr.stamp()?;
        let found = match self {
            Self::Parts(parts) => piecewise(&mut cdr, parts)?,
            Self::Joints => joints(&mut cdr)?,
            Self::Defined(_) => vec![],
        };
        Ok((stamp, found))
    }
}

/// The stamp of the innermost header around a field; NaN where there is none.
fn stamp_of(found: &[(String, f64)], field: &str) -> f64 {
    let around = field.rmatch_indices('.').map(|(at, _)| format!("{}.", &field[..at])).chain([String::new()]);
    let mut names = around.flat_map(|inner| ["header.stamp", "stamp"].map(|name| format!("{inner}{name}")));
    names.find_map(|name| found.iter().find(|(n, _)| *n == name)).map_or(f64::NAN, |(_, stamp)| *stamp)
}

fn piecewise(cdr: &mut Cdr, parts: &[Part]) -> Read<Vec<(String, f64)>> {
    let mut found = Vec::new();
    for part in parts {
        match part {
            Text => drop(cdr.text()?),
            Number(name) => found.push(((*name).to_string(), cdr.f64()?)),
            Skip(n) => (0..*n).try_for_each(|_| cdr.f64().map(drop))?,
            Turn => {
                let (x, y, z, w) = (cdr.f64()?, cdr.f64()?, cdr.f64()?, cdr.f64()?);
                found.push(("yaw".into(), yaw([x, y, z, w])));
            }
        }
    }
    Ok(found)
}

fn joints(cdr: &mut Cdr) -> Read<Vec<(String, f64)>> {
    cdr.text()?;
    let names = cdr.texts()?;
    let mut found = Vec::new();
    for what in JOINT {
        let numbers = cdr.numbers()?;
        found.extend(names.iter().zip(numbers).map(|(name, v)| (format!("{what}.{name}"), v)));
    }
    Ok(found)
}
