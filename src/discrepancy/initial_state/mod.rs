//! Where a window can begin: the sensor inverted, headings from the path, states that no sensor sees.

pub(crate) mod first_rows;
pub mod heading_from_path;
pub(crate) mod hidden_state_fit;
pub mod hidden_states;
pub mod pose;
pub(crate) mod slow_manifold;
pub mod speed_fit;
