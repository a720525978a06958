//! Vehicles that forces drive.

mod derived;
mod energy;
mod files;
mod laws;
mod sleigh;
mod steering;
mod vehicles;
