//! Dormand and Prince's method of order 8 with steps chosen by the tolerance, on memory that is used again.
//!
//! The algorithm is Hairer's program DOP853 with the constants of the crate `ode_solvers`, whose general vectors cost
//! several times what a wheel's three states do; tests hold one against the other.

use super::tableau::{E3, E5, ORDER_8};

const STAGES: usize = 12;
/// Stages that the result and its error read.
const READ_STAGES: [usize; 8] = [0, 5, 6, 7, 8, 9, 10, 11];
/// Numbers that are summed together: rows of memory are so long, or a multiple, with zeros at their end.
const VECTOR_WIDTH: usize = 4;
type Wide = [f64; VECTOR_WIDTH];
/// The least and the greatest ratio of a step to the one before, and the safety factor: Hairer's DOP853 has 0.333, 6 and 0.9.
const MIN_STEP_RATIO: f64 = 0.333;
const MAX_STEP_RATIO: f64 = 6.0;
const SAFETY: f64 = 0.9;

/// Why a run ended early.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Stop {
    /// The rate at the start is not a number.
    Undefined,
    /// No step is short enough, at this time.
    Underflow(f64),
    /// So many steps were not enough, at this time.
    Steps(f64),
}

/// What a run has taken.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Effort {
    pub longest: f64,
    pub accepted: u32,
    pub rejected: u32,
}

/// Memory for runs of systems of one size.
#[derive(Clone, Debug, Default)]
pub(crate) struct Dop853 {
    /// Rates, stage by stage.
    k: Vec<Wide>,
    y: Vec<Wide>,
    at: Vec<Wide>,
    new: Vec<Wide>,
}

