//! Manoeuvres a vehicle can drive, as data: shares of the speeds and turns it has been driven at.

use super::envelope::{Envelope, Turning};
use crate::number_format::significant;
use std::f64::consts::TAU;

/// level + swing·sin(2πt/period), as a share of the largest value.
#[derive(Clone, Copy, Debug)]
struct Wave {
    level: f64,
    swing: f64,
    period: f64,
}

const fn steady(level: f64) -> Wave {
    Wave { level, swing: 0.0, period: 1.0 }
}

const fn swinging(level: f64, swing: f64, period: f64) -> Wave {
    Wave { level, swing, period }
}

impl Wave {
    fn at(self, t: f64) -> f64 {
        self.level + self.swing * (TAU * t / self.period).sin()
    }
}

/// A stretch of a manoeuvre.
#[derive(Clone, Copy, Debug)]
struct Phase {
    /// s
    seconds: f64,
    speed: Wave,
    turn: Wave,
}

const fn phase(seconds: f64, speed: Wave, turn: Wave) -> Phase {
    Phase { seconds, speed, turn }
}

/// What a manoeuvre needs of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Needs {
    Nothing,
    Turns,
    TurnsOnTheSpot,
    Reverse,
}

/// A minute of driving.
#[derive(Clone, Copy, Debug)]
pub struct Manoeuvre {
    needs: Needs,
    phases: &'static [Phase],
}

/// Length of every manoeuvre, s.
pub const LENGTH: f64 = 60.0;

const LEFT: Wave = steady(1.0);
const RIGHT: Wave = steady(-1.0);
const AHEAD: Wave = steady(0.0);
const FAST: Wave = steady(1.0);
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

    /// What to drive, in a sentence with numbers.
    pub fn sentence(&self, envelope: &Envelope) -> String {
        let phases: Vec<String> = self.phases.iter().map(|p| p.words(envelope)).collect();
        format!("drive {}", phases.join(", then "))
    }
}

impl Phase {
    fn driven(&self, envelope: &Envelope, t: f64) -> [f64; 2] {
        let speed = self.speed.at(t) * envelope.speed;
        [speed, envelope.bounded(speed, self.turn.at(t) * envelope.turn)]
    }

    fn words(&self, envelope: &Envelope) -> String {
        let number = |x: f64| significant(x.abs(), 2);
        let fastest = self.speed.level.abs() + self.speed.swing;
        let turn = self.turn.level.abs() + self.turn.swing;
        let turn = envelope.bounded(fastest * envelope.speed, turn * envelope.turn);
        let speed = match (self.speed.swing > 0.0, self.speed.level) {
            (true, level) => format!(
                "at a speed that swings between {} and {} m/s every {} s",
                number((level - self.speed.swing) * envelope.speed),
                number(fastest * envelope.speed),
                number(self.speed.period)
            ),
            (false, 0.0) => "on the spot".into(),
            (false, level) => {
                let way = if level < 0.0 { "backwards " } else { "" };
                format!("{way}at {} m/s", number(level * envelope.speed))
            }
        };
        let side = if self.turn.level < 0.0 { "right" } else { "left" };
        let path = match (self.turn.level == 0.0, self.turn.swing > 0.0, envelope.turning) {
            (true, false, _) | (_, _, Turning::Nothing) => "straight ahead".to_string(),
            (_, true, Turning::Rate) => {
                format!("weaving left and right by up to {} rad/s every {} s", number(turn), number(self.turn.period))
            }
            (_, true, Turning::Angle) => {
                format!("steering left and right by up to {} rad every {} s", number(turn), number(self.turn.period))
            }
            (_, _, Turning::Rate) if fastest == 0.0 => format!("turning {side} by {} rad/s", number(turn)),
            (_, _, Turning::Rate) => {
                let radius = fastest * envelope.speed / turn.abs().max(1e-9);
                format!("in circles to the {side} of radius {} m", number(radius))
            }
            (_, _, Turning::Angle) => format!("in circles to the {side}, steering {} rad", number(turn)),
        };
        format!("{} s {speed}, {path}", number(self.seconds))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::record::run_record::{Known, Record};
    use crate::model::Model;
    use crate::motion::{Signals, Timing};

    /// What a vehicle was driven at: ahead and turning for five seconds, then straight back.
    fn envelope(vehicle: &str, lengths: &[(&str, f64)], turning: [f64; 2], back: [f64; 2]) -> Envelope {
        let model = Model::new(vehicle, lengths).unwrap();
        let time: Vec<f64> = (0..100).map(|i| 0.1 * f64::from(i)).collect();
        let input = |k: usize| time.iter().map(|t| if *t < 5.0 { turning[k] } else { back[k] }).collect::<Vec<_>>();
        let signals = Signals::new(&time, &[input(0), input(1)], Timing::Sample);
        let record = Record {
            name: String::new(),
            rows: 0..time.len(),
            time,
            columns: vec![],
            has_heading: false,
            signals,
            trailers: 0,
            known: Known::default(),
        };
        Envelope::of(&model, &[record]).unwrap()
    }

    #[test]
    fn only_a_phase_that_goes_back_says_so() {
        let lengths = [("wheel_radius", 0.1), ("track_width", 0.5)];
        let envelope = envelope("differential-drive", &lengths, [7.0, 13.0], [-10.0; 2]);
        let ways = |speed: f64| phase(30.0, steady(speed), LEFT).words(&envelope);
        assert!(ways(-0.6).contains(" backwards at "), "{}", ways(-0.6));
        assert!(ways(0.0).contains(" on the spot, turning left"), "{}", ways(0.0));
        assert!(ways(1.0).contains("s at "), "{}", ways(1.0));
        let backwards = |m: &Manoeuvre| m.sentence(&envelope).contains("backwards");
        assert!(library(&envelope).any(&backwards));
        assert!(library(&envelope).all(|m| backwards(m) == (m.needs == Needs::Reverse)));
    }

    #[test]
    fn who_steers_is_told_an_angle() {
        let car = envelope("car", &[("wheel_radius", 0.3), ("wheelbase", 2.7)], [0.2, 10.0], [0.0, 10.0]);
        let words = phase(30.0, FAST, LEFT).words(&car);
        assert!(words.contains("steering 0.20 rad"), "{words}");
        assert!(library(&car).all(|m| !m.sentence(&car).contains("on the spot") && m.needs != Needs::Reverse));
    }

    const PLAN: Manoeuvre = Manoeuvre {
        needs: Needs::Turns,
        phases: &[
            phase(30.0, FAST, LEFT),
            phase(10.0, SLOW, RIGHT),
            phase(20.0, swinging(0.6, 0.4, 10.0), steady(0.5)),
        ],
    };

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

    #[test]
    fn a_phase_is_told_in_numbers() {
        let lengths = [("wheel_radius", 0.1), ("track_width", 0.5)];
        let envelope = envelope("differential-drive", &lengths, [7.0, 13.0], [-10.0; 2]);
        assert_eq!(
            PLAN.sentence(&envelope),
            "drive 30 s at 1.0 m/s, in circles to the left of radius 0.83 m, then 10 s at 0.35 m/s, in circles to the right of \
             radius 0.29 m, then 20 s at a speed that swings between 0.20 and 1.0 m/s every 10 s, in circles to the left of \
             radius 1.7 m"
        );
        let weaving = phase(60.0, steady(0.8), swinging(0.0, 0.5, 20.0)).words(&envelope);
        assert_eq!(weaving, "60 s at 0.80 m/s, weaving left and right by up to 0.60 rad/s every 20 s");
    }
}
