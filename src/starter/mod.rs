//! A model file to begin with: every key with unit and meaning, columns found in a log.

mod matching;
mod spellings;
mod template;

pub use template::{Starter, Wanted};
