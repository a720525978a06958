//! Vehicles that are generated: wheels of any radius, place and heading, fixed, steered or castors, and trailers.
//!
//! No wheel has the radius of another. A fixed wheel is mounted at an angle to the body. Rigid bodies only turn about a
//! point, so an ideal vehicle moves only if the axles of all its fixed and steered wheels meet in one point, or are
//! parallel; which of its wheels stand so is part of its making:
//!
//! | wheel | stands | leaves the ideal vehicle |
//! |---|---|---|
//! | abreast | on the line of the axle, facing as it does or backwards | all freedoms |
//! | castor | anywhere, at any angle | all freedoms |
//! | askew | at any heading, its axle through the centre of turning; parallel where the vehicle drives straight | one: circling that centre |
//! | loose | anywhere, at any heading | none; it moves by creep alone |
//!
//! [`vehicles`] makes those that the theorems speak of, which creep *near* an ideal motion: none of their wheels is
//! loose. [`loose_vehicles`] makes any.

mod constrained_motion;
mod describe;
mod moving;
mod plane;
mod stand;
mod strategy;
mod vehicle;

pub use constrained_motion::ConstrainedMotion;
pub use moving::{Contact, Moving};
pub use stand::{Facing, Placed};
pub use strategy::{any_drive, loose_vehicles, moving, vehicles};
pub use vehicle::{Drive, Generated};
