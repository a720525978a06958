//! Orthonormal directions, and what of a vector lies outside them.

use nalgebra::DVector;

/// A direction of which less than this share is new adds nothing.
const NEW: f64 = 1e-7;

/// Directions at right angles to each other, of length one.
#[derive(Clone, Debug, Default)]
pub struct Basis(Vec<DVector<f64>>);

impl Basis {
    /// With the part of a vector that is new.
    pub fn with(mut self, vector: &DVector<f64>) -> Self {
        let rest = self.outside(vector);
        let norm = rest.norm();
        if norm > NEW * vector.norm() {
            self.0.push(rest / norm);
        }
        self
    }

    /// What of a vector lies outside, orthogonalised twice against rounding.
    pub fn outside(&self, vector: &DVector<f64>) -> DVector<f64> {
        let mut rest = vector.clone();
        for _ in 0..2 {
            for direction in &self.0 {
                rest.axpy(-direction.dot(&rest), direction, 1.0);
            }
        }
        rest
    }
}
