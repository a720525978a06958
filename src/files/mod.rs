//! Files in and out: model files, logged runs, and results that are whole or absent.
//!
//! Whatever a user hands in ends either as a value that needs no further checking or as one
//! [`Error`](crate::Error) with file, line, column and advice. The catalogues of vehicles and effects
//! are not known here; the caller passes what may stand in a model file as [`Known`].

mod apart;
#[cfg(feature = "mcap")]
mod bag;
mod cell;
mod claims_file;
mod columns;
mod dynamics_section;
mod effect_entry;
mod effect_parameter;
mod effects_file;
mod formula_text;
mod header;
mod inputs_file;
mod known;
mod log;
mod model_file;
mod near;
mod order;
mod output;
mod own_file;
mod parameters;
#[cfg(feature = "parquet")]
mod parquet_log;
mod patch;
mod records;
mod run_file;
mod sheet;
mod spot;
mod sweep_axis;
mod sweep_file;
mod text;
mod toml_table;
#[cfg(any(feature = "parquet", feature = "mcap"))]
mod usable;
mod vehicle_constraints;
mod vehicle_parts;
mod vehicle_quantities;
mod vehicle_types;
mod vehicles_file;

pub use apart::Clock;
pub use claims_file::{ClaimEntry, read_claims};
pub use columns::{Columns, InputColumn, Resolved, ResolvedInput};
pub use dynamics_section::{ContactEntry, DynamicsEntry, StartEntry};
pub use effect_entry::EffectEntry;
pub use effects_file::{EffectsFile, OwnEffect};
pub use formula_text::FormulaText;
pub use header::read_header;
pub use inputs_file::Inputs;
pub use known::{Known, KnownDynamics, KnownEffect, KnownInput, KnownLaw, KnownParameter, KnownVehicle};
pub use model_file::{Initial, InputTiming, ModelFile, Noise, Sensor};
pub(crate) use output::{check_target, put_in_place, unwritable, write_whole_with};
pub use output::{write_all_or_nothing, write_whole, write_whole_by};
pub use patch::VEHICLES_FILE;
pub use run_file::{Apart, Run};
pub use spot::Spot;
pub use sweep_axis::{Axis, AxisValues, Distribution, Sampled};
pub use sweep_file::{SweepFile, SweepInput, SweepRows};
pub(crate) use text::open;
pub use text::read_text;
pub use vehicles_file::{OwnConstraint, OwnPart, OwnVehicle, VehiclesFile};

pub(crate) use near::{advice, shown};
