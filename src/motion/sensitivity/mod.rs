//! Trajectories with exact derivatives: the variational equations beside the model.

pub(crate) mod equilibrium;
pub(crate) mod exponential_stepper;
pub(crate) mod exponential_weights;
pub(crate) mod lane_stepper;
pub(crate) mod single_stepper;
pub(crate) mod states;
pub(crate) mod variational_equations;
