//! The program as it is run: what it prints and writes, and what it does with what is bad, odd or cut short.

mod bad_input;
#[path = "../support/bad_inputs.rs"]
mod bad_inputs;
mod cli;
mod daily_use;
#[path = "../support/digits.rs"]
mod digits;
mod drawn_plans;
mod edges;
mod export;
mod fit;
mod fleet;
mod hostile_names;
mod killed;
#[path = "../support/known.rs"]
mod known;
mod libraries;
mod odd_paths;
mod output;
mod own_forces;
mod own_states;
mod plan;
#[path = "../support/program.rs"]
mod program;
mod quiet;
#[path = "../support/reviewed.rs"]
mod reviewed;
#[path = "../simulator/mod.rs"]
mod simulator;
#[path = "../support/slips.rs"]
mod slips;
mod sweep;
mod track;
