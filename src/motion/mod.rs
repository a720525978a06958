//! Motion: inputs as signals, trajectories and their exact sensitivities.

mod signal;
mod spline;

pub use signal::{Signals, Timing};
