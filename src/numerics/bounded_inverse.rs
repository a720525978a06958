//! An inverse that stays bounded: singular values below a floor count as the floor (Golub and Van Loan, Matrix Computations,
//! 4th ed. 2013, 5.5).

use nalgebra::DMatrix;

/// V·diag(1/max(σᵢ, floor))·Uᵀ of a square matrix U·diag(σ)·Vᵀ; the inverse as it is where no entry of it exceeds 1/floor, and
/// `None` where the matrix is not finite.
///
/// ```
/// # use nalgebra::dmatrix;
/// # use creepage::numerics::bounded_inverse::bounded_inverse;
/// let inverse = bounded_inverse(&dmatrix![2.0, 0.0; 0.0, 1e-9], 1e-3).unwrap();
/// assert!((inverse - dmatrix![0.5, 0.0; 0.0, 1e3]).norm() < 1e-9);
/// ```
pub fn bounded_inverse(matrix: &DMatrix<f64>, floor: f64) -> Option<DMatrix<f64>> {
    let inverse = matrix.clone().try_inverse();
    if let Some(inverse) = inverse.filter(|inverse| inverse.iter().all(|x| x.abs() * floor <= 1.0)) {
        return Some(inverse);
    }
    if !matrix.iter().all(|x| x.is_finite()) {
        return None;
    }
    let mut svd = matrix.clone().svd(true, true);
    svd.singular_values.apply(|value| *value = value.max(floor));
    svd.pseudo_inverse(0.0).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn what_is_well_told_is_inverted_bit_for_bit() {
        let matrix = dmatrix![1.0, 0.3, -0.2; 0.1, 0.9, 0.4; 0.0, -0.5, 1.1];
        assert_eq!(bounded_inverse(&matrix, 1e-4), matrix.clone().try_inverse());
    }

    #[test]
    fn a_forgotten_direction_counts_as_the_floor() {
        let turn = dmatrix![0.8, -0.6; 0.6, 0.8];
        for forgotten in [1e-6, 1e-12] {
            let matrix = &turn * dmatrix![0.5, 0.0; 0.0, forgotten] * turn.transpose();
            let bounded = &turn * dmatrix![2.0, 0.0; 0.0, 1e4] * turn.transpose();
            assert!((bounded_inverse(&matrix, 1e-4).unwrap() - bounded).norm() < 1e-7);
        }
        assert!(bounded_inverse(&dmatrix![f64::NAN], 1e-4).is_none());
    }
}
