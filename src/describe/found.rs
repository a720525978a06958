//! A part of a description, or in words why it is not known.

/// A part of the structure, or in words why it is not known.
pub type Found<T> = std::result::Result<T, String>;
