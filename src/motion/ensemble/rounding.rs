//! The rounding error of a run: the least error that a finer step can still reach.

use super::lanes::{LANES, Lane};
use super::steps::States;

/// The error of a case, and what of it is due to steps that are too long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Estimate {
    /// The whole of it; NaN where the motion is undefined.
    pub error: f64,
    /// As if there were no rounding.
    pub truncation: f64,
}

impl Estimate {
    /// From what the order of the method makes of the difference of two runs, and what rounding leaves at best.
    pub fn new(truncation: f64, floor: f64) -> Self {
        Self { error: truncation + floor, truncation }
    }

    /// Whether rounding decides, and twice the steps have not made the rest smaller than half of that before.
    pub fn is_stuck(&self, before: Option<f64>) -> bool {
        self.truncation <= self.error / 2.0 && before.is_some_and(|b| self.truncation >= b / 2.0)
    }
}

/// Units in the last place that rounding leaves of a number at best, as a share of one.
const MIN_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// What rounding leaves of each lane at best, relative to the size of a state above one: units in the last place, and of
/// the place on the plane what a heading that is rounded makes of the way there.
pub(crate) struct Floor {
    turned_way: Lane,
}

impl Floor {
    pub fn new() -> Self {
        Self { turned_way: [0.0; LANES] }
    }

    /// Takes a row into account.
    pub fn see(&mut self, states: &States, visible: usize) {
        for (l, most) in self.turned_way.iter_mut().enumerate() {
            let way = states.reach[0][l].max(states.reach[1][l]);
            let heading = |i: usize| states.start[i][l].abs() + states.reach[i][l];
            let turned = (2..visible).map(heading).fold(0.0, f64::max);
            let nearest = states.z[0][l].abs().min(states.z[1][l].abs()).max(1.0);
            *most = most.max(way * turned / nearest);
        }
    }

    /// Of a lane.
    pub fn of(&self, l: usize) -> f64 {
        MIN_ROUNDING * (1.0 + self.turned_way[l])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where steps are too long more of them help, even where they have not helped yet.
    #[test]
    fn what_rounding_decides_is_stuck_when_more_steps_do_not_help() {
        let of = |truncation: f64| Estimate::new(truncation, 1e-14);
        assert_eq!(of(1e-10).error, 1e-10 + 1e-14);
        let stuck = |truncation, before| of(truncation).is_stuck(before);
        assert_eq!([stuck(1e-15, None), stuck(1e-15, Some(1e-13)), stuck(1e-15, Some(1e-15))], [false, false, true]);
        assert!(stuck(0.0, Some(0.0)) && !stuck(1e-6, Some(1e-6)) && !stuck(f64::NAN, Some(1e-15)));
    }

    /// Four units in the last place; a heading that is rounded turns the way from the start.
    #[test]
    fn the_floor_is_of_the_last_places() {
        let lanes = |z: [f64; 3]| z.map(|v| [v; LANES]).to_vec();
        let of = |start: [f64; 3], rows: &[[f64; 3]]| {
            let (mut floor, mut states) = (Floor::new(), States::new(&lanes(start)));
            for z in rows {
                states.z = lanes(*z);
                states.note_reach();
                floor.see(&states, 3);
            }
            floor.of(5) / MIN_ROUNDING
        };
        assert_eq!(of([0.0; 3], &[[0.0, 0.0, 0.0]]), 1.0);
        assert_eq!(of([0.0, 0.0, 3.0], &[[0.5, -2.0, -30.0]]), 1.0 + 2.0 * 36.0);
        assert_eq!(of([1e6, 1e6, 0.0], &[[1e6 + 50.0, 1e6, 4.0]]), 1.0 + 50.0 * 4.0 / 1e6);
        // There and back again.
        assert_eq!(of([0.0; 3], &[[9.0, 3.0, -2.0], [0.0; 3]]), 1.0 + 9.0 * 2.0);
    }
}
