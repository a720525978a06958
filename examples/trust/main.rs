//! The benchmark of trust: hundreds of hidden runs by the independent simulator, put before `discover`.
//!
//! ```text
//! cargo run --release --example trust -- [--null 1000] [--effects 900] [--timed 60] [--seed S] [--threads N]
//!                                        [--only vehicle/effect] [--out DIR] [--case SEED]
//! ```
//! Prints false alarms, names, coverage of intervals, gaps and times with their binomial intervals, lists the
//! cases that fail with their seeds, and writes `trust.json`, `cases.csv`, `parameters.csv`, `times.csv` and
//! `trust.svg` to DIR. `--case SEED` runs one case alone and leaves its log and model file in DIR.

mod heat_map;
mod interval;
mod rows;
#[path = "../../tests/simulator/mod.rs"]
mod simulator;
mod suite;
mod table;
mod tally;
#[path = "../worker_pool/mod.rs"]
mod worker_pool;
mod workers;

use clap::Parser;
use std::path::{Path, PathBuf};
use suite::case::{Case, Kind, seed};
use suite::make::MAKES;
use suite::trial;
use tally::Tally;

/// Put the discover command to the test on hidden runs.
#[derive(Parser)]
struct Arguments {
    /// Runs with nothing hidden
    #[arg(long, default_value_t = 1000)]
    null: u64,
    /// Runs with something hidden; one in six hides a pair
    #[arg(long, default_value_t = 900)]
    effects: u64,
    /// Runs with nothing hidden whose inputs come in steps or with noise
    #[arg(long, default_value_t = 500)]
    coarse: u64,
    /// Runs in which one effect begins at a time, or holds for a time
    #[arg(long, default_value_t = 200)]
    in_part: u64,
    /// Runs of 60 s at 50 Hz whose time is measured, one after another
    #[arg(long, default_value_t = 60)]
    timed: u64,
    /// Which suite of cases
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Threads; the results are the same for every number
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// Only this vehicle and effect; either may be left out: `car/`, `/lever-arm`
    #[arg(long, value_name = "VEHICLE/EFFECT")]
    only: Option<String>,
    /// Folder for tables and figure
    #[arg(long, value_name = "DIR", default_value = "trust")]
    out: PathBuf,
    /// One case alone, by its seed
    #[arg(long, value_name = "SEED")]
    case: Option<u64>,
}

fn main() -> std::io::Result<()> {
    let arguments = Arguments::parse();
    std::fs::create_dir_all(&arguments.out)?;
    if let Some(seed) = arguments.case {
        return alone(seed, &arguments.out);
    }
    let seeds: Vec<u64> =
        [(Kind::Nothing, arguments.null), pairs_apart(arguments.effects, false), pairs_apart(arguments.effects, true)]
            .into_iter()
            .chain([(Kind::InPart, arguments.in_part), (Kind::Coarse, arguments.coarse)])
            .flat_map(|(kind, n)| chosen(&arguments, kind, n))
            .collect();
    let mut outcomes = workers::all(&seeds, arguments.threads, &|done| say(done, seeds.len()));
    let timed = chosen(&arguments, Kind::Timed, arguments.timed);
    outcomes.extend(workers::all(&timed, 1, &|done| say(done, timed.len())));
    eprintln!();
    let out = |name: &str| arguments.out.join(name);
    std::fs::write(out("cases.csv"), rows::cases(&outcomes))?;
    std::fs::write(out("parameters.csv"), rows::parameters(&outcomes))?;
    std::fs::write(out("times.csv"), rows::times(&outcomes))?;
    let tally = Tally::of(&outcomes);
    std::fs::write(out("trust.json"), serde_json::to_string_pretty(&tally)? + "\n")?;
    std::fs::write(out("trust.svg"), heat_map::svg(&tally))?;
    print!("{}", table::text(&tally, &outcomes));
    Ok(())
}

/// One in six of the cases that hide something hides a pair.
fn pairs_apart(effects: u64, pairs: bool) -> (Kind, u64) {
    if pairs { (Kind::Pair, effects / 6) } else { (Kind::Single, effects - effects / 6) }
}

/// The first seeds of a kind that are asked for.
fn chosen(arguments: &Arguments, kind: Kind, n: u64) -> Vec<u64> {
    let all = (0..100_000).map(|i| seed(arguments.seed, kind, i));
    let only = arguments.only.as_deref().unwrap_or("/");
    let (vehicle, effect) = only.split_once('/').unwrap_or((only, ""));
    let fits = |seed: &u64| {
        let (_, make, targets) = Case::topic(*seed);
        (vehicle.is_empty() || MAKES[make].name == vehicle)
            && (effect.is_empty() || targets.iter().any(|t| t.0 == effect))
    };
    all.filter(fits).take(n as usize).collect()
}

fn say(done: usize, all: usize) {
    eprint!("\r{done} of {all} ");
}

/// Runs one case and leaves its files.
fn alone(seed: u64, out: &Path) -> std::io::Result<()> {
    let outcome = workers::all(&[seed], 1, &|_| ()).remove(0);
    trial::write(&outcome.case, out)?;
    let one = [outcome];
    print!("{}{}", rows::cases(&one), rows::parameters(&one));
    for (target, apart) in one[0].case.powers.iter().flat_map(|p| &p.rivals) {
        println!("chi2 apart from {}: {apart:.1}", rows::target_text(*target));
    }
    if let Ok(report) = &one[0].trial.answer {
        std::fs::write(out.join("report.json"), serde_json::to_string_pretty(report)? + "\n")?;
    }
    Ok(())
}
