//! The cost of a plan: time, smooth and small inputs, and nearness to a path, with the curvature of its squares (Gauss and Newton).

use super::quadratic_program::QuadraticProgram;
use super::transcription::{Point, Program};

/// The weight of distances from a path beside the duration's, by a metre squared.
const PATH: f64 = 100.0;
/// A curvature for what no cost asks for.
const REGULARISATION: f64 = 1e-8;

impl Program<'_> {
    /// The cost of a point.
    pub fn cost(&self, point: &Point) -> f64 {
        let per = self.per_channel() as f64;
        let mut cost = self.weights.time * point.duration / self.usual;
        for (c, limit) in point.coefficients.iter().zip(self.limits) {
            let of = |v: f64| (v / limit.scale()).powi(2);
            cost += 0.5 * self.weights.effort * c.iter().map(|v| of(*v)).sum::<f64>() / per;
            cost += 0.5 * self.weights.smoothness * c.windows(2).map(|w| of(w[1] - w[0])).sum::<f64>() * per;
        }
        let off = |(k, z): (usize, &Vec<f64>)| {
            let at = self.point.at(z).0;
            self.path.nearest([at[0], at[1]], self.share(k)).map_or(0.0, |foot| foot.off.powi(2))
        };
        cost + 0.5 * PATH * point.states.iter().enumerate().map(off).sum::<f64>()
    }

    /// The slope and the curvature of the cost, and of a damping that holds inputs and the duration near where they are.
    pub(super) fn costs(&self, point: &Point, damping: f64, program: &mut QuadraticProgram) {
        let mut add = |i: usize, j: usize, v: f64| program.quadratic.push((i.min(j), i.max(j), v));
        (0..self.spans() * self.n()).for_each(|i| add(i, i, REGULARISATION));
        add(self.of_duration(), self.of_duration(), REGULARISATION + damping / self.usual.powi(2));
        program.linear[self.of_duration()] += self.weights.time / self.usual;
        let per = self.per_channel();
        for (channel, limit) in self.limits.iter().enumerate() {
            let c = &point.coefficients[channel];
            let [effort, smoothness] = [self.weights.effort / per as f64, self.weights.smoothness * per as f64]
                .map(|w| w / limit.scale().powi(2));
            for j in 0..per {
                let here = self.of_coefficient(channel, j);
                add(here, here, effort + damping / limit.scale().powi(2));
                program.linear[here] += effort * c[j];
                if j + 1 < per {
                    let ahead = here + 1;
                    [here, ahead].into_iter().for_each(|i| add(i, i, smoothness));
                    add(here, ahead, -smoothness);
                    program.linear[ahead] += smoothness * (c[j + 1] - c[j]);
                    program.linear[here] -= smoothness * (c[j + 1] - c[j]);
                }
            }
        }
        for (k, z) in point.states.iter().enumerate() {
            let (at, slopes) = self.point.at(z);
            let Some(foot) = self.path.nearest([at[0], at[1]], self.share(k)) else { continue };
            let across = |a: usize| foot.normal[0] * slopes[(0, a)] + foot.normal[1] * slopes[(1, a)];
            for a in 0..self.n() {
                program.linear[self.of_state(k, a)] += PATH * foot.off * across(a);
                for b in a..self.n() {
                    add(self.of_state(k, a), self.of_state(k, b), PATH * across(a) * across(b));
                }
            }
        }
    }

    /// The share of the duration at the end of a span.
    fn share(&self, span: usize) -> f64 {
        (span + 1) as f64 / self.spans() as f64
    }

    /// The curvature of a change of each unknown alone: states by metres and radians, inputs and the duration by their sizes.
    pub(super) fn distances(&self, program: &mut QuadraticProgram) {
        let mut add = |i: usize, size: f64| program.quadratic.push((i, i, size.powi(-2)));
        (0..self.spans() * self.n()).for_each(|i| add(i, 1.0));
        for (channel, limit) in self.limits.iter().enumerate() {
            (0..self.per_channel()).for_each(|j| add(self.of_coefficient(channel, j), limit.scale()));
        }
        add(self.of_duration(), self.usual);
    }
}
