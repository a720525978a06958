//! Linear equations in coefficients, and rows of motions from which they are made.

use super::carrier::Carrier;
use crate::formula::Normal;

/// One row at one point: Σ cⱼ·gⱼ = t.
pub struct Equation<S = Normal> {
    /// g₁, g₂, …
    pub factors: Vec<S>,
    /// t
    pub target: S,
}

/// a − b, row by row.
pub fn less<S: Carrier>(a: &[S], b: &[S]) -> Vec<S> {
    a.iter().zip(b).map(|(a, b)| a.sub(b)).collect()
}

/// −a, row by row.
pub fn negative<S: Carrier>(rows: &[S]) -> Vec<S> {
    rows.iter().map(S::neg).collect()
}

/// The equations Σ cⱼ·columnⱼ = target, row by row.
pub fn side_by_side<S: Carrier>(columns: &[Vec<S>], target: &[S]) -> Vec<Equation<S>> {
    let row = |i: usize| columns.iter().map(|c| c[i].clone()).collect();
    target.iter().enumerate().map(|(i, t)| Equation { factors: row(i), target: t.clone() }).collect()
}
