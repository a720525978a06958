//! A model file to begin with: every key with unit and meaning, columns found in a log.

pub(crate) mod column_matching;
pub(crate) mod column_names;
mod column_units;
mod proposals;
mod samples;
mod template;
mod urdf;

pub use template::{Starter, Wanted};
pub use urdf::Measures;
