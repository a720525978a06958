//! `creepage discover`

use super::output::{Format, print};
use super::progress::ProgressLine;
use super::runs;
use super::terminal;
use super::user_catalogues::UserCatalogues;
use crate::discrepancy::rendering::patched_state::State;
use clap::Args;
use creepage::discrepancy::discover::discover_aligned;
use creepage::discrepancy::discovery::Discovery;
use creepage::discrepancy::rendering::html::{gap_svg, html};
use creepage::discrepancy::rendering::summary::summary_text_in;
use creepage::discrepancy::report::Verdict;
use creepage::discrepancy::request::Request;
use creepage::files::{ModelFile, VEHICLES_FILE, write_all_or_nothing};
use creepage::model::Model;
use creepage::{Error, Result};
use std::path::{Path, PathBuf};

/// Find where model and measurement disagree, name the missing effect, add it to the model
#[derive(Args)]
#[command(after_help = "\
Example:
  creepage discover examples/runs/cornering/eights.csv examples/runs/cornering/rosette.csv \\
    --held-out examples/runs/cornering/bay_held_out.csv \\
    --model examples/runs/cornering/model.toml --out report
  creepage discover INPUTS.csv --truth POSES.csv --model MODEL.toml --out report
  creepage discover RUN.csv --model MODEL.toml --effects examples/effects/my_effects.toml --out report

Writes report.json, report.html, gap.svg and, but for unusable data, model.patched.toml into the output folder, and the
file of a vehicle of your own beside them, so that the patched model runs again.
Exit code 0 whatever the verdict, but 3 for one of --fail-on; 2 for unusable input, 1 for a failed run.")]
pub struct Arguments {
    /// Measured runs, CSV
    #[arg(required = true, value_name = "RUN.csv")]
    runs: Vec<PathBuf>,
    /// The model as it is believed to be
    #[arg(long, value_name = "MODEL.toml")]
    model: PathBuf,
    /// Folder for the report
    #[arg(long, value_name = "DIR", default_value = "report")]
    out: PathBuf,
    /// Runs that are only judged, opened after the last choice; without it the last quarter of every run
    #[arg(long, num_args = 1.., value_name = "RUN.csv")]
    held_out: Vec<PathBuf>,
    /// Measured poses in files of their own, one for each run and in their order: the clocks of both are aligned
    #[arg(long, num_args = 1.., value_name = "POSE.csv")]
    truth: Vec<PathBuf>,
    /// The same for the held-out runs
    #[arg(long, num_args = 1.., value_name = "POSE.csv")]
    held_out_truth: Vec<PathBuf>,
    /// About where the clock of the poses reads against that of the inputs, s; found from the motion when left out
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = runs::seconds, requires = "truth")]
    clock_offset: Option<f64>,
    /// A horizon of the gap, s (repeatable) [default: 1, 5 and 30]
    #[arg(long = "horizon", value_name = "S", allow_negative_numbers = true, value_parser = horizon)]
    horizons: Vec<f64>,
    /// What to print: the summary, or the report as JSON
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Verdicts that end the command with exit code 3, after everything is written, such as missing-effect,unexplained
    #[arg(long, value_name = "VERDICT", value_delimiter = ',', value_parser = verdict)]
    fail_on: Vec<Verdict>,
    /// Seed of the noise floor's random numbers
    #[arg(long, allow_negative_numbers = true, default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    own: UserCatalogues,
}

fn verdict(text: &str) -> std::result::Result<Verdict, String> {
    let known: Vec<&str> = Verdict::ALL.iter().map(|v| v.id()).collect();
    let found = Verdict::ALL.into_iter().find(|v| v.id() == text);
    found.ok_or_else(|| format!("no such verdict; the verdicts are {}", known.join(", ")))
}

fn horizon(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(h) if h.is_finite() && h > 0.0 => Ok(h),
        _ => Err("a horizon is a positive number of seconds".into()),
    }
}

/// Carries out the command.
pub fn run(arguments: &Arguments, quiet: bool) -> Result<()> {
    let progress = ProgressLine::new(quiet);
    progress.say("reading the runs");
    let (file, library) = &arguments.own.read(&arguments.model)?;
    Model::check_motion(file)?;
    let Arguments { runs, held_out, truth, held_out_truth, .. } = arguments;
    if truth.is_empty() && !held_out_truth.is_empty() {
        return Err(
            Error::input("--held-out-truth is given without --truth").help("name the poses of the other runs too")
        );
    }
    if !truth.is_empty() && held_out_truth.is_empty() && !held_out.is_empty() {
        return Err(Error::input("--held-out is given without --held-out-truth").help("name the poses of every run"));
    }
    let distinct = runs::distinct(runs, held_out).and_then(|()| runs::distinct(truth, held_out_truth));
    let (runs, held_out) =
        (runs::read(runs, truth, "--truth", file)?, runs::read(held_out, held_out_truth, "--held-out-truth", file)?);
    distinct?;
    let request = Request {
        file,
        runs: &runs,
        held_out: &held_out,
        library,
        horizons: &arguments.horizons,
        seed: arguments.seed,
    };
    let found = discover_aligned(&request, arguments.clock_offset, &|p| progress.hear(p))?;
    drop(progress);
    write(&found, file, &arguments.out)?;
    match arguments.format {
        Format::Json => print(&found.report.json()?)?,
        Format::Text if !quiet => print(&screen(&found, &arguments.out))?,
        Format::Text => {}
    }
    let verdict = found.report.verdict;
    match arguments.fail_on.contains(&verdict) {
        true => Err(Error::verdict(format!("the verdict is {}", verdict.id()))),
        false => Ok(()),
    }
}

fn write(found: &Discovery, file: &ModelFile, out: &Path) -> Result<()> {
    let mut files = vec![
        ("report.json", found.report.json()?),
        ("report.html", html(&found.report, &found.pictures)),
        ("gap.svg", gap_svg(&found.report, &found.pictures)),
    ];
    if is_patched(found) {
        files.push(("model.patched.toml", found.patched(file)));
    }
    files.extend(file.vehicle_origin().map(|o| (VEHICLES_FILE, o.text.clone())));
    let bytes: Vec<(&str, &[u8])> = files.iter().map(|(name, text)| (*name, text.as_bytes())).collect();
    write_all_or_nothing(out, &bytes)
}

/// Whether there is a model to write: of data that cannot be put to one there is none.
fn is_patched(found: &Discovery) -> bool {
    found.report.verdict != Verdict::UnusableData
}

fn screen(found: &Discovery, out: &Path) -> String {
    let files = match is_patched(found) {
        true => "report.html, report.json, gap.svg and model.patched.toml",
        false => "report.html, report.json and gap.svg",
    };
    let written = format!("{files} are in {}\n", out.display());
    let text = summary_text_in(&found.report, terminal::columns());
    format!("{}{written}", terminal::headed(&text, State::of(&found.report)))
}
