//! How a run is logged: rate, noise, gaps, jitter, wrapped angles, gross errors.

use super::make::Make;
use super::power::FITTED;
use crate::simulator::{InputLog, Mounting, Noise, Outliers, Scenario, Timing, Tractor};
use rand::Rng;
use rand_chacha::ChaCha8Rng;

/// What the issue asks for: noise from 0.1 mm and 0.1 mrad to 5 cm and 20 mrad.
const POSITION: (f64, f64) = (1e-4, 5e-2);
const HEADING: (f64, f64) = (1e-4, 2e-2);
/// Rows per second, Hz.
const RATE: (f64, f64) = (10.0, 100.0);
/// Length of a run, s.
const DURATION: (f64, f64) = (20.0, 120.0);
/// A run in which something begins lasts as long as this at least, s.
pub const LONG: f64 = 60.0;

/// Draws how a scenario is logged; a run whose time is measured has 60 s at 50 Hz.
pub fn draw(scenario: &mut Scenario, timed: bool, random: &mut ChaCha8Rng) {
    let (duration, rate) = (octaves(DURATION, random), octaves(RATE, random));
    (scenario.duration, scenario.rate) = if timed { (60.0, 50.0) } else { (duration, rate) };
    scenario.noise = Noise { position: octaves(POSITION, random), heading: octaves(HEADING, random) };
    scenario.timing = if random.random_bool(0.3) { Timing::IntervalMean } else { Timing::Sample };
    scenario.wrap_heading = random.random();
    scenario.jitter = if random.random_bool(0.4) { random.random_range(0.05..0.6) } else { 0.0 };
    scenario.dropouts = if random.random_bool(0.3) { random.random_range(0.005..0.05) } else { 0.0 };
    scenario.gaps = if random.random_bool(0.25) { gaps(scenario.duration, random) } else { vec![] };
    let share = random.random_range(0.0005..0.01);
    let size = octaves((0.05, 2.0), random).max(10.0 * scenario.noise.position);
    scenario.outliers = if random.random_bool(0.15) { Outliers { share, size } } else { Outliers::default() };
    if random.random_bool(0.2) {
        let mut some = |most: f64| random.random_range(-most..most);
        scenario.mounting = Mounting { lever_arm: [some(0.3), some(0.2)], heading_offset: some(0.2) };
    }
}

/// Ticks of a wheel's encoder for each turn.
const TICKS: (f64, f64) = (20.0, 4000.0);
/// Steps and noise of a steering angle, rad, and of a gyroscope, rad/s.
const STEERING_STEP: (f64, f64) = (1e-3, 3e-2);
const STEERING_NOISE: (f64, f64) = (1e-4, 5e-3);
const GYRO_STEP: (f64, f64) = (1e-4, 2e-2);
const GYRO_NOISE: (f64, f64) = (1e-4, 2e-2);

/// Draws inputs that come in steps or with noise.
pub fn draw_inputs(scenario: &mut Scenario, make: &Make, random: &mut ChaCha8Rng) {
    let turns_by_wheels = make.tractor == Tractor::DifferentialDrive;
    let (step, noise) =
        if make.tractor.is_steered() { (STEERING_STEP, STEERING_NOISE) } else { (GYRO_STEP, GYRO_NOISE) };
    // An encoder counts between rows; whoever logs its counts says so.
    if turns_by_wheels || !make.by_speed && random.random_bool(0.5) {
        scenario.inputs.tick = std::f64::consts::TAU / octaves(TICKS, random);
        scenario.timing = Timing::IntervalMean;
    }
    if turns_by_wheels || scenario.inputs != InputLog::default() && random.random_bool(0.5) {
        return;
    }
    match random.random_bool(0.5) {
        true => scenario.inputs.step = octaves(step, random),
        false => scenario.inputs.noise = octaves(noise, random),
    }
}

/// When what is hidden begins, or between which times it holds.
pub fn span(scenario: &Scenario, random: &mut ChaCha8Rng) -> [f64; 2] {
    let fitted = FITTED * scenario.duration;
    let begins = fitted * random.random_range(0.25..0.6);
    let ends = if random.random_bool(0.5) { f64::INFINITY } else { begins + fitted * random.random_range(0.25..0.35) };
    [begins, ends]
}

/// One or two stretches of 0.7 to 4 s without rows, well inside the run.
fn gaps(duration: f64, random: &mut ChaCha8Rng) -> Vec<(f64, f64)> {
    let mut gaps: Vec<(f64, f64)> = (0..random.random_range(1..=2))
        .map(|i| {
            let from = duration * (0.15 + 0.35 * f64::from(i) + random.random_range(0.0..0.25));
            (from, from + random.random_range(0.7..4.0))
        })
        .collect();
    gaps.sort_by(|a, b| a.0.total_cmp(&b.0));
    gaps
}

/// A number between two, equally often in every octave.
fn octaves((low, high): (f64, f64), random: &mut ChaCha8Rng) -> f64 {
    low * (high / low).powf(random.random())
}
