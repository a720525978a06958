//! Numeric rejection: what has no solution at points where every symbol is a number has none as formulas.
//!
//! | symbol | meaning |
//! |---|---|
//! | G·c = t | the equations of all points of a sample, each column of G scaled to length one |
//! | r | t − G·c for the c of least squares (singular values, the smallest left out) |
//!
//! A system is rejected where ‖r‖ > 10⁻⁶·‖t‖ and some |rᵢ| > 10⁻⁷ in every sample, a change of parameter where the
//! motions differ by as much; what is nearer goes to the proof. A coefficient may have a pole at the numbers of one
//! sample, hence more than one.

use super::carrier::SURE;
use super::equation::Equation;
use super::linear_system::LinearSystem;
use super::pair::Pair;
use super::points::Point;
use nalgebra::{DMatrix, DVector};

/// Singular values below this share of the greatest are rounding.
const RANK: f64 = 1e-10;
/// Numbers of which motions are made are about one: what is below is rounding, whatever it is compared with.
const NOTICEABLE: f64 = 1e-7;
/// Beyond this an equation has a pole nearby, and says little.
const LARGE: f64 = 1e5;

/// Whether a system is inconsistent at every sample of a pair.
pub fn has_no_solution(pair: &Pair, system: &impl LinearSystem) -> bool {
    let contradictory = |sample: &Vec<Point<f64>>| {
        let all = sample.iter().flat_map(|at| system.equations(pair, at).unwrap_or_default());
        is_inconsistent(system.unknowns(pair), &all.filter(is_moderate).collect::<Vec<_>>())
    };
    !pair.samples.is_empty() && pair.samples.iter().all(contradictory)
}

/// Whether two motions, row by row at a point, differ at every sample of a pair.
pub fn differ(pair: &Pair, motions: &impl Fn(&Point<f64>) -> Option<[Vec<f64>; 2]>) -> bool {
    let far = |a: f64, b: f64| {
        let (off, size) = ((a - b).abs(), a.abs().max(b.abs()));
        off.is_finite() && size < LARGE && off > SURE * size && off > NOTICEABLE
    };
    let apart = |[a, b]: [Vec<f64>; 2]| a.iter().zip(&b).any(|(a, b)| far(*a, *b));
    let refuted = |sample: &Vec<Point<f64>>| sample.iter().filter_map(motions).any(apart);
    !pair.samples.is_empty() && pair.samples.iter().all(refuted)
}

fn is_moderate(e: &Equation<f64>) -> bool {
    e.factors.iter().chain([&e.target]).all(|v| v.is_finite() && v.abs() < LARGE)
}

/// Whether least squares leave more than rounding.
fn is_inconsistent(unknowns: usize, equations: &[Equation<f64>]) -> bool {
    if equations.len() <= unknowns {
        return false;
    }
    let target = DVector::from_iterator(equations.len(), equations.iter().map(|e| e.target));
    let mut factors = DMatrix::from_fn(equations.len(), unknowns, |i, j| equations[i].factors[j]);
    for mut column in factors.column_iter_mut() {
        let norm = column.norm();
        column.unscale_mut(if norm > NOTICEABLE { norm } else { 1.0 });
    }
    let svd = factors.clone().svd(true, true);
    let least = RANK * svd.singular_values.max();
    let Ok(c) = svd.solve(&target, least) else { return false };
    let rest = &target - factors * c;
    rest.norm() > SURE * target.norm() && rest.amax() > NOTICEABLE
}

#[cfg(test)]
mod tests {
    use super::*;

    fn equation(factors: [f64; 2], target: f64) -> Equation<f64> {
        Equation { factors: factors.to_vec(), target }
    }

    #[test]
    fn only_a_clear_contradiction_is_one() {
        let lines = [equation([1.0, 0.0], 2.0), equation([0.0, 1.0], 3.0)];
        let with = |target: f64| {
            let [a, b] = &lines;
            is_inconsistent(
                2,
                &[equation([1.0, 0.0], a.target), equation([0.0, 1.0], b.target), equation([1.0, 1.0], target)],
            )
        };
        assert!(with(5.1) && with(4.99));
        assert!(!with(5.0) && !with(5.0 + 1e-9));
        // As many equations as unknowns, and a column that is rounding.
        assert!(!is_inconsistent(2, &lines));
        let beside = |noise: f64, target: f64| {
            is_inconsistent(1, &[Equation { factors: vec![noise], target }, Equation { factors: vec![-noise], target }])
        };
        assert!(beside(1.0, 1.0) && beside(1e-16, 1.0) && !beside(1e-16, 1e-15));
    }
}
