//! Vectors and matrices of formulas in space.

use crate::formula::{Expr, Fun, Symbol};

/// Three rows of three formulas.
pub type Matrix = [[Expr; 3]; 3];
/// Three formulas.
pub(super) type Vector = [Expr; 3];

/// An axis of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

/// The rotation made of turns, each about an axis of the frame that the turns before it have made.
///
/// ```
/// use creepage::connection::{Axis, turned};
/// use creepage::formula::Expr;
/// let [gamma, tau] = ["gamma", "tau"].map(Expr::sym);
/// assert_eq!(turned(&[(Axis::Z, tau.clone())])[1][0].to_string(), "sin(tau)");
/// // Bent by gamma towards tau, without twist.
/// let bent = turned(&[(Axis::Z, tau.clone()), (Axis::Y, gamma), (Axis::Z, -&tau)]);
/// assert_eq!(bent[0][2].to_string(), "cos(tau)*sin(gamma)");
/// ```
pub fn turned(turns: &[(Axis, Expr)]) -> Matrix {
    let one = built(|i, j| Expr::int(i64::from(i == j)));
    turns.iter().fold(one, |whole, (axis, angle)| times(&whole, &about(*axis, angle)))
}

fn about(axis: Axis, angle: &Expr) -> Matrix {
    let (cos, sin) = (Expr::call(Fun::Cos, angle), Expr::call(Fun::Sin, angle));
    let axis = axis as usize;
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    built(|i, j| match (i, j) {
        _ if i == axis && j == axis => Expr::int(1),
        _ if i == j => cos.clone(),
        _ if i == last && j == next => sin.clone(),
        _ if i == next && j == last => -&sin,
        _ => Expr::int(0),
    })
}

pub(super) fn built(entry: impl Fn(usize, usize) -> Expr) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

fn sum(terms: [Expr; 3]) -> Expr {
    terms.into_iter().fold(Expr::int(0), |sum, t| &sum + &t)
}

pub(super) fn times(a: &Matrix, b: &Matrix) -> Matrix {
    built(|i, j| sum([0, 1, 2].map(|k| &a[i][k] * &b[k][j])))
}

pub(super) fn plus(a: &Matrix, b: &Matrix) -> Matrix {
    built(|i, j| &a[i][j] + &b[i][j])
}

pub(super) fn transposed(a: &Matrix) -> Matrix {
    built(|i, j| a[j][i].clone())
}

pub(super) fn applied(a: &Matrix, v: &Vector) -> Vector {
    std::array::from_fn(|i| sum([0, 1, 2].map(|k| &a[i][k] * &v[k])))
}

pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &(&a[j] * &b[k]) - &(&a[k] * &b[j])
    })
}

pub(super) fn derivative(a: &Matrix, by: &Symbol) -> Matrix {
    built(|i, j| a[i][j].derivative(by).tidy())
}

/// The vector ω of a skew matrix, [ω]·v = ω × v.
pub(super) fn axial(a: &Matrix) -> Vector {
    [a[2][1].clone(), a[0][2].clone(), a[1][0].clone()]
}

/// The determinant: the first column times the cross product of the others.
fn determinant(a: &Matrix) -> Expr {
    let [x, y, z] = transposed(a);
    let minors = cross(&y, &z);
    sum([0, 1, 2].map(|i| &x[i] * &minors[i]))
}

/// The solution of a·x = b by Cramer's rule.
pub(super) fn solved(a: &Matrix, b: &Vector) -> Vector {
    let whole = determinant(a);
    std::array::from_fn(|k| {
        let replaced = built(|i, j| if j == k { b[i].clone() } else { a[i][j].clone() });
        &determinant(&replaced) / &whole
    })
}
