//! `creepage fit`

use super::output::{Format, print_answer};
use super::progress::ProgressLine;
use super::runs;
use super::user_catalogues::UserVehicles;
use clap::Args;
use creepage::discrepancy::calibration::calibrate::calibrate;
use creepage::discrepancy::calibration::targets::Target;
use creepage::discrepancy::rendering::calibration_text::calibration_text;
use creepage::discrepancy::request::Request;
use creepage::files::write_whole;
use creepage::model::Model;
use creepage::{Error, Result};
use std::path::PathBuf;

/// Fit just these effects: values, deviations, covariance, and no selection
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage fit examples/runs/cornering/eights.csv --model examples/runs/cornering/model.toml \\
    --effects cornering-creep,lever-arm
  creepage fit RUN.csv --model MODEL.toml --effects track-width,wheel-radius-mismatch --format json | jq .covariance
  creepage fit RUN.csv --model MODEL.toml --effects input-lag@steering_angle --out model.fitted.toml

Unlike discover, fit names nothing: every effect that is asked for gets a value, significant or not, so that values of
many runs or robots can be put together. All rows are fitted. What is known before any run stands in the model file:
  [[effects]]
  id = \"track-width\"
  scale = 0.0                              # where the fit begins
  prior = { mean = 0.0, std = 0.02 }       # of several parameters: prior = { a = { mean = 0.0, std = 0.1 } }
  bounds = [-0.1, 0.1]
Exit code 0 whatever the values, 2 for unusable input, 1 for a failed run.")]
pub struct Arguments {
    /// Measured runs
    #[arg(required = true, value_name = "RUN.csv")]
    runs: Vec<PathBuf>,
    /// The model as it is believed to be
    #[arg(long, value_name = "MODEL.toml")]
    model: PathBuf,
    /// The effects, as in `creepage effects`; one of several inputs or trailers is written ID@INPUT, ID@TRAILER
    #[arg(long, required = true, value_name = "ID,ID", value_delimiter = ',', value_parser = target)]
    effects: Vec<Target>,
    /// Where the model with the fitted effects goes
    #[arg(long, value_name = "MODEL.toml")]
    out: Option<PathBuf>,
    #[command(flatten)]
    apart: runs::Apart,
    /// How to print it
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    vehicles: UserVehicles,
    /// Effects of your own, as in examples/effects/my_effects.toml, that --effects may name
    #[arg(long, value_name = "FILE.toml")]
    own_effects: Option<PathBuf>,
}

fn target(text: &str) -> std::result::Result<Target, String> {
    text.parse().map_err(|e: Error| e.to_string())
}

/// Carries out the command.
pub fn run(arguments: &Arguments, quiet: bool) -> Result<()> {
    let progress = ProgressLine::new(quiet);
    progress.say("reading the runs");
    let own = arguments.own_effects.as_deref();
    let model = creepage::Model::read_with(&arguments.model, arguments.vehicles.file(), own)?;
    let (file, library) = &model.into_parts();
    Model::check_motion(file)?;
    if let Some(out) = &arguments.out {
        let inputs = arguments.runs.iter().chain(&arguments.apart.truth).chain([&arguments.model]);
        runs::not_an_input(out, &inputs.map(PathBuf::as_path).collect::<Vec<_>>())?;
    }
    let runs = runs::read(&arguments.runs, &arguments.apart.truth, "--truth", file)?;
    runs::distinct(&arguments.runs, &[])?;
    let request = Request { file, runs: &runs, held_out: &[], library, horizons: &[], seed: 0 };
    let found = calibrate(&request, &arguments.effects, arguments.apart.clock_offset, &|p| progress.hear(p))?;
    drop(progress);
    if let Some(out) = arguments.out.as_ref().filter(|_| !found.entries.is_empty()) {
        write_whole(out, file.patched(&found.entries).as_bytes())?;
    }
    print_answer(&found.calibration, arguments.format, quiet, calibration_text)
}
