//! Model predictive control (Rawlings, Mayne, Diehl 2017, chapter 1): commands that keep a model near a reference within the
//! limits of its inputs, from one linearisation along the last plan and one quadratic program a sample (real-time iteration,
//! Diehl and others 2005).

use crate::error::Result;
use crate::model::Equations;
use crate::motion::Integrator;
use crate::planning::{BSpline, Limit, QuadraticProgram, Shooting, nearest};
use nalgebra::{DMatrix, DVector};

/// An error of position, m, and of a heading, rad, that costs as much as a command half its range away from the planned one.
const WORTH: [f64; 2] = [0.02, 0.05];
/// A trailer's heading counts this share of the body's.
const OF_TRAILERS: f64 = 0.3;
/// How far, as a share of an input's range, a command may be from the planned one for that cost.
const HALF: f64 = 0.5;

/// What a model is led along: measured values and commands, a row a sample.
#[derive(Clone, Debug)]
pub struct Reference {
    /// x, y, heading, headings of trailers.
    pub poses: Vec<Vec<f64>>,
    /// The commands under which the model that it was planned on goes there.
    pub commands: Vec<Vec<f64>>,
}

impl Reference {
    /// Row of a sample; behind the end it stays.
    fn at(rows: &[Vec<f64>], k: usize) -> &[f64] {
        rows.get(k).or(rows.last()).map_or(&[], Vec::as_slice)
    }

    /// The commands of a sample.
    pub fn command(&self, k: usize) -> &[f64] {
        Self::at(&self.commands, k)
    }

    /// The pose of a sample.
    pub fn pose(&self, k: usize) -> &[f64] {
        Self::at(&self.poses, k)
    }
}

/// A controller of a model.
pub struct PredictiveControl<'a> {
    /// The model.
    pub equations: &'a Equations,
    /// Limits of its inputs.
    pub limits: &'a [Limit],
    /// Time between two commands, s.
    pub sample: f64,
    /// How many commands it looks ahead.
    pub horizon: usize,
    /// How the motion is integrated.
    pub integrator: Integrator,
}

/// Where a controller stands.
pub struct Now<'a> {
    /// Number of the sample.
    pub k: usize,
    /// States, as estimated.
    pub states: &'a [f64],
    /// Free parameters, as estimated.
    pub parameters: &'a [f64],
    /// The command that has been reached.
    pub command: &'a [f64],
}

/// Commands, and the derivatives of the measured values at each sample by all of them.
struct Linearised {
    outputs: Vec<DVector<f64>>,
    slopes: Vec<DMatrix<f64>>,
}

