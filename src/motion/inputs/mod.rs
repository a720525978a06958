//! Logged inputs as functions of time.

pub(crate) mod cubic_spline;
pub(crate) mod drive;
pub(crate) mod lane_lookup;
pub(crate) mod signals;
