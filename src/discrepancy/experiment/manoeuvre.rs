//! Manoeuvres a vehicle can drive, as data: shares of the speeds and turns it has been driven at.

use super::envelope::{Envelope, Turning};
use std::f64::consts::TAU;

/// level + swing·sin(2πt/period), as a share of the largest value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wave {
    /// Mean share.
    pub level: f64,
    /// Amplitude.
    pub swing: f64,
    /// s
    pub period: f64,
}

pub(crate) const fn steady(level: f64) -> Wave {
    Wave { level, swing: 0.0, period: 1.0 }
}

pub(crate) const fn swinging(level: f64, swing: f64, period: f64) -> Wave {
    Wave { level, swing, period }
}

impl Wave {
    fn at(self, t: f64) -> f64 {
        self.level + self.swing * (TAU * t / self.period).sin()
    }
}

/// A stretch of a manoeuvre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Phase {
    /// s
    pub seconds: f64,
    /// Share of the envelope's speed.
    pub speed: Wave,
    /// Share of the envelope's turn.
    pub turn: Wave,
}

pub(crate) const fn phase(seconds: f64, speed: Wave, turn: Wave) -> Phase {
    Phase { seconds, speed, turn }
}

/// What a manoeuvre needs of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Needs {
    Nothing,
    Turns,
    TurnsOnTheSpot,
    Reverse,
}

/// A minute of driving.
#[derive(Clone, Copy, Debug)]
pub struct Manoeuvre {
    pub(crate) needs: Needs,
    pub(crate) phases: &'static [Phase],
}

/// Length of every manoeuvre, s.
pub const LENGTH: f64 = 60.0;

pub(crate) const LEFT: Wave = steady(1.0);
const RIGHT: Wave = steady(-1.0);
const AHEAD: Wave = steady(0.0);
pub(crate) const FAST: Wave = steady(1.0);
const SLOW: Wave = steady(0.35);

/// All manoeuvres, the simplest first.
const LIBRARY: &[Manoeuvre] = &[
    Manoeuvre { needs: Needs::Nothing, phases: &[phase(30.0, FAST, AHEAD), phase(30.0, SLOW, AHEAD)] },
    Manoeuvre { needs: Needs::Nothing, phases: &[phase(60.0, swinging(0.6, 0.4, 10.0), AHEAD)] },
    Manoeuvre { needs: Needs::Turns, phases: &[phase(30.0, FAST, LEFT), phase(30.0, FAST, RIGHT)] },
    Manoeuvre { needs: Needs::Turns, phases: &[phase(30.0, SLOW, LEFT), phase(30.0, SLOW, RIGHT)] },
    Manoeuvre {
        needs: Needs::Turns,
        phases: &[phase(15.0, FAST, LEFT), phase(15.0, FAST, RIGHT), phase(15.0, SLOW, LEFT), phase(15.0, SLOW, RIGHT)],
    },
    Manoeuvre {
        needs: Needs::Turns,
        phases: &[
            phase(15.0, FAST, LEFT),
            phase(15.0, FAST, RIGHT),
            phase(15.0, SLOW, steady(0.35)),
            phase(15.0, SLOW, steady(-0.35)),
        ],
    },
    Manoeuvre {
        needs: Needs::Turns,
        phases: &[phase(20.0, FAST, AHEAD), phase(20.0, FAST, LEFT), phase(20.0, FAST, RIGHT)],
    },
    Manoeuvre { needs: Needs::TurnsOnTheSpot, phases: &[phase(30.0, AHEAD, LEFT), phase(30.0, AHEAD, RIGHT)] },
    Manoeuvre { needs: Needs::Turns, phases: &[phase(60.0, steady(0.8), swinging(0.0, 1.0, 20.0))] },
    Manoeuvre { needs: Needs::Turns, phases: &[phase(60.0, swinging(0.6, 0.4, 13.0), swinging(0.0, 1.0, 20.0))] },
    Manoeuvre { needs: Needs::Turns, phases: &[phase(60.0, swinging(0.5, 0.5, 7.0), swinging(0.0, 1.0, 20.0))] },
    Manoeuvre { needs: Needs::Turns, phases: &[phase(60.0, FAST, swinging(0.0, 1.0, 4.0))] },
    Manoeuvre {
        needs: Needs::Turns,
        phases: &[phase(30.0, FAST, swinging(0.0, 1.0, 10.0)), phase(30.0, FAST, swinging(0.0, 1.0, 4.0))],
    },
    Manoeuvre { needs: Needs::Turns, phases: &[phase(60.0, swinging(0.6, 0.4, 5.0), swinging(0.0, 1.0, 8.0))] },
    Manoeuvre {
        needs: Needs::Reverse,
        phases: &[phase(30.0, FAST, swinging(0.0, 1.0, 15.0)), phase(30.0, steady(-0.6), swinging(0.0, 1.0, 15.0))],
    },
];

/// The manoeuvres a vehicle can drive, the simplest first.
pub fn library(envelope: &Envelope) -> impl Iterator<Item = &'static Manoeuvre> {
    let (turning, reverses) = (envelope.turning, envelope.reverses);
    LIBRARY.iter().filter(move |m| match m.needs {
        Needs::Nothing => true,
        Needs::Turns => turning != Turning::Nothing,
        Needs::TurnsOnTheSpot => turning == Turning::Rate,
        Needs::Reverse => reverses && turning != Turning::Nothing,
    })
}

/// How long a driver takes to change speed and turn, s.
const REACTION: f64 = 1.0;

