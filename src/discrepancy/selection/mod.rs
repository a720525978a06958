//! Which effects are selected: a search that never sees held-out data.

pub(crate) mod backward;
pub(crate) mod candidates;
pub mod choice;
pub(crate) mod input_noise;
pub(crate) mod input_sampling;
mod interval_search;
pub(crate) mod limits;
mod memo;
pub mod odd_run;
pub mod other_vehicle;
pub(crate) mod refusals;
pub(crate) mod refute;
pub(crate) mod rounded_inputs;
mod scope_deviation;
pub(crate) mod scope_proposals;
mod scope_refinement;
mod scope_screen;
pub(crate) mod scopes;
pub(crate) mod search;
mod second_choice;
pub mod select;
pub(crate) mod stability;
pub(crate) mod stepwise;
pub(crate) mod transients;
pub mod unnamed_terms;
pub(crate) mod walks;
