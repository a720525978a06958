//! Fixed steps with exact sensitivities along several arcs side by side.

use super::Signals;
use super::lookup::Lookup;
use super::stepper::Arc;
use crate::formula::{Isa, Kernel};
use crate::model::{Equations, Workspace};

/// Largest angle the vehicle may turn within one step, rad.
const TURN_PER_STEP: f64 = 0.1;
/// Largest step in units of the shortest time constant.
const STEP_PER_TIME_CONSTANT: f64 = 0.35;
/// Most steps between two rows: a time constant of a millisecond is followed through rows a second apart.
const MAX_STEPS: f64 = 4096.0;

/// Integrates [`Equations`] along [`Signals`] by the classical Runge–Kutta scheme of order four, L states beside their
/// sensitivities S = ∂z/∂(visible start, p) by the variational equations.
///
/// S′ = J_z·S + [0 | J_p − J_u·u̇·∂delay/∂p], one compiled evaluation a stage. The step adapts to the yaw rate
/// and to the shortest time constant of the states, so the same code serves 10 Hz logs and stiff hidden states. Every
/// arc has steps of its own: the results are those of one arc alone, bit for bit.
pub(crate) struct LaneStepper<'a, const L: usize> {
    motion: Motion<'a, L>,
    rate: Arcs<L>,
    total: Arcs<L>,
    at: Arcs<L>,
    isa: Isa,
}

/// L states and their sensitivities; S is stored row by row, with [`Equations::visible`] + p columns, or empty when it is
/// not wanted.
#[derive(Clone, Debug, Default)]
pub(crate) struct Arcs<const L: usize> {
    pub z: Vec<[f64; L]>,
    pub s: Vec<[f64; L]>,
}

impl<const L: usize> Arcs<L> {
    /// One of the arcs.
    pub fn one(&self, l: usize) -> Arc {
        let lane = |values: &[[f64; L]]| values.iter().map(|v| v[l]).collect();
        Arc { z: lane(&self.z), s: lane(&self.s) }
    }
}

/// z′ and S′ as functions of time.
struct Motion<'a, const L: usize> {
    equations: &'a Equations,
    signals: &'a Signals,
    workspace: Workspace<L>,
    lookup: Lookup<L>,
    delay: [f64; L],
    delay_slopes: Vec<[f64; L]>,
    /// Columns of S before this one stay as they are.
    first: usize,
    /// Which states each rate depends on.
    read_by: Vec<Vec<usize>>,
}

impl<'a, const L: usize> LaneStepper<'a, L> {
    /// Equations along signals, each arc at its own parameters.
    pub fn new(equations: &'a Equations, signals: &'a Signals, p: [&[f64]; L]) -> Self {
        let mut workspace = equations.side_by_side(p);
        let delay = equations.delays(&mut workspace).to_vec();
        let motion = Motion {
            equations,
            signals,
            lookup: Lookup::new(signals),
            workspace,
            delay: delay[0],
            delay_slopes: delay[1..].to_vec(),
            first: equations.unread(),
            read_by: equations.read_by(),
        };
        Self { motion, rate: Arcs::default(), total: Arcs::default(), at: Arcs::default(), isa: Isa::best() }
    }

    /// Columns of the sensitivities.
    pub fn columns(&self) -> usize {
        self.motion.columns()
    }

    /// The instructions that kernels of a caller are to use.
    pub fn isa(&self) -> Isa {
        self.isa
    }

    /// The inputs that act at some times.
    pub fn inputs(&mut self, t: &[f64; L]) -> &[[f64; L]] {
        self.motion.look_up(t);
        &self.motion.lookup.value
    }

    /// Advances arcs from some times to others; where both are the same an arc stays as it is.
    pub fn advance(&mut self, z: &mut [[f64; L]], s: &mut [[f64; L]], from: &[f64; L], to: &[f64; L]) {
        let isa = if s.is_empty() { Isa::default() } else { self.isa };
        isa.dispatch(Advance { stepper: self, z, s, from, to });
    }

