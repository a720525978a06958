//! Constraints of mechanisms: forms, growth, regimes, realisation, effects.

mod effects;
mod forms;
mod growth;
mod growth_laws;
#[path = "../models/mod.rs"]
mod models;
mod motion;
mod realisation;
mod regime;
#[path = "../support/mod.rs"]
mod support;
mod vehicles;
