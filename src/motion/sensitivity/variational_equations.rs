//! The variational equations S′ = J_z·S + J_p of several trajectories side by side.

use super::states::{LaneStates, add};
use crate::formula::{Isa, Kernel};
use crate::model::{Derived, Equations, Fineness, Workspace};
use crate::motion::Signals;
use crate::motion::inputs::lane_lookup::Lookup;

/// z′ and S′ as functions of time.
pub(crate) struct VariationalEquations<'a, const L: usize> {
    equations: &'a Equations,
    pub signals: &'a Signals,
    workspace: Workspace<L>,
    lookup: Lookup<L>,
    delay: [f64; L],
    delay_slopes: Vec<[f64; L]>,
    /// What inputs with delays of their own are at their own times.
    own: Vec<OwnDelay<L>>,
    /// Whether parameters move the time at which inputs are looked up.
    delayed: bool,
    /// Rows of S before this one stay as they are.
    pub still: usize,
    /// Columns of S before this one stay as they are.
    pub first: usize,
    /// How many columns behind those of the parameters belong to the start of hidden states.
    pub hidden_starts: usize,
    /// Which states each rate depends on.
    read_by: Vec<Vec<usize>>,
    /// The instructions for many lanes, or many columns of sensitivities.
    pub isa: Isa,
}

/// One evaluation of z′ and S′.
struct Rate<'s, 'a, const L: usize> {
    motion: &'s mut VariationalEquations<'a, L>,
    z: &'s [[f64; L]],
    s: &'s [[f64; L]],
    t: &'s [f64; L],
    rate: &'s mut LaneStates<L>,
}

impl<const L: usize> Kernel for Rate<'_, '_, L> {
    #[inline(always)]
    fn run(self) {
        self.motion.rate_here(self.z, self.s, self.t, self.rate);
    }
}

/// An input that is late by itself.
struct OwnDelay<const L: usize> {
    /// The places of what it gives among the inputs: its own, and that of its rate.
    inputs: Vec<usize>,
    delay: [f64; L],
    slopes: Vec<[f64; L]>,
    lookup: Lookup<L>,
}

/// The inputs that have delays of their own.
fn own_delays<const L: usize>(equations: &Equations, signals: &Signals, delays: &[[f64; L]]) -> Vec<OwnDelay<L>> {
    let (count, p) = (1 + equations.own_delays, equations.free.len());
    let own = |c: usize| {
        let of_rate = equations.derived.iter().position(|d| *d == Derived::Rate(c));
        OwnDelay {
            inputs: [Some(c), of_rate.map(|k| equations.logged() + k)].into_iter().flatten().collect(),
            delay: delays[1 + c],
            slopes: delays[count + (1 + c) * p..count + (2 + c) * p].to_vec(),
            lookup: Lookup::new(signals, &equations.derived),
        }
    };
    (0..equations.own_delays).map(own).collect()
}

impl<'a, const L: usize> VariationalEquations<'a, L> {
    /// Equations along signals, each arc at its own parameters.
    pub fn new(equations: &'a Equations, signals: &'a Signals, p: [&[f64]; L]) -> Self {
        let mut workspace = equations.side_by_side(p);
        let delay = equations.delays(&mut workspace).to_vec();
        Self {
            equations,
            signals,
            lookup: Lookup::new(signals, &equations.derived),
            workspace,
            delay: delay[0],
            delay_slopes: delay[1 + equations.own_delays..][..equations.free.len()].to_vec(),
            own: own_delays(equations, signals, &delay),
            delayed: delay[1 + equations.own_delays..].as_flattened().iter().any(|slope| *slope != 0.0),
            still: equations.still(),
            first: equations.unread(),
            hidden_starts: 0,
            read_by: equations.read_by(),
            isa: Isa::best(),
        }
    }

    /// Columns of the sensitivities: by the visible start, the parameters and, where they are asked for, the hidden start.
    pub fn columns(&self) -> usize {
        self.equations.visible + self.equations.free.len() + self.hidden_starts
    }

