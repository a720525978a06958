//! The front door: the jobs of the program as calls of one line, on models and runs that need no file.

mod discover;
mod discovery;
mod model;
mod options;
mod run;
mod simulate_many;
mod verify;

pub use discover::{check, check_with, describe, describe_with, discover, discover_with, fit, simulate};
pub use discovery::Discovery;
pub use model::Model;
pub use options::Options;
pub use run::Pose;
pub use simulate_many::{Motions, simulate_many};
pub use verify::{sweep, verify};
