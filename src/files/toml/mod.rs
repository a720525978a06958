//! TOML files with the span of every key, for messages that name file, line and column.

pub(crate) mod formula_text;
pub(crate) mod location;
pub(crate) mod spanned_table;
pub(crate) mod suggestions;
pub(crate) mod text;
pub(crate) mod user_file;
