//! Compiled formulas run over blocks of lanes.

mod exec;
mod isa;
mod lane_program;
mod lower;
mod math;
mod rows;

pub use isa::{Isa, Kernel};
pub use lane_program::{Changes, Lanes, Memory};
pub use rows::Rows;
