//! `creepage check`

use super::output::{Format, json, print_answer};
use super::progress::ProgressLine;
use super::runs;
use super::user_catalogues::UserCatalogues;
use clap::Args;
use creepage::discrepancy::check::check_aligned;
use creepage::discrepancy::identifiability::Checked;
use creepage::discrepancy::rendering::check_text::check_text;
use creepage::discrepancy::rendering::figure_data;
use creepage::discrepancy::rendering::html::check_page::check_html;
use creepage::discrepancy::report::ColumnPicture;
use creepage::files::write_all_or_nothing;
use creepage::model::Model;
use creepage::report::Standing;
use creepage::{Check, Result};
use std::path::PathBuf;

/// Say what runs can identify of a model, before anyone drives again
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage check examples/runs/cornering/eights.csv --model examples/runs/cornering/model.toml
  creepage check RUN.csv --model MODEL.toml --out checked
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
    #[command(flatten)]
    apart: runs::Apart,
    /// How to print it
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Folder for a page and the answer as JSON: check.html and check.json
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    own: UserCatalogues,
}

/// Carries out the command.
pub fn run(arguments: &Arguments, quiet: bool) -> Result<()> {
    let progress = ProgressLine::new(quiet);
    progress.say("reading the runs");
    let (file, library) = &arguments.own.read(&arguments.model)?;
    Model::check_motion(file)?;
    let runs = runs::read(&arguments.runs, &arguments.apart.truth, "--truth", file)?;
    runs::distinct(&arguments.runs, &[])?;
    let of = Checked { file, runs: &runs, library };
    let answer = check_aligned(&of, arguments.apart.clock_offset, &|p| progress.hear(p))?;
    drop(progress);
    if let Some(out) = &arguments.out {
        let page = check_html(&answer, &file.title(), env!("CARGO_PKG_VERSION"), &columns(&answer, &of)?);
        write_all_or_nothing(out, &[("check.html", page.as_bytes()), ("check.json", json(&answer)?.as_bytes())])?;
    }
    print_answer(&answer, arguments.format, quiet, check_text)
}

/// The columns of runs that cannot be used: what is wrong with them is seen there.
fn columns(answer: &Check, of: &Checked) -> Result<Vec<ColumnPicture>> {
    match of.runs.first().filter(|_| answer.verdict == Standing::UnusableData) {
        Some(first) => Ok(figure_data::columns(of.runs, &Model::from_file(of.file, of.library, &first.roles)?)),
        None => Ok(vec![]),
    }
}
