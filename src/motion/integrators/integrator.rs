//! The one place where differential equations are integrated: orders 4 and 5 by the crate `ode_solvers`, order 8 by
//! [`Dop853`] of our own, and stiff ones by the crate `differential-equations` (see `radau.rs`).
//!
//! What was found in the crate's source and by running it (0.6.2), and what is done about it here:
//!
//! | the crate | here |
//! |---|---|
//! | `Dop853` has c₁₂ = 0 in its table where c₁₂ = 1 belongs, so on y′ = f(t, y) it has order 1; its vectors are made anew in every stage, three times the time of a wheel's own equations | not used |
//! | other methods read the time they are given | time is a state, t′ = 1, and the crate's own time is never read |
//! | dense output extrapolates, compares absolute times, loops forever or panics at negative or falling times | only `OutputType::Sparse`; a run is a chain of spans, each from 0 to its length, going forward |
//! | `Rk4` takes ⌈length/step⌉ steps of the given size: it overshoots, by a whole step when the quotient is rounded up | the step is length/n and the end is set half a step short, so that exactly n are taken |
//! | `Rk4` returns `Ok` on NaN and panics where the number of steps is not a number | the result is checked; the number of steps is computed here |
//! | a span of no length is a step size underflow | it returns its start |
//! | an undefined right-hand side at the start gives a first step that is NaN and 100,000 steps of NaN | the start is evaluated before |
//! | an absolute tolerance of zero divides zero by zero where a state is zero | it is refused |
//! | `hinit` makes the first step of every span small | a span starts from the longest step of the span before |
//! | the test for stiffness ends a run that is only slow | it is switched off; `max_steps` bounds the work |
//! | `Dopri5` allows one step more than `n_max` | left so |

use super::dop853;
use super::dop853::{Dop853, Request};
use super::radau;
use super::radau::{Differences, Slopes};
use crate::error::{Error, Result};
use ode_solvers::dop_shared::IntegrationError;
use ode_solvers::{DVector, Dopri5, OutputType, Rk4, System};
use std::cell::{Cell, RefCell};

/// A Runge–Kutta method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Dormand and Prince of order 5, steps chosen by the tolerance.
    Dopri5,
    /// Dormand and Prince of order 8, steps chosen by the tolerance.
    Dop853,
    /// The same, or quadrature at its tolerances where the heading of a vehicle hangs on the inputs alone.
    Automatic,
    /// The classical one of order 4 with steps of equal length; tolerances are not read.
    Rk4 {
        /// The longest step, s; it is shortened to divide each span.
        step: f64,
    },
    /// Radau IIA of order 5, implicit and L-stable, for stiff equations: its steps follow the solution and not the
    /// shortest time constant. With exact slopes by [`Integrator::solve_with_slopes`], else with differences.
    Radau5,
}

/// Integrates y′ = f(t, y) to given times, forward or backward, through any sign of time.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | rtol | 1 | error of a step allowed per size of each component |
/// | atol | as y | error of a step allowed besides, greater than zero |
/// | max_steps | 1 | steps of a whole call, after which it gives up |
///
/// Validity: f is smooth between the times; put kinks of f among them. Each time is stepped to exactly.
///
/// Source: E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, II.4–II.5; of Radau IIA
/// E. Hairer, G. Wanner, *II*, IV.8.
///
/// ```
/// use creepage::motion::Integrator;
/// // y' = cos(t)·y, y(0) = 1: y = exp(sin t), asked for backward in time.
/// let rows = Integrator::default().solve(|t, y, dy| dy[0] = t.cos() * y[0], 0.0, &[1.0], &[-1.0, -2.0]).unwrap();
/// assert!((rows[1][0] - (-2f64).sin().exp()).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integrator {
    /// The method.
    pub method: Method,
    /// Relative tolerance.
    pub rtol: f64,
    /// Absolute tolerance.
    pub atol: f64,
    /// The most steps of one call.
    pub max_steps: u32,
}

impl Default for Integrator {
    /// Quadrature or order 8 at 1e-10 relative and 1e-12 absolute.
    fn default() -> Self {
        Self { method: Method::Automatic, rtol: 1e-10, atol: 1e-12, max_steps: 10_000_000 }
    }
}

