//! Calibration: effects that a user names are fitted together, and none is selected.
//!
//! Bias by selection is what it avoids: an effect that a run does not show significantly is estimated all the same, with its
//! deviation and its covariance, so that values of many runs or robots can be put together.

pub mod calibrate;
mod profile_likelihood;
pub mod targets;
