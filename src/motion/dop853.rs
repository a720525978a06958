//! Dormand and Prince's method of order 8 with steps chosen by the tolerance, on memory that is used again.
//!
//! The algorithm is Hairer's program DOP853 with the constants of the crate `ode_solvers`, whose general vectors cost
//! several times what a wheel's three states do; tests hold one against the other.

use super::tableau::{E3, E5, ORDER_8};

const STAGES: usize = 12;
/// Bounds of the change of a step's length, and what is taken off it for safety.
const SHRINK: f64 = 0.333;
const GROW: f64 = 6.0;
const SAFETY: f64 = 0.9;

/// Why a run ended early.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stop {
    /// No step is short enough, at this time.
    Underflow(f64),
    /// So many steps were not enough, at this time.
    Steps(f64),
}

/// What a run has taken.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Effort {
    pub longest: f64,
    pub accepted: u32,
    pub rejected: u32,
}

/// Memory for runs of systems of one size.
#[derive(Clone, Debug, Default)]
pub(super) struct Dop853 {
    /// Rates, stage by stage.
    k: Vec<f64>,
    at: Vec<f64>,
    new: Vec<f64>,
    /// The rate at the new state.
    rate: Vec<f64>,
}

/// What a run is asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Request {
    pub from: f64,
    pub to: f64,
    pub rtol: f64,
    pub atol: f64,
    /// The first step, or zero to choose it.
    pub first: f64,
    pub most_steps: u32,
}

impl Dop853 {
    /// Advances y; the rate at its start has to be defined.
    pub fn run(
        &mut self,
        rhs: &mut impl FnMut(f64, &[f64], &mut [f64]),
        request: Request,
        y: &mut [f64],
    ) -> Result<Effort, Stop> {
        let n = y.len();
        self.k.resize(STAGES * n, 0.0);
        [&mut self.at, &mut self.new, &mut self.rate].into_iter().for_each(|v| v.resize(n, 0.0));
        let Request { from, to, .. } = request;
        let (length, sign) = ((to - from).abs(), (to - from).signum());
        let (mut t, mut effort, mut refused) = (from, Effort::default(), false);
        rhs(t, y, &mut self.k[..n]);
        let mut h = match request.first.min(length) {
            0.0 => self.first_step(rhs, request, y),
            first => first * sign,
        };
        loop {
            if effort.accepted + effort.rejected >= request.most_steps {
                return Err(Stop::Steps(t));
            }
            if 0.1 * h.abs() <= f64::EPSILON * (t - from).abs() || !h.is_finite() {
                return Err(Stop::Underflow(t));
            }
            let last = (t + 1.01 * h - to) * sign > 0.0;
            if last {
                h = to - t;
            }
            let error = self.step(rhs, request, (t, h), y);
            let change = error.powf(1.0 / 8.0) / SAFETY;
            if error <= 1.0 {
                effort.accepted += 1;
                effort.longest = effort.longest.max(h.abs());
                y.copy_from_slice(&self.new);
                if last {
                    return Ok(effort);
                }
                t += h;
                rhs(t, y, &mut self.rate);
                self.k[..n].copy_from_slice(&self.rate);
                let next = (h / change.clamp(1.0 / GROW, 1.0 / SHRINK)).abs().min(length);
                h = sign * if refused { next.min(h.abs()) } else { next };
                refused = false;
            } else {
                effort.rejected += u32::from(effort.accepted > 0);
                // Where the error is not a number, the step shrinks as far as it may.
                h /= change.min(1.0 / SHRINK);
                refused = true;
            }
        }
    }

    /// One step: the new state, and its error in units of the tolerance.
    fn step(
        &mut self,
        rhs: &mut impl FnMut(f64, &[f64], &mut [f64]),
        request: Request,
        (t, h): (f64, f64),
        y: &[f64],
    ) -> f64 {
        let n = y.len();
        for (s, row) in ORDER_8.a.iter().enumerate() {
            sum(&mut self.at, y, h, row, &self.k);
            let (_, k) = self.k.split_at_mut((s + 1) * n);
            rhs(t + ORDER_8.c[s + 1] * h, &self.at, &mut k[..n]);
        }
        sum(&mut self.new, y, h, ORDER_8.b, &self.k);
        let (mut fifth, mut third) = (0.0, 0.0);
        for (i, (old, new)) in y.iter().zip(&self.new).enumerate() {
            let k = |s: usize| self.k[s * n + i];
            let scale = request.atol + old.abs().max(new.abs()) * request.rtol;
            let e5: f64 = (0..STAGES).filter(|s| E5[*s] != 0.0).map(|s| E5[s] * k(s)).sum();
            let b: f64 = (0..STAGES).filter(|s| ORDER_8.b[*s] != 0.0).map(|s| ORDER_8.b[s] * k(s)).sum();
            let e3 = b - E3[0] * k(0) - E3[1] * k(8) - E3[2] * k(11);
            fifth += (e5 / scale).powi(2);
            third += (e3 / scale).powi(2);
        }
        let both = fifth + 0.01 * third;
        let both = if both <= 0.0 { 1.0 } else { both };
        // The time counts as a state without error, as where it is carried as one.
        h.abs() * fifth * (1.0 / (both * (n + 1) as f64)).sqrt()
    }

    /// A first step by the sizes of y, y′ and y″.
    fn first_step(&mut self, rhs: &mut impl FnMut(f64, &[f64], &mut [f64]), request: Request, y: &[f64]) -> f64 {
        let n = y.len();
        let (length, sign) = ((request.to - request.from).abs(), (request.to - request.from).signum());
        let norm = |v: &dyn Fn(usize) -> f64| -> f64 {
            (0..n).map(|i| (v(i) / (request.atol + y[i].abs() * request.rtol)).powi(2)).sum()
        };
        let f0 = &self.k[..n];
        let (d0, d1) = (norm(&|i| y[i]), norm(&|i| f0[i]));
        let h0 = if d0 < 1e-10 || d1 < 1e-10 { 1e-6 } else { 0.01 * (d0 / d1).sqrt() };
        let h0 = sign * h0.min(length);
        (0..n).for_each(|i| self.at[i] = y[i] + h0 * f0[i]);
        rhs(request.from + h0, &self.at, &mut self.rate);
        let d2 = norm(&|i| self.rate[i] - f0[i]).sqrt() / h0.abs();
        let largest = d1.sqrt().max(d2);
        let h1 = if largest <= 1e-15 { f64::max(1e-6, h0.abs() * 1e-3) } else { (0.01 / largest).powf(1.0 / 8.0) };
        sign * (100.0 * h0.abs()).min(h1).min(length)
    }
}

/// out = y + h·Σ weight·rate
fn sum(out: &mut [f64], y: &[f64], h: f64, weights: &[f64], k: &[f64]) {
    let n = y.len();
    out.copy_from_slice(y);
    for (weight, rate) in weights.iter().zip(k.chunks_exact(n)).filter(|(w, _)| **w != 0.0) {
        let w = h * weight;
        out.iter_mut().zip(rate).for_each(|(out, rate)| *out += w * rate);
    }
}
