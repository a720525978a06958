//! The step of Levenberg and Marquardt.

use nalgebra::{DMatrix, DVector};

/// The step −(H + λ·D)⁻¹·g of a sum of squares; `None` where no step is defined.
///
/// | symbol | meaning |
/// |---|---|
/// | H | information matrix, JᵀJ weighted by the variances |
/// | g | gradient Jᵀr of half the sum of squares |
/// | λ | damping: 0 is the step of Gauss and Newton, much of it a short step downhill |
/// | D | the diagonal of H, or what was `seen` of it before where that is larger: a parameter that the residuals cease to depend on does not run away |
///
/// A parameter without information stays where it is.
///
/// Source: D. W. Marquardt, *An algorithm for least-squares estimation of nonlinear parameters*, SIAM J. 11 (1963); D as
/// in J. J. Moré, *The Levenberg–Marquardt algorithm: implementation and theory* (1978).
///
/// ```
/// use creepage::discrepancy::estimation::levenberg_marquardt::damped_step;
/// use nalgebra::{dmatrix, dvector};
/// // y = 2 b and y = 4 at b = 1: the residual is −2, the minimum lies one further.
/// let step = damped_step(dmatrix![4.0], &dvector![-4.0], 0.0, &dvector![0.0]).unwrap();
/// assert!((step[0] - 1.0).abs() < 1e-15);
/// ```
pub fn damped_step(
    mut information: DMatrix<f64>,
    gradient: &DVector<f64>,
    damping: f64,
    seen: &DVector<f64>,
) -> Option<DVector<f64>> {
    for i in 0..information.nrows() {
        let d = information[(i, i)];
        information[(i, i)] = match seen[i] > d {
            true => d + damping * seen[i],
            false if d > 0.0 => d * (1.0 + damping),
            false => 1.0,
        };
    }
    let step = -information.cholesky()?.solve(gradient);
    step.iter().all(|x| x.is_finite()).then_some(step)
}
