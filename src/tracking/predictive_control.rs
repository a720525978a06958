//! Model predictive control (Rawlings, Mayne, Diehl 2017, chapter 1): commands that keep a model near a reference within the
//! limits of its inputs, from one linearisation along the last plan and one quadratic program a sample (real-time iteration,
//! Diehl and others 2005).

use super::reference::Reference;
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
/// To what commands are found, as a share of their limits.
const ACCURACY: f64 = 1e-11;

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
    /// How many samples pass until a command acts, input by input.
    pub delays: Vec<usize>,
    /// How the motion is integrated.
    pub integrator: Integrator,
}

/// Where a controller stands.
pub struct Now<'a> {
    /// States, as estimated, at the sample at which the input that acts soonest is next to be commanded.
    pub states: &'a [f64],
    /// Free parameters, as estimated.
    pub parameters: &'a [f64],
    /// The commands that have been given, a row a sample, the last one of this sample.
    pub commands: &'a [Vec<f64>],
}

impl Now<'_> {
    /// Number of the sample.
    fn sample(&self) -> usize {
        self.commands.len() - 1
    }
}

/// Commands, and the derivatives of the measured values at each sample by all of them.
struct Linearised {
    outputs: Vec<DVector<f64>>,
    slopes: Vec<DMatrix<f64>>,
}

/// Inputs sample by sample as they act, the commands of samples before them.
struct Acting {
    /// When the first sample begins.
    first: Vec<f64>,
    rows: Vec<Vec<f64>>,
}

