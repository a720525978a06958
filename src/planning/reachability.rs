//! Directions in which a vehicle can be moved at all (accessibility: Sussmann and Jurdjevic 1972), from motions under sampled
//! inputs: what none of them changes, no plan changes.

use super::b_spline::BSpline;
use super::initial_guess::nearest;
use super::limits::Limit;
use super::shooting::Shooting;
use super::tracked_point::TrackedPoint;

/// How many motions are looked at, and how long each takes, s.
const MOTIONS: usize = 12;
const TIME: f64 = 2.0;
/// A change that is rounding, m or rad.
const NOTHING: f64 = 1e-9;

/// What no input changes of a pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fixed {
    /// The heading.
    Heading,
    /// The place.
    Place,
    /// The distance from a line through the start.
    Line,
}

/// Motions from a start under sampled inputs.
pub struct Motions {
    /// The pose at the start: x, y, heading.
    start: [f64; 3],
    /// What each motion changes of it.
    changes: Vec<[f64; 3]>,
}

impl Motions {
    /// Of a point of a vehicle, under inputs within their limits; `shooting` has inputs that are one piece. Motions that are
    /// undefined say nothing.
    pub fn sampled(shooting: &Shooting, start: &[f64], point: &TrackedPoint, limits: &[Limit]) -> Self {
        let from = point.at(start).0;
        let moved = |motion: usize| {
            let end = shooting.end(start, &sampled(limits, shooting.spline, motion), 0, TIME).ok()?;
            let to = point.at(&end).0;
            Some([0, 1, 2].map(|i| to[i] - from[i]))
        };
        Self { start: from, changes: (0..MOTIONS).filter_map(moved).collect() }
    }

    /// What would have to change for a goal, and no input changes; none where all can change that must.
    pub fn unreachable(&self, goal: (f64, f64, Option<f64>)) -> Option<Fixed> {
        let [x, y, heading] = self.start;
        let most = |of: &dyn Fn(&[f64; 3]) -> f64| self.changes.iter().map(|m| of(m).abs()).fold(0.0, f64::max);
        let wanted = [goal.0 - x, goal.1 - y];
        let turn = goal.2.map_or(0.0, |h| nearest(h - heading, 0.0));
        let farthest = self.changes.iter().max_by(|a, b| a[0].hypot(a[1]).total_cmp(&b[0].hypot(b[1])))?;
        if turn.abs() > NOTHING && most(&|m| m[2]) < NOTHING {
            return Some(Fixed::Heading);
        }
        let length = farthest[0].hypot(farthest[1]);
        if length < NOTHING {
            return (wanted[0].hypot(wanted[1]) > NOTHING).then_some(Fixed::Place);
        }
        let across = |v: &[f64]| (farthest[0] * v[1] - farthest[1] * v[0]) / length;
        let is_line = most(&|m| across(m)) < NOTHING * length.max(1.0);
        (is_line && across(&wanted).abs() > NOTHING * length.max(1.0)).then_some(Fixed::Line)
    }
}

/// Coefficients of inputs within their limits, spread by multiples of irrational numbers (Weyl's sequence).
fn sampled(limits: &[Limit], spline: BSpline, motion: usize) -> Vec<Vec<f64>> {
    let of = |(channel, limit): (usize, &Limit)| {
        let share =
            |j: usize| ((motion + 1) as f64 * ((channel * spline.coefficients() + j + 2) as f64).sqrt()).fract();
        let [least, most] = limit.range;
        (0..spline.coefficients()).map(|j| least + (most - least) * share(j)).collect()
    };
    limits.iter().enumerate().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Model;
    use crate::motion::Integrator;

    fn fixed(model: &Model, goal: (f64, f64, Option<f64>)) -> Option<Fixed> {
        let equations = model.equations(&[]).unwrap();
        let point = TrackedPoint::of(model, &equations, 0).unwrap();
        let spline = BSpline { degree: 3, spans: 1 };
        let integrator = Integrator::default();
        let shooting = Shooting { equations: &equations, parameters: &[], begins: 0.0, spline, integrator };
        Motions::sampled(&shooting, &vec![0.0; equations.n()], &point, &Limit::usual(model)).unreachable(goal)
    }

    #[test]
    fn a_body_that_does_not_turn_one_on_a_line_and_one_in_flight_are_told() {
        let parallel = Model::new("synchro-drive", &[("wheel_radius", 0.1)]).unwrap();
        assert_eq!(fixed(&parallel, (1.0, 0.3, Some(0.2))), Some(Fixed::Heading));
        assert_eq!(fixed(&parallel, (1.0, 0.3, Some(0.0))), None);
        let disk = Model::new("disk", &[("wheel_radius", 0.1)]).unwrap();
        assert_eq!(fixed(&disk, (1.0, 0.3, None)), Some(Fixed::Line));
        assert_eq!(fixed(&disk, (-1.0, 0.0, Some(0.0))), None);
        let hopper = Model::new("hopper", &[("body_inertia", 1.0), ("leg_mass", 1.0), ("leg_offset", 0.1)]).unwrap();
        assert_eq!(fixed(&hopper, (0.1, 0.0, Some(0.3))), Some(Fixed::Place));
        assert_eq!(fixed(&hopper, (0.0, 0.0, Some(0.3))), None);
        let wheel = Model::new("unicycle", &[("wheel_radius", 0.1)]).unwrap();
        assert_eq!(fixed(&wheel, (0.0, 1.0, Some(1.0))), None);
    }
}
