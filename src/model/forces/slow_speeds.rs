//! The speeds that three tenths of a second do not forget: the transition matrix exp(J·T) of the linearised motion.

use crate::error::Result;
use crate::formula::Symbol;
use crate::model::forced_motion::ForcedMotion;
use crate::model::vehicle_model::Model;
use nalgebra::DMatrix;

/// The time over which a speed must be remembered, s. What is forgotten sooner follows the others to first order in its time
/// constant; a slower one follows too badly for millimetres.
const TIME: f64 = 0.3;
/// What must be left of it after that time.
const LEFT: f64 = 1e-3;
/// Of so many speeds sets are tried.
const MOST: usize = 12;
/// A speed at which the vehicle is looked at, m/s.
const AHEAD: f64 = 1.0;

/// The quasi-velocities that tell best what is still there after that time, of a model with forces: as many as the transition
/// matrix has eigenvalues that are not forgotten, and of these sets the one whose block has the largest smallest singular
/// value.
///
/// A speed that friction has changed beyond recognition by then is no state to begin a window with; it follows from the
/// others.
///
/// # Errors
/// When a formula of the model is undefined by name.
pub(super) fn slow_speeds(model: &Model, forced: &ForcedMotion) -> Result<Vec<Symbol>> {
    let equations = model.equations(&[])?;
    let n = equations.n();
    let place = |s: &Symbol| equations.states.iter().position(|state| state == s);
    let mut z = vec![0.0; n];
    for (name, value) in [("body.u", AHEAD), ("theta.omega", AHEAD), ("theta_1.omega", AHEAD), ("theta_2.omega", AHEAD)]
    {
        place(&name.into()).into_iter().for_each(|i| z[i] = value);
    }
    let u = vec![0.0; equations.inputs.len()];
    let mut w = equations.workspace(&[]);
    let all = equations.rates_and_jacobian(&mut w, &z, &u);
    let width = n + u.len();
    let moving: Vec<usize> = forced.states.iter().filter_map(place).collect();
    let slope = DMatrix::from_fn(moving.len(), moving.len(), |i, k| all[n + moving[i] * width + moving[k]]);
    if slope.iter().any(|v| !v.is_finite()) {
        return Ok(vec![]);
    }
    let left = (slope * TIME).exp();
    let kept = left.complex_eigenvalues().iter().filter(|e| e.norm() > LEFT).count();
    let speeds: Vec<(&Symbol, usize)> =
        forced.speeds.iter().filter_map(|s| Some((s, moving.iter().position(|i| Some(*i) == place(s))?))).collect();
    let told = |subset: &u32| {
        let at: Vec<usize> = (0..speeds.len()).filter(|i| subset >> i & 1 == 1).map(|i| speeds[i].1).collect();
        DMatrix::from_fn(at.len(), at.len(), |i, k| left[(at[i], at[k])]).singular_values().min()
    };
    // Of equal ones the first, which has the speeds of the body. A mode that is all but forgotten may be told by none.
    let best_of = |size: usize| {
        let sets = (1..1_u32 << speeds.len().min(MOST)).filter(|s| s.count_ones() as usize == size);
        let told = sets.map(|s| (s, told(&s))).filter(|(_, told)| *told > LEFT);
        told.reduce(|a, b| if b.1 > a.1 * (1.0 + 1e-9) { b } else { a })
    };
    let best = (1..=kept.min(speeds.len())).rev().find_map(best_of);
    let taken = best.map_or(0, |(subset, _)| subset);
    Ok((0..speeds.len()).filter(|i| taken >> i & 1 == 1).map(|i| speeds[i].0.clone()).collect())
}