impl PredictiveControl<'_> {
    /// Samples until the first of the inputs acts.
    pub fn soonest(&self) -> usize {
        self.delays.iter().copied().min().unwrap_or(0)
    }

    /// By how many samples each input acts later than the first of them.
    pub fn waits(&self) -> impl Iterator<Item = usize> + '_ {
        self.delays.iter().map(|delay| delay - self.soonest())
    }

    /// The commands of the next samples, each in the row of the sample at which it acts, from a guess of the first of them; the
    /// guess where no better ones are found.
    ///
    /// Rows begin with the input that acts soonest; what acts in them of the others is on its way and stays as it is.
    ///
    /// # Errors
    /// When the motion is undefined on the way.
    pub fn commands(&self, reference: &Reference, now: &Now, guess: &[Vec<f64>]) -> Result<Vec<Vec<f64>>> {
        let Acting { first, rows: guess } = self.acting(reference, now, guess);
        let linear = self.linearised(now, &first, &guess)?;
        let program = self.program(reference, now, &first, &guess, &linear);
        let channels = self.limits.len();
        let Some(step) = program.solution(ACCURACY) else { return Ok(guess) };
        let moved = |(j, row): (usize, &Vec<f64>)| {
            let step = &step.x[j * channels..(j + 1) * channels];
            let inside = |((u, d), limit): ((&f64, &f64), &Limit)| (u + d).clamp(limit.range[0], limit.range[1]);
            row.iter().zip(step).zip(self.limits).map(inside).collect()
        };
        Ok(guess.iter().enumerate().map(moved).collect())
    }

    /// The inputs as they act from the sample on at which the first one does: as they are on their way, as guessed, or as planned.
    fn acting(&self, reference: &Reference, now: &Now, guess: &[Vec<f64>]) -> Acting {
        let begins = now.sample() + self.soonest();
        let given = |acts: usize, c: usize| now.commands[acts.saturating_sub(self.delays[c])][c];
        let of = |j: usize, c: usize| match begins + j + 1 {
            acts if acts <= now.sample() + self.delays[c] => given(acts, c),
            acts => guess.get(j).map_or_else(|| self.planned(reference, acts, c), |row| row[c]),
        };
        let channels = 0..self.limits.len();
        let rows = self.horizon + self.waits().max().unwrap_or(0);
        Acting {
            first: channels.clone().map(|c| given(begins, c)).collect(),
            rows: (0..rows).map(|j| channels.clone().map(|c| of(j, c)).collect()).collect(),
        }
    }

    /// The planned command that acts at a sample.
    fn planned(&self, reference: &Reference, acts: usize, c: usize) -> f64 {
        reference.command(acts.saturating_sub(self.delays[c]))[c]
    }

    fn linearised(&self, now: &Now, first: &[f64], commands: &[Vec<f64>]) -> Result<Linearised> {
        let (n, channels, visible) = (self.equations.n(), self.limits.len(), self.equations.visible);
        let spline = BSpline { degree: 1, spans: 1 };
        let mut states = now.states.to_vec();
        let mut by_commands = DMatrix::zeros(n, commands.len() * channels);
        let mut w = self.equations.workspace(now.parameters);
        let mut found = Linearised { outputs: vec![], slopes: vec![] };
        for (j, next) in commands.iter().enumerate() {
            let before = if j == 0 { first } else { &commands[j - 1] };
            let pair: Vec<Vec<f64>> = before.iter().zip(next).map(|(a, b)| vec![*a, *b]).collect();
            let shooting = Shooting {
                equations: self.equations,
                parameters: now.parameters,
                begins: (now.sample() + self.soonest() + j) as f64 * self.sample,
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
    fn program(
        &self,
        reference: &Reference,
        now: &Now,
        first: &[f64],
        guess: &[Vec<f64>],
        linear: &Linearised,
    ) -> QuadraticProgram {
        let begins = now.sample() + self.soonest();
        let channels = self.limits.len();
        let size = guess.len() * channels;
        let (mut quadratic, mut gradient) = (DMatrix::<f64>::zeros(size, size), DVector::<f64>::zeros(size));
        for (j, (outputs, slopes)) in linear.outputs.iter().zip(&linear.slopes).enumerate() {
            let wanted = reference.pose(begins + j + 1);
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
                let planned = self.planned(reference, begins + j + 1, c);
                let planned_before = self.planned(reference, begins + j, c);
                let before = if j == 0 { first[c] } else { guess[j - 1][c] };
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
        self.bounded(&mut program, first, guess);
        program
    }

    fn bounded(&self, program: &mut QuadraticProgram, first: &[f64], guess: &[Vec<f64>]) {
        let channels = self.limits.len();
        // What is on its way stays as it is.
        let on_its_way = self.waits().enumerate().flat_map(|(c, wait)| (0..wait).map(move |j| j * channels + c));
        program.equal = on_its_way.enumerate().map(|(row, at)| (row, at, 1.0)).collect();
        program.equal_to = vec![0.0; program.equal.len()];
        let mut below = |entries: &[(usize, f64)], most: f64| {
            let row = program.below_of.len();
            program.below.extend(entries.iter().map(|(at, v)| (row, *at, *v)));
            program.below_of.push(most);
        };
        let waits: Vec<usize> = self.waits().collect();
        for (j, row) in guess.iter().enumerate() {
            for (c, limit) in self.limits.iter().enumerate().filter(|(c, _)| j >= waits[*c]) {
                let (at, u) = (j * channels + c, row[c]);
                below(&[(at, 1.0)], limit.range[1] - u);
                below(&[(at, -1.0)], u - limit.range[0]);
                let before = if j == 0 { first[c] } else { guess[j - 1][c] };
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
        led_late(off, most, [0, 0], &[vec![2.0, 0.0]])
    }

    /// With delays in samples, and commands that have been given.
    fn led_late(off: f64, most: f64, delays: [usize; 2], commands: &[Vec<f64>]) -> (Vec<Vec<f64>>, Limit) {
        let equations = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().equations(&[]).unwrap();
        let limit =
            |role: &str, most: f64, rate: f64| Limit { role: role.into(), range: [-most, most], rate, rests: true };
        let limits = [limit("wheel_rate", 4.0, 4.0), limit("yaw_rate", most, 5.0)];
        let control = PredictiveControl {
            equations: &equations,
            limits: &limits,
            sample: 0.1,
            horizon: 15,
            delays: delays.to_vec(),
            integrator: Integrator::default(),
        };
        let rows: Vec<f64> = (0..20).map(|k| 0.1 * k as f64).collect();
        let reference = Reference {
            poses: rows.iter().map(|x| vec![*x, 0.0, 0.0]).collect(),
            commands: vec![vec![2.0, 0.0]; rows.len()],
        };
        let now = Now { states: &[0.0, off, 0.0], parameters: &[], commands };
        (control.commands(&reference, &now, &vec![vec![2.0, 0.0]; 15]).unwrap(), limits[1].clone())
    }

    /// What has been commanded acts as it was commanded, and what is commanded now is what helps when it acts.
    #[test]
    fn commands_on_their_way_stay_and_those_that_follow_reckon_with_them() {
        let sent: Vec<Vec<f64>> = [0.0, 0.1, 0.2, 0.3].iter().map(|yaw| vec![2.0, *yaw]).collect();
        let (found, _) = led_late(0.0, 10.0, [1, 3], &sent);
        // The wheel acts a sample on, the yaw rate three: two commands of it are on their way when the wheel's first acts.
        assert!((found[0][1] - 0.2).abs() < 1e-9 && (found[1][1] - 0.3).abs() < 1e-9, "{found:?}");
        assert_eq!(found.len(), 17);
        // To the left for a while, then to the right.
        assert!(found[3][1] < -0.05, "{found:?}");
        let (unaware, _) = led_late(0.0, 10.0, [1, 1], &sent);
        assert!(unaware.len() == 15 && unaware[0][1] < 0.2, "{unaware:?}");
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
