//! Reports and figures as a person has read and accepted them.

#[path = "../support/cornering.rs"]
mod cornering;
mod fig7;
mod figures;
mod html;
mod many;
#[path = "../models/mod.rs"]
mod models;
mod one;
#[path = "../support/reviewed.rs"]
mod reviewed;
#[path = "../support/rounded.rs"]
mod rounded;
#[path = "../simulator/mod.rs"]
mod simulator;
#[path = "../synthetic/mod.rs"]
mod synthetic;
