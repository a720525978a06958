//! The stiff method: single steps of Radau IIA from the crate `differential-equations`, its work bounded here.
//!
//! What was found in its source (0.7.0), and what is done about it here. Looked at as well: `diffsol` (BDF, SDIRK; two
//! hundred crates and a second nalgebra), `russell_ode` (needs a BLAS), `ode_solvers` (nothing implicit).
//!
//! | the crate | here |
//! |---|---|
//! | a state whose length is known at run time has no zero to start from: `Vec` is out of bounds at the first step | arrays of fixed length, filled up with components that rest |
//! | `initialize` turns a tolerance into that of its error estimate, one of all components once for each of them | a tolerance for each component |
//! | after a step whose decomposition was kept, a shorter one (refused, or up to the end) is tried with the old one and may never converge | a new solver for every step, so that nothing is kept |
//! | `init` estimates a first step from differences of f | the step is chosen here |

use differential_equations::linalg::Matrix;
use differential_equations::methods::ImplicitRungeKutta;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use differential_equations::status::Status;
use ode_solvers::dop_shared::IntegrationError;
use std::cell::RefCell;

/// A right-hand side: writes f(t, y) into its last argument. It is called by its address, so that the crate's method is
/// compiled once for each length of the state and not again for each right-hand side.
pub(crate) type Rates<'a> = dyn FnMut(f64, &[f64], &mut [f64]) + 'a;

/// ∂f/∂y of a right-hand side.
pub(crate) trait Slopes {
    /// Writes ∂fᵢ/∂yⱼ row by row; false where they have to be had from differences.
    fn write(&mut self, t: f64, y: &[f64], slopes: &mut [f64]) -> bool;
}

/// Slopes from differences of the right-hand side.
pub(crate) struct Differences;

impl Slopes for Differences {
    fn write(&mut self, _: f64, _: &[f64], _: &mut [f64]) -> bool {
        false
    }
}

impl<J: FnMut(f64, &[f64], &mut [f64])> Slopes for J {
    fn write(&mut self, t: f64, y: &[f64], slopes: &mut [f64]) -> bool {
        self(t, y, slopes);
        true
    }
}

/// Slopes at other times, times a factor.
pub(crate) struct Retimed<'a, J, T> {
    pub slopes: &'a mut J,
    pub time: T,
    pub factor: f64,
}

impl<J: Slopes, T: Fn(f64) -> f64> Slopes for Retimed<'_, J, T> {
    fn write(&mut self, t: f64, y: &[f64], slopes: &mut [f64]) -> bool {
        let known = self.slopes.write((self.time)(t), y, slopes);
        slopes.iter_mut().for_each(|v| *v *= self.factor);
        known
    }
}

/// What a span asks for.
pub(crate) struct Span {
    /// How long it is.
    pub length: f64,
    /// The first step to try; zero for none known.
    pub first: f64,
    pub rtol: f64,
    pub atol: f64,
    /// The most steps.
    pub most: u32,
}

/// Where a span ended.
pub(crate) struct Done {
    pub y: Vec<f64>,
    /// A step to go on with.
    pub next: f64,
    pub steps: u32,
}

/// Integrates y′ = f(s, y) from s = 0 through a span.
pub(crate) fn step_through(
    rates: &mut Rates<'_>,
    slopes: &mut dyn Slopes,
    span: &Span,
    y: &[f64],
) -> Result<Done, IntegrationError> {
    match y.len() {
        0..=4 => padded::<4>(rates, slopes, span, y),
        5..=8 => padded::<8>(rates, slopes, span, y),
        9..=16 => padded::<16>(rates, slopes, span, y),
        17..=32 => padded::<32>(rates, slopes, span, y),
        33..=64 => padded::<64>(rates, slopes, span, y),
        _ => padded::<MAX_STATES>(rates, slopes, span, y),
    }
}

/// The most states the stiff method takes: its matrices have a size that is fixed when the program is built.
pub(crate) const MAX_STATES: usize = 256;
/// The shortest step, as a share of the span.
const MIN_STEP: f64 = 1e-15;
/// The smallest relative tolerance the crate takes.
const MIN_RELATIVE_TOLERANCE: f64 = 1e-14;
/// The first step where none is known, as a share of the shortest time constant.
const FIRST_STEP: f64 = 0.1;
/// How much longer a step may be than the one before; layers must not be leapt over.
const MAX_STEP_GROWTH: f64 = 2.0;
/// Newton's method stops at this share of what the crate thinks enough: an error across a stiff direction is a force.
const NEWTON_TOLERANCE: f64 = 1e-3;

fn padded<const N: usize>(
    rates: &mut Rates<'_>,
    slopes: &mut dyn Slopes,
    span: &Span,
    y: &[f64],
) -> Result<Done, IntegrationError> {
    let system = Padded { n: y.len(), parts: RefCell::new((rates, slopes)) };
    let mut now = [0.0; N];
    now[..y.len()].copy_from_slice(y);
    let (mut passed, mut steps) = (0.0, 0);
    let mut next = if span.first > 0.0 { span.first } else { system.cautious(&now, span) };
    while passed < span.length {
        let left = span.length - passed;
        // Two equal steps to the end are better than a long and a very short one.
        let wanted = next.min(left);
        let h = if left < 2.0 * wanted { left / (left / wanted).ceil() } else { wanted };
        if steps >= span.most {
            return Err(IntegrationError::MaxNumStepReached { x: passed, n_step: span.most });
        }
        steps += 1;
        let step = system.step(passed, h, &now, span).filter(|s| s.next > MIN_STEP * span.length);
        let Step { y, accepted, next: after } = step.ok_or(IntegrationError::StepSizeUnderflow { x: passed })?;
        if accepted {
            (now, passed) = (y, if h == left { span.length } else { passed + h });
        }
        // A step cut to fit the end says nothing against longer ones.
        next = if accepted && h < wanted { after.max(next) } else { after };
    }
    Ok(Done { y: now[..system.n].to_vec(), next, steps })
}

