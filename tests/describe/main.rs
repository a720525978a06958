//! What `creepage describe` says of every vehicle with every effect.

mod formulas;
#[path = "../models/mod.rs"]
mod models;
mod regimes;
#[path = "../support/reviewed.rs"]
mod reviewed;
mod snapshots;
mod structure;
