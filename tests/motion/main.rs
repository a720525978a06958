//! Motion: kinematics, integrators, sensitivities, ensembles, and what they cost.

mod cost_of_trailers;
mod ensemble;
mod every_effect;
mod ideal_limit;
mod integrator;
mod kinematics;
mod order;
mod scaling;
mod sensitivity;
#[path = "../support/mod.rs"]
mod support;
