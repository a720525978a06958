//! Model files and how a finding is written into them.

pub(crate) mod dynamics;
pub(crate) mod effect_entry;
pub(crate) mod known;
pub(crate) mod model_file;
pub(crate) mod parameters;
pub(crate) mod patch;
