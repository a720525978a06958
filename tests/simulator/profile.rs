//! What the driver asks for: a speed and a turn, as smooth functions of time.

use super::signal::Signal;
use super::vehicle::Vehicle;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Speed (m/s) of the driven wheel or axle, and turn: yaw rate (rad/s) or steering angle (rad).
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Speed in m/s, by the nominal wheel radius.
    pub speed: Signal,
    /// Yaw rate in rad/s (unicycle, differential drive), else steering angle in rad.
    pub turn: Signal,
}

/// The middle and half width of a signal's range and the periods of its waves (s).
struct Range {
    middle: f64,
    half: f64,
    periods: (f64, f64),
}

impl Profile {
    /// A wandering drive that suits the vehicle: both turn directions, speed always forward.
    pub fn random(vehicle: &Vehicle, random: &mut ChaCha8Rng) -> Self {
        let (speed, turn) = ranges(vehicle);
        Profile { speed: wander(&speed, random), turn: wander(&turn, random) }
    }

    /// Constant speed (m/s) and constant turn (rad/s or rad).
    pub fn constant(speed: f64, turn: f64) -> Self {
        Profile { speed: Signal::constant(speed), turn: Signal::constant(turn) }
    }

    /// The drive with left and right exchanged.
    pub fn mirrored(&self) -> Self {
        Profile { speed: self.speed.clone(), turn: -self.turn.clone() }
    }

    /// The drive back along the same path, `steered` where the turn is an angle, not a rate.
    pub fn reversed(&self, end: f64, steered: bool) -> Self {
        let turn = self.turn.reversed(end);
        Profile { speed: -self.speed.reversed(end), turn: if steered { turn } else { -turn } }
    }
}

fn ranges(vehicle: &Vehicle) -> (Range, Range) {
    let (middle, half, turn, brisk) = match vehicle.tractor() {
        super::Tractor::Unicycle => (1.0, 0.55, 1.0, (5.0, 20.0)),
        super::Tractor::DifferentialDrive => (0.5, 0.25, 1.1, (5.0, 20.0)),
        super::Tractor::Tricycle => (2.0, 0.9, 0.3, (6.0, 24.0)),
        super::Tractor::Car | super::Tractor::FourWheelCar => (5.0, 2.3, 0.25, (8.0, 30.0)),
    };
    // A trailer turned past a right angle would be driven backwards: keep the chain stretched.
    let calm = if vehicle.trailers() > 0 { 0.6 } else { 1.0 };
    let speed = Range { middle, half, periods: brisk };
    let turn = Range { middle: 0.0, half: turn * calm, periods: brisk };
    (speed, turn)
}

/// Five waves of random period and phase whose amplitudes add up to the half width of the range.
fn wander(range: &Range, random: &mut ChaCha8Rng) -> Signal {
    let shares: [f64; 5] = std::array::from_fn(|_| random.random_range(0.5..1.0));
    let total: f64 = shares.iter().sum();
    let (low, high) = range.periods;
    shares.iter().fold(Signal::constant(range.middle), |sum, share| {
        // Equal steps in log period: slow and fast waves are as frequent as each other.
        let period = low * (high / low).powf(random.random());
        sum + Signal::wave(range.half * share / total, period, random.random_range(0.0..TAU))
    })
}
