//! Regenerates the bundled example runs byte for byte.
//!
//! ```text
//! cargo run --release --example make_runs [FOLDER]      # default: examples/runs
//! ```

#[path = "../tests/simulator/mod.rs"]
mod simulator;

use simulator::{Hidden, Log, Noise, Profile, Scenario, Signal, Timing, Tractor};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::path::{Path, PathBuf};

/// The first zero of the Bessel function J₀: a heading that swings with this amplitude (rad) at
/// constant speed brings the vehicle back to where it was after each period, on a figure of eight.
const EIGHT: f64 = 2.404_825_557_695_773;

/// A folder of runs that share a model and an answer.
struct Set {
    folder: &'static str,
    story: &'static str,
    base: Scenario,
    runs: Vec<(&'static str, Profile)>,
}

fn main() -> std::io::Result<()> {
    let default = || concat!(env!("CARGO_MANIFEST_DIR"), "/examples/runs").into();
    let root: PathBuf = std::env::args_os().nth(1).map_or_else(default, PathBuf::from);
    for set in [cornering(), track(), nothing(), steering(), pair()] {
        write(&root.join(set.folder), &set)?;
    }
    write_apart(&root.join("clocks"))
}

fn write(folder: &Path, set: &Set) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let story: String = set.story.lines().map(|line| format!("# {line}\n")).collect();
    let model = format!("{story}\n{}", set.base.model_toml());
    std::fs::write(folder.join("model.toml"), model)?;
    let answer = serde_json::to_string_pretty(&set.base.answer())?;
    std::fs::write(folder.join("answer.json"), answer + "\n")?;
    for (seed, (name, profile)) in (set.base.seed..).zip(&set.runs) {
        let run = Scenario { profile: profile.clone(), seed, ..set.base.clone() };
        run.run().write_csv(folder.join(name).with_extension("csv"))?;
    }
    Ok(())
}

fn cornering() -> Set {
    let mut base = robot(1);
    base.hidden = vec![Hidden::CorneringCreep { mass_over_bt: 0.11 }];
    Set {
        folder: "cornering",
        story: "A mobile robot on a slippery floor, logged as wheel rate and gyro, seen by motion capture.\n\
                Its user believes that the wheel never slips sideways.",
        runs: vec![("eights", eights(1.0, 15.0)), ("rosette", rosette(1.0, 5)), ("bay_held_out", bay(1.0))],
        base,
    }
}

fn track() -> Set {
    let mut base = Scenario {
        hidden: vec![Hidden::TrackWidth { scale: 0.035 }],
        timing: Timing::IntervalMean,
        noise: Noise::MOCAP,
        start: [0.4, -0.3, 0.2],
        ..Scenario::new(Tractor::DifferentialDrive, 20)
    };
    base.parameters.wheel_radius = 0.06;
    base.parameters.track_width = 0.32;
    Set {
        folder: "track",
        story: "A vacuum cleaner's two driven wheels, read by encoders and seen by motion capture.\n\
                The track width is the one of the drawing.",
        runs: vec![("rosette", rosette(0.5, 5)), ("meander", meander(0.5)), ("square_held_out", squares(0.5))],
        base,
    }
}

fn nothing() -> Set {
    let base = robot(41);
    Set {
        folder: "nothing",
        story: "The robot of `cornering` on a floor that grips. The model is right as it stands.",
        runs: vec![("rosette", rosette(1.0, 5)), ("eights", eights(1.0, 15.0))],
        base,
    }
}

fn steering() -> Set {
    let mut base = Scenario {
        hidden: vec![Hidden::SteeringOffset { offset: 0.02 }],
        noise: Noise { position: 0.01, heading: 0.003 },
        start: [12.0, -8.0, 0.6],
        ..Scenario::new(Tractor::Car, 60)
    };
    base.parameters.wheel_radius = 0.31;
    base.parameters.wheelbase = 2.7;
    let swing = |amplitude: f64, period: f64| Profile {
        speed: Signal::constant(5.0) + Signal::wave(1.2, 23.0, 0.5),
        // The heading swings by speed·tan(angle)/wheelbase·period/2π.
        turn: Signal::wave((amplitude * TAU / period * 2.7 / 5.0).atan(), period, FRAC_PI_2),
    };
    Set {
        folder: "steering",
        story: "A car with satellite positioning and an inertial heading. Somebody refitted its steering\n\
                sensor and trusted the mark on the shaft.",
        runs: vec![("eights", swing(EIGHT, 30.0)), ("meander", swing(1.9, 26.0))],
        base,
    }
}

fn pair() -> Set {
    let mut base = robot(80);
    base.hidden = vec![Hidden::RotationCreep { e_rc: 0.03 }, Hidden::YawRateBias { bias: 0.015 }];
    Set {
        folder: "pair",
        story: "The robot of `cornering` with a new tyre and a gyro that nobody let warm up:\n\
                two faults at once.",
        runs: vec![("eights", eights(1.0, 15.0)), ("meander", meander(1.0))],
        base,
    }
}

