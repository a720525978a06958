//! Files that a user hands over: models, logs, effects, vehicles of their own.

#[path = "../support/bad_effects.rs"]
mod bad_effects;
#[path = "../support/bad_formulas.rs"]
mod bad_formulas;
#[path = "../support/bad_inputs.rs"]
#[allow(dead_code, reason = "the table of bad inputs is another test's")]
mod bad_inputs;
#[path = "../support/bad_vehicles.rs"]
mod bad_vehicles;
mod bag_definitions;
mod bag_messages;
mod bounds;
mod effects_identity;
mod kept;
#[path = "../support/known.rs"]
mod known;
mod log_formats;
mod measured;
mod model_terms;
#[path = "../models/mod.rs"]
mod models;
mod own_format;
mod parquet_types;
#[path = "../support/program.rs"]
mod program;
mod read;
mod robot_description;
mod robot_logs;
#[path = "../simulator/mod.rs"]
mod simulator;
#[path = "../support/slips.rs"]
mod slips;
#[path = "../support/mod.rs"]
mod support;
#[cfg(feature = "mcap")]
#[path = "../../examples/to_bag.rs"]
#[allow(dead_code)]
mod to_bag;
#[cfg(feature = "parquet")]
#[path = "../../examples/to_parquet.rs"]
#[allow(dead_code)]
mod to_parquet;
mod two_files;
#[cfg(any(feature = "mcap", feature = "parquet"))]
#[path = "../support/two_names.rs"]
mod two_names;
mod user_effects;
mod user_vehicles;
