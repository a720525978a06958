//! Where and when model and data disagree.

pub(crate) mod asked_motion;
pub mod clock_drift;
pub mod constraint_residuals;
pub(crate) mod driving_regimes;
pub mod sensor_residuals;
pub mod unexplained_motion;
pub(crate) mod whiteness;
