//! The states of a vehicle, and how windows treat each.

use super::freedom::{Freedom, Speed};
use super::observation::{HEADING, POSITION, TRAILER};
use super::trailer::trailer_heading;
use crate::formula::Symbol;

/// A component of the process noise: nodes that name the same one jump with one variance for each second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Jump {
    /// Its name.
    pub id: &'static str,
    /// What it violates.
    pub place: &'static str,
    /// The unit of its standard deviation over a window.
    pub unit: &'static str,
    /// The unit of the rate that it violates.
    pub rate_unit: &'static str,
    /// The component of the measurement noise it is as large as at first, and told from none by.
    pub scale: usize,
    /// Whether the path of the positions shows it where nothing else is measured.
    pub is_shown_by_path: bool,
}

/// The component of the process noise across the body among [`JUMPS`].
pub const ACROSS: usize = 1;
/// The component of the process noise in yaw among [`JUMPS`].
pub const YAW: usize = 2;

/// The components of the process noise: along and across the body, in yaw, of trailers; then those of the speeds that forces
/// change.
pub const JUMPS: [Jump; 9] = [
    Jump {
        id: "along",
        place: "rotation constraint",
        unit: "m",
        rate_unit: "m/s",
        scale: POSITION,
        is_shown_by_path: true,
    },
    Jump {
        id: "across",
        place: "traverse constraint",
        unit: "m",
        rate_unit: "m/s",
        scale: POSITION,
        is_shown_by_path: true,
    },
    Jump { id: "yaw", place: "yaw rate", unit: "rad", rate_unit: "rad/s", scale: HEADING, is_shown_by_path: true },
    Jump {
        id: "trailer",
        place: "trailer constraint",
        unit: "rad",
        rate_unit: "rad/s",
        scale: TRAILER,
        is_shown_by_path: false,
    },
    Jump {
        id: "force-along",
        place: "force along the body",
        unit: "m/s",
        rate_unit: "m/s^2",
        scale: POSITION,
        is_shown_by_path: true,
    },
    Jump {
        id: "force-across",
        place: "force across the body",
        unit: "m/s",
        rate_unit: "m/s^2",
        scale: POSITION,
        is_shown_by_path: true,
    },
    Jump {
        id: "torque",
        place: "torque on the body",
        unit: "rad/s",
        rate_unit: "rad/s^2",
        scale: HEADING,
        is_shown_by_path: true,
    },
    Jump {
        id: "torque-of-trailer",
        place: "torque on a trailer",
        unit: "rad/s",
        rate_unit: "rad/s^2",
        scale: TRAILER,
        is_shown_by_path: false,
    },
    Jump {
        id: "torque-of-wheel",
        place: "torque on a wheel",
        unit: "rad/s",
        rate_unit: "rad/s^2",
        scale: HEADING,
        is_shown_by_path: true,
    },
];

/// How many of the components are of poses.
pub const OF_POSES: usize = 4;

/// The component of the process noise of a speed among [`JUMPS`].
fn jump_of(speed: Speed) -> usize {
    OF_POSES + speed as usize
}

/// How windows treat a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Treatment {
    /// Free at the start of every window; from window to window it jumps by a component of the process noise.
    Node(Node),
    /// Measured by nobody: propagated from window to window.
    Carried,
}

/// A state that is free at the start of every window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Node {
    /// Whether it is an angle.
    pub is_angle: bool,
    /// Its component of the process noise among [`JUMPS`]; of the place, along the axis of the body with its number.
    pub jump: usize,
}

/// The nodes that are the place of the body: they jump along its axes.
pub const PLACE: [usize; 2] = [0, 1];
/// The node that is the direction of these axes.
pub const DIRECTION: usize = 2;

const BODY: [Node; 3] =
    [Node { is_angle: false, jump: 0 }, Node { is_angle: false, jump: 1 }, Node { is_angle: true, jump: 2 }];
const TRAILING: Node = Node { is_angle: true, jump: 3 };

/// The nodes of a vehicle with so many trailers, in the order of the states: the pose, then headings of trailers, then
/// speeds that forces change.
///
/// ```
/// use creepage::model::state::{JUMPS, nodes};
/// let jumps: Vec<&str> = nodes(1).map(|node| JUMPS[node.jump].id).collect();
/// assert_eq!(jumps, ["along", "across", "yaw", "trailer"]);
/// ```
pub fn nodes(of: impl Into<Freedom>) -> impl ExactSizeIterator<Item = Node> {
    let of = of.into();
    let poses = BODY.len() + of.trailers;
    (0..poses + of.speeds.len()).map(move |i| match i.checked_sub(poses) {
        None => BODY.get(i).copied().unwrap_or(TRAILING),
        Some(k) => Node { is_angle: false, jump: jump_of(of.speeds[k]) },
    })
}

/// The components of the process noise up to the last one that these nodes have.
pub fn jumps(of: impl Into<Freedom>) -> &'static [Jump] {
    let last = nodes(of).map(|node| node.jump).max().unwrap_or(0);
    &JUMPS[..=last]
}

/// The symbols of the nodes, in their order.
pub(super) fn node_symbols(trailers: usize) -> impl Iterator<Item = Symbol> {
    ["x", "y", "phi"].into_iter().map(Symbol::from).chain((1..=trailers).map(trailer_heading))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::observation::{outputs, sensor_noise};

    /// Every node has a symbol and an output, and every component is one of those that are there.
    #[test]
    fn nodes_symbols_and_outputs_are_of_one_list() {
        for trailers in [0, 1, 3] {
            assert_eq!(nodes(trailers).len(), node_symbols(trailers).count());
            assert_eq!(nodes(trailers).len(), outputs(trailers).count());
            assert!(nodes(trailers).zip(outputs(trailers)).all(|(node, y)| node.is_angle == y.is_angle));
            assert!(nodes(trailers).all(|node| node.jump < jumps(trailers).len()));
            assert!(jumps(trailers).iter().all(|jump| sensor_noise(trailers)[jump.scale].unit == jump.unit));
        }
        assert_eq!((jumps(0).len(), jumps(2).len(), sensor_noise(0).len(), sensor_noise(2).len()), (3, 4, 2, 3));
    }
}
