//! Where the search for a plan begins: smooth curves through the poses, each leg driven forward or backward, and inputs that come
//! nearest to their speeds.

use super::b_spline::BSpline;
use super::limits::Limit;
use super::path::Path;
use super::trailing::{between, trail};
use super::transcription::Point;
use crate::model::Equations;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::{PI, TAU};

/// Poses at the ends of spans along a curve, with their speeds by the share of the whole.
pub struct Curve {
    /// x, y, heading.
    pub poses: Vec<[f64; 3]>,
    /// Whether the vehicle goes ahead before each pose.
    pub ahead: Vec<bool>,
    /// Metres.
    pub length: f64,
}

/// Where a search begins.
pub struct FirstGuess {
    /// Poses of the tracked point at the ends of spans.
    pub poses: Vec<[f64; 3]>,
    /// The curve that the body follows.
    pub on_body: Curve,
    /// How long that usually takes, s.
    pub usual: f64,
}

/// A leg from a pose to a pose, forward or backward at either end.
#[derive(Clone, Copy, Debug)]
struct Leg {
    from: [f64; 3],
    to: [f64; 3],
    ahead: [bool; 2],
    reach: f64,
}

/// Curves through poses: forward, backward, and with a change of direction either way, for every leg alike; `reach` is how far
/// they go on along the headings, as a share of what is usual.
pub fn curves(poses: &[[f64; 3]], spans: &[usize], reach: f64) -> Vec<Curve> {
    let ways = [[true, true], [false, false], [true, false], [false, true]];
    ways.into_iter().map(|ahead| curve(poses, spans, ahead, reach)).collect()
}

/// Curves along a path, forward and backward.
pub fn followed(path: &Path, first: [f64; 3], spans: usize) -> Vec<Curve> {
    let one = |ahead: bool| {
        let mut heading = first[2];
        let pose = |k: usize| {
            let ([x, y], course) = path.at((k + 1) as f64 / spans as f64)?;
            heading = nearest(course + if ahead { 0.0 } else { PI }, heading);
            Some([x, y, heading])
        };
        Curve { poses: (0..spans).filter_map(pose).collect(), ahead: vec![ahead; spans], length: path.length() }
    };
    vec![one(true), one(false)]
}

fn curve(poses: &[[f64; 3]], spans: &[usize], ahead: [bool; 2], reach: f64) -> Curve {
    let mut found = Curve { poses: vec![], ahead: vec![], length: 0.0 };
    let mut heading = poses[0][2];
    for (legs, spans) in poses.windows(2).zip(spans) {
        let mut to = legs[1];
        to[2] = nearest(to[2], heading);
        let leg = Leg { from: [legs[0][0], legs[0][1], heading], to, ahead, reach };
        let points: Vec<([f64; 2], bool)> = (0..=*spans).map(|i| leg.at(i as f64 / *spans as f64)).collect();
        for i in 1..points.len() {
            let ([x0, y0], _) = points[i - 1];
            let ([x, y], ahead) = points[i];
            let course = (y - y0).atan2(x - x0) + if ahead { 0.0 } else { PI };
            // The chord turns half a span before the curve.
            let still = (x - x0).hypot(y - y0) < 1e-9;
            heading = nearest(if i + 1 == points.len() || still { to[2] } else { course }, heading);
            found.poses.push([x, y, heading]);
            found.ahead.push(ahead);
            found.length += (x - x0).hypot(y - y0);
        }
    }
    found
}

/// An angle by whole turns as near to another as it can be.
pub fn nearest(angle: f64, to: f64) -> f64 {
    angle + TAU * ((to - angle) / TAU).round()
}

impl Leg {
    /// The place at a share of the leg, and whether it is driven ahead.
    fn at(&self, s: f64) -> ([f64; 2], bool) {
        let distance = (self.to[0] - self.from[0]).hypot(self.to[1] - self.from[1]);
        let turn = (self.to[2] - self.from[2]).abs();
        // A vehicle that ends where it begins, turned, has to go somewhere meanwhile.
        let reach = self.reach * distance.max(0.3 * turn).max(1e-3);
        let along = |pose: [f64; 3], ahead: bool, by: f64| {
            let by = if ahead { by } else { -by };
            [by * pose[2].cos(), by * pose[2].sin()]
        };
        if self.ahead[0] == self.ahead[1] {
            let slopes = [along(self.from, self.ahead[0], reach), along(self.to, self.ahead[1], reach)];
            return (hermite(self.from, self.to, slopes, s), self.ahead[0]);
        }
        // To a cusp beyond both, and back.
        let (out, back) = (along(self.from, self.ahead[0], 0.7 * reach), along(self.to, self.ahead[1], 0.7 * reach));
        let cusp = [0, 1].map(|i| 0.5 * (self.from[i] + out[i] + self.to[i] - back[i]));
        let middle = 0.5 * (self.from[2] + self.to[2]);
        let cusp = [cusp[0], cusp[1], middle];
        let (first, second) = (along(cusp, self.ahead[0], 0.5 * reach), along(cusp, self.ahead[1], 0.5 * reach));
        match s <= 0.5 {
            true => (hermite(self.from, cusp, [out, first], 2.0 * s), self.ahead[0]),
            false => (hermite(cusp, self.to, [second, back], 2.0 * s - 1.0), self.ahead[1]),
        }
    }
}

