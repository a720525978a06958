//! The solution of a symmetric positive definite system as formulas, by LDLᵀ factors without pivoting (Golub and Van Loan,
//! Matrix Computations, 4.1.2).

use super::rate_forms::{sum, times};
use crate::formula::{Expr, Symbol};
use crate::mechanism::Definitions;

/// Defines the solution x of A·x = b, A given by its lower triangle row by row: names of x, A's entries and b.
///
/// ```text
/// d_j = a_jj − Σ l_jk²·d_k      l_ij = (a_ij − Σ l_ik·l_jk·d_k)/d_j      y_i = b_i − Σ l_ik·y_k
/// x_i = y_i/d_i − Σ l_ki·x_k
/// ```
pub(super) fn define_solution(d: &mut Definitions, a: &[Vec<Expr>], b: &[Expr], names: &[Symbol]) {
    let n = b.len();
    let mut name = |stem: &str, formula: Expr| named(d, stem, formula);
    let (mut pivots, mut lower): (Vec<Expr>, Vec<Vec<Expr>>) = (vec![], vec![]);
    for (i, entries) in a.iter().enumerate() {
        let mut row: Vec<Expr> = Vec::new();
        for (j, entry) in entries.iter().enumerate() {
            let parts = (0..j).map(|k| times(&times(&row[k], if j < i { &lower[j][k] } else { &row[k] }), &pivots[k]));
            let left = entry - &sum(parts);
            if j < i {
                let factor = if left.is_zero() { left } else { &left / &pivots[j] };
                row.push(name(&format!("mass.factor_{}_{}", i + 1, j + 1), factor));
            } else {
                pivots.push(name(&format!("mass.pivot_{}", i + 1), left));
            }
        }
        lower.push(row);
    }
    let mut y: Vec<Expr> = Vec::new();
    for i in 0..n {
        let known = sum((0..i).map(|k| times(&lower[i][k], &y[k])));
        y.push(name(&format!("mass.forward_{}", i + 1), &b[i] - &known));
    }
    for i in (0..n).rev() {
        let known = sum((i + 1..n).map(|k| times(&lower[k][i], &Expr::sym(names[k].clone()))));
        let quotient = if y[i].is_zero() { Expr::int(0) } else { &y[i] / &pivots[i] };
        d.define(names[i].clone(), &quotient - &known);
    }
}

/// A formula by a name where it is more than a number or a name.
fn named(d: &mut Definitions, stem: &str, formula: Expr) -> Expr {
    if formula.as_number().is_some() || matches!(formula.node(), crate::formula::Node::Sym(_)) {
        return formula;
    }
    d.define(stem, formula);
    Expr::sym(stem)
}
