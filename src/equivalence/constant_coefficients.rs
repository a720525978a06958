//! Coefficients that are the same in every state and for every input.

use super::equation::Equation;
use super::values::int;
use crate::formula::{Normal, Scalar};

/// The c of Σ cⱼ·gⱼ = t for all equations, zero where they may be anything; the work ends with the first contradiction.
///
/// Equations with an undefined part say nothing.
pub fn constants(unknowns: usize, equations: impl Iterator<Item = Equation>) -> Option<Vec<Normal>> {
    let mut solved: Vec<Option<Equation>> = (0..unknowns).map(|_| None).collect();
    for equation in equations {
        let Some(rest) = reduced(equation, &solved) else { continue };
        match rest.factors.iter().position(|g| !g.is_zero()) {
            Some(j) => insert(&mut solved, j, rest),
            None if !rest.target.is_zero() => return None,
            None => {}
        }
    }
    Some(solved.into_iter().map(|e| e.map_or_else(|| int(0), |e| e.target)).collect())
}

/// An equation without the unknowns that are solved for; `None` where it is undefined.
fn reduced(mut e: Equation, solved: &[Option<Equation>]) -> Option<Equation> {
    for (j, pivot) in solved.iter().enumerate() {
        let Some(pivot) = pivot else { continue };
        e = less(e, pivot, j);
    }
    let defined = e.factors.iter().chain([&e.target]).all(Scalar::is_defined);
    defined.then_some(e)
}

/// An equation minus a multiple of another, whose j-th factor is one.
fn less(e: Equation, pivot: &Equation, j: usize) -> Equation {
    let by = e.factors[j].clone();
    if by.is_zero() {
        return e;
    }
    let minus = |(x, y): (&Normal, &Normal)| x.sub(&by.mul(y));
    Equation {
        factors: e.factors.iter().zip(&pivot.factors).map(minus).collect(),
        target: minus((&e.target, &pivot.target)),
    }
}

/// Makes an equation the one that gives its j-th unknown.
fn insert(solved: &mut [Option<Equation>], j: usize, e: Equation) {
    let scale = e.factors[j].recip();
    if !scale.is_defined() {
        return;
    }
    let own = Equation { factors: e.factors.iter().map(|g| g.mul(&scale)).collect(), target: e.target.mul(&scale) };
    for other in solved.iter_mut() {
        *other = other.take().map(|o| less(o, &own, j));
    }
    solved[j] = Some(own);
}
