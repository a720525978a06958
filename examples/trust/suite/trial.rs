//! A case put before `discover`, by way of real files.

use super::case::Case;
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::report::Report;
use creepage::discrepancy::request::Request;
use creepage::files::{ModelFile, Run};
use creepage::progress::unheard;
use creepage::{Result, effects, model};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::Instant;

/// The answer to a case, or why there is none, and how long it took.
pub struct Trial {
    /// What `discover` said; an error or a panic in words.
    pub answer: std::result::Result<Report, String>,
    /// Rows of the log.
    pub rows: usize,
    /// Time of `discover` alone, s.
    pub seconds: f64,
}

/// Writes a case's files into a folder: the log and the model file.
pub fn write(case: &Case, folder: &Path) -> std::io::Result<usize> {
    let log = case.scenario.run();
    std::fs::write(folder.join("model.toml"), case.model_toml())?;
    log.write_csv(folder.join("run.csv"))?;
    Ok(log.rows.len())
}

/// Hands a case to `discover`.
pub fn run(case: &Case) -> Trial {
    let folder = tempfile::tempdir().expect("a folder for temporary files");
    let rows = write(case, folder.path()).expect("temporary files can be written");
    let mut seconds = 0.0;
    let answer = catch_unwind(AssertUnwindSafe(|| asked(folder.path(), &mut seconds)));
    let answer = match answer {
        Ok(answer) => answer.map_err(|e| format!("error: {e}")),
        Err(_) => Err("panic".into()),
    };
    Trial { answer, rows, seconds }
}

fn asked(folder: &Path, seconds: &mut f64) -> Result<Report> {
    let file = ModelFile::read(folder.join("model.toml"), &model::known(effects::all()))?;
    let runs = [Run::read(folder.join("run.csv"), &file)?];
    let request = Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[], seed: 0 };
    let begun = Instant::now();
    let found = discover(&request, &unheard);
    *seconds = begun.elapsed().as_secs_f64();
    found.map(|f| f.report)
}
