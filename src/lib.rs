//! Creep kinematics of nonholonomic vehicles.
#![warn(missing_docs)]

pub mod error;
pub mod files;
pub mod formula;
pub mod mechanism;

pub use error::{Error, Result};
