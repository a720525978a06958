//! Many trajectories of one model: blocks of lanes, Runge–Kutta steps of order 8 or 4, and an error estimate for every
//! case.

mod case;
mod equations;
mod initial_states;
mod lanes;
mod model_ensemble;
mod plan;
mod refine;
mod rounding;
mod start;
mod steps;

pub use case::Case;
pub use equations::{EnsembleInputs, Varied};
pub use model_ensemble::Ensemble;
pub use plan::Plan;