impl Integrator {
    /// The same method at other tolerances.
    pub fn with_tolerance(self, rtol: f64, atol: f64) -> Self {
        Self { rtol, atol, ..self }
    }

    /// The stiff method where contacts have friction, which may be stiff; else the same.
    pub(crate) fn for_friction(self, has_friction: bool) -> Self {
        if has_friction { Self { method: Method::Radau5, ..self } } else { self }
    }

    /// The states at `times`, which are visited in the order they are given, from y(t0) = y0.
    ///
    /// `rhs` writes f(t, y) into its last argument.
    ///
    /// # Errors
    /// When a number given is not finite, a tolerance or step is not positive, f is undefined on the way
    /// (NaN or infinite), the solution grows beyond bounds, or `max_steps` are not enough.
    pub fn solve(
        &self,
        rhs: impl FnMut(f64, &[f64], &mut [f64]),
        t0: f64,
        y0: &[f64],
        times: &[f64],
    ) -> Result<Vec<Vec<f64>>> {
        self.visit(rhs, Differences, t0, y0, times)
    }

    /// As [`Integrator::solve`], with the exact ∂f/∂y for [`Method::Radau5`]; the other methods do not read it.
    ///
    /// `slopes` writes ∂fᵢ/∂yⱼ row by row into its last argument, n·n numbers.
    ///
    /// # Errors
    /// As [`Integrator::solve`].
    ///
    /// ```
    /// use creepage::motion::{Integrator, Method};
    /// // y' = -1e6 (y - cos t): after an instant y is cos t, and the work does not follow the 1e6.
    /// let stiff = Integrator { method: Method::Radau5, max_steps: 300, ..Integrator::default() };
    /// let f = |t: f64, y: &[f64], dy: &mut [f64]| dy[0] = -1e6 * (y[0] - t.cos());
    /// let end = stiff.solve_with_slopes(f, |_, _, j: &mut [f64]| j[0] = -1e6, 0.0, &[2.0], &[10.0]).unwrap();
    /// assert!((end[0][0] - 10f64.cos()).abs() < 1e-6);
    /// ```
    pub fn solve_with_slopes(
        &self,
        rhs: impl FnMut(f64, &[f64], &mut [f64]),
        slopes: impl FnMut(f64, &[f64], &mut [f64]),
        t0: f64,
        y0: &[f64],
        times: &[f64],
    ) -> Result<Vec<Vec<f64>>> {
        self.visit(rhs, slopes, t0, y0, times)
    }

    fn visit(
        &self,
        mut rhs: impl FnMut(f64, &[f64], &mut [f64]),
        mut slopes: impl Slopes,
        t0: f64,
        y0: &[f64],
        times: &[f64],
    ) -> Result<Vec<Vec<f64>>> {
        let mut walk = self.walk()?;
        let (mut t, mut y) = (t0, y0.to_vec());
        let mut visit = |to: &f64| {
            y = walk.span(&mut rhs, &mut slopes, t, *to, &y)?;
            t = *to;
            Ok(y.clone())
        };
        times.iter().map(&mut visit).collect()
    }

    /// Begins a chain of spans.
    pub(crate) fn walk(&self) -> Result<Walk> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        let sound = match self.method {
            Method::Rk4 { step } => positive(step),
            _ => positive(self.atol) && self.rtol.is_finite() && self.rtol >= 0.0,
        };
        if !sound {
            return Err(Error::input("the integrator's step and absolute tolerance have to be positive numbers")
                .help("use the default tolerances"));
        }
        Ok(Walk { integrator: *self, memory: Dop853::default(), first: 0.0, left: self.max_steps })
    }
}

/// What the crate gives for a span.
type Stepped = std::result::Result<DVector<f64>, IntegrationError>;

/// A chain of spans under way: the next first step and how many steps are left.
pub(crate) struct Walk {
    integrator: Integrator,
    memory: Dop853,
    first: f64,
    left: u32,
}

