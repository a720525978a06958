//! Constraints that come of a symmetry: momentum, connections, drag.

mod bodies;
mod cat;
mod connection;
mod drag;
mod hopper;
#[path = "../models/mod.rs"]
mod models;
mod momentum;
#[path = "../support/mod.rs"]
mod support;
mod types;
