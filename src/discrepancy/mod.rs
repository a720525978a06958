//! Discrepancy: where model and measurement disagree, which effect is missing, and how much it mends.
//!
//! run → windows → fit → choose → gap → report. The statistical model of a run is
//!
//! | | |
//! |---|---|
//! | within a window | z′ = f(z, u, p): the model, exactly |
//! | at a window's end | z jumps by w ~ N(0, W·diag(q)): what no effect of the model explains |
//! | at a row | y = h(z, p) + v, v ~ N(0, σ²): the sensor |
//!
//! A jump is written in the body's axes: along the vehicle it violates the rotation constraint, across it the
//! traverse constraint, and the third is yaw. With q = 0 a run is one trajectory; with large q windows stand
//! alone. q and σ are estimated with the parameters, so noise, unexplained motion and effects are told apart.

pub mod calibration;
pub mod calibration_report;
pub mod check;
pub mod clock_alignment;
pub mod diagnosis;
pub mod discover;
pub mod discovery;
pub mod estimation;
pub mod evidence;
pub mod experiment;
#[cfg(test)]
mod fixtures;
pub mod identifiability;
pub mod initial_state;
mod kinematic_comparison;
pub mod localisation;
pub mod pipeline;
mod pose_filter;
pub mod preprocessing;
pub mod record;
pub mod rendering;
pub mod report;
pub mod request;
pub mod selection;
pub mod shooting;
