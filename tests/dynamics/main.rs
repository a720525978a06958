//! Vehicles that forces drive.

mod derived;
mod energy;
mod files;
mod laws;
mod lowered;
mod sleigh;
mod steering;
mod vehicles;
