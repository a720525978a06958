//! Many trajectories of one model: blocks of lanes, steps of order 8 or 4, and a check of every result.

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