/// What the clock of the poses reads when that of the inputs reads 0, s, and how much faster it runs.
const OFFSET: f64 = 1500.25;
const DRIFT: f64 = 1.5e-4;

/// A drive that two devices log, each by its own clock and at its own rate.
fn write_apart(folder: &Path) -> std::io::Result<()> {
    let mut base = Scenario { profile: meander(0.5), jitter: 0.3, seed: 100, ..track().base };
    base.hidden = vec![Hidden::WheelRadiusMismatch { scale: -0.02 }];
    let story = "The vacuum cleaner of `track` with a worn left wheel. Its controller logs what the wheels turn, a camera in\n\
                 another room where it is; nobody has set their clocks.";
    write(folder, &Set { folder: "clocks", story, base: base.clone(), runs: vec![] })?;
    let mut answer = base.answer();
    answer["clock"] = serde_json::json!({ "offset_s": OFFSET, "drift": DRIFT, "at_s": 0.0 });
    std::fs::write(folder.join("answer.json"), serde_json::to_string_pretty(&answer)? + "\n")?;
    let inputs = base.run();
    let poses = Scenario { rate: 10.0, seed: base.seed + 1, ..base }.run();
    let first = inputs.columns.len() - 2;
    part(&inputs, first..inputs.columns.len(), |t| t / (1.0 + DRIFT)).write_csv(folder.join("inputs.csv"))?;
    part(&poses, 1..first, |t| OFFSET + t).write_csv(folder.join("poses.csv"))
}

/// The time by some clock and some columns of a log.
fn part(log: &Log, columns: std::ops::Range<usize>, clock: impl Fn(f64) -> f64) -> Log {
    let named = std::iter::once(&log.columns[0]).chain(&log.columns[columns.clone()]).cloned().collect();
    let row = |row: &Vec<f64>| std::iter::once(clock(row[0])).chain(row[columns.clone()].iter().copied()).collect();
    Log { columns: named, rows: log.rows.iter().map(row).collect(), truth: log.truth.clone() }
}

/// A robot of about 1 m/s whose pose is measured to 2 mm and 2 mrad.
fn robot(seed: u64) -> Scenario {
    let mut robot = Scenario { noise: Noise::MOCAP, start: [0.5, -0.2, 0.3], ..Scenario::new(Tractor::Unicycle, seed) };
    robot.parameters.wheel_radius = 0.1;
    robot
}

/// A yaw rate that swings the heading by `amplitude` (rad) once a `period` (s).
fn swing(amplitude: f64, period: f64) -> Signal {
    Signal::wave(amplitude * TAU / period, period, FRAC_PI_2)
}

/// Figures of eight that precess, because the speed (m/s) breathes at a rhythm of its own.
fn eights(speed: f64, period: f64) -> Profile {
    Profile {
        speed: Signal::constant(speed) + Signal::wave(0.28 * speed, 0.71 * period, 0.4),
        turn: swing(EIGHT, period),
    }
}

/// A meandering river.
fn meander(speed: f64) -> Profile {
    Profile { speed: Signal::constant(speed) + Signal::wave(0.3 * speed, 17.0, 0.0), turn: swing(1.9, 12.0) }
}

/// A closed flower: one petal every 60 s/petals, each turned by 2π/petals.
fn rosette(speed: f64, petals: u32) -> Profile {
    let period = 60.0 / f64::from(petals);
    Profile {
        speed: Signal::constant(speed) + Signal::wave(0.3 * speed, period / 2.0, 0.8),
        turn: Signal::constant(TAU / 60.0) + swing(2.2, period),
    }
}

/// A winding road round a bay: bends of two lengths to both sides, about a heading that turns by 252° in 60 s. It ends
/// elsewhere than it begins, so errors do not cancel as on a closed path.
fn bay(speed: f64) -> Profile {
    Profile {
        speed: Signal::constant(speed) + Signal::wave(0.25 * speed, 9.0, 0.5),
        turn: Signal::constant(0.7 * TAU / 60.0) + swing(1.1, 9.0) + swing(1.0, 17.0),
    }
}

/// A square to the left and a square to the right that share a side, with slow rounded corners.
fn squares(speed: f64) -> Profile {
    let (leg, corner, peak) = (7.5, FRAC_PI_2, 1.2);
    let turns = (0..8).map(|i| {
        let middle = leg * (f64::from(i) + 0.5);
        let half = 0.5 * corner / peak;
        let side = if i < 4 { peak } else { -peak };
        Signal::pulse(side, middle - half, middle + half, 0.2)
    });
    Profile {
        speed: Signal::constant(speed) + Signal::wave(0.25 * speed, leg, FRAC_PI_2),
        turn: turns.fold(Signal::default(), |sum, turn| sum + turn),
    }
}
