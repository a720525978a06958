//! Motion planning with creep: inputs under which a model as it is reaches a pose, by direct multiple shooting (Bock and Plitt
//! 1984; Betts, *Practical Methods for Optimal Control*, 2010, chapters 3 and 4).
//!
//! | step | where |
//! |---|---|
//! | inputs as splines whose coefficients bound value and slope | `b_spline`, `limits` |
//! | motion over a span, with exact derivatives | `shooting` |
//! | what is to be reached: the sensor's pose, or a trailer's | `tracked_point`, `path` |
//! | the nonlinear program, and steps to its solution | `transcription`, `cost`, `quadratic_program`, `sequential_quadratic_programming` |
//! | where the search begins, and how it goes on from there | `first_guesses`, `initial_guess`, `trailing`, `continuation` |
//! | inputs that act late, or do not act everywhere | `dead_time`, `smoothing` |
//! | what no input changes | `reachability` |
//! | the task; the plan, or why there is none | `task`, `planner`, `plan`, `infeasible` |
//! | rows that a robot can be given, what becomes of them on a model, and how they lead to the goal | `plan_table`, `execution`, `correction` |
//! | the job as a whole, its report, its words | `job`, `report`, `plan_text` |

mod b_spline;
mod continuation;
mod correction;
mod cost;
mod dead_time;
mod execution;
mod first_guesses;
mod infeasible;
mod initial_guess;
mod job;
mod limits;
mod path;
mod plan;
mod plan_table;
mod plan_text;
mod planner;
mod quadratic_program;
mod reachability;
mod report;
mod sequential_quadratic_programming;
mod shooting;
mod smoothing;
mod task;
mod tracked_point;
mod trailing;
mod transcription;

pub(crate) use b_spline::BSpline;
pub use dead_time::DeadTime;
pub use execution::{Executed, execute, plan_rows, spread};
pub use infeasible::Infeasible;
pub(crate) use initial_guess::nearest;
pub use job::{Covariance, Planned, planned};
pub use limits::{Limit, Said, with_said};
pub use path::Path;
pub use plan::Plan;
pub use plan_table::plan_table;
pub use plan_text::{infeasible, plan_text};
pub use planner::{BEND, plan};
pub(crate) use quadratic_program::QuadraticProgram;
pub use reachability::Fixed;
pub use report::{Ideal, PlanReport, Reached, Spread};
pub(crate) use shooting::Shooting;
pub use task::Task;
pub use transcription::Weights;
