//! Motion: inputs as signals, trajectories and their exact sensitivities.

mod arcs;
mod conservative;
mod dop853;
mod drive;
mod driven;
mod energy;
mod ensemble;
mod exponential;
mod forgetting;
mod initial;
mod integrator;
mod lane_motion;
mod lane_stepper;
mod lookup;
mod signal;
mod simulate;
mod spline;
mod stepper;
mod stiff;
mod tableau;
mod trajectory;

pub(crate) use arcs::Arcs;
pub use conservative::{EndPoint, FIG7_DURATION, Instant, Reading, fig7_case, fig7_path, fig7_stepwise};
pub use drive::{Drive, Formulas};
pub use driven::{Creep, assembled, driven};
pub use energy::{Instantaneous, fig7_instants};
pub use ensemble::{Case, Ensemble, EnsembleInputs, Plan, Varied};
pub use initial::{initial_hidden, visible_state};
pub use integrator::{Integrator, Method};
pub(crate) use lane_stepper::LaneStepper;
pub use signal::{Signals, Timing};
pub use simulate::{Table, simulate_model};
pub use stepper::{Arc, Stepper};
pub use trajectory::{integrate, simulate, with_sensitivities};
