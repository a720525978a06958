//! A linear system solved by LU decomposition with full pivoting, a singular one by least squares (SVD).

use nalgebra::{DMatrix, DVector};

/// A pivot below this share of the largest is rounding, and its matrix counts as singular.
pub(super) const SINGULAR_PIVOT: f64 = 1e-12;

/// The solution; of least size where contacts say the same twice, NaN where there is none.
pub(super) fn solution(matrix: DMatrix<f64>, side: &DVector<f64>) -> DVector<f64> {
    let right = DMatrix::from_column_slice(side.len(), 1, side.as_slice());
    DVector::from_column_slice(solutions(matrix, right).as_slice())
}

pub(super) fn solutions(matrix: DMatrix<f64>, right: DMatrix<f64>) -> DMatrix<f64> {
    let (rows, columns) = right.shape();
    let nothing = || DMatrix::from_element(rows, columns, f64::NAN);
    if matrix.iter().chain(right.iter()).any(|v| !v.is_finite()) {
        return nothing();
    }
    // Rows of masses and rows of lengths differ in size by orders of magnitude.
    let scale: Vec<f64> = matrix.row_iter().map(|r| r.amax()).map(|s| if s > 0.0 { s } else { 1.0 }).collect();
    let matrix = DMatrix::from_fn(rows, rows, |i, k| matrix[(i, k)] / scale[i]);
    let right = DMatrix::from_fn(rows, columns, |i, k| right[(i, k)] / scale[i]);
    let lu = matrix.clone().full_piv_lu();
    let pivots = lu.u().diagonal().map(f64::abs);
    if pivots.min() > SINGULAR_PIVOT * pivots.max() {
        return lu.solve(&right).unwrap_or_else(nothing);
    }
    let svd = matrix.svd(true, true);
    let cut = SINGULAR_PIVOT * svd.singular_values.max();
    svd.solve(&right, cut).unwrap_or_else(|_| nothing())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_other_units_are_no_less_independent() {
        let matrix = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 1e-20, -1e-20]);
        let found = solution(matrix, &DVector::from_vec(vec![3.0, 1e-20]));
        assert!((found[0] - 2.0).abs() < 1e-12 && (found[1] - 1.0).abs() < 1e-12, "{found}");
        // A row of zeros asks for nothing, and the rest is of least size.
        let matrix = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 0.0, 0.0]);
        let found = solution(matrix, &DVector::from_vec(vec![2.0, 0.0]));
        assert!((found[0] - 1.0).abs() < 1e-12 && (found[1] - 1.0).abs() < 1e-12, "{found}");
    }
}
