//! `creepage check`

use super::output::{Format, print};
use super::progress::ProgressLine;
use super::runs;
use super::user_catalogues::UserCatalogues;
use clap::Args;
use creepage::discrepancy::check::check_aligned;
use creepage::discrepancy::identifiability::Checked;
use creepage::discrepancy::rendering::check_text::check_text;
use creepage::model::Model;
use creepage::{Error, Result};
use std::path::PathBuf;

/// Say what runs can identify of a model, before anyone drives again
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage check examples/runs/cornering/eights.csv --model examples/runs/cornering/model.toml
  creepage check RUN.csv --model MODEL.toml --format json | jq '.effects[] | select(.seen == \"no\") | .id'

For every effect of the library that applies: the standard deviation these runs would give its parameters, the smallest
value that would be seen, whether a plausible one would; which effects would not be told apart; the state of the data
(rows, noise, gaps, times, turns, speeds, units); a manoeuvre that would mend most. Exit code 0 whatever the answer.")]
pub struct Arguments {
    /// Measured runs
    #[arg(required = true, value_name = "RUN.csv")]
    runs: Vec<PathBuf>,
    /// The model as it is believed to be
    #[arg(long, value_name = "MODEL.toml")]
    model: PathBuf,
    /// Measured poses in files of their own, one for each run and in their order
    #[arg(long, num_args = 1.., value_name = "POSE.csv")]
    truth: Vec<PathBuf>,
    /// About where the clock of the poses reads against that of the inputs, s
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = runs::seconds, requires = "truth")]
    clock_offset: Option<f64>,
    /// How to print it
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    own: UserCatalogues,
}

/// Carries out the command.
pub fn run(arguments: &Arguments, quiet: bool) -> Result<()> {
    let progress = ProgressLine::new(quiet);
    progress.say("reading the runs");
    let (file, library) = &arguments.own.read(&arguments.model)?;
    file.no_forces("check")?;
    Model::check_motion(file)?;
    let runs = runs::read(&arguments.runs, &arguments.truth, "--truth", file)?;
    runs::distinct(&arguments.runs, &[])?;
    let of = Checked { file, runs: &runs, library };
    let answer = check_aligned(&of, arguments.clock_offset, &|p| progress.hear(p))?;
    drop(progress);
    let json = || serde_json::to_string_pretty(&answer).map_err(|e| Error::run(format!("no JSON: {e}")));
    match arguments.format {
        Format::Json => print(&format!("{}\n", json()?))?,
        Format::Text if !quiet => print(&check_text(&answer))?,
        Format::Text => {}
    }
    Ok(())
}
