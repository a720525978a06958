//! The paper's energy rule: the motion of Fig. 7 under each reading of the word "conservative".

pub(crate) mod instants;
pub(crate) mod readings;

pub use instants::{Instantaneous, fig7_instants};
pub use readings::{EndPoint, FIG7_DURATION, Instant, Reading, fig7_case, fig7_path, fig7_stepwise};
