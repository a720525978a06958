//! Model files (TOML): read and checked, and patched by the effects that were found.

pub(crate) mod dynamics;
pub(crate) mod effect_entry;
pub(crate) mod known;
pub(crate) mod measured;
pub(crate) mod measurement;
pub(crate) mod model_file;
pub(crate) mod parameters;
pub(crate) mod patch;
pub(crate) mod prior_entry;
pub(crate) mod scope_entry;
