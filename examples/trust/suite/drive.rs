//! How the vehicle is driven: sums of smooth signals, to both sides, to one side, in circles, with stops.

use crate::simulator::{Profile, Signal, Tractor};
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// A manner of driving.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    /// Speed and turn wander, to both sides.
    Wander,
    /// As a river: one slow swing dominates, the speed breathes.
    Meander,
    /// Turns to one side only.
    OneSided,
    /// Circles at a speed that hardly changes.
    Circles,
    /// Wanders and stops every now and then.
    Stops,
}

impl Drive {
    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Drive::Wander => "wander",
            Drive::Meander => "meander",
            Drive::OneSided => "one-sided",
            Drive::Circles => "circles",
            Drive::Stops => "stops",
        }
    }

    /// One of them, rich drives more often than poor ones.
    pub fn drawn(random: &mut ChaCha8Rng) -> Self {
        match random.random_range(0..20) {
            0..10 => Drive::Wander,
            10..14 => Drive::Meander,
            14..17 => Drive::OneSided,
            17..18 => Drive::Circles,
            _ => Drive::Stops,
        }
    }

    /// A rich one, which changes speed and turns to both sides.
    pub fn rich(random: &mut ChaCha8Rng) -> Self {
        if random.random_bool(0.7) { Drive::Wander } else { Drive::Meander }
    }

    /// Speed and turn over time that suit the vehicle, never backwards.
    pub fn profile(self, tractor: Tractor, trailers: bool, random: &mut ChaCha8Rng) -> Profile {
        let reach = Reach::of(tractor, trailers);
        let side = if random.random::<bool>() { 1.0 } else { -1.0 };
        let half = reach.turn * random.random_range(0.5..1.0);
        let swift = reach.speed * random.random_range(0.6..1.2);
        let speed =
            |share: f64, random: &mut ChaCha8Rng| Signal::constant(swift) + waves(share * swift, reach.periods, random);
        match self {
            Drive::Wander => Profile { speed: speed(0.5, random), turn: waves(half, reach.periods, random) },
            Drive::Meander => {
                let slow = random.random_range(0.5..1.0) * reach.periods.1;
                let swing = Signal::wave(0.8 * half, slow, random.random_range(0.0..TAU));
                Profile { speed: speed(0.35, random), turn: swing + waves(0.2 * half, reach.periods, random) }
            }
            Drive::OneSided => {
                let turn = Signal::constant(0.5 * half) + waves(0.4 * half, reach.periods, random);
                Profile { speed: speed(0.4, random), turn: turn * side }
            }
            Drive::Circles => Profile { speed: speed(0.03, random), turn: Signal::constant(side * 0.6 * half) },
            Drive::Stops => {
                let pause = 1.5 * reach.periods.0;
                let stopping = Signal::constant(0.5 * swift)
                    + Signal::wave(0.5 * swift, random.random_range(1.0..2.0) * pause, random.random_range(0.0..TAU));
                Profile { speed: stopping, turn: waves(half, reach.periods, random) }
            }
        }
    }
}

/// What suits a vehicle: middle speed (m/s), largest turn (rad/s or rad), shortest and longest period (s).
struct Reach {
    speed: f64,
    turn: f64,
    periods: (f64, f64),
}

impl Reach {
    fn of(tractor: Tractor, trailers: bool) -> Self {
        let (speed, turn, periods) = match tractor {
            Tractor::Unicycle => (1.0, 1.0, (5.0, 20.0)),
            Tractor::DifferentialDrive => (0.5, 1.1, (5.0, 20.0)),
            Tractor::Tricycle => (2.0, 0.35, (6.0, 24.0)),
            Tractor::Car | Tractor::FourWheelCar => (5.0, 0.28, (8.0, 30.0)),
        };
        // A trailer turned past a right angle would be driven backwards: keep the chain stretched.
        Reach { speed, turn: if trailers { 0.6 * turn } else { turn }, periods }
    }
}

/// Five waves of random period and phase whose amplitudes add up to `half`.
fn waves(half: f64, (low, high): (f64, f64), random: &mut ChaCha8Rng) -> Signal {
    let shares: [f64; 5] = std::array::from_fn(|_| random.random_range(0.5..1.0));
    let total: f64 = shares.iter().sum();
    shares.iter().fold(Signal::default(), |sum, share| {
        let period = low * (high / low).powf(random.random());
        sum + Signal::wave(half * share / total, period, random.random_range(0.0..TAU))
    })
}
