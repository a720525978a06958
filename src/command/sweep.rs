//! `creepage sweep`

use super::output::print;
use super::progress::ProgressLine;
use super::runs::not_an_input;
use clap::Args;
use creepage::Result;
use creepage::sweep::{Shard, Summary, Sweep};
use std::path::PathBuf;

/// Simulate a model over a grid or a seeded sample of parameters, inputs and initial poses
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage sweep examples/sweeps/wheels.toml --out wheels.csv
  creepage sweep SPEC.toml --out part-01.csv --shard 1/2
  creepage sweep SPEC.toml --out part-02.csv --shard 2/2
  cat part-01.csv part-02.csv > all.csv
  creepage sweep SPEC.toml --out all.parquet --join part-01.parquet part-02.parquet

Stopped at any moment and started again with the same files, it goes on where it was: what is done waits in
FILE.partial. Parts one behind the other are the whole table; --join checks that, and joins Parquet.")]
pub struct Arguments {
    /// The sweep
    #[arg(value_name = "SPEC.toml")]
    spec: PathBuf,
    /// Where the table goes: .csv, or .parquet where the program was built with that feature
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Do the I-th of N parts, counted from 1
    #[arg(long, value_name = "I/N", allow_hyphen_values = true, conflicts_with = "join")]
    shard: Option<Shard>,
    /// Join finished parts, given in their order
    #[arg(long, value_name = "PART", num_args = 1..)]
    join: Vec<PathBuf>,
}

/// Carries out the command.
pub fn run(arguments: &Arguments, quiet: bool) -> Result<()> {
    let progress = ProgressLine::new(quiet);
    let sweep = Sweep::read(&arguments.spec)?;
    let read = sweep.inputs();
    not_an_input(&arguments.out, &[&read[..], &[arguments.spec.as_path()]].concat())?;
    if let (Some((log, warnings)), false) = (sweep.warnings(), quiet) {
        progress.warn(log, warnings);
    }
    let out = &arguments.out;
    let text = if arguments.join.is_empty() {
        let summary = sweep.write(arguments.shard.unwrap_or(Shard::WHOLE), out, &|p| progress.hear(p))?;
        told(&summary)
    } else {
        sweep.join(&arguments.join, out)?;
        format!("{} cases", sweep.cases())
    };
    drop(progress);
    if !quiet {
        print(&format!("{text} are in {}\n", out.display()))?;
    }
    Ok(())
}

fn told(s: &Summary) -> String {
    let mut text = format!("{} cases", s.cases);
    let mut add = |n: usize, what: &str| {
        if n > 0 {
            text.push_str(&format!(", {n} {what}"));
        }
    };
    add(s.found, "of them from a run that was stopped");
    add(s.undefined, "undefined");
    add(s.not_converged, "less exact than asked for");
    text
}
