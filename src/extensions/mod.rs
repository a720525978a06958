//! The library of effects and vehicles: those of the catalogues, and a user's own from a file.
//!
//! An effect of a user's own is held against every vehicle it applies to before anything else is done with it: names,
//! units, the value at which it vanishes, what the sensor may depend on, how far formulas grow when they are put into
//! one another. What passes can be used like an effect of the catalogue.

pub(crate) mod applicability;
mod forced_test_vehicle;
pub(crate) mod formula_growth;
mod names;
pub(crate) mod neutral_value;
mod sensor;
pub(crate) mod test_vehicle;
mod units;
mod user_effects;
mod vehicle;

pub use user_effects::{with_own, with_own_on};
pub use vehicle::{vehicles_of, vehicles_with_own};
