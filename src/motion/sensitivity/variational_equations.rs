//! The variational equations S′ = J_z·S + J_p of several trajectories side by side.

use super::states::{LaneStates, add};
use crate::model::{Equations, Workspace};
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
    /// Whether parameters move the time at which inputs are looked up.
    delayed: bool,
    /// Rows of S before this one stay as they are.
    pub still: usize,
    /// Columns of S before this one stay as they are.
    pub first: usize,
    /// Which states each rate depends on.
    read_by: Vec<Vec<usize>>,
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
            delay_slopes: delay[1..].to_vec(),
            delayed: delay[1..].as_flattened().iter().any(|slope| *slope != 0.0),
            still: equations.still(),
            first: equations.unread(),
            read_by: equations.read_by(),
        }
    }

    /// Columns of the sensitivities.
    pub fn columns(&self) -> usize {
        self.equations.visible + self.equations.free.len()
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

    /// ∂z′ᵢ/∂zᵢ of every state where the rate was last asked for; `known` where S′ was asked for, too.
    #[inline(always)]
    pub fn own_slopes(&mut self, z: &[[f64; L]], known: bool) -> impl Iterator<Item = &[f64; L]> {
        if !known {
            self.equations.jacobian_here(&mut self.workspace, z, &self.lookup.value);
        }
        let n = z.len();
        let width = n + self.lookup.value.len() + self.delay_slopes.len();
        let f = self.equations.last_jacobian(&self.workspace);
        (0..n).map(move |i| &f[n + i * width + i])
    }

    #[inline(always)]
    fn look_up(&mut self, t: &[f64; L]) {
        let mut earlier = [0.0; L];
        for l in 0..L {
            earlier[l] = t[l] - self.delay[l];
        }
        self.lookup.find(self.signals, &earlier);
    }

    /// z′ and S′, but for the rows and columns that stay as they are.
    #[inline(always)]
    pub fn rate(&mut self, z: &[[f64; L]], s: &[[f64; L]], t: &[f64; L], rate: &mut LaneStates<L>) {
        self.look_up(t);
        if s.is_empty() {
            return self.equations.rates_here(&mut self.workspace, z, &self.lookup.value, &mut rate.z);
        }
        let (n, m, p) = (z.len(), self.lookup.value.len(), self.delay_slopes.len());
        let (width, k) = (n + m + p, self.columns());
        let f = self.equations.jacobian_here(&mut self.workspace, z, &self.lookup.value);
        rate.z.copy_from_slice(&f[..n]);
        for (i, read) in self.read_by.iter().enumerate().skip(self.still) {
            let row = &f[n + i * width..n + (i + 1) * width];
            let out = &mut rate.s[i * k + self.first..(i + 1) * k];
            out.fill([0.0; L]);
            for j in read {
                add(out, &row[*j], &s[j * k + self.first..(j + 1) * k]);
            }
            let (by_p, out) = (&row[n + m..], &mut out[k - p - self.first..]);
            if !self.delayed {
                add(out, &[1.0; L], by_p);
                continue;
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
        }
    }
}
