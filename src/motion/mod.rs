//! Motion: inputs as signals, trajectories and their exact sensitivities.

mod signal;
mod spline;
mod stepper;

pub use signal::{Signals, Timing};
pub use stepper::{Arc, Stepper};