    /// How many entries of S, the first ones, stay as they are; none where S is not asked for.
    #[inline(always)]
    pub fn still_entries(&self, s: &[[f64; L]]) -> usize {
        if s.is_empty() { 0 } else { self.still * self.columns() }
    }

    /// The times at which an effect begins or ends.
    pub fn edges(&self) -> &[f64] {
        &self.equations.edges
    }

    /// The inputs that act at some times.
    pub fn inputs(&mut self, t: &[f64; L]) -> &[[f64; L]] {
        self.look_up(t);
        &self.lookup.value
    }

    /// What the sensor measures at some states, and the rows of its derivatives with respect to (visible z, p).
    #[inline(always)]
    pub fn outputs(&mut self, z: &[[f64; L]]) -> &[[f64; L]] {
        self.equations.outputs_here(&mut self.workspace, z)
    }

    /// Evaluates what is measured beside the pose at some states and times.
    #[inline(always)]
    pub fn evaluate_quantities(&mut self, z: &[[f64; L]], t: &[f64; L]) {
        self.look_up(t);
        self.equations.evaluate_quantities(&mut self.workspace, z, &self.lookup.value);
    }

    /// One of the quantities that were evaluated last, and its derivatives by the columns of the sensitivities S of n states:
    /// J_z·S + J_p.
    #[inline(always)]
    pub fn quantity(&self, i: usize, n: usize, s: &[[f64; L]], slopes: &mut [[f64; L]]) -> [f64; L] {
        let all = self.equations.last_quantities(&self.workspace);
        let width = n + self.lookup.value.len() + self.delay_slopes.len();
        let row = &all[self.equations.quantity_count + i * width..][..width];
        let k = self.columns();
        slopes.fill([0.0; L]);
        for (slope, s) in row[..n].iter().zip(s.chunks_exact(k)) {
            add(slopes, slope, s);
        }
        self.add_by_parameters(row, n, &mut slopes[self.equations.visible..]);
        all[i]
    }

    /// ∂z′ᵢ/∂zᵢ of every state where the rate was last asked for; `known` where S′ was asked for, too.
    #[inline]
    pub fn own_slopes(&mut self, z: &[[f64; L]], known: bool) -> impl Iterator<Item = &[f64; L]> {
        let n = z.len();
        let (all, first, step) = match known {
            true => {
                let width = n + self.lookup.value.len() + self.delay_slopes.len();
                (self.equations.last_jacobian(&self.workspace), n, width + 1)
            }
            false => (self.equations.own_slopes(&mut self.workspace, z, &self.lookup.value), 0, 1),
        };
        (0..n).map(move |i| &all[first + i * step])
    }

    /// Which states each rate depends on.
    pub fn read_by(&self) -> &[Vec<usize>] {
        &self.read_by
    }

    /// How finely states that forget are followed.
    pub fn fineness(&self) -> Fineness {
        self.equations.fineness
    }

    /// Whether forces move the vehicle, so that its speeds may be stiff.
    pub fn is_forced(&self) -> bool {
        self.equations.is_forced
    }

    #[inline(always)]
    fn look_up(&mut self, t: &[f64; L]) {
        let mut earlier = [0.0; L];
        for l in 0..L {
            earlier[l] = t[l] - self.delay[l];
        }
        self.lookup.find(self.signals, &earlier);
        for own in &mut self.own {
            let mut then = earlier;
            (0..L).for_each(|l| then[l] -= own.delay[l]);
            own.lookup.find(self.signals, &then);
            for i in &own.inputs {
                self.lookup.value[*i] = own.lookup.value[*i];
                self.lookup.slope[*i] = own.lookup.slope[*i];
            }
        }
    }

    /// z′ and S′, but for the rows and columns that stay as they are.
    pub fn rate(&mut self, z: &[[f64; L]], s: &[[f64; L]], t: &[f64; L], rate: &mut LaneStates<L>) {
        self.isa_with(s).dispatch(Rate { motion: self, z, s, t, rate });
    }