/// A right-hand side filled up to N components.
struct Padded<'a> {
    n: usize,
    parts: RefCell<(&'a mut Rates<'a>, &'a mut dyn Slopes)>,
}

struct Step<const N: usize> {
    y: [f64; N],
    accepted: bool,
    next: f64,
}

impl Padded<'_> {
    /// A first step shorter than the shortest time constant: where a layer begins a span, longer ones are refused one after
    /// another until one is as short.
    fn cautious<const N: usize>(&self, y: &[f64; N], span: &Span) -> f64 {
        let mut slopes = vec![0.0; self.n * self.n];
        self.write_slopes(0.0, y, &mut slopes);
        let rows = slopes.chunks(self.n.max(1)).map(|row| row.iter().map(|s| s.abs()).sum::<f64>());
        let fastest = rows.fold(0.0, f64::max);
        if fastest > 0.0 { (FIRST_STEP / fastest).min(span.length) } else { span.length }
    }

    /// One step, accepted or refused; nothing where no step can be made.
    fn step<const N: usize>(&self, at: f64, h: f64, y: &[f64; N], span: &Span) -> Option<Step<N>> {
        // Components that rest must not dilute the mean error: a power 2/3 of this factor and then a root come after.
        let share = (self.n.max(1) as f64 / N as f64).powf(0.75);
        let rtol = share * span.rtol.max(MIN_RELATIVE_TOLERANCE);
        let estimated = 0.1 * rtol.powf(2.0 / 3.0);
        let newton = (NEWTON_TOLERANCE * estimated.sqrt().min(0.03)).max(1e-15 / estimated);
        let mut solver = ImplicitRungeKutta::radau5()
            .rtol(vec![rtol; N])
            .atol(vec![share * span.atol; N])
            .newton_tol(newton)
            .max_newton_iter(10)
            .max_scale(MAX_STEP_GROWTH)
            .h0(h);
        // The end it is told is only a bound on its steps, and well beyond this one.
        solver.init(self, at, at + 2.0 * span.length, y).ok()?;
        solver.step(self).ok()?;
        let accepted = !matches!(solver.status(), Status::RejectedStep);
        Some(Step { y: *solver.y(), accepted, next: solver.h() })
    }
}

impl<const N: usize> ODE<f64, [f64; N]> for Padded<'_> {
    fn diff(&self, s: f64, y: &[f64; N], rates: &mut [f64; N]) {
        rates[self.n..].fill(0.0);
        (self.parts.borrow_mut().0)(s, &y[..self.n], &mut rates[..self.n]);
    }

    fn jacobian(&self, s: f64, y: &[f64; N], j: &mut Matrix<f64>) {
        let n = self.n;
        let mut slopes = vec![0.0; n * n];
        self.write_slopes(s, y, &mut slopes);
        (0..n).for_each(|i| (0..n).for_each(|k| j[(i, k)] = slopes[i * n + k]));
    }
}

impl Padded<'_> {
    fn write_slopes<const N: usize>(&self, s: f64, y: &[f64; N], slopes: &mut [f64]) {
        if !self.parts.borrow_mut().1.write(s, &y[..self.n], slopes) {
            self.differences(s, y, slopes);
        }
    }

    fn differences<const N: usize>(&self, s: f64, y: &[f64; N], slopes: &mut [f64]) {
        let (mut here, mut there, mut moved) = ([0.0; N], [0.0; N], *y);
        self.diff(s, y, &mut here);
        for k in 0..self.n {
            let by = f64::EPSILON.sqrt() * y[k].abs().max(1e-5);
            moved[k] = y[k] + by;
            self.diff(s, &moved, &mut there);
            (0..self.n).for_each(|i| slopes[i * self.n + k] = (there[i] - here[i]) / by);
            moved[k] = y[k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A layer at the start moves something else and is over at once: it is met with steps as short, none of them in vain.
    #[test]
    fn a_layer_at_the_start_is_not_stepped_over() {
        for rate in [1e3, 1e6, 1e9] {
            let mut rates = |_: f64, y: &[f64], out: &mut [f64]| {
                out[0] = -rate * y[0];
                out[1] = rate * y[0] * y[0];
            };
            let span = Span { length: 1.0, first: 0.0, rtol: 1e-6, atol: 1e-9, most: 10_000 };
            let done = step_through(&mut rates, &mut Differences, &span, &[1.0, 0.0]).unwrap();
            assert!(done.y[0].abs() < 1e-6 && (done.y[1] - 0.5).abs() < 1e-8, "{rate}: {:?}", done.y);
            assert!(done.steps < 100, "{rate}: {} steps", done.steps);
        }
    }

    /// x' = x², y' = x·y far from one: a step that is not in proportion would lose all digits.
    #[test]
    fn differences_are_slopes_whatever_the_size() {
        let mut rates = |_: f64, y: &[f64], out: &mut [f64]| {
            out[0] = y[0] * y[0];
            out[1] = y[0] * y[1];
        };
        for size in [1e-3, 1.0, 1e6] {
            let mut differences = Differences;
            let padded = Padded { n: 2, parts: RefCell::new((&mut rates, &mut differences)) };
            let (y, mut slopes) = ([3.0 * size, -size, 7.0], [0.0; 4]);
            padded.differences(0.0, &y, &mut slopes);
            for (found, expected) in slopes.iter().zip([6.0 * size, 0.0, -size, 3.0 * size]) {
                assert!((found - expected).abs() < 1e-6 * size, "{slopes:?} at {size}");
            }
        }
    }
}
