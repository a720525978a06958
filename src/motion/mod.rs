//! Motion: inputs as signals, trajectories and their exact sensitivities.

pub(crate) mod catalogue_model;
mod ensemble;
pub mod inputs;
pub mod integrators;
pub mod sensitivity;
mod simulate;
mod trajectory;

pub use catalogue_model::{Creep, assembled, driven};
pub use ensemble::{Case, Ensemble, EnsembleInputs, Plan, Varied};
pub use inputs::drive::{Drive, Formulas};
pub(crate) use inputs::signals::timings;
pub use inputs::signals::{Signals, Timing};
pub use integrators::integrator::{Integrator, Method};
pub use sensitivity::equilibrium::{initial_hidden, visible_state};
pub(crate) use sensitivity::lane_stepper::LaneStepper;
pub use sensitivity::single_stepper::Stepper;
pub(crate) use sensitivity::states::LaneStates;
pub use sensitivity::states::StateSensitivity;
pub use simulate::{Table, simulate_model};
pub use trajectory::{integrate, simulate, with_sensitivities};