    /// As [`LaneStepper::advance`], inlined into a kernel of the caller.
    #[inline(always)]
    pub fn advance_here(&mut self, z: &mut [[f64; L]], s: &mut [[f64; L]], from: &[f64; L], to: &[f64; L]) {
        let Self { motion, rate, total, at, .. } = self;
        for arcs in [&mut *rate, &mut *total, &mut *at] {
            arcs.z.resize(z.len(), [0.0; L]);
            arcs.s.resize(s.len(), [0.0; L]);
        }
        motion.rate(z, s, from, rate);
        let mut span = [0.0; L];
        for l in 0..L {
            span[l] = to[l] - from[l];
        }
        let steps = motion.steps(z, s, &rate.z, &span);
        let (mut h, mut most) = ([0.0; L], 0.0);
        for l in 0..L {
            h[l] = span[l] / if steps[l] == 0.0 { 1.0 } else { steps[l] };
            most = if steps[l] > most { steps[l] } else { most };
        }
        for i in 0..most as usize {
            let mut t = [0.0; L];
            for l in 0..L {
                t[l] = from[l] + h[l] * i as f64;
            }
            if i > 0 {
                motion.rate(z, s, &t, rate);
            }
            motion.step(z, s, (&t, &h), rate, total, at);
            let mut wanted = [false; L];
            for l in 0..L {
                wanted[l] = (i as f64) < steps[l];
            }
            take(z, &total.z, &wanted);
            take(s, &total.s, &wanted);
        }
    }

    /// What the sensor measures at some states, and the rows of its derivatives with respect to (visible z, p).
    #[inline(always)]
    pub fn outputs_here(&mut self, z: &[[f64; L]]) -> &[[f64; L]] {
        self.motion.equations.outputs_here(&mut self.motion.workspace, z)
    }
}

struct Advance<'s, 'a, const L: usize> {
    stepper: &'s mut LaneStepper<'a, L>,
    z: &'s mut [[f64; L]],
    s: &'s mut [[f64; L]],
    from: &'s [f64; L],
    to: &'s [f64; L],
}

impl<const L: usize> Kernel for Advance<'_, '_, L> {
    #[inline(always)]
    fn run(self) {
        self.stepper.advance_here(self.z, self.s, self.from, self.to);
    }
}

