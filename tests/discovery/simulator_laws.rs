//! The simulator against closed forms and symmetries that its code does not contain.

#[path = "../simulator/checks/effects.rs"]
mod effects;
#[path = "../simulator/checks/integration.rs"]
mod integration;
#[path = "../simulator/checks/logging.rs"]
mod logging;
#[path = "../simulator/checks/motion.rs"]
mod motion;
#[path = "../simulator/checks/symmetry.rs"]
mod symmetry;

use crate::simulator::{Hidden, Log, Scenario, Tractor, Truth, Vehicle};

const TRACTORS: [Tractor; 5] =
    [Tractor::Unicycle, Tractor::DifferentialDrive, Tractor::Tricycle, Tractor::Car, Tractor::FourWheelCar];

/// A short exact run from the origin, heading along x.
fn short(vehicle: impl Into<Vehicle>, seed: u64) -> Scenario {
    Scenario { duration: 12.0, start: [0.0; 3], ..Scenario::new(vehicle, seed) }
}

fn hiding(scenario: &Scenario, hidden: &[Hidden]) -> Log {
    let hidden = hidden.to_vec();
    Scenario { hidden, ..scenario.clone() }.run()
}

#[track_caller]
fn near(a: f64, b: f64, within: f64) {
    assert!((a - b).abs() <= within, "{a} is not {b} within {within:e}");
}

/// Both runs pass the same poses at the same times.
#[track_caller]
fn same_path(a: &Log, b: &Log, within: f64) {
    assert_eq!(a.truth.len(), b.truth.len());
    for (a, b) in a.truth.iter().zip(&b.truth) {
        near(a.x, b.x, within);
        near(a.y, b.y, within);
        near(a.heading, b.heading, within);
    }
}

/// The largest distance between two runs, m.
fn apart(a: &Log, b: &Log) -> f64 {
    let distance = |(a, b): (&Truth, &Truth)| (a.x - b.x).hypot(a.y - b.y);
    a.truth.iter().zip(&b.truth).map(distance).fold(0.0, f64::max)
}

fn last(log: &Log) -> &Truth {
    log.truth.last().expect("a run has rows")
}
