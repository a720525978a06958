//! Trajectories with exact derivatives, by the variational equations beside those of the model.

mod collocation_sensitivity;
mod collocation_stepper;
pub(crate) mod equilibrium;
pub(crate) mod exponential_stepper;
pub(crate) mod exponential_weights;
pub(crate) mod lane_stepper;
mod radau_tableau;
pub(crate) mod single_stepper;
pub(crate) mod states;
pub(crate) mod variational_equations;
