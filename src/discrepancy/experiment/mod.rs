//! Optimal experiment design: the manoeuvre that would tell rival effects apart.

pub mod design;
pub mod envelope;
pub mod manoeuvre;
pub mod next_step;
mod predicted_fit;
