//! Runs whose inputs and poses have clocks of their own: the clocks aligned, then `discover`.
//!
//! | step | how |
//! |---|---|
//! | coarse | the way and the turn of every second, by the model from the inputs and by the poses; offset and drift of the largest correlation |
//! | fine | the fit of the model with a delay of the inputs that is free, and a drift by the deviance's parabola |
//! | choice | effects, the delay of all runs among them: what it finds is added to the clocks |
//! | again | the fine step beside the effects that were chosen, so that no effect hides in a clock |
//!
//! A delay of the inputs and an offset of their clock are one and the same here, so `input-delay` is never named.

pub(crate) mod aligned_run;
pub(crate) mod cross_correlation;
pub(crate) mod refinement;
pub(crate) mod speed_profile;

pub use aligned_run::Aligned;
pub use refinement::{Fitted, refined};
