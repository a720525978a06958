//! Discrepancy: where model and measurement disagree, which effect is missing, and how much it mends.
//!
//! run → windows → fit → choose → gap → report. The statistical model of a run is
//!
//! | | |
//! |---|---|
//! | within a window | z′ = f(z, u, p): the model, exactly |
//! | at a window's end | z jumps by w ~ N(0, W·diag(q)): what no effect of the model explains |
//! | at a row | y = h(z, p) + v, v ~ N(0, σ²): the sensor |
//!
//! A jump is written in the body's axes: along the vehicle it violates the rotation constraint, across it the
//! traverse constraint, and the third is yaw. With q = 0 a run is one trajectory; with large q windows stand
//! alone. q and σ are estimated with the parameters, so noise, unexplained motion and effects are told apart.

pub mod align;
mod along;
pub mod angle;
mod begun;
pub mod bootstrap;
mod bounds;
pub mod carry;
pub mod chain;
pub mod choose;
pub mod clock;
mod coarse;
mod contested;
pub mod course;
pub mod crossval;
pub mod damped;
mod data;
pub mod discover;
mod driven;
pub mod envelope;
mod evidence;
mod exchange;
pub mod experiment;
pub mod fit;
#[cfg(test)]
mod fixtures;
pub mod gap;
pub mod html;
pub mod identifiable;
pub mod identity;
mod implausible;
mod judged;
mod limits;
mod listed;
pub mod locate;
pub mod manoeuvre;
pub mod noise;
pub mod outliers;
pub mod picture;
pub mod problem;
mod ranked;
pub mod rates;
pub mod record;
mod regimes;
pub mod relatives;
pub mod remaining;
pub mod report;
mod sampled;
pub mod screen;
mod selection;
mod slips;
pub mod smooth;
mod soon;
mod stable;
pub mod summary;
pub mod unnamed;
pub mod variances;
pub mod verdict;
mod walk;
pub mod whiteness;
pub mod windows;
