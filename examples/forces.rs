//! The benchmark of forces: hidden effects on vehicles that forces move, simulated by code of its own, put before `discover`.
//!
//! ```text
//! cargo run --release --example forces -- [--null 60] [--effects 10] [--seed S] [--threads N] [--only MAKE/EFFECT]
//!                                         [--measured] [--case MAKE/EFFECT/INDEX --out DIR]
//! ```
//! `--effects` counts the runs of every effect, the makes by turns. Prints false alarms, names by effect, the coverage of
//! intervals and times; `--case` writes the files of one case.

#[allow(dead_code, unused_imports)]
#[path = "../tests/simulator/forces/mod.rs"]
mod forces;
#[path = "worker_pool/mod.rs"]
mod worker_pool;

use clap::Parser;
use creepage::discrepancy::calibration::calibrate::calibrate;
use creepage::discrepancy::calibration::targets::Target;
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::report::{Named, Report};
use creepage::discrepancy::request::Request;
use creepage::files::{ModelFile, Run};
use creepage::progress::unheard;
use creepage::{Result, dynamics, effects};
use forces::{Drive, MAKES, Make, Secret, secrets};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;
use worker_pool::shared_out;

/// Put the discover command to the test on vehicles that forces move.
#[derive(Parser)]
struct Arguments {
    /// Runs with nothing hidden
    #[arg(long, default_value_t = 60)]
    null: u64,
    /// Runs of every effect
    #[arg(long, default_value_t = 10)]
    effects: u64,
    /// Which suite of cases
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// How long each run lasts, s
    #[arg(long, default_value_t = 40.0)]
    seconds: f64,
    /// Threads; the results are the same for every number
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// Only this make and effect; either may be left out: `car/`, `/mass`
    #[arg(long, value_name = "MAKE/EFFECT", default_value = "/")]
    only: String,
    /// With a gyro and encoders of the driven wheels measured beside the pose
    #[arg(long)]
    measured: bool,
    /// The files of one case, and no more
    #[arg(long, value_name = "MAKE/EFFECT/INDEX")]
    case: Option<String>,
    /// Folder for the files of a case
    #[arg(long, value_name = "DIR", default_value = "forces")]
    out: PathBuf,
}

/// A case by what it hides.
struct Case {
    label: String,
    drive: Drive,
}

/// What a case came to.
struct Outcome {
    judged: Judged,
    /// Whether the data can tell what is hidden: its amplitude is six deviations in a fit of the true effect.
    told: bool,
    /// For every parameter of an effect that was named right, whether the interval of 95 % holds the truth.
    covered: Vec<bool>,
    seconds: f64,
    said: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Judged {
    Right,
    Class,
    Rest,
    Wrong,
    Failed,
}

const TOLD: f64 = 6.0;

fn main() -> std::io::Result<()> {
    let arguments = Arguments::parse();
    let cases = cases(&arguments);
    if let Some(wanted) = &arguments.case {
        let case = cases.iter().find(|c| c.label == *wanted).expect("the case is one of the suite");
        std::fs::create_dir_all(&arguments.out)?;
        write(case, &arguments.out)?;
        println!("{:?}", case.drive.secret);
        return Ok(());
    }
    let outcomes = all(&cases, arguments.threads);
    table(&cases, &outcomes);
    Ok(())
}

fn cases(arguments: &Arguments) -> Vec<Case> {
    let (make, effect) = arguments.only.split_once('/').unwrap_or((&arguments.only, ""));
    let wanted = |m: Make, id: &str| (make.is_empty() || m.name() == make) && (effect.is_empty() || id == effect);
    let seed = |k: u64| arguments.seed * 1_000_000 + k;
    let mut found = Vec::new();
    let case = |make: Make, id: &str, k: u64, secret: Option<Secret>, number: u64| Case {
        label: format!("{}/{id}/{k}", make.name()),
        drive: Drive { make, seed: seed(number), seconds: arguments.seconds, secret, sensors: arguments.measured },
    };
    for k in 0..arguments.null {
        let make = MAKES[k as usize % MAKES.len()];
        found.extend(wanted(make, "nothing").then(|| case(make, "nothing", k, None, k)));
    }
    let mut ids: Vec<&'static str> = MAKES.iter().flat_map(|m| secrets(*m)).map(|(id, _)| id).collect();
    ids.sort_unstable();
    ids.dedup();
    for (i, id) in ids.iter().enumerate() {
        let with =
            |m: &Make| secrets(*m).into_iter().filter(|(own, _)| own == id).map(|(_, t)| (*m, t)).collect::<Vec<_>>();
        let makes: Vec<(Make, Option<usize>)> = MAKES.iter().flat_map(with).collect();
        for k in 0..arguments.effects {
            let (make, trailer) = makes[k as usize % makes.len()];
            let number = 10_000 + 1000 * i as u64 + k;
            let mut random = ChaCha8Rng::seed_from_u64(seed(number) + 500_000);
            let secret = Secret::drawn(id, trailer, &mut random);
            found.extend(wanted(make, id).then(|| case(make, id, k, Some(secret), number)));
        }
    }
    found
}

fn write(case: &Case, folder: &Path) -> std::io::Result<()> {
    for (k, run) in case.drive.runs(1).into_iter().enumerate() {
        std::fs::write(folder.join("model.toml"), run.model)?;
        std::fs::write(folder.join(format!("run_{}.csv", k + 1)), run.csv)?;
    }
    Ok(())
}

fn all(cases: &[Case], threads: usize) -> Vec<Outcome> {
    let told = |done: usize, case: &Case, outcome: &Outcome| {
        let Outcome { judged, seconds, said, .. } = outcome;
        eprintln!("{done} of {}: {} {judged:?} {seconds:.1} s {said}", cases.len(), case.label);
    };
    shared_out(cases, threads, &one, &told)
}

fn one(case: &Case) -> Outcome {
    let folder = tempfile::tempdir().expect("a folder for temporary files");
    write(case, folder.path()).expect("temporary files can be written");
    let mut seconds = 0.0;
    match asked(folder.path(), case, &mut seconds) {
        Ok((report, told)) => {
            let judged = judge(case, &report);
            let said =
                report.effects.iter().map(|e| format!("{} {:?}", e.id, values(e))).collect::<Vec<_>>().join(", ");
            let said = format!(
                "{:?} [{said}] told {told} {:?}",
                report.verdict,
                case.drive.secret.as_ref().map(|s| &s.values)
            );
            Outcome { judged, told, covered: covered(case, &report), seconds, said }
        }
        Err(e) => Outcome { judged: Judged::Failed, told: false, covered: vec![], seconds, said: e.to_string() },
    }
}

fn values(named: &Named) -> Vec<f64> {
    named.parameters.values().map(|p| (p.value * 1e4).round() / 1e4).collect()
}

fn asked(folder: &Path, case: &Case, seconds: &mut f64) -> Result<(Report, bool)> {
    let file = ModelFile::read(folder.join("model.toml"), &dynamics::known(effects::all()))?;
    let runs = [Run::read(folder.join("run_1.csv"), &file)?];
    let request = Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[], seed: 0 };
    let begun = Instant::now();
    let found = discover(&request, &unheard);
    *seconds = begun.elapsed().as_secs_f64();
    let report = found?.report;
    let told = match &case.drive.secret {
        None => true,
        Some(secret) => {
            let target = Target::of(secret.id, None, secret.trailer);
            let fitted = calibrate(&request, &[target], None, &unheard)?;
            let (name, truth) = secret.values[0];
            let estimate = fitted.calibration.effects.first().and_then(|e| e.parameters.get(name));
            // A fit that ends elsewhere says nothing of what can be told.
            let is_told = |value: f64, std: f64| truth.abs() > TOLD * std && (value - truth).abs() < TOLD * std;
            estimate.and_then(|p| Some(is_told(p.value, p.std?))).unwrap_or(false)
        }
    };
    Ok((report, told))
}

