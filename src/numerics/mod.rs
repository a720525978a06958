//! Methods of numerical mathematics that know nothing of vehicles.

pub mod levenberg_marquardt;
