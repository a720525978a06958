//! Report, page and pictures for people: every sentence of an answer is made here.

pub mod calibration_text;
pub(crate) mod changes;
pub mod check_text;
pub(crate) mod defect_text;
pub(crate) mod effect_names;
pub(crate) mod experiment_text;
pub mod figure_data;
pub(crate) mod finding_text;
pub mod html;
pub(crate) mod kinematic_text;
pub mod manoeuvre_text;
pub(crate) mod odd_run_text;
pub(crate) mod other_vehicle_text;
pub(crate) mod patched_state;
pub(crate) mod plain_text;
pub(crate) mod pose_filter_text;
pub(crate) mod reason_text;
pub(crate) mod refusal_text;
pub(crate) mod regime_text;
pub(crate) mod repair_text;
pub(crate) mod rest_text;
pub(crate) mod slip_text;
pub mod summary;
pub(crate) mod title_text;
pub(crate) mod warning_text;
