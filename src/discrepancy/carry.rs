//! States that no sensor sees: at rest at the start of a log, then carried along.

use crate::model::Equations;
use crate::motion::{Arc, Stepper, initial_hidden};
use nalgebra::DMatrix;

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
