//! Creep kinematics of nonholonomic vehicles.
#![warn(missing_docs)]

pub mod claims;
pub mod connection;
pub mod describe;
pub mod discrepancy;
pub mod dynamics;
pub mod effects;
pub mod error;
pub mod figures;
pub mod files;
pub mod formula;
pub mod library;
pub mod mechanism;
pub mod model;
pub mod motion;
pub mod origin;
pub mod picture;
pub mod starter;
pub mod sweep;
pub mod theory;
pub mod vehicles;

pub use error::{Error, Result};
