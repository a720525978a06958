//! The solution of a linear system of a comparison: refuted by numbers, else found exactly.

use super::constant_coefficients::constants;
use super::linear_system::LinearSystem;
use super::numeric_rejection::has_no_solution;
use super::pair::Pair;
use crate::formula::Normal;

/// The c of a system, as formulas of what is open; `None` where there are none.
pub fn solution(pair: &Pair, system: &impl LinearSystem) -> Option<Vec<Normal>> {
    if has_no_solution(pair, system) {
        return None;
    }
    let all = pair.points.iter().flat_map(|at| system.equations(pair, at).unwrap_or_default());
    constants(system.unknowns(pair), all)
}
