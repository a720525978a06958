//! A model file to begin with: every key with unit and meaning, columns found in a log.

pub(crate) mod column_matching;
pub(crate) mod column_names;
mod template;

pub use template::{Starter, Wanted};
