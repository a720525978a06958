//! States that no sensor sees: at rest at the start of a log, then carried along.

use crate::model::Equations;
use crate::motion::{Arc, Stepper};
use nalgebra::{DMatrix, DVector};

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
    let width = n + u.len() + p.len();
    let mut workspace = equations.workspace(p);
    let mut z = [visible, &arc.z].concat();
    for _ in 0..20 {
        let f = equations.rates_and_jacobian(&mut workspace, &z, &u).to_vec();
        let entry = |i: usize, j: usize| f[n + (m + i) * width + j];
        let slope = DMatrix::from_fn(h, h, |i, j| entry(i, m + j));
        let Some(lu) = Some(slope.lu()).filter(|lu| lu.is_invertible()) else { return arc };
        let Some(step) = lu.solve(&DVector::from_fn(h, |i, _| f[m + i])) else { return arc };
        if !step.iter().all(|x| x.is_finite()) {
            return arc;
        }
        (0..h).for_each(|i| z[m + i] -= step[i]);
        if let Some(by_p) = lu.solve(&DMatrix::from_fn(h, p.len(), |i, j| entry(i, n + u.len() + j))) {
            for i in 0..h {
                (0..p.len()).for_each(|j| arc.s[(m + i) * k + m + j] = -by_p[(i, j)]);
            }
        }
        if step.amax() < 1e-12 {
            break;
        }
    }
    if z.iter().chain(&arc.s).all(|x| x.is_finite()) {
        arc.z = z[m..].to_vec();
    }
    arc
}