    /// The instructions for states with these sensitivities: one state alone fills no vector.
    pub fn isa_with(&self, s: &[[f64; L]]) -> Isa {
        if s.is_empty() { Isa::for_lanes(L) } else { self.isa }
    }

    #[inline(always)]
    fn rate_here(&mut self, z: &[[f64; L]], s: &[[f64; L]], t: &[f64; L], rate: &mut LaneStates<L>) {
        self.look_up(t);
        if s.is_empty() {
            return self.equations.rates_here(&mut self.workspace, z, &self.lookup.value, &mut rate.z);
        }
        let (n, k) = (z.len(), self.columns());
        rate.z.copy_from_slice(&self.equations.jacobian_here(&mut self.workspace, z, &self.lookup.value)[..n]);
        for (i_row, read) in self.read_by.iter().enumerate().skip(self.still) {
            let row = self.slopes_of(i_row, n);
            let out = &mut rate.s[i_row * k + self.first..(i_row + 1) * k];
            out.fill([0.0; L]);
            for j in read {
                add(out, &row[*j], &s[j * k + self.first..(j + 1) * k]);
            }
            if let Some(by_parameters) = self.equations.visible.checked_sub(self.first) {
                self.add_by_parameters(self.slopes_of(i_row, n), n, &mut out[by_parameters..]);
            }
        }
    }

    /// z′, and row by row ∂z′/∂z and ∂z′/∂p with the inputs as the parameters delay them.
    #[inline(always)]
    pub fn linearised(
        &mut self,
        z: &[[f64; L]],
        t: &[f64; L],
        rates: &mut [[f64; L]],
        [by_states, by_p]: [&mut [[f64; L]]; 2],
    ) {
        self.look_up(t);
        let (n, p) = (z.len(), self.delay_slopes.len());
        rates.copy_from_slice(&self.equations.jacobian_here(&mut self.workspace, z, &self.lookup.value)[..n]);
        by_p.fill([0.0; L]);
        for (i_row, by_states) in by_states.chunks_exact_mut(n).enumerate() {
            by_states.copy_from_slice(&self.slopes_of(i_row, n)[..n]);
            self.add_by_parameters(self.slopes_of(i_row, n), n, &mut by_p[i_row * p..(i_row + 1) * p]);
        }
    }

    /// The derivatives of one of n rates by (z, u, p) where they were last asked for.
    #[inline(always)]
    fn slopes_of(&self, i_row: usize, n: usize) -> &[[f64; L]] {
        let width = n + self.lookup.value.len() + self.delay_slopes.len();
        &self.equations.last_jacobian(&self.workspace)[n + i_row * width..n + (i_row + 1) * width]
    }

    /// J_p − J_u·u̇·∂delay/∂p of what has these derivatives by (z, u, p), of n states.
    #[inline(always)]
    fn add_by_parameters(&self, row: &[[f64; L]], n: usize, out: &mut [[f64; L]]) {
        let m = self.lookup.value.len();
        let by_p = &row[n + m..];
        if !self.delayed {
            return add(out, &[1.0; L], by_p);
        }
        let mut along_inputs = [0.0; L];
        for (by_input, slope) in row[n..n + m].iter().zip(&self.lookup.slope) {
            for l in 0..L {
                along_inputs[l] += by_input[l] * slope[l];
            }
        }
        for ((out, by_p), delay_slope) in out.iter_mut().zip(by_p).zip(&self.delay_slopes) {
            for l in 0..L {
                out[l] += by_p[l] - along_inputs[l] * delay_slope[l];
            }
        }
        for own in &self.own {
            for i in &own.inputs {
                let (by_input, slope) = (&row[n + i], &self.lookup.slope[*i]);
                let mut along = [0.0; L];
                (0..L).for_each(|l| along[l] = -by_input[l] * slope[l]);
                for (out, delay_slope) in out.iter_mut().zip(&own.slopes) {
                    (0..L).for_each(|l| out[l] += along[l] * delay_slope[l]);
                }
            }
        }
    }
}
