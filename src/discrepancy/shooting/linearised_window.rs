//! A window linearised about its start: what its rows say of states and parameters.

use crate::discrepancy::shooting::block_sums::Blocks;
use nalgebra::DMatrix;

/// The model along one window: to first order in the start z and the parameters p,
/// residuals r + J·(δz, δp) and end e + F·δz + B·δp.
#[derive(Clone, Debug)]
pub struct LinearisedWindow {
    /// Σ (J, r)ᵀ(J, r) for each component of the measurement noise, columns (z, p, 1).
    pub gram: Vec<DMatrix<f64>>,
    /// Number of values with each.
    pub count: Vec<usize>,
    /// Residuals of neighbouring rows together, for each.
    pub blocks: Vec<Blocks>,
    /// δz of this window's start as (δz̃, δp, 1)-columns, δz̃ being the end before the jump against the next start.
    pub back: Option<DMatrix<f64>>,
    /// Axes of the body at the window's end; columns along, across, yaw, trailers.
    pub axes: DMatrix<f64>,
    /// Duration, s.
    pub duration: f64,
    /// End of the window minus the next start, in the body's axes.
    pub mismatch: Vec<f64>,
    /// How many numbers its rows were asked for about how the hidden states begin; of the first window of a segment.
    pub initial_state_dof: f64,
}

impl LinearisedWindow {
    /// Sum of the squared residuals with one component of the noise.
    pub fn square(&self, channel: usize) -> f64 {
        let last = self.gram[channel].nrows() - 1;
        self.gram[channel][(last, last)]
    }
}
