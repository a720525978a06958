//! The noise model: variances of the sensor (measurement noise) and of the jumps between windows (process noise).

/// Variances of the statistical model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseModel {
    /// Of a measured position (m²), heading and trailer heading (rad²).
    pub measurement: [f64; 3],
    /// Of the jump, for each second: along, across (m²/s), yaw, trailer heading (rad²/s).
    pub process: [f64; 4],
}

impl NoiseModel {
    /// Whether two sets differ by no more than their estimation could tell.
    pub fn close_to(&self, other: &NoiseModel) -> bool {
        let pairs = self.measurement.iter().zip(&other.measurement).chain(self.process.iter().zip(&other.process));
        pairs.into_iter().all(|(a, b)| (a / b).ln().abs() < 0.2)
    }
}

/// Which variances are free.
#[derive(Clone, Copy, Debug)]
pub struct Estimated {
    /// Noise of position, heading, trailer heading.
    pub measurement: [bool; 3],
    /// Jumps along, across, yaw, trailer.
    pub process: [bool; 4],
}
