//! The meaning of a fit: verdict, equivalent effects, plausibility, contradictions, gaps before and after.

pub mod advice;
pub(crate) mod before_after;
pub(crate) mod contradictions;
pub mod equivalents;
pub(crate) mod findings;
pub(crate) mod forecasts;
pub(crate) mod held_out;
pub(crate) mod plausibility;
pub mod reason;
pub(crate) mod rest;
pub(crate) mod scope_spans;
pub mod verdict;
pub mod warning;