fn judge(case: &Case, report: &Report) -> Judged {
    let Some(secret) = &case.drive.secret else {
        return if report.effects.is_empty() && report.unnamed.is_empty() { Judged::Right } else { Judged::Wrong };
    };
    match report.effects.as_slice() {
        [] => Judged::Rest,
        [one] if one.id == secret.id => Judged::Right,
        [one] if one.indistinguishable_from.iter().any(|r| r.id == secret.id) => Judged::Class,
        _ => Judged::Wrong,
    }
}

fn covered(case: &Case, report: &Report) -> Vec<bool> {
    let Some(secret) = &case.drive.secret else { return vec![] };
    let Some(named) = report.effects.iter().find(|e| e.id == secret.id && report.effects.len() == 1) else {
        return vec![];
    };
    let of = |(name, truth): &(&str, f64)| {
        let p = named.parameters.get(*name)?;
        Some((p.value - truth).abs() <= 1.96 * p.std?)
    };
    secret.values.iter().filter_map(of).collect()
}

fn table(cases: &[Case], outcomes: &[Outcome]) {
    let mut rows: BTreeMap<String, BTreeMap<Judged, usize>> = BTreeMap::new();
    let mut count = |name: &str, judged: Judged| *rows.entry(name.into()).or_default().entry(judged).or_default() += 1;
    for (case, outcome) in cases.iter().zip(outcomes) {
        let id = case.drive.secret.as_ref().map_or("nothing", |s| s.id);
        count(id, outcome.judged);
        if id != "nothing" && outcome.told {
            count("= all that can be told", outcome.judged);
        }
        if id != "nothing" {
            count("= all", outcome.judged);
        }
    }
    let all = [Judged::Right, Judged::Class, Judged::Rest, Judged::Wrong, Judged::Failed];
    println!("{:28} {:>6} {:>6} {:>6} {:>6} {:>6}", "", "right", "class", "rest", "wrong", "failed");
    for (name, row) in &rows {
        print!("{name:28}");
        all.iter().for_each(|j| print!(" {:6}", row.get(j).copied().unwrap_or(0)));
        println!();
    }
    let covered: Vec<bool> = outcomes.iter().flat_map(|o| o.covered.iter().copied()).collect();
    println!("intervals of 95 %: {} of {} hold the truth", covered.iter().filter(|c| **c).count(), covered.len());
    let mut times: Vec<f64> = outcomes.iter().map(|o| o.seconds).collect();
    times.sort_by(f64::total_cmp);
    if let (Some(middle), Some(longest)) = (times.get(times.len() / 2), times.last()) {
        println!("discover: median {middle:.1} s, longest {longest:.1} s");
    }
}
