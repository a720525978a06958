//! The claims of the paper and of users, and the ledger of them.

mod checks;
mod coverage;
mod generated;
mod kernel;
mod ledger;
mod met;
#[path = "../support/mod.rs"]
mod support;
mod written;
