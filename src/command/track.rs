//! `creepage track`

use super::output::{Format, pretty, print};
use super::plan_task::TaskArguments;
use super::progress::ProgressLine;
use super::user_catalogues::UserCatalogues;
use clap::Args;
use creepage::figures::tracking_picture;
use creepage::files::write_all_or_nothing;
use creepage::model::Model;
use creepage::planning::infeasible;
use creepage::tracking::{Tracked, Trials, drives_table, tracked, tracking_text};
use creepage::{Error, Result};
use std::path::PathBuf;

/// Drive plans in simulation with feedback, on the ideal model, with creep observed, and on the model as it is
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage track report/model.patched.toml --goal 2,1,1.57
  creepage track model.toml --goal 0,-1.2,0 --noise 0.01,0.02 --every 0.2 --drives 50
  creepage track model.toml --path lane.csv --out tracked

The vehicle is the model with its effects. A plan is made on it, and one on the same model without its effects; each is driven
alone and with feedback: poses with noise go through an extended Kalman filter to a model predictive controller. The observer has
the coefficients of creep as states that begin at zero and may drift; time constants are held as the model has them. The table
says how far each way is from its own plan, and from where that ends.
DIR gets track.json, track.svg and drives.csv, the first drive of every way.
Exit code 0, or 1 when the goal cannot be reached, with the reason; 2 for unusable input.")]
pub struct Arguments {
    /// The model, with what it is known to miss
    #[arg(value_name = "MODEL.toml")]
    model: PathBuf,
    #[command(flatten)]
    task: TaskArguments,
    /// Deviations of a measured pose: position, m, and heading, rad
    #[arg(long, value_name = "M,RAD", default_value = "0.005,0.01", value_parser = noise)]
    noise: Noise,
    /// Time between two poses, and between two commands, s
    #[arg(long, value_name = "S", default_value_t = 0.1, value_parser = sample)]
    every: f64,
    /// How many commands the controller looks ahead
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u16).range(2..=200))]
    horizon: u16,
    /// How long the vehicle is led on behind the end of its plan, s
    #[arg(long, value_name = "S", default_value_t = 1.0, value_parser = settling)]
    settling: f64,
    /// Drives of each way with feedback
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u16).range(1..=10_000))]
    drives: u16,
    /// Seed of the noise
    #[arg(long, value_name = "S", default_value_t = 0)]
    seed: u64,
    /// Folder for the report
    #[arg(long, value_name = "DIR", default_value = "track")]
    out: PathBuf,
    /// How to print what becomes of it
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    own: UserCatalogues,
}

/// Deviations of a measured pose.
type Noise = (f64, f64);

fn noise(text: &str) -> std::result::Result<Noise, String> {
    let wrong = || "write M,RAD, such as 0.005,0.01: each above zero and at most 10".to_string();
    let number = |t: &str| t.trim().parse::<f64>().ok().filter(|v| (1e-9..=10.0).contains(v));
    let (m, rad) = text.split_once(',').ok_or_else(wrong)?;
    number(m).zip(number(rad)).ok_or_else(wrong)
}

fn between(text: &str, least: f64, most: f64) -> std::result::Result<f64, String> {
    let value = text.parse::<f64>().ok().filter(|v| (least..=most).contains(v));
    value.ok_or_else(|| format!("a time from {least} to {most} s"))
}

fn sample(text: &str) -> std::result::Result<f64, String> {
    between(text, 1e-3, 10.0)
}

fn settling(text: &str) -> std::result::Result<f64, String> {
    between(text, 0.0, 1e3)
}

/// Carries out the command.
pub fn run(arguments: &Arguments, quiet: bool) -> Result<()> {
    let (file, library) = &arguments.own.read(&arguments.model)?;
    file.no_forces("track")?;
    Model::check_motion(file)?;
    let model = Model::of_file(file, library)?;
    let task = arguments.task.task(file, &model)?;
    let trials = Trials {
        sample: arguments.every,
        noise: [arguments.noise.0, arguments.noise.1],
        drives: usize::from(arguments.drives),
        horizon: usize::from(arguments.horizon),
        settling: arguments.settling,
        seed: arguments.seed,
    };
    let progress = ProgressLine::new(quiet);
    progress.say("planning");
    let found = tracked(&model, &task, &trials, &|p| progress.hear(p))?;
    drop(progress);
    let found = found.map_err(|why| {
        let (message, help) = infeasible(why, task.duration);
        Error::run(message).help(help)
    })?;
    told(arguments, &found, quiet)
}

fn told(arguments: &Arguments, found: &Tracked, quiet: bool) -> Result<()> {
    let json = serde_json::to_value(&found.report).map_err(|e| Error::run(format!("no JSON: {e}")))?;
    let (json, svg, table) = (pretty(&json), tracking_picture(found), drives_table(found));
    let files = [("track.json", json.as_bytes()), ("track.svg", svg.as_bytes()), ("drives.csv", table.as_bytes())];
    write_all_or_nothing(&arguments.out, &files)?;
    match arguments.format {
        Format::Json => print(&json),
        Format::Text if quiet => Ok(()),
        Format::Text => {
            let out = arguments.out.display();
            print(&format!("{}\n{out}/track.svg shows the first drive of each\n", tracking_text(&found.report)))
        }
    }
}
