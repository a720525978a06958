//! A fleet: many robots, many runs, and what they say together.
//!
//! | step | where |
//! |---|---|
//! | a table of logs with robot, model and tags | `files/manifest` |
//! | `discover` on the runs of each robot, resumable and in shards | `map`, `rows` |
//! | the effects that more robots name than mistakes explain | `needed_effects`, `false_discovery_rate` |
//! | `fit` of these on every run, significant or not | `fits` |
//! | robots, runs, tags and wear: a mixed model by restricted maximum likelihood | `linear_mixed_model`, `covariates`, `parameter_model` |
//! | robots and runs that differ | `outlying_robots` |
//! | the report, a page, a table, a model for each robot | `join`, `column`, `report`, `rendering`, `robot_models` |

mod column;
mod covariates;
mod false_discovery_rate;
mod fits;
mod join;
mod linear_mixed_model;
mod map;
mod needed_effects;
mod outlying_robots;
mod parameter_model;
mod rendering;
mod report;
mod robot_models;
mod rows;

pub(crate) use covariates::days;
pub use join::{Joined, join};
pub use map::{Outcome, map};
pub use rendering::fleet_html::fleet_html;
#[cfg(feature = "parquet")]
pub use rendering::fleet_table::fleet_parquet;
pub use rendering::fleet_table::fleet_table;
pub use rendering::fleet_text::fleet_text;
pub use report::*;
pub use robot_models::RobotModel;
pub use rows::{Mapped, Rows};
