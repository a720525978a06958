//! Dormand and Prince's method of order 8 with steps chosen by the tolerance, on memory that is used again.
//!
//! The algorithm is Hairer's program DOP853 with the constants of the crate `ode_solvers`, whose general vectors cost
//! several times what a wheel's three states do; tests hold one against the other.

use super::tableau::{E3, E5, ORDER_8};

const STAGES: usize = 12;
/// Stages that the result and its error read.
const USED: [usize; 8] = [0, 5, 6, 7, 8, 9, 10, 11];
/// Numbers that are summed together: rows of memory are so long, or a multiple, with zeros at their end.
const WIDTH: usize = 4;
type Wide = [f64; WIDTH];
/// Bounds of the change of a step's length, and what is taken off it for safety.
const SHRINK: f64 = 0.333;
const GROW: f64 = 6.0;
const SAFETY: f64 = 0.9;

/// Why a run ended early.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stop {
    /// The rate at the start is not a number.
    Undefined,
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
    k: Vec<Wide>,
    y: Vec<Wide>,
    at: Vec<Wide>,
    new: Vec<Wide>,
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
    /// Advances y.
    pub fn run(
        &mut self,
        rhs: &mut impl FnMut(f64, &[f64], &mut [f64]),
        request: Request,
        y: &mut [f64],
    ) -> Result<Effort, Stop> {
        let n = y.len();
        let row = n.div_ceil(WIDTH);
        self.k.resize(STAGES * row, [0.0; WIDTH]);
        [&mut self.y, &mut self.at, &mut self.new].into_iter().for_each(|v| v.resize(row, [0.0; WIDTH]));
        self.y.as_flattened_mut()[..n].copy_from_slice(y);
        let Request { from, to, .. } = request;
        let (length, sign) = ((to - from).abs(), (to - from).signum());
        let (mut t, mut effort, mut refused) = (from, Effort::default(), false);
        rhs(t, y, &mut self.k.as_flattened_mut()[..n]);
        if !self.k.as_flattened()[..n].iter().all(|v| v.is_finite()) {
            return Err(Stop::Undefined);
        }
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
            let error = self.step(rhs, request, (t, h), n);
            let change = error.powf(1.0 / 8.0) / SAFETY;
            if error <= 1.0 {
                effort.accepted += 1;
                effort.longest = effort.longest.max(h.abs());
                std::mem::swap(&mut self.y, &mut self.new);
                if last {
                    y.copy_from_slice(&self.y.as_flattened()[..n]);
                    return Ok(effort);
                }
                t += h;
                rhs(t, &self.y.as_flattened()[..n], &mut self.k.as_flattened_mut()[..n]);
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
        n: usize,
    ) -> f64 {
        // Written out, so that the weights are numbers in the code.
        self.stage::<1>(rhs, (t, h), n);
        self.stage::<2>(rhs, (t, h), n);
        self.stage::<3>(rhs, (t, h), n);
        self.stage::<4>(rhs, (t, h), n);
        self.stage::<5>(rhs, (t, h), n);
        self.stage::<6>(rhs, (t, h), n);
        self.stage::<7>(rhs, (t, h), n);
        self.stage::<8>(rhs, (t, h), n);
        self.stage::<9>(rhs, (t, h), n);
        self.stage::<10>(rhs, (t, h), n);
        self.stage::<11>(rhs, (t, h), n);
        sum(&mut self.new, &self.y, h, ORDER_8.b, &self.k);
        self.error(request, h, n)
    }

    #[inline(always)]
    fn stage<const S: usize>(&mut self, rhs: &mut impl FnMut(f64, &[f64], &mut [f64]), (t, h): (f64, f64), n: usize) {
        let (before, k) = self.k.split_at_mut(S * self.y.len());
        sum(&mut self.at, &self.y, h, ORDER_8.a[S - 1], before);
        rhs(t + ORDER_8.c[S] * h, &self.at.as_flattened()[..n], &mut k.as_flattened_mut()[..n]);
    }

    fn error(&self, request: Request, h: f64, n: usize) -> f64 {
        let (mut fifth, mut third) = (0.0, 0.0);
        let row = self.y.len();
        for (i, (old, new)) in self.y.iter().zip(&self.new).enumerate() {
            let (mut e5, mut b) = ([0.0; WIDTH], [0.0; WIDTH]);
            for s in USED {
                let k = &self.k[s * row + i];
                for l in 0..WIDTH {
                    e5[l] += E5[s] * k[l];
                    b[l] += ORDER_8.b[s] * k[l];
                }
            }
            for l in 0..WIDTH.min(n - i * WIDTH) {
                let k = |s: usize| self.k[s * row + i][l];
                let scale = request.atol + old[l].abs().max(new[l].abs()) * request.rtol;
                let e3 = b[l] - E3[0] * k(0) - E3[1] * k(8) - E3[2] * k(11);
                fifth += (e5[l] / scale).powi(2);
                third += (e3 / scale).powi(2);
            }
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
        let (f0, at, rate) = (self.k.as_flattened(), self.at.as_flattened_mut(), self.new.as_flattened_mut());
        let (d0, d1) = (norm(&|i| y[i]), norm(&|i| f0[i]));
        let h0 = if d0 < 1e-10 || d1 < 1e-10 { 1e-6 } else { 0.01 * (d0 / d1).sqrt() };
        let h0 = sign * h0.min(length);
        (0..n).for_each(|i| at[i] = y[i] + h0 * f0[i]);
        rhs(request.from + h0, &at[..n], &mut rate[..n]);
        let d2 = norm(&|i| rate[i] - f0[i]).sqrt() / h0.abs();
        let largest = d1.sqrt().max(d2);
        let h1 = if largest <= 1e-15 { f64::max(1e-6, h0.abs() * 1e-3) } else { (0.01 / largest).powf(1.0 / 8.0) };
        sign * (100.0 * h0.abs()).min(h1).min(length)
    }
}

/// out = y + h·Σ weight·rate, each number by itself.
#[inline(always)]
fn sum(out: &mut [Wide], y: &[Wide], h: f64, weights: &[f64], k: &[Wide]) {
    let terms = || weights.iter().enumerate().filter(|(_, w)| **w != 0.0).map(|(s, w)| (s, h * w));
    // One width stays in the processor's registers.
    if let ([out], [y]) = (&mut *out, y) {
        let mut total = *y;
        for (s, w) in terms() {
            for l in 0..WIDTH {
                total[l] += w * k[s][l];
            }
        }
        *out = total;
        return;
    }
    let row = y.len();
    out.copy_from_slice(y);
    for (s, w) in terms() {
        let rate = k[s * row..][..row].as_flattened();
        out.as_flattened_mut().iter_mut().zip(rate).for_each(|(out, rate)| *out += w * rate);
    }
}
