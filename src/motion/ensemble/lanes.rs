//! The lanes of a block: so many cases are integrated side by side by vector instructions.

/// Lanes of a block: four vectors of AVX-512.
pub(crate) const LANES: usize = 32;

/// The lanes of one quantity.
pub(crate) type Lane = [f64; LANES];
