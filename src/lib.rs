//! Creep kinematics of nonholonomic vehicles.
#![warn(missing_docs)]

pub mod discrepancy;
pub mod error;
pub mod formula;
pub mod picture;

pub use error::{Error, Result};
