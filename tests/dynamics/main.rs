//! Vehicles that forces drive.

mod derived;
mod energy;
mod files;
#[allow(dead_code, unused_imports)]
#[path = "../simulator/forces/mod.rs"]
mod forces;
mod laws;
mod lowered;
mod parked;
mod simulated;
mod sleigh;
mod steering;
mod vehicles;
