//! The discrepancy workflow on drawn runs: names, laws, intervals, verdicts, advice.

mod asynchronous;
mod begun_anywhere;
mod bootstrap;
mod coloured_noise;
mod contradicted;
mod different_drives;
mod drifting;
mod filtered_poses;
mod fit_coverage;
mod fit_rates;
mod fit_statistics;
#[path = "../forced/mod.rs"]
mod forced;
mod forces;
#[allow(dead_code, unused_imports)]
#[path = "../simulator/forces/mod.rs"]
mod forces_simulator;
mod gross_errors;
mod hidden_forces;
mod laws;
mod logs_of_another_vehicle;
mod measured;
mod names;
mod next_experiment;
#[path = "../support/noisy_run.rs"]
mod noisy_run;
mod other_vehicles;
mod places_alone;
#[path = "../support/read_back.rs"]
mod read_back;
mod scopes;
mod short_runs;
#[path = "../simulator/mod.rs"]
mod simulator;
mod simulator_laws;
mod slow_logs;
mod sparse_poses;
mod trust_small;
mod unit_slips;
mod unnamed;
