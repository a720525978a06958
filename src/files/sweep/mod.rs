//! Sweep files (TOML): one model, a grid or a sample of its values.

pub(crate) mod axis;
pub(crate) mod sweep_file;
