//! The sensitivities of a step of collocation, exact for the stages that were found, by the implicit function theorem.

use super::radau_tableau::{STAGES, Tableau};
use crate::numerics::row_factors::RowFactors;

/// Derivatives of the rates at the stages of a step.
pub(super) struct StageSlopes<'s, const L: usize> {
    pub tableau: &'s Tableau,
    pub h: f64,
    /// How many states there are, and how many of them, the first ones, are integrals of the others.
    pub n: usize,
    pub pose: usize,
    /// J row by row, a lane for each stage.
    pub by_states: &'s [[f64; L]],
    /// P row by row, a lane for each stage.
    pub by_p: &'s [[f64; L]],
}

/// Memory for the sensitivities of a step.
#[derive(Default)]
pub(super) struct SensitivityMemory {
    factors: RowFactors,
    rows: Vec<f64>,
    side: Vec<f64>,
    weights: [Vec<f64>; STAGES],
    before: Vec<f64>,
}

impl<const L: usize> StageSlopes<'_, L> {
    /// S at the end of the step in place of S at its beginning, row by row.
    ///
    /// With ΔS_i what S has changed by at stage i, ΔS_i = h·Σ a_ij·(J_j·(S + ΔS_j) + P_j). The end is the last stage: of the
    /// inverse of 1 − h·A⊗J the rows of that stage are enough, W_j = h·Σ_i u_i·a_ij, and S ← S + Σ W_j·(J_j·S + P_j).
    pub fn advance(&self, s: &mut [f64], memory: &mut SensitivityMemory) {
        let n = self.n;
        let (k, p) = (s.len() / n, self.by_p.len() / n);
        if !self.last_rows(memory) {
            return s.fill(f64::NAN);
        }
        let SensitivityMemory { rows, weights, before, .. } = memory;
        for (j, weights) in weights.iter_mut().enumerate() {
            weights.clear();
            weights.resize(n * n, 0.0);
            for (i, rows) in rows.chunks_exact(n * n).enumerate() {
                let by = self.h * self.tableau.a[i][j];
                weights.iter_mut().zip(rows).for_each(|(w, u)| *w += by * u);
            }
        }
        before.clear();
        before.extend_from_slice(s);
        for (r, row) in s.chunks_exact_mut(k).enumerate() {
            for c in 0..n {
                let through = |d: usize| (0..STAGES).map(|j| weights[j][d * n + r] * self.slope(j, d, c)).sum::<f64>();
                add(row, (0..n).map(through).sum(), before[c * k..(c + 1) * k].iter().copied());
            }
            let row = &mut row[k - p..];
            for (j, weights) in weights.iter().enumerate() {
                for c in 0..if p > 0 { n } else { 0 } {
                    add(row, weights[c * n + r], self.by_p[c * p..(c + 1) * p].iter().map(|lanes| lanes[j]));
                }
            }
        }
    }

    fn slope(&self, stage: usize, row: usize, col: usize) -> f64 {
        self.by_states[row * self.n + col][stage]
    }

    /// The rows u of the inverse of 1 − h·A⊗J that belong to the last stage, each as a column, the stages one after another;
    /// whether there are any.
    fn last_rows(&self, memory: &mut SensitivityMemory) -> bool {
        let SensitivityMemory { factors, rows, side, .. } = memory;
        let Self { n, pose, h, tableau, .. } = *self;
        let free = n - pose;
        let factored = factors.factor(STAGES * free, |row, col| {
            let ((j, b), (i, a)) = ((row / free, pose + row % free), (col / free, pose + col % free));
            f64::from(u8::from(row == col)) - h * tableau.a[i][j] * self.slope(j, a, b)
        });
        if !factored {
            return false;
        }
        rows.clear();
        rows.resize(STAGES * n * n, 0.0);
        let at = |stage: usize, state: usize, r: usize| (stage * n + state) * n + r;
        // Integrals: u = e + e·h·A⊗J among themselves, which is all, for what they read reads none of them.
        for q in 0..pose {
            rows[at(STAGES - 1, q, q)] = 1.0;
            for (j, by) in tableau.a[STAGES - 1].iter().enumerate() {
                (0..pose).for_each(|c| rows[at(j, c, q)] += h * by * self.slope(j, q, c));
            }
        }
        // What they ask of the others, and the others by themselves.
        side.clear();
        side.resize(STAGES * free * n, 0.0);
        for (row, side) in side.chunks_exact_mut(n).enumerate() {
            let (j, c) = (row / free, pose + row % free);
            if j == STAGES - 1 {
                side[c] = 1.0;
            }
            for (r, side) in side.iter_mut().enumerate().take(pose) {
                let asked = |i: usize, q: usize| rows[at(i, q, r)] * h * tableau.a[i][j] * self.slope(j, q, c);
                *side = (0..STAGES).map(|i| (0..pose).map(|q| asked(i, q)).sum::<f64>()).sum();
            }
        }
        factors.solve(side);
        for (row, side) in side.chunks_exact(n).enumerate() {
            let first = at(row / free, pose + row % free, 0);
            rows[first..first + n].copy_from_slice(side);
        }
        true
    }
}

/// out += by·values
fn add(out: &mut [f64], by: f64, values: impl Iterator<Item = f64>) {
    if by != 0.0 {
        out.iter_mut().zip(values).for_each(|(out, value)| *out += by * value);
    }
}
