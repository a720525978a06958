//! `creepage discover`

use super::own_effects::OwnEffects;
use super::print;
use super::progress::Progress;
use clap::Args;
use creepage::discrepancy::discover::{Discovery, Request, discover};
use creepage::discrepancy::html::{gap_svg, html};
use creepage::discrepancy::summary::summary_text;
use creepage::files::{ModelFile, Run, write_all_or_nothing};
use creepage::model::{self, Model};
use creepage::{Error, Result};
use std::path::{Path, PathBuf};

/// Find where model and measurement disagree, name the missing effect, add it to the model
#[derive(Args)]
#[command(after_help = "\
Example:
  creepage discover examples/runs/cornering/eights.csv examples/runs/cornering/rosette.csv \\
    --held-out examples/runs/cornering/square_held_out.csv \\
    --model examples/runs/cornering/model.toml --out report
  creepage discover RUN.csv --model MODEL.toml --effects examples/effects/my_effects.toml --out report

Writes report.json, report.html, gap.svg and model.patched.toml into the output folder.
Exit code 0 whatever the verdict, 2 for unusable input, 1 for a failed run.")]
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
    /// A horizon of the gap, s (repeatable) [default: 1, 5 and 30]
    #[arg(long = "horizon", value_name = "S", value_parser = horizon)]
    horizons: Vec<f64>,
    /// Seed of the noise floor's random numbers
    #[arg(long, default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    own: OwnEffects,
}

fn horizon(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(h) if h.is_finite() && h > 0.0 => Ok(h),
        _ => Err("a horizon is a positive number of seconds".into()),
    }
}

/// Carries out the command.
pub fn run(arguments: &Arguments, quiet: bool) -> Result<()> {
    let progress = Progress::new(quiet);
    progress.say("reading the runs");
    let library = &arguments.own.library()?;
    let file = ModelFile::read(&arguments.model, &model::known(library))?;
    Model::check_motion(&file)?;
    let read = |paths: &[PathBuf]| paths.iter().map(|p| Run::read(p, &file)).collect::<Result<Vec<_>>>();
    let (runs, held_out) = (read(&arguments.runs)?, read(&arguments.held_out)?);
    distinct(&arguments.runs, &arguments.held_out)?;
    let request = Request {
        file: &file,
        runs: &runs,
        held_out: &held_out,
        library,
        horizons: &arguments.horizons,
        seed: arguments.seed,
    };
    let found = discover(&request, &|what| progress.say(what))?;
    drop(progress);
    write(&found, &file, &arguments.out)?;
    if !quiet {
        print(&screen(&found, &arguments.out))?;
    }
    Ok(())
}

/// A run that is fitted cannot be held out.
fn distinct(runs: &[PathBuf], held_out: &[PathBuf]) -> Result<()> {
    let same = |a: &Path, b: &Path| a == b || matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b);
    for (i, run) in runs.iter().enumerate() {
        if held_out.iter().any(|h| same(run, h)) {
            return Err(Error::input("the run is fitted and held out at once").at_file(run).help("name it once"));
        }
        if runs[..i].iter().any(|r| same(run, r)) {
            return Err(Error::input("the run is named twice").at_file(run).help("name it once"));
        }
    }
    Ok(())
}

fn write(found: &Discovery, file: &ModelFile, out: &Path) -> Result<()> {
    let json = serde_json::to_string_pretty(&found.report).map_err(|e| Error::run(format!("no report.json: {e}")))?;
    write_all_or_nothing(
        out,
        &[
            ("report.json", format!("{json}\n").as_bytes()),
            ("report.html", html(&found.report, &found.pictures).as_bytes()),
            ("gap.svg", gap_svg(&found.report, &found.pictures).as_bytes()),
            ("model.patched.toml", found.patched(file).as_bytes()),
        ],
    )
}

fn screen(found: &Discovery, out: &Path) -> String {
    let written = format!("report.html, report.json, gap.svg and model.patched.toml are in {}\n", out.display());
    format!("{}{written}", summary_text(&found.report))
}
