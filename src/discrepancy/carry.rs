//! States that no sensor sees: at rest at the start of a log, then carried along.

use super::record::Record;
use crate::model::Equations;
use crate::motion::{Arc, Stepper, initial_hidden};
use nalgebra::DMatrix;

/// How long before the first window hidden states are carried from rest, s.
const LEAD: f64 = 3.0;

/// Hidden states and all sensitivities at a row, carried there from rest through what the log says before it.
pub fn before(equations: &Equations, p: &[f64], record: &Record, row: usize, visible: &[f64]) -> Arc {
    if equations.n() == equations.visible {
        return Arc::default();
    }
    let mut stepper = Stepper::new(equations, &record.signals, p);
    let time = &record.time;
    let gap = record.gap();
    let joined = |i: &usize| time[i + 1] - time[*i] <= gap && time[row] - time[*i] <= LEAD;
    let first = (0..row).rev().take_while(joined).last().unwrap_or(row);
    let mut hidden = at_rest(equations, p, &mut stepper, time[first], visible);
    for i in first..row {
        // The pose a hidden state sees is the measured one; only the hidden states are carried.
        let mut arc = stepper.start(&[visible, &hidden.z].concat(), Some(&hidden.s));
        stepper.advance(&mut arc, time[i], time[i + 1]);
        hidden = Arc { z: arc.z[equations.visible..].to_vec(), s: arc.s };
    }
    hidden
}

/// Hidden states and all sensitivities at a time, the hidden ones in their equilibrium under the inputs there.
///
/// A state that forgets is soon where its inputs drive it; its equilibrium is the best guess of where it is at
/// the start of a log, and depends on p: ∂h/∂p = −(∂h′/∂h)⁻¹·∂h′/∂p. Where there is no equilibrium, it is zero.
pub fn at_rest(equations: &Equations, p: &[f64], stepper: &mut Stepper, t: f64, visible: &[f64]) -> Arc {
    let (n, m) = (equations.n(), equations.visible);
    let (h, k) = (n - m, stepper.columns());
    let mut arc = Arc { z: vec![0.0; h], s: vec![0.0; n * k] };
    if h == 0 {
        return arc;
    }
    let u = stepper.inputs(t).to_vec();
    arc.z = initial_hidden(equations, p, &u, visible);
    let width = n + u.len() + p.len();
    let mut workspace = equations.workspace(p);
    let f = equations.rates_and_jacobian(&mut workspace, &[visible, &arc.z].concat(), &u);
    let entry = |i: usize, j: usize| f[n + (m + i) * width + j];
    let slope = DMatrix::from_fn(h, h, |i, j| entry(i, m + j));
    let by_p = slope.lu().solve(&DMatrix::from_fn(h, p.len(), |i, j| entry(i, n + u.len() + j)));
    if let Some(by_p) = by_p.filter(|b| b.iter().all(|x| x.is_finite())) {
        for i in 0..h {
            (0..p.len()).for_each(|j| arc.s[(m + i) * k + m + j] = -by_p[(i, j)]);
        }
    }
    arc
}