impl Manoeuvre {
    /// Speed, m/s, and turn at a time.
    fn asked(&self, envelope: &Envelope, t: f64) -> [f64; 2] {
        let mut from = 0.0;
        for p in self.phases {
            if t < from + p.seconds {
                return p.driven(envelope, t - from);
            }
            from += p.seconds;
        }
        self.phases.last().map_or([0.0; 2], |p| p.driven(envelope, p.seconds))
    }

    /// The logged inputs at times from 0 to [`LENGTH`], channel by channel; one phase passes into the next smoothly.
    pub fn inputs(&self, envelope: &Envelope, times: &[f64]) -> Vec<Vec<f64>> {
        const POINTS: i32 = 8;
        let smooth = |t: f64| {
            // A weight of 1 + cos over the time a driver takes.
            let offsets = (-POINTS..=POINTS).map(|k| f64::from(k) / f64::from(POINTS));
            let weighted = offsets.map(|s| (1.0 + (0.5 * TAU * s).cos(), self.asked(envelope, t + s * REACTION)));
            let (total, sum) =
                weighted.fold((0.0, [0.0; 2]), |(n, [a, b]), (w, [v, u])| (n + w, [a + w * v, b + w * u]));
            envelope.inputs(sum[0] / total, sum[1] / total)
        };
        let rows: Vec<Vec<f64>> = times.iter().map(|t| smooth(*t)).collect();
        (0..rows.first().map_or(0, Vec::len)).map(|c| rows.iter().map(|r| r[c]).collect()).collect()
    }
}

impl Phase {
    fn driven(&self, envelope: &Envelope, t: f64) -> [f64; 2] {
        let speed = self.speed.at(t) * envelope.speed;
        [speed, envelope.bounded(speed, self.turn.at(t) * envelope.turn)]
    }
}

#[cfg(test)]
pub(crate) mod samples {
    use super::*;
    use crate::discrepancy::record::input_noise::InputNoise;
    use crate::discrepancy::record::row_weights::RowWeights;
    use crate::discrepancy::record::run_record::{Known, Record};
    use crate::model::Model;
    use crate::model::observation::Observation;
    use crate::motion::{Signals, Timing};

    /// What a vehicle was driven at: ahead and turning for five seconds, then straight back.
    pub fn envelope(vehicle: &str, lengths: &[(&str, f64)], turning: [f64; 2], back: [f64; 2]) -> Envelope {
        let model = Model::new(vehicle, lengths).unwrap();
        let time: Vec<f64> = (0..100).map(|i| 0.1 * f64::from(i)).collect();
        let input = |k: usize| time.iter().map(|t| if *t < 5.0 { turning[k] } else { back[k] }).collect::<Vec<_>>();
        let signals = Signals::new(&time, &[input(0), input(1)], Timing::Sample);
        let record = Record {
            name: String::new(),
            rows: 0..time.len(),
            time,
            columns: vec![],
            quantities: vec![],
            observation: Observation::new(0, false, 0),
            weights: RowWeights::default(),
            signals,
            input_noise: InputNoise::of(&[], &[], &[]).into(),
            known: Known::default(),
        };
        Envelope::of(&model, &[record]).unwrap()
    }

    pub const PLAN: Manoeuvre = Manoeuvre {
        needs: Needs::Turns,
        phases: &[
            phase(30.0, FAST, LEFT),
            phase(10.0, SLOW, RIGHT),
            phase(20.0, swinging(0.6, 0.4, 10.0), steady(0.5)),
        ],
    };
}

#[cfg(test)]
mod tests {
    use super::samples::{PLAN, envelope};
    use super::*;

    /// At 1 m/s it was turned by 1.2 rad/s, and is asked for no more of both together.
    #[test]
    fn what_is_logged_is_what_moves_the_vehicle_as_planned() {
        let lengths = [("wheel_radius", 0.1), ("track_width", 0.5)];
        let differential = envelope("differential-drive", &lengths, [7.0, 13.0], [-10.0; 2]);
        let unicycle = envelope("unicycle", &[("wheel_radius", 0.5)], [2.0, 1.2], [-2.0, 0.0]);
        let by_wheels: fn([f64; 2]) -> [f64; 2] = |u| [0.05 * (u[0] + u[1]), 0.2 * (u[1] - u[0])];
        let by_rates: fn([f64; 2]) -> [f64; 2] = |u| [0.5 * u[0], u[1]];
        // A weight of 1 + cos over a second to either side makes a wave smaller.
        let rate = TAU / 10.0;
        let smoothed = rate.sin() / rate / (1.0 - (2.0 * rate / TAU).powi(2));
        let swings = |t: f64| 0.6 + 0.4 * smoothed * (rate * t).sin();
        for (envelope, moved) in [(differential, by_wheels), (unicycle, by_rates)] {
            let at = |t: f64| {
                let inputs = PLAN.inputs(&envelope, &[5.0, t]);
                moved([inputs[0][1], inputs[1][1]])
            };
            // Between two phases it is halfway; what is right at the border is of the second, an eighth of all.
            let between = |a: f64, b: f64| (7.0 * a + 9.0 * b) / 16.0;
            let expected = [
                (0.0, 1.0, 1.2),
                (28.9, 1.0, 1.2),
                (30.0, between(1.0, 0.35), between(1.2, -1.2)),
                (31.1, 0.35, -1.2),
                (42.5, swings(2.5), 0.6),
                (44.2, swings(4.2), 0.6),
                (58.7, swings(18.7), 0.6),
            ];
            for (t, speed, turn) in expected {
                let [v, w] = at(t);
                assert!((v - speed).abs() < 2e-3 && (w - turn).abs() < 2e-3, "{t}: {v} for {speed}, {w} for {turn}");
            }
        }
    }
}
