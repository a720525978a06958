//! Runs as the command line names them: one file each, or inputs and poses apart.

use clap::Args;
use creepage::files::{ModelFile, Run};
use creepage::{Error, Result};
use std::path::{Path, PathBuf};

/// Poses in files of their own, of a command that holds no run out.
#[derive(Args)]
pub struct Apart {
    /// Measured poses in files of their own, one for each run and in their order
    #[arg(long, num_args = 1.., value_name = "POSE.csv")]
    pub truth: Vec<PathBuf>,
    /// About where the clock of the poses reads against that of the inputs, s
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = seconds, requires = "truth")]
    pub clock_offset: Option<f64>,
}

/// Reads runs; with `truths`, the poses of each from the file in the same place.
///
/// # Errors
/// When a file cannot be read, or there are more or fewer files of poses than runs.
pub fn read(runs: &[PathBuf], truths: &[PathBuf], option: &str, file: &ModelFile) -> Result<Vec<Run>> {
    if truths.is_empty() {
        return runs.iter().map(|p| Run::read(p, file)).collect();
    }
    if runs.len() != truths.len() {
        let message = format!("{} under {option} for {}", counted(truths.len(), "file"), counted(runs.len(), "run"));
        return Err(Error::input(message).help("name the poses of every run, in the order of the runs"));
    }
    distinct(truths, &[])?;
    runs.iter().zip(truths).map(|(r, t)| Run::read_apart(r, t, file)).collect()
}

fn counted(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{n} {noun}s") }
}

/// Whether two paths lead to one file.
fn same(a: &Path, b: &Path) -> bool {
    a == b || matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// A run that is fitted cannot be held out, and none counts twice.
pub fn distinct(runs: &[PathBuf], held_out: &[PathBuf]) -> Result<()> {
    for set in [runs, held_out] {
        if let Some((_, twice)) = set.iter().enumerate().find(|(i, run)| set[..*i].iter().any(|r| same(run, r))) {
            return Err(Error::input("the run is named twice").at_file(twice).help("name it once"));
        }
    }
    for run in runs {
        if held_out.iter().any(|h| same(run, h)) {
            return Err(Error::input("the run is fitted and held out at once").at_file(run).help("name it once"));
        }
    }
    Ok(())
}

/// A clock offset of the command line, s.
pub fn seconds(text: &str) -> std::result::Result<f64, String> {
    text.parse::<f64>().ok().filter(|s| s.is_finite()).ok_or_else(|| "an offset is a number of seconds".into())
}

/// Refuses an output that is one of the files it is made from.
///
/// # Errors
/// When one of the inputs is the same file, under whatever name.
pub fn not_an_input(out: &Path, inputs: &[&Path]) -> Result<()> {
    // A terminal or a pipe may be both.
    match inputs.iter().find(|input| out.is_file() && same(out, input)) {
        None => Ok(()),
        Some(input) => Err(Error::input(format!("is read as {} and would be overwritten", input.display()))
            .at_file(out)
            .help("give another name to --out")),
    }
}
