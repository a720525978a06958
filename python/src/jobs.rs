//! The jobs: each is one call of the library.

use crate::errors::raised;
use crate::model::Model;
use crate::run::Run;
use crate::work::worked;
use clap::Parser;
use creepage::sweep::{Shard, Sweep};
use creepage::{Options, command};
use numpy::{PyArray1, PyArray3, PyArrayMethods, ToPyArray};
use pyo3::prelude::*;
use std::path::PathBuf;

fn all(runs: &[PyRef<Run>]) -> Vec<creepage::Run> {
    runs.iter().map(|run| run.0.clone()).collect()
}

fn pretty(value: &impl serde::Serialize) -> creepage::Result<String> {
    serde_json::to_string_pretty(value).map_err(|e| creepage::Error::run(format!("an answer has no JSON: {e}")))
}

/// Finds what is missing: JSON, page, screen, and the text of the patched model.
#[pyfunction]
#[pyo3(signature = (model, runs, held_out, horizons, seed, clock_offset, effects, threads, progress))]
#[expect(clippy::too_many_arguments, reason = "each is one of the command's options")]
pub fn discover(
    py: Python,
    model: &Model,
    runs: Vec<PyRef<Run>>,
    held_out: Vec<PyRef<Run>>,
    horizons: Vec<f64>,
    seed: u64,
    clock_offset: Option<f64>,
    effects: Option<Vec<String>>,
    threads: Option<usize>,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<(String, String, String, String)> {
    let (model, runs, held_out) = (&model.0, all(&runs), all(&held_out));
    worked(py, threads, progress, move |progress| {
        let options = Options { held_out, horizons, seed, clock_offset, effects, progress };
        let found = creepage::discover_with(model, &runs, &options)?;
        Ok((found.json()?, found.html(), found.text(), found.model.text().to_string()))
    })
}

/// Says before any fit what runs can tell: JSON.
#[pyfunction]
pub fn check(
    py: Python,
    model: &Model,
    runs: Vec<PyRef<Run>>,
    clock_offset: Option<f64>,
    effects: Option<Vec<String>>,
    threads: Option<usize>,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<String> {
    let (model, runs) = (&model.0, all(&runs));
    worked(py, threads, progress, move |progress| {
        let options = Options { clock_offset, effects, progress, ..Options::default() };
        pretty(&creepage::check_with(model, &runs, &options)?)
    })
}

/// Fits just these effects: JSON.
#[pyfunction]
pub fn fit(
    py: Python,
    model: &Model,
    runs: Vec<PyRef<Run>>,
    effects: Vec<String>,
    threads: Option<usize>,
) -> PyResult<String> {
    let (model, runs) = (&model.0, all(&runs));
    worked(py, threads, None, move |_| {
        let effects: Vec<&str> = effects.iter().map(String::as_str).collect();
        pretty(&creepage::fit(model, &runs, &effects)?)
    })
}

/// The motion of a model over the inputs of a run, column by column.
#[pyfunction]
pub fn simulate<'py>(py: Python<'py>, model: &Model, run: &Run) -> PyResult<Vec<(String, Bound<'py, PyArray1<f64>>)>> {
    let table = py.detach(|| creepage::simulate(&model.0, &run.0)).map_err(|e| raised(py, &e))?;
    Ok(table.names.into_iter().zip(&table.columns).map(|(name, column)| (name, column.to_pyarray(py))).collect())
}

/// The motions of a model over the inputs of a run, once for each set of values: x, y, heading and headings of trailers of
/// every case and row, how many are undefined, and how many did not reach the error asked for.
#[pyfunction]
pub fn simulate_many<'py>(
    py: Python<'py>,
    model: &Model,
    run: &Run,
    values: Vec<(String, Vec<f64>)>,
    threads: Option<usize>,
) -> PyResult<(Bound<'py, PyArray3<f64>>, usize, usize)> {
    let (model, run) = (&model.0, &run.0);
    let (shape, poses, (undefined, rough)) = worked(py, threads, None, move |_| {
        let values: Vec<(&str, Vec<f64>)> = values.iter().map(|(name, of)| (name.as_str(), of.clone())).collect();
        let found = creepage::simulate_many(model, run, &values)?;
        let undefined = found.cases.iter().filter(|c| !c.is_defined()).count();
        let rough = found.cases.iter().filter(|c| c.is_defined() && !c.converged).count();
        Ok(([found.cases.len(), found.rows, found.pose], found.poses().collect(), (undefined, rough)))
    })?;
    Ok((PyArray1::from_vec(py, poses).reshape(shape)?, undefined, rough))
}

/// Simulates the cases of a sweep's file, or of a shard of them, into a table; how many there are, and how many of them are
/// undefined.
#[pyfunction]
#[pyo3(signature = (spec, out, shard, threads, progress))]
pub fn sweep(
    py: Python,
    spec: PathBuf,
    out: PathBuf,
    shard: Option<String>,
    threads: Option<usize>,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<(usize, usize)> {
    worked(py, threads, progress, move |progress| {
        let shard = shard.map_or(Ok(Shard::WHOLE), |part| part.parse().map_err(creepage::Error::input))?;
        let written = Sweep::read(spec)?.write(shard, &out, progress)?;
        Ok((written.cases, written.undefined))
    })
}

/// Joins the tables of all shards of a sweep.
#[pyfunction]
pub fn join_sweep(py: Python, spec: PathBuf, parts: Vec<PathBuf>, out: PathBuf) -> PyResult<()> {
    py.detach(|| Sweep::read(spec)?.join(&parts, &out)).map_err(|e| raised(py, &e))
}

/// The constraints of a model: text, LaTeX and JSON.
#[pyfunction]
pub fn describe(py: Python, model: &Model) -> PyResult<(String, String, String)> {
    let told = py.detach(|| {
        let found = creepage::describe(&model.0)?;
        Ok((
            creepage::describe::text(&found),
            creepage::describe::latex(&found),
            pretty(&creepage::describe::json(&found))?,
        ))
    });
    told.map_err(|e| raised(py, &e))
}

/// Runs claims: JSON of their ledger.
#[pyfunction]
pub fn verify(
    py: Python,
    ids: Vec<String>,
    seed: u64,
    threads: Option<usize>,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<String> {
    worked(py, threads, progress, move |progress| {
        let ids: Vec<&str> = ids.iter().map(String::as_str).collect();
        let ledger = creepage::verify(&ids, &Options { seed, progress, ..Options::default() })?;
        pretty(&creepage::claims::ledger::json(&ledger))
    })
}

/// The effects that can be named, of one vehicle where one is given: JSON.
#[pyfunction]
pub fn effects(py: Python, vehicle: Option<String>) -> PyResult<String> {
    let (vehicles, library) = (creepage::vehicles::all(), creepage::effects::all());
    let told = py.detach(|| match &vehicle {
        Some(vehicle) => pretty(&creepage::describe::vehicle_effects_json(vehicle, vehicles, library)?),
        None => pretty(&creepage::describe::effects_json(vehicles, library)?),
    });
    told.map_err(|e| raised(py, &e))
}

/// The command `creepage` with its arguments, the first of which is its own name; the exit code.
#[pyfunction]
pub fn main(py: Python, arguments: Vec<String>) -> u8 {
    py.detach(|| match command::Cli::try_parse_from(arguments) {
        Ok(cli) => command::ended(cli.run()),
        Err(error) => {
            let _ = error.print();
            u8::try_from(error.exit_code()).unwrap_or(2)
        }
    })
}
