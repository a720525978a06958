//! Methods of numerical mathematics that know nothing of vehicles.

pub mod bounded_inverse;
pub mod levenberg_marquardt;
pub mod row_factors;
mod secant_curvature;
mod usual_step;

pub(crate) use usual_step::usual_step;
