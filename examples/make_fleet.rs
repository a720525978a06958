//! Makes a fleet of simulated robots with its manifest: differential drives whose tracks are 3 % wider than the drawing, give or
//! take 0.6 % from robot to robot, whose left wheels differ by 0.4 %, and of which one has a worn tyre.
//!
//! ```text
//! cargo run --release --example make_fleet -- FOLDER [ROBOTS] [RUNS] [SEED] [SECONDS] [RATE]
//! ```
//!
//! Without numbers it makes the bundled fleet of `examples/fleet` byte for byte.

#[path = "../tests/simulator/mod.rs"]
mod simulator;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};
use simulator::{Hidden, Noise, Profile, Scenario, Signal, Timing, Tractor};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::fmt::Write;
use std::path::PathBuf;

fn main() -> std::io::Result<()> {
    let default = || concat!(env!("CARGO_MANIFEST_DIR"), "/examples/fleet").into();
    let folder: PathBuf = std::env::args_os().nth(1).map_or_else(default, PathBuf::from);
    let number = |i: usize, usual: u64| std::env::args().nth(i).map_or(usual, |n| n.parse().expect("a whole number"));
    let (robots, runs, seed) = (number(2, 8), number(3, 1), number(4, 1));
    let (seconds, rate) = (number(5, 30) as f64, number(6, 10) as f64);
    std::fs::create_dir_all(&folder)?;
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = |mean: f64, std: f64| Normal::new(mean, std).unwrap().sample(&mut random);
    let mut manifest = String::from("robot,run,date,log,model,floor\n");
    let worn = robots / 3;
    for robot in 0..robots {
        let (track, mismatch) = (normal(0.03, 0.006), normal(0.0, 0.004));
        let mismatch = if robot == worn { 0.045 } else { mismatch };
        let name = format!("robot{:02}", robot + 1);
        for run in 0..runs {
            let drawn = seed * 100_000 + robot * 100 + run;
            let scenario = scenario(drawn, [track, mismatch], seconds, rate);
            let log = format!("{name}-{}.csv", run + 1);
            scenario.run().write_csv(folder.join(&log))?;
            let floor = ["tile", "wood"][(run % 2) as usize];
            let _ = writeln!(manifest, "{name},run{},2026-11-{:02},{log},model.toml,{floor}", run + 1, 1 + run);
            std::fs::write(folder.join("model.toml"), scenario.model_toml())?;
        }
    }
    std::fs::write(folder.join("fleet.csv"), manifest)
}

fn scenario(seed: u64, [track, mismatch]: [f64; 2], seconds: f64, rate: f64) -> Scenario {
    let phase = seed as f64;
    let period = 9.0 + 3.0 * phase.sin();
    let mut base = Scenario {
        hidden: vec![Hidden::TrackWidth { scale: track }, Hidden::WheelRadiusMismatch { scale: mismatch }],
        timing: Timing::IntervalMean,
        noise: Noise::MOCAP,
        duration: seconds,
        rate,
        profile: Profile {
            speed: Signal::constant(0.5) + Signal::wave(0.15, 17.0, phase),
            turn: Signal::constant(0.1) + Signal::wave(1.7 * TAU / period, period, FRAC_PI_2 + phase),
        },
        ..Scenario::new(Tractor::DifferentialDrive, seed)
    };
    base.parameters.wheel_radius = 0.06;
    base.parameters.track_width = 0.32;
    base
}
