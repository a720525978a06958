//! The states of a vehicle that are free at the start of every window: its pose, and speeds that forces change.

use crate::formula::Symbol;
use std::sync::Arc;

/// A speed that forces change, and that a window does not forget.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Speed {
    /// Of the body, ahead.
    Along,
    /// Of the body, to the left.
    Across,
    /// The body's yaw rate.
    Yaw,
    /// The yaw rate of a trailer.
    Trailer,
    /// The rate of a wheel or a castor.
    Wheel,
}

impl Speed {
    /// The speed that a quasi-velocity is, by its name.
    pub(crate) fn named(name: &Symbol) -> Self {
        match name.as_str() {
            "body.u" => Self::Along,
            "body.w" => Self::Across,
            "body.omega" => Self::Yaw,
            other if other.starts_with("trailer_") => Self::Trailer,
            _ => Self::Wheel,
        }
    }
}

/// What of a vehicle is free at the start of every window, its pose, headings of trailers, speeds that forces change, and what
/// is measured beside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Freedom {
    /// How many trailers it has.
    pub trailers: usize,
    /// The speeds; none where the inputs say how it moves.
    pub speeds: Arc<[Speed]>,
    /// The quantities that a log measures beside its pose: the standard deviation of each, where it is known.
    pub quantities: Arc<[Option<f64>]>,
}

impl From<usize> for Freedom {
    fn from(trailers: usize) -> Self {
        Self { trailers, speeds: Arc::default(), quantities: Arc::default() }
    }
}
