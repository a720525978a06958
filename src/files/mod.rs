//! Files in and out: model files, logged runs, and results that are whole or absent.
//!
//! Whatever a user hands in ends either as a value that needs no further checking or as one
//! [`Error`](crate::Error) with file, line, column and advice. The catalogues of vehicles and effects
//! are not known here; the caller passes what may stand in a model file as [`Known`].

pub(crate) mod atomic_write;
mod csv_quoting;
pub mod extension;
pub mod log;
pub mod manifest;
pub mod model;
mod output_path;
pub(crate) mod robot_description;
pub mod sweep;
pub mod toml;
mod write_together;

pub(crate) use atomic_write::{put_in_place, write_whole_with};
pub use atomic_write::{write_whole, write_whole_by};
pub(crate) use csv_quoting::quoted;
pub use extension::claims::{ClaimEntry, read_claims};
pub use extension::effects::{EffectsFile, UserEffect};
pub use extension::user_vehicle::{UserConstraint, UserPart, UserVehicle};
pub use extension::vehicles::VehiclesFile;
pub use log::cells::Cells;
pub use log::column_entry::{ColumnEntry, Kind, Reading};
pub use log::columns::{Columns, InputColumn, Resolved, ResolvedInput};
pub use log::header::read_beginning;
pub use log::inputs::Inputs;
pub use log::run::{Apart, Defined, Deviations, Run};
pub use log::two_clocks::Clock;
pub use manifest::{FleetLog, Manifest, Robot};
pub use model::dynamics::{ContactEntry, DynamicsEntry, StartEntry};
pub use model::effect_entry::EffectEntry;
pub use model::known::{Known, KnownDynamics, KnownEffect, KnownInput, KnownLaw, KnownParameter, KnownVehicle};
pub use model::measured::MeasuredEntry;
pub use model::measurement::{Initial, InputTiming, Noise, PoseFilter, Sensor};
pub use model::model_file::ModelFile;
pub use model::patch::VEHICLES_FILE;
pub(crate) use model::patch::{lines_of, with_pose_filter};
#[doc(hidden)]
pub use model::prior_entry::KnownBefore;
pub use model::scope_entry::{CourseEntry, Motion};
pub(crate) use output_path::{check_target, unwritable};
pub use sweep::axis::{Axis, AxisValues, Distribution, Sampled};
pub use sweep::sweep_file::{SweepFile, SweepInput, SweepRows};
pub use toml::formula_text::FormulaText;
pub use toml::location::Spot;
pub(crate) use toml::text::open;
pub use toml::text::read_text;
pub use write_together::write_all_or_nothing;

pub(crate) use log::cells::is_without_names;
pub(crate) use log::csv_cell::Cell;
pub(crate) use log::time_stamp::{is_iso_8601, iso_8601};
pub(crate) use toml::suggestions::{advice, shown};
