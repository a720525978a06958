//! Tracking with creep: a plan driven in closed loop by a vehicle that creeps, with feedback on models that know of it or do not.
//!
//! | step | where |
//! |---|---|
//! | commands between samples | `commands` |
//! | poses with noise become states, coefficients of creep among them | `extended_kalman_filter` |
//! | commands that keep a model near its plan, within limits | `predictive_control` |
//! | a drive, sample by sample | `closed_loop` |
//! | ways to drive beside one another, their report, its words and a table | `job`, `report`, `tracking_text`, `drives_table` |

mod closed_loop;
mod commands;
mod drives_table;
mod extended_kalman_filter;
mod job;
mod predictive_control;
mod reference;
mod report;
mod tracking_text;

pub use drives_table::drives_table;
pub use job::{Tracked, Trials, Way, tracked};
pub use report::{Observed, SensorDeviation, TrackingReport, WayReport};
pub use tracking_text::tracking_text;
pub(crate) use tracking_text::way_in_words;