impl<const L: usize> Motion<'_, L> {
    fn columns(&self) -> usize {
        self.equations.visible + self.equations.free.len()
    }

    #[inline(always)]
    fn look_up(&mut self, t: &[f64; L]) {
        let mut earlier = [0.0; L];
        for l in 0..L {
            earlier[l] = t[l] - self.delay[l];
        }
        self.lookup.find(self.signals, &earlier);
    }

    /// How many steps the motion asks for; none where there is no way to go.
    #[inline(always)]
    fn steps(&mut self, z: &[[f64; L]], s: &[[f64; L]], rate: &[[f64; L]], span: &[f64; L]) -> [f64; L] {
        if s.is_empty() {
            self.equations.jacobian_here(&mut self.workspace, z, &self.lookup.value);
        }
        let f = self.equations.last_jacobian(&self.workspace);
        let n = z.len();
        let width = n + self.lookup.value.len() + self.equations.free.len();
        let mut fastest = [0.0; L];
        for i in 0..n {
            let own = &f[n + i * width + i];
            for l in 0..L {
                fastest[l] = if own[l].abs() > fastest[l] { own[l].abs() } else { fastest[l] };
            }
        }
        let mut steps = [0.0; L];
        for l in 0..L {
            let (turning, forgetting) = (rate[2][l].abs() / TURN_PER_STEP, fastest[l] / STEP_PER_TIME_CONSTANT);
            let each = if turning > forgetting { turning } else { forgetting };
            let count = (span[l].abs() * each).ceil().clamp(1.0, MAX_STEPS);
            steps[l] = if span[l] == 0.0 { 0.0 } else { count };
        }
        steps
    }

    /// One step into `total`; the rate at its beginning is known.
    #[inline(always)]
    fn step(
        &mut self,
        z: &[[f64; L]],
        s: &[[f64; L]],
        (t, h): (&[f64; L], &[f64; L]),
        rate: &mut Arcs<L>,
        total: &mut Arcs<L>,
        at: &mut Arcs<L>,
    ) {
        total.z.copy_from_slice(z);
        total.s.copy_from_slice(s);
        for (advance, weight, next) in [(0.5, 1.0, 0.5), (0.5, 2.0, 0.5), (1.0, 2.0, 1.0), (0.0, 1.0, 0.0)] {
            let (mut share, mut ahead, mut then) = ([0.0; L], [0.0; L], [0.0; L]);
            for l in 0..L {
                share[l] = weight * h[l] / 6.0;
                ahead[l] = advance * h[l];
                then[l] = t[l] + next * h[l];
            }
            let (from, width) = (self.first, self.columns());
            add(&mut total.z, &share, &rate.z);
            for (total, rate) in total.s.chunks_exact_mut(width).zip(rate.s.chunks_exact(width)) {
                add(&mut total[from..], &share, &rate[from..]);
            }
            if advance > 0.0 {
                sum(&mut at.z, z, &ahead, &rate.z);
                let rows = at.s.chunks_exact_mut(width).zip(s.chunks_exact(width)).zip(rate.s.chunks_exact(width));
                for ((at, s), rate) in rows {
                    sum(&mut at[from..], &s[from..], &ahead, &rate[from..]);
                }
                self.rate(&at.z, &at.s, &then, rate);
            }
        }
    }

    /// z′ and S′, but for the columns that stay as they are.
    #[inline(always)]
    fn rate(&mut self, z: &[[f64; L]], s: &[[f64; L]], t: &[f64; L], rate: &mut Arcs<L>) {
        self.look_up(t);
        if s.is_empty() {
            return self.equations.rates_here(&mut self.workspace, z, &self.lookup.value, &mut rate.z);
        }
        let (n, m, p) = (z.len(), self.lookup.value.len(), self.delay_slopes.len());
        let (width, k) = (n + m + p, self.columns());
        let f = self.equations.jacobian_here(&mut self.workspace, z, &self.lookup.value);
        rate.z.copy_from_slice(&f[..n]);
        for (i, read) in self.read_by.iter().enumerate() {
            let row = &f[n + i * width..n + (i + 1) * width];
            let out = &mut rate.s[i * k + self.first..(i + 1) * k];
            out.fill([0.0; L]);
            for j in read {
                add(out, &row[*j], &s[j * k + self.first..(j + 1) * k]);
            }
            let mut along_inputs = [0.0; L];
            for (by_input, slope) in row[n..n + m].iter().zip(&self.lookup.slope) {
                for l in 0..L {
                    along_inputs[l] += by_input[l] * slope[l];
                }
            }
            let by_p = &row[n + m..];
            let out = &mut out[k - p - self.first..];
            for ((out, by_p), delay_slope) in out.iter_mut().zip(by_p).zip(&self.delay_slopes) {
                for l in 0..L {
                    out[l] += by_p[l] - along_inputs[l] * delay_slope[l];
                }
            }
        }
    }
}

/// out = y + h·k
#[inline(always)]
fn sum<const L: usize>(out: &mut [[f64; L]], y: &[[f64; L]], h: &[f64; L], k: &[[f64; L]]) {
    for ((out, y), k) in out.iter_mut().zip(y).zip(k) {
        for l in 0..L {
            out[l] = y[l] + h[l] * k[l];
        }
    }
}

/// out += h·k
#[inline(always)]
fn add<const L: usize>(out: &mut [[f64; L]], h: &[f64; L], k: &[[f64; L]]) {
    for (out, k) in out.iter_mut().zip(k) {
        for l in 0..L {
            out[l] += h[l] * k[l];
        }
    }
}

/// Takes the new values where they are wanted.
#[inline(always)]
fn take<const L: usize>(old: &mut [[f64; L]], new: &[[f64; L]], wanted: &[bool; L]) {
    for (old, new) in old.iter_mut().zip(new) {
        for l in 0..L {
            old[l] = if wanted[l] { new[l] } else { old[l] };
        }
    }
}
