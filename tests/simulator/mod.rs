//! An independent simulator of measured runs: a vehicle with known hidden effects drives, a logger
//! writes down what an engineer would have.
//!
//! It exists to test the library and therefore shares nothing with it. No constraint is derived
//! and no formula is compiled: at every instant the wheels say, in world coordinates, how their
//! contact points move ([`contact`]), a 3×3 linear system gives the motion of the body, Newton's
//! law with masses and reactions moves what slips ([`body`]), trailers hang on points ([`trailer`]),
//! and an implicit Gauss scheme of order six ([`gauss`]) integrates it all.
//!
//! ```text
//! signal → profile → wheels ⟨hidden laws⟩ → contact → body, trailers → gauss → sensor → log
//! ```
//! Signs: x forward, y left, angles counter-clockwise, lateral speed positive to the left.

// Each test crate and the example that mount this module use another part of it.
#![allow(dead_code, unused_imports)]

mod body;
mod contact;
mod gauss;
mod hidden;
mod input_log;
mod lately;
mod laws;
mod log;
mod model;
mod profile;
mod scenario;
mod sensor;
mod signal;
mod trailer;
mod vehicle;

pub use gauss::advance;
pub use hidden::Hidden;
pub use input_log::InputLog;
pub use log::{Log, Truth};
pub use profile::Profile;
pub use scenario::{Scenario, Timing};
pub use sensor::{Mounting, Noise, Outliers};
pub use signal::Signal;
pub use vehicle::{Parameters, Tractor, Vehicle};
