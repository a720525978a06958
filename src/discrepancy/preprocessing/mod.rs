//! Data set right before a fit: outliers, errors of units, quantised inputs.

pub(crate) mod cleaned_run;
mod clipped_inputs;
pub(crate) mod clock_jumps;
pub(crate) mod dataset;
pub(crate) mod dead_reckoning;
mod generated_run;
mod held_poses;
pub(crate) mod input_effects;
mod input_spikes;
pub(crate) mod motion_ratios;
mod other_motion;
pub mod outliers;
mod path_pair;
pub(crate) mod prepared_run;
pub(crate) mod quantisation;
pub(crate) mod reference_jumps;
pub(crate) mod repair_search;
pub(crate) mod repair_trial;
pub(crate) mod repairs;
pub(crate) mod row_defects;
pub(crate) mod servo_line;
pub(crate) mod signed_ratios;
pub(crate) mod slips;
pub(crate) mod stamp_defects;
pub(crate) mod unit_errors;
