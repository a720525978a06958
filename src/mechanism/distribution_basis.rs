//! A basis of the distribution Δ = ker A(q) near a point, as power series, by Gauss–Jordan elimination over the local
//! ring.

use super::point::not_exact;
use super::vector_field::Field;
use super::{Point, Row};
use crate::error::{Error, Result};
use crate::formula::{BigRational, Expr, Jet, Layout, Scalar, Symbol};
use num_traits::{One, Zero};
use std::sync::Arc;

/// A basis of Δ = {q̇ : A·q̇ = 0} near a point.
pub(crate) struct Frame {
    /// The variables and order of the series.
    pub layout: Arc<Layout>,
    /// The fields of the basis.
    pub fields: Vec<Field>,
}

/// The coordinates that occur in the coefficients: series are needed in these only.
pub(crate) fn shape_coordinates(rows: &[Row], coordinates: &[Symbol]) -> Vec<Symbol> {
    let occurs = |q: &Symbol| rows.iter().flat_map(|r| r.terms()).any(|(_, c)| c.mentions(q));
    coordinates.iter().filter(|q| occurs(q)).cloned().collect()
}

/// The rows' basis of motions at a point, as series up to an order.
///
/// Elimination over the local ring: only series with a constant term are divided by, so every step holds near the
/// point, not only at it.
///
/// # Errors
/// When a coefficient has no exact value, or when what is left after elimination is zero at the point but not near it.
pub(crate) fn frame(rows: &[Row], coordinates: &[Symbol], at: &Point, order: usize) -> Result<Frame> {
    let layout = Arc::new(Layout::new(shape_coordinates(rows, coordinates), order));
    let mut matrix = rows.iter().map(|r| series(r, coordinates, at, &layout)).collect::<Result<Vec<_>>>()?;
    let pivots = eliminate(&mut matrix, &Jet::is_zero, &pivot);
    let used = |r: &usize| pivots.iter().any(|(p, _)| p == r);
    if (0..matrix.len()).filter(|r| !used(r)).any(|r| matrix[r].iter().any(|c| !c.is_zero())) {
        return Err(rank_changes());
    }
    let free = (0..coordinates.len()).filter(|c| pivots.iter().all(|(_, p)| p != c));
    let field = |c: usize| Field::of(&motion(&matrix, &pivots, c, coordinates.len()), &layout);
    let fields: Option<Vec<Field>> = free.map(field).collect();
    Ok(Frame { fields: fields.ok_or_else(rank_changes)?, layout })
}

/// What to say where the number of independent constraints is not constant.
pub(crate) fn rank_changes() -> Error {
    Error::input("the constraints are fewer at this point than near it")
        .help("choose a point where the number of independent constraints does not change")
}

fn series(row: &Row, coordinates: &[Symbol], at: &Point, layout: &Arc<Layout>) -> Result<Vec<Jet>> {
    let value = |s: &Symbol| Jet::variable(layout, s, at.value(s));
    let coefficient = |q: &Symbol| match row.coefficient(&q.rate()) {
        c if c.is_zero() => Some(zero()),
        c => c.eval(&value).filter(|jet| jet.constant().as_rational().is_some()),
    };
    coordinates.iter().map(|q| coefficient(q).ok_or_else(|| not_exact(row))).collect()
}

fn zero() -> Jet {
    Jet::number(&BigRational::zero())
}

/// Gauss–Jordan elimination by the pivots that are chosen, row and column; their places, which become one with zeros above and
/// below.
pub(crate) fn eliminate<S: Scalar>(
    matrix: &mut [Vec<S>],
    is_zero: &impl Fn(&S) -> bool,
    pivot: &impl Fn(&[Vec<S>], &[(usize, usize)]) -> Option<(usize, usize)>,
) -> Vec<(usize, usize)> {
    let mut pivots: Vec<(usize, usize)> = Vec::new();
    while let Some((r, c)) = pivot(matrix, &pivots) {
        let inverse = matrix[r][c].recip();
        let row: Vec<S> = matrix[r].iter().map(|v| if is_zero(v) { v.clone() } else { v.mul(&inverse) }).collect();
        for (_, other) in matrix.iter_mut().enumerate().filter(|(i, _)| *i != r) {
            subtract(other, &row, c, is_zero);
        }
        matrix[r] = row;
        pivots.push((r, c));
    }
    pivots
}

/// row − row[c]·by
fn subtract<S: Scalar>(row: &mut [S], by: &[S], c: usize, is_zero: &impl Fn(&S) -> bool) {
    let factor = row[c].clone();
    if is_zero(&factor) {
        return;
    }
    for (v, b) in row.iter_mut().zip(by).filter(|(_, b)| !is_zero(b)) {
        *v = v.sub(&factor.mul(b));
    }
}

/// The invertible entry with the shortest series: constants keep all series short.
fn pivot(matrix: &[Vec<Jet>], pivots: &[(usize, usize)]) -> Option<(usize, usize)> {
    let open = |r: &usize| pivots.iter().all(|(p, _)| p != r);
    let rows = (0..matrix.len()).filter(open);
    let entries = rows.flat_map(|r| (0..matrix[r].len()).map(move |c| (r, c)));
    let invertible = entries.filter(|(r, c)| matrix[*r][*c].constant().as_rational().is_some_and(|v| !v.is_zero()));
    let length = |r: usize| matrix[r].iter().map(|v| v.terms().len()).sum::<usize>();
    invertible.min_by_key(|(r, c)| (matrix[*r][*c].terms().len(), length(*r)))
}

/// The motion in which one free coordinate moves at unit rate and the other free ones rest.
pub(crate) fn motion<S: Scalar>(matrix: &[Vec<S>], pivots: &[(usize, usize)], free: usize, count: usize) -> Vec<S> {
    let mut field = vec![S::number(&BigRational::zero()); count];
    field[free] = S::number(&BigRational::one());
    pivots.iter().for_each(|(r, c)| field[*c] = matrix[*r][free].neg());
    field
}

/// The coefficients of all rows.
pub(crate) fn coefficients(rows: &[Row]) -> impl Iterator<Item = &Expr> {
    rows.iter().flat_map(|r| r.terms()).map(|(_, c)| c)
}
