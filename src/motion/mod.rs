//! Motion: inputs as signals, trajectories and their exact sensitivities.

pub(crate) mod catalogue_model;
mod ensemble;
#[doc(hidden)]
pub mod inputs;
#[doc(hidden)]
pub mod integrators;
mod pose_quadrature;
#[doc(hidden)]
pub mod sensitivity;
mod simulate;
mod trajectory;

pub(crate) use catalogue_model::driven_by;
#[doc(hidden)]
pub use catalogue_model::{Creep, assembled, driven};
#[doc(hidden)]
pub use ensemble::{Case, Ensemble, EnsembleInputs, Plan, Varied};
#[doc(hidden)]
pub use inputs::drive::Drive;
pub use inputs::drive::Formulas;
pub use inputs::signals::Signals;
#[doc(hidden)]
pub use inputs::signals::Timing;
pub(crate) use inputs::signals::{running_integral, timings};
pub use integrators::integrator::Integrator;
#[doc(hidden)]
pub use integrators::integrator::Method;
#[doc(hidden)]
pub use sensitivity::equilibrium::{initial_hidden, visible_state};
pub(crate) use sensitivity::lane_stepper::LaneStepper;
#[doc(hidden)]
pub use sensitivity::single_stepper::Stepper;
pub(crate) use sensitivity::states::LaneStates;
#[doc(hidden)]
pub use sensitivity::states::StateSensitivity;
pub use simulate::Table;
#[doc(hidden)]
pub use simulate::simulate_model;
pub(crate) use trajectory::input_delays;
pub use trajectory::simulate;
#[doc(hidden)]
pub use trajectory::{integrate, with_sensitivities};