impl Walk {
    /// The state at `to` from the state at `from`.
    pub(crate) fn span(
        &mut self,
        rhs: &mut impl FnMut(f64, &[f64], &mut [f64]),
        slopes: &mut impl Slopes,
        from: f64,
        to: f64,
        y: &[f64],
    ) -> Result<Vec<f64>> {
        if !(from.is_finite() && to.is_finite() && y.iter().all(|v| v.is_finite())) {
            return Err(Error::run(format!("an integration from t = {from} to {to} needs finite numbers")));
        }
        if from == to {
            return Ok(y.to_vec());
        }
        if self.integrator.method == Method::Radau5 && y.len() > radau::MAX_STATES {
            let message = format!("{} states are more than the {} of the stiff method", y.len(), radau::MAX_STATES);
            return Err(Error::run(message).help("use an explicit method"));
        }
        if matches!(self.integrator.method, Method::Dop853 | Method::Automatic) {
            return self.order_8(rhs, from, to, y);
        }
        let (undefined, rhs) = (Cell::new(false), RefCell::new(rhs));
        let system = Clocked { rhs: &rhs, undefined: &undefined, from, direction: (to - from).signum() };
        let start = DVector::from_iterator(y.len() + 1, y.iter().copied().chain([0.0]));
        system.system(0.0, &start, &mut start.clone());
        if undefined.get() {
            return Err(Error::run(format!("the equations of motion are undefined at t = {from}")));
        }
        let at = |s: f64| from + s * (to - from).signum();
        let end = match self.integrator.method {
            Method::Radau5 => self.implicit(&system, slopes, (to - from).abs(), y),
            Method::Rk4 { step } => self.even_steps(system, (to - from).abs(), start, step),
            _ => self.order_5(system, (to - from).abs(), start),
        };
        let end = end.map_err(|e| self.explain(&e, undefined.get(), at))?;
        let end = &end.as_slice()[..y.len()];
        match end.iter().all(|v| v.is_finite()) {
            true => Ok(end.to_vec()),
            false => Err(Error::run(format!("the equations of motion are undefined between t = {from} and {to}"))),
        }
    }

    /// The stiff method through a span.
    fn implicit<F>(&mut self, system: &Clocked<F>, slopes: &mut impl Slopes, length: f64, y: &[f64]) -> Stepped
    where
        F: FnMut(f64, &[f64], &mut [f64]),
    {
        let Integrator { rtol, atol, .. } = self.integrator;
        let (from, direction) = (system.from, system.direction);
        let mut rates = |s: f64, y: &[f64], dy: &mut [f64]| system.rates(s, y, dy);
        let mut slopes = radau::Retimed { slopes, time: |s| from + direction * s, factor: direction };
        let span = radau::Span { length, first: self.first, rtol, atol, most: self.left };
        let done = radau::step_through(&mut rates, &mut slopes, &span, y)?;
        self.first = done.next;
        self.left = self.left.saturating_sub(done.steps);
        Ok(DVector::from_vec(done.y))
    }

    /// A span of order 8.
    fn order_8(
        &mut self,
        rhs: &mut impl FnMut(f64, &[f64], &mut [f64]),
        from: f64,
        to: f64,
        y: &[f64],
    ) -> Result<Vec<f64>> {
        let undefined = Cell::new(false);
        let mut watched = |t: f64, y: &[f64], rates: &mut [f64]| {
            rhs(t, y, rates);
            undefined.set(!rates.iter().all(|v| v.is_finite()));
        };
        let mut end = y.to_vec();
        let Integrator { rtol, atol, .. } = self.integrator;
        let request = Request { from, to, rtol, atol, first: self.first, most_steps: self.left };
        let done = self.memory.run(&mut watched, request, &mut end).map_err(|stop| match stop {
            dop853::Stop::Undefined => Error::run(format!("the equations of motion are undefined at t = {from}")),
            dop853::Stop::Underflow(x) => {
                self.explain(&IntegrationError::StepSizeUnderflow { x }, undefined.get(), |x| x)
            }
            dop853::Stop::Steps(x) => {
                self.explain(&IntegrationError::MaxNumStepReached { x, n_step: self.left }, undefined.get(), |x| x)
            }
        })?;
        self.account(done.longest, done.accepted, done.rejected);
        match end.iter().all(|v| v.is_finite()) {
            true => Ok(end),
            false => Err(Error::run(format!("the equations of motion are undefined between t = {from} and {to}"))),
        }
    }

