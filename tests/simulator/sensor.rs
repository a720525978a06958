//! The sensors: where the tracked point sits, how they scatter, and which rows they lose.

use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use std::f64::consts::{PI, TAU};

/// Gaussian scatter of the measured pose, 1 sigma; inputs are logged exactly.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Noise {
    /// Of x and of y, m.
    pub position: f64,
    /// Of every measured heading, rad.
    pub heading: f64,
}

impl Noise {
    /// An optical tracking system: 2 mm and 2 mrad.
    pub const MOCAP: Noise = Noise { position: 0.002, heading: 0.002 };
    /// Satellites with a reference station: 20 mm and 10 mrad.
    pub const RTK: Noise = Noise { position: 0.02, heading: 0.01 };
}

/// Gross errors: single rows whose measured position jumps.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outliers {
    /// Share of the rows, 0 to 1.
    pub share: f64,
    /// Standard deviation of the jump, m.
    pub size: f64,
}

/// Where the measured pose sits on the body, as far as the user knows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Mounting {
    /// Forward and left of the reference point, m.
    pub lever_arm: [f64; 2],
    /// Measured minus body heading, rad.
    pub heading_offset: f64,
}

/// Scatters a measured position (m) and the headings (rad) in place.
pub fn disturb(
    position: &mut [f64; 2],
    headings: &mut [f64],
    noise: Noise,
    outliers: Outliers,
    random: &mut ChaCha8Rng,
) {
    // The same draws whatever the settings: a run without outliers keeps its noise when they come.
    let jumps = random.random::<f64>() < outliers.share;
    for value in position {
        let jump = if jumps { outliers.size } else { 0.0 };
        *value += noise.position * normal(random) + jump * normal(random);
    }
    for value in headings {
        *value += noise.heading * normal(random);
    }
}

fn normal(random: &mut ChaCha8Rng) -> f64 {
    random.sample(StandardNormal)
}

/// The same angle in (−π, π].
pub fn wrapped(angle: f64) -> f64 {
    let turned = (angle + PI).rem_euclid(TAU) - PI;
    if turned == -PI { PI } else { turned }
}
