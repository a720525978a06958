//! The paper's energy rule: Fig. 7 under both readings.

pub(crate) mod instants;
pub(crate) mod readings;