    /// A span of order 5.
    fn order_5(&mut self, system: impl System<f64, DVector<f64>>, length: f64, y: DVector<f64>) -> Stepped {
        let Integrator { rtol, atol, .. } = self.integrator;
        let (first, n_max, never, sparse) = (self.first.min(length), self.left, u32::MAX, OutputType::Sparse);
        let mut s = Dopri5::from_param(
            system, 0.0, length, length, y, rtol, atol, 0.9, 0.04, 0.2, 10.0, length, first, n_max, never, sparse,
        );
        let stats = s.integrate()?;
        self.account(longest(s.x_out()), stats.accepted_steps, stats.rejected_steps);
        s.y_out().last().cloned().ok_or(IntegrationError::StepSizeUnderflow { x: 0.0 })
    }

    /// A span of order 4 in steps of equal length, at most `step`.
    fn even_steps(
        &mut self,
        system: impl System<f64, DVector<f64>>,
        length: f64,
        y: DVector<f64>,
        step: f64,
    ) -> Stepped {
        let n = (length / step * (1.0 - 1e-12)).ceil().max(1.0);
        if n > f64::from(self.left) {
            return Err(IntegrationError::MaxNumStepReached { x: 0.0, n_step: self.left });
        }
        let h = length / n;
        let mut s = Rk4::new(system, 0.0, y, (n - 0.5) * h, h);
        let stats = s.integrate()?;
        self.account(h, stats.accepted_steps, stats.rejected_steps);
        s.y_out().last().cloned().ok_or(IntegrationError::StepSizeUnderflow { x: 0.0 })
    }

    /// Notes the work done. A span of one step says nothing against longer ones; where it took several, the next
    /// begins with little more than the longest of them, since a first step that is refused is a step wasted.
    fn account(&mut self, longest: f64, accepted: u32, rejected: u32) {
        self.first = if accepted == 1 { self.first.max(2.0 * longest) } else { 1.2 * longest };
        self.left = self.left.saturating_sub(accepted + rejected);
    }

    fn explain(&self, e: &IntegrationError, undefined: bool, at: impl Fn(f64) -> f64) -> Error {
        match e {
            IntegrationError::StepSizeUnderflow { x } if undefined => {
                Error::run(format!("the equations of motion are undefined near t = {}", at(*x)))
            }
            IntegrationError::StepSizeUnderflow { x } | IntegrationError::StiffnessDetected { x } => {
                Error::run(format!("no step is short enough for the tolerance near t = {}", at(*x)))
                    .help("loosen the tolerance, or look for a solution that grows beyond bounds there")
            }
            IntegrationError::MaxNumStepReached { x, .. } => {
                Error::run(format!("{} steps were not enough; stopped at t = {}", self.integrator.max_steps, at(*x)))
                    .help("loosen the tolerance, or look for a time constant far shorter than the run")
            }
        }
    }
}

/// The longest of the steps taken.
fn longest(times: &[f64]) -> f64 {
    times.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max)
}

/// y′ = f(t, y) with the time that has passed as its last state.
struct Clocked<'a, F> {
    rhs: &'a RefCell<F>,
    undefined: &'a Cell<bool>,
    from: f64,
    direction: f64,
}

impl<F: FnMut(f64, &[f64], &mut [f64])> Clocked<'_, F> {
    fn rates(&self, passed: f64, y: &[f64], rates: &mut [f64]) {
        (self.rhs.borrow_mut())(self.from + self.direction * passed, y, rates);
        rates.iter_mut().for_each(|v| *v *= self.direction);
        self.undefined.set(!rates.iter().all(|v| v.is_finite()));
    }
}

impl<F: FnMut(f64, &[f64], &mut [f64])> System<f64, DVector<f64>> for Clocked<'_, F> {
    fn system(&self, _: f64, y: &DVector<f64>, dy: &mut DVector<f64>) {
        let n = y.len() - 1;
        self.rates(y[n], &y.as_slice()[..n], &mut dy.as_mut_slice()[..n]);
        dy[n] = 1.0;
    }
}