/// What a run is asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request {
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
        let row = n.div_ceil(VECTOR_WIDTH);
        self.k.resize(STAGES * row, [0.0; VECTOR_WIDTH]);
        [&mut self.y, &mut self.at, &mut self.new].into_iter().for_each(|v| v.resize(row, [0.0; VECTOR_WIDTH]));
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
                let next = (h / change.clamp(1.0 / MAX_STEP_RATIO, 1.0 / MIN_STEP_RATIO)).abs().min(length);
                h = sign * if refused { next.min(h.abs()) } else { next };
                refused = false;
            } else {
                effort.rejected += u32::from(effort.accepted > 0);
                // Where the error is not a number, the step shrinks as far as it may.
                h /= change.min(1.0 / MIN_STEP_RATIO);
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
            let (mut e5, mut b) = ([0.0; VECTOR_WIDTH], [0.0; VECTOR_WIDTH]);
            for s in READ_STAGES {
                let k = &self.k[s * row + i];
                for l in 0..VECTOR_WIDTH {
                    e5[l] += E5[s] * k[l];
                    b[l] += ORDER_8.b[s] * k[l];
                }
            }
            for l in 0..VECTOR_WIDTH.min(n - i * VECTOR_WIDTH) {
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
            for l in 0..VECTOR_WIDTH {
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

#[cfg(test)]
mod tests {
    use super::*;
    use ode_solvers::dop_shared::{OutputType, Stats};
    use ode_solvers::{DVector, System};

    type Rates = fn(f64, &[f64], &mut [f64]);

    /// With one more state for the crate: the time, since at the end of a step it asks for rates of a wrong time; or, where
    /// it is to choose the first step by the states, one that rests.
    struct Longer(Rates, f64);

    impl System<f64, DVector<f64>> for Longer {
        fn system(&self, _: f64, y: &DVector<f64>, dy: &mut DVector<f64>) {
            let n = y.len() - 1;
            (self.0)(y[n], &y.as_slice()[..n], &mut dy.as_mut_slice()[..n]);
            dy[n] = self.1;
        }
    }

    /// The crate's steps: their ends, how many there were, and the last state.
    fn theirs(f: Rates, request: Request, y: &[f64], [start, pace]: [f64; 2]) -> (Vec<f64>, Stats, Vec<f64>) {
        let Request { from, to, rtol, atol, first, most_steps } = request;
        let start = DVector::from_iterator(y.len() + 1, y.iter().copied().chain([start]));
        let (span, first, never) = ((to - from).abs(), first * (to - from).signum(), u32::MAX);
        let (f, sparse) = (Longer(f, pace), OutputType::Sparse);
        let mut s = ode_solvers::Dop853::from_param(
            f,
            from,
            to,
            span,
            start,
            rtol,
            atol,
            SAFETY,
            0.0,
            MIN_STEP_RATIO,
            MAX_STEP_RATIO,
            span,
            first,
            most_steps,
            never,
            sparse,
        );
        let stats = s.integrate().unwrap();
        (s.x_out().clone(), stats, s.y_out().last().unwrap().as_slice()[..y.len()].to_vec())
    }

    const PENDULUM: Rates = |t, y, dy| {
        dy[0] = y[1];
        dy[1] = t.cos() - y[0].sin();
    };
    /// Relaxes and jumps: steps are refused.
    const VAN_DER_POL: Rates = |_, y, dy| {
        dy[0] = y[1];
        dy[1] = 10.0 * (1.0 - y[0] * y[0]) * y[1] - y[0];
    };
    const GROWTH: Rates = |t, y, dy| dy[0] = y[0] * t.cos();
    const CHAIN: Rates = |t, y, dy| {
        for i in 0..y.len() {
            dy[i] = (t * (1.0 + i as f64)).sin() - y[i] * y[(i + 1) % y.len()];
        }
    };

    /// Step by step what the crate does, whatever the number of states, forwards and back.
    #[test]
    fn steps_are_those_of_the_crate() {
        let mut refused = 0;
        for (f, y, to) in [
            (PENDULUM, vec![1.0, 0.0], 20.0),
            (VAN_DER_POL, vec![2.0, 0.0], 30.0),
            (GROWTH, vec![3.0], -7.0),
            (CHAIN, vec![0.5, 0.1, 0.2, 0.3], 8.0),
            (CHAIN, vec![0.5; 5], 8.0),
            (CHAIN, (0..11).map(|i| 0.1 * f64::from(i)).collect(), -0.5),
        ] {
            for (rtol, atol) in [(1e-4, 1e-4), (1e-8, 1e-10), (1e-11, 1e-6)] {
                let request = Request { from: 0.25, to, rtol, atol, first: 0.05, most_steps: 100_000 };
                let (ends, stats, wanted) = theirs(f, request, &y, [request.from, 1.0]);
                let mut found = y.clone();
                let effort = Dop853::default().run(&mut { f }, request, &mut found).unwrap();
                assert_eq!(
                    (effort.accepted, effort.rejected),
                    (stats.accepted_steps, stats.rejected_steps),
                    "{to} {rtol}"
                );
                refused += effort.rejected;
                let longest = ends.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max);
                assert!((effort.longest - longest).abs() < 1e-6 * longest, "{effort:?} {longest}");
                for (found, wanted) in found.iter().zip(&wanted) {
                    assert!((found - wanted).abs() < 1e-9 * wanted.abs().max(1.0), "{found} {wanted}");
                }
                // So many steps are enough, and one fewer is not.
                let taken = effort.accepted + effort.rejected;
                let limited =
                    |most_steps| Dop853::default().run(&mut { f }, Request { most_steps, ..request }, &mut y.clone());
                assert_eq!(limited(taken), Ok(effort));
                assert!(matches!(limited(taken - 1), Err(Stop::Steps(_))));
            }
        }
        assert!(refused > 20, "{refused}");
    }

    /// The first step of ours, where none is given.
    fn first(f: Rates, request: Request, y: &[f64]) -> f64 {
        match Dop853::default().run(&mut { f }, Request { first: 0.0, most_steps: 1, ..request }, &mut y.to_vec()) {
            Err(Stop::Steps(t)) => t,
            Ok(effort) => effort.longest * request.to.signum(),
            other => panic!("{other:?}"),
        }
    }

    /// That of the crate from states and rates of every size; back in time that of the mirrored motion, where the crate has
    /// a slip of the sign.
    #[test]
    fn first_steps_are_those_of_the_crate() {
        const MIRRORED: Rates = |t, y, dy| {
            VAN_DER_POL(t, y, dy);
            dy.iter_mut().for_each(|v| *v = -*v);
        };
        const REST: Rates = |_, _, dy| dy.fill(0.0);
        const FALL: Rates = |_, y, dy| {
            dy[0] = y[1];
            dy[1] = 1e-3;
        };
        for (rtol, atol) in [(1e-4, 1e-4), (1e-8, 1e-10), (0.0, 1e-3)] {
            let request = |to| Request { from: 0.0, to, rtol, atol, first: 0.0, most_steps: 100_000 };
            for (f, y, to) in [
                (VAN_DER_POL, [2.0, 0.0], 30.0),
                (VAN_DER_POL, [2.0, 0.5], 3.0),
                (VAN_DER_POL, [0.0, 0.0], 3.0),
                (VAN_DER_POL, [1e-20, 1e-9], 3.0),
                (FALL, [0.0, 0.0], 50.0),
                (FALL, [1e3, 0.0], 50.0),
                (FALL, [1e9, 1e-9], 50.0),
                (FALL, [1e9, 1.0], 1e-3),
                (REST, [1.0, 2.0], 5.0),
                (REST, [0.0, 0.0], 5.0),
            ] {
                let (found, wanted) = (first(f, request(to), &y), theirs(f, request(to), &y, [0.0, 0.0]).0[1]);
                assert!((found - wanted).abs() <= 1e-12 * wanted, "{y:?} to {to}, {rtol}: {found} {wanted}");
            }
            for y in [[2.0, 0.0], [2.0, 0.5], [1e-20, 1e-9]] {
                assert_eq!(first(VAN_DER_POL, request(-3.0), &y), -first(MIRRORED, request(3.0), &y), "{y:?}");
            }
        }
    }

    /// What has no solution to its end is left where it stops, whichever way it goes.
    #[test]
    fn a_solution_without_an_end_is_left_there() {
        const BLOWS_UP: Rates = |_, y, dy| dy[0] = y[0] * y[0];
        const ENDS: Rates = |t, _, dy| dy[0] = if t.abs() < 0.7 { 1.0 } else { f64::NAN };
        for sign in [1.0, -1.0] {
            let request =
                Request { from: 0.0, to: 2.0 * sign, rtol: 1e-10, atol: 1e-12, first: 0.0, most_steps: 10_000 };
            let run = |f: Rates| Dop853::default().run(&mut { f }, request, &mut [sign]);
            let Err(Stop::Underflow(at)) = run(BLOWS_UP) else { panic!("{:?}", run(BLOWS_UP)) };
            assert!((at - sign).abs() < 1e-9, "{at}");
            let Err(Stop::Underflow(at)) = run(ENDS) else { panic!("{:?}", run(ENDS)) };
            assert!((at - 0.7 * sign).abs() < 1e-12, "{at}");
            assert_eq!(run(|_, _, dy| dy[0] = f64::NAN), Err(Stop::Undefined));
        }
    }
}