impl PredictiveControl<'_> {
    /// The commands of the next samples, from a guess of them; the guess where no better ones are found.
    ///
    /// # Errors
    /// When the motion is undefined on the way.
    pub fn commands(&self, reference: &Reference, now: &Now, guess: Vec<Vec<f64>>) -> Result<Vec<Vec<f64>>> {
        let linear = self.linearised(now, &guess)?;
        let program = self.program(reference, now, &guess, &linear);
        let channels = self.limits.len();
        let Some(step) = program.solution() else { return Ok(guess) };
        let moved = |(j, row): (usize, &Vec<f64>)| {
            let step = &step.x[j * channels..(j + 1) * channels];
            let inside = |((u, d), limit): ((&f64, &f64), &Limit)| (u + d).clamp(limit.range[0], limit.range[1]);
            row.iter().zip(step).zip(self.limits).map(inside).collect()
        };
        Ok(guess.iter().enumerate().map(moved).collect())
    }

    fn linearised(&self, now: &Now, commands: &[Vec<f64>]) -> Result<Linearised> {
        let (n, channels, visible) = (self.equations.n(), self.limits.len(), self.equations.visible);
        let spline = BSpline { degree: 1, spans: 1 };
        let mut states = now.states.to_vec();
        let mut by_commands = DMatrix::zeros(n, commands.len() * channels);
        let mut w = self.equations.workspace(now.parameters);
        let mut found = Linearised { outputs: vec![], slopes: vec![] };
        for (j, next) in commands.iter().enumerate() {
            let before = if j == 0 { now.command } else { &commands[j - 1] };
            let pair: Vec<Vec<f64>> = before.iter().zip(next).map(|(a, b)| vec![*a, *b]).collect();
            let shooting = Shooting {
                equations: self.equations,
                parameters: now.parameters,
                begins: (now.k + j) as f64 * self.sample,
                spline,
                integrator: self.integrator,
            };
            let span = shooting.span(&states, &pair, 0, self.sample)?;
            by_commands = span.slopes.columns(0, n) * by_commands;
            for c in 0..channels {
                for (end, at) in [(0, j.checked_sub(1)), (1, Some(j))] {
                    if let Some(at) = at {
                        let mut column = by_commands.column_mut(at * channels + c);
                        column += span.slopes.column(n + 2 * c + end);
                    }
                }
            }
            states = span.end;
            let all = self.equations.outputs(&mut w, &states);
            let width = visible + now.parameters.len();
            let observed =
                DMatrix::from_fn(visible, n, |i, k| if k < visible { all[visible + i * width + k] } else { 0.0 });
            found.outputs.push(DVector::from_column_slice(&all[..visible]));
            found.slopes.push(observed * &by_commands);
        }
        Ok(found)
    }

    /// Squares of errors and of commands that are not the planned ones, within the limits of the commands and of their rates.
    fn program(&self, reference: &Reference, now: &Now, guess: &[Vec<f64>], linear: &Linearised) -> QuadraticProgram {
        let channels = self.limits.len();
        let size = guess.len() * channels;
        let (mut quadratic, mut gradient) = (DMatrix::<f64>::zeros(size, size), DVector::<f64>::zeros(size));
        for (j, (outputs, slopes)) in linear.outputs.iter().zip(&linear.slopes).enumerate() {
            let wanted = reference.pose(now.k + j + 1);
            for i in 0..outputs.len() {
                let off = outputs[i] - wanted[i];
                let (off, worth) = match i {
                    0 | 1 => (off, WORTH[0]),
                    2 => (nearest(off, 0.0), WORTH[1]),
                    _ => (nearest(off, 0.0), WORTH[1] / OF_TRAILERS),
                };
                let row = slopes.row(i).transpose() / worth;
                quadratic.ger(1.0, &row, &row, 1.0);
                gradient.axpy(off / worth, &row, 1.0);
            }
        }
        for j in 0..guess.len() {
            for (c, limit) in self.limits.iter().enumerate() {
                let (at, weight) = (j * channels + c, 1.0 / (HALF * limit.scale()).powi(2));
                let planned = reference.command(now.k + j + 1)[c];
                let planned_before = reference.command(now.k + j)[c];
                let before = if j == 0 { now.command[c] } else { guess[j - 1][c] };
                // The command itself, and its step.
                quadratic[(at, at)] += 2.0 * weight;
                gradient[at] += weight * (guess[j][c] - planned);
                let step = weight * (guess[j][c] - before - (planned - planned_before));
                gradient[at] += step;
                if j > 0 {
                    let earlier = at - channels;
                    quadratic[(earlier, earlier)] += weight;
                    quadratic[(earlier, at)] -= weight;
                    quadratic[(at, earlier)] -= weight;
                    gradient[earlier] -= step;
                }
            }
        }
        let mut program = QuadraticProgram { linear: gradient.iter().copied().collect(), ..Default::default() };
        let upper = (0..size).flat_map(|k| (0..=k).map(move |i| (i, k)));
        program.quadratic = upper.map(|(i, k)| (i, k, quadratic[(i, k)])).collect();
        self.bounded(&mut program, now, guess);
        program
    }

    fn bounded(&self, program: &mut QuadraticProgram, now: &Now, guess: &[Vec<f64>]) {
        let channels = self.limits.len();
        let mut below = |entries: &[(usize, f64)], most: f64| {
            let row = program.below_of.len();
            program.below.extend(entries.iter().map(|(at, v)| (row, *at, *v)));
            program.below_of.push(most);
        };
        for (j, row) in guess.iter().enumerate() {
            for (c, limit) in self.limits.iter().enumerate() {
                let (at, u) = (j * channels + c, row[c]);
                below(&[(at, 1.0)], limit.range[1] - u);
                below(&[(at, -1.0)], u - limit.range[0]);
                let before = if j == 0 { now.command[c] } else { guess[j - 1][c] };
                let most = limit.rate * self.sample;
                for sign in [1.0, -1.0] {
                    let step = most - sign * (u - before);
                    match j {
                        0 => below(&[(at, sign)], step),
                        _ => below(&[(at, sign), (at - channels, -sign)], step),
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Model;

    /// A wheel beside a line along x at 1 m/s, within limits of its yaw rate.
    fn led(off: f64, most: f64) -> (Vec<Vec<f64>>, Limit) {
        let equations = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().equations(&[]).unwrap();
        let limit =
            |role: &str, most: f64, rate: f64| Limit { role: role.into(), range: [-most, most], rate, rests: true };
        let limits = [limit("wheel_rate", 4.0, 4.0), limit("yaw_rate", most, 5.0)];
        let control = PredictiveControl {
            equations: &equations,
            limits: &limits,
            sample: 0.1,
            horizon: 15,
            integrator: Integrator::default(),
        };
        let rows: Vec<f64> = (0..20).map(|k| 0.1 * k as f64).collect();
        let reference = Reference {
            poses: rows.iter().map(|x| vec![*x, 0.0, 0.0]).collect(),
            commands: vec![vec![2.0, 0.0]; rows.len()],
        };
        let now = Now { k: 0, states: &[0.0, off, 0.0], parameters: &[], command: &[2.0, 0.0] };
        (control.commands(&reference, &now, vec![vec![2.0, 0.0]; 15]).unwrap(), limits[1].clone())
    }

    #[test]
    fn on_its_line_a_wheel_is_commanded_as_planned_and_beside_it_towards_it() {
        let (on, _) = led(0.0, 1.0);
        assert!(on.iter().all(|u| (u[0] - 2.0).abs() < 1e-7 && u[1].abs() < 1e-7), "{on:?}");
        let (left, _) = led(0.1, 10.0);
        let (right, _) = led(-0.1, 10.0);
        assert!(left[1][1] < -0.1);
        // Mirrored.
        assert!(left.iter().zip(&right).all(|(l, r)| (l[1] + r[1]).abs() < 1e-6 && (l[0] - r[0]).abs() < 1e-6));
    }

    #[test]
    fn limits_of_commands_and_of_their_rates_are_kept() {
        let (found, limit) = led(0.5, 0.4);
        assert!(found.iter().any(|u| (u[1] + 0.4).abs() < 1e-6), "{found:?}");
        assert!(found.iter().all(|u| u[1].abs() <= 0.4));
        let (fast, _) = led(0.5, 10.0);
        let steps = std::iter::once(fast[0][1]).chain(fast.windows(2).map(|w| w[1][1] - w[0][1]));
        let steps: Vec<f64> = steps.map(f64::abs).collect();
        assert!(steps.iter().all(|s| *s <= 0.1 * limit.rate + 1e-9));
        assert!(steps.iter().any(|s| (s - 0.1 * limit.rate).abs() < 1e-6), "{steps:?}");
    }
}
