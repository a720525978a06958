//! The ledger of claims in its written forms: text, JSON, the table of contents and the errata.

mod contents;
mod errata;
mod json;
mod text;

pub use contents::{claims_json, claims_text, contents};
pub use errata::errata;
pub use json::json;
pub use text::{proofs_text, text};
