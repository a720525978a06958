//! Sweep files.

pub(crate) mod axis;
pub(crate) mod sweep_file;