/// The cubic with these ends and end slopes.
fn hermite(from: [f64; 3], to: [f64; 3], slopes: [[f64; 2]; 2], s: f64) -> [f64; 2] {
    let (s2, s3) = (s * s, s * s * s);
    let weights = [2.0 * s3 - 3.0 * s2 + 1.0, s3 - 2.0 * s2 + s, 3.0 * s2 - 2.0 * s3, s3 - s2];
    [0, 1].map(|i| weights[0] * from[i] + weights[1] * slopes[0][i] + weights[2] * to[i] + weights[3] * slopes[1][i])
}

/// A state at a pose, with the trailers straight behind and all else as at the start.
pub fn straight(start: &[f64], equations: &Equations, pose: [f64; 3]) -> Vec<f64> {
    let mut z = start.to_vec();
    z[..3].copy_from_slice(&pose);
    z[3..equations.visible].fill(pose[2]);
    z
}

/// The point of a search that follows a curve in a duration, and the state that it begins with: the start, with trailers as a curve
/// that begins backward would have them.
pub fn point(
    curve: &Curve,
    start: &[f64],
    equations: &Equations,
    limits: &[Limit],
    spline: BSpline,
    duration: f64,
) -> (Point, Vec<f64>) {
    let step = duration / spline.spans as f64;
    let mut states: Vec<Vec<f64>> = vec![start.to_vec()];
    states.extend(curve.poses.iter().map(|pose| straight(start, equations, *pose)));
    let mut inputs: Vec<Vec<f64>> = vec![];
    let mut last = vec![0.0; limits.len()];
    for k in 0..spline.spans {
        let (a, b) = (&states[k], &states[k + 1]);
        let wanted = [0, 1, 2].map(|i| (b[i] - a[i]) / step);
        last = driving(equations, &between(a, b, 0.5), wanted, curve.ahead[k], &last, limits);
        inputs.push(last.clone());
    }
    trail(equations, &mut states, &inputs, &curve.ahead, step);
    let at = |channel: usize, x: f64| {
        let place = (x - 0.5).clamp(0.0, spline.spans as f64 - 1.0);
        let (i, share) = (place as usize, place.fract());
        let next = inputs[(i + 1).min(spline.spans - 1)][channel];
        inputs[i][channel] * (1.0 - share) + next * share
    };
    let coefficients = limits.iter().enumerate().map(|(channel, limit)| {
        let count = spline.coefficients();
        let is_end = |j: usize| j == 0 || j + 1 == count;
        (0..count).map(|j| if limit.rests && is_end(j) { 0.0 } else { at(channel, spline.greville(j)) }).collect()
    });
    let after = states.split_off(1);
    (Point { coefficients: coefficients.collect(), states: after, duration }, states.remove(0))
}

/// Inputs within their limits under which the body moves nearly as wanted, by a few steps of Gauss and Newton.
fn driving(
    equations: &Equations,
    z: &[f64],
    wanted: [f64; 3],
    ahead: bool,
    last: &[f64],
    limits: &[Limit],
) -> Vec<f64> {
    let (n, m) = (equations.n(), limits.len());
    let mut w = equations.workspace(&[]);
    let sign = if ahead { 1.0 } else { -1.0 };
    // What drives begins in the right direction, what steers where it was.
    let begin = |(l, last): (&Limit, &f64)| if l.rests { sign * 0.3 * l.scale() } else { *last };
    let mut u: Vec<f64> = limits.iter().zip(last).map(begin).collect();
    u.resize(equations.inputs.len(), 0.0);
    for _ in 0..8 {
        let all = equations.rates_and_jacobian(&mut w, z, &u);
        let width = n + equations.inputs.len();
        let slopes = DMatrix::from_fn(3, m, |i, j| all[n + i * width + n + j] * limits[j].scale());
        let off = DVector::from_fn(3, |i, _| wanted[i] - all[i]);
        if !slopes.iter().chain(&off).all(|v| v.is_finite()) {
            break;
        }
        let damped: DMatrix<f64> = slopes.transpose() * &slopes + 1e-6 * DMatrix::identity(m, m);
        let Some(step) = damped.cholesky().map(|c| c.solve(&(slopes.transpose() * off))) else { break };
        for (j, limit) in limits.iter().enumerate() {
            u[j] = (u[j] + step[j].clamp(-0.5, 0.5) * limit.scale()).clamp(limit.range[0], limit.range[1]);
        }
    }
    u.truncate(m);
    u
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_begin_and_end_at_their_poses() {
        for curve in curves(&[[0.0, 0.0, 0.0], [2.0, 1.0, 3.0], [0.0, 0.0, -3.0]], &[10, 6], 1.0) {
            assert_eq!(curve.poses.len(), 16);
            // Headings go on by whole turns.
            let near = |a: [f64; 3], b: [f64; 3]| {
                (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12 && (nearest(b[2], a[2]) - a[2]).abs() < 1e-12
            };
            assert!(near(curve.poses[9], [2.0, 1.0, 3.0]) && near(curve.poses[15], [0.0, 0.0, -3.0]));
            assert!(curve.poses.windows(2).all(|w| (w[1][2] - w[0][2]).abs() <= PI + 1e-9));
        }
    }
}
