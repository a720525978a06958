//! The ledger written down.

mod contents;
mod errata;
mod json;
mod text;

pub use contents::{claims_json, claims_text, contents};
pub use errata::errata;
pub use json::json;
pub use text::text;
