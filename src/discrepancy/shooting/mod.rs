//! Multiple shooting (Bock and Plitt, 1984): a run in short windows, each integrated with its sensitivities from a state of its own.

pub mod block_sums;
mod hidden_start;
mod hidden_trajectory;
pub mod linearised_window;
pub mod rollout;
pub(crate) mod row_sums;
pub mod window_integration;
pub mod windows;
