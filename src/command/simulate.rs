//! `creepage simulate`

use super::output::print;
use super::progress::ProgressLine;
use super::runs::not_an_input;
use super::user_catalogues::UserCatalogues;
use clap::{Args, ValueEnum};
use creepage::dynamics::{simulate_file, simulate_file_by};
use creepage::files::{Initial, Inputs, ModelFile, write_whole_by};
use creepage::model::Model;
use creepage::motion::{Integrator, Method, Signals, Table, simulate_model};
use creepage::{Error, Result};
use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::PathBuf;

/// Integrate a (patched) model over given inputs
#[derive(Args)]
#[command(after_help = "\
Example:
  creepage simulate examples/runs/cornering/model.toml --inputs examples/runs/cornering/eights.csv --out path.csv
  creepage simulate report/model.patched.toml --inputs IN.csv --out path.csv --effects examples/effects/my_effects.toml

Begins at the model's [initial], or at the pose in the first row of the inputs, or at the origin.
A model with [dynamics] moves by forces: the columns of the inputs are then forces and torques.

The result does not hang on the method; what takes the work does. Two that share no code are a check of each other:
  creepage simulate MODEL.toml --inputs IN.csv --out a.csv
  creepage simulate MODEL.toml --inputs IN.csv --out b.csv --integrator dopri5")]
pub struct Arguments {
    /// The model
    #[arg(value_name = "MODEL.toml")]
    model: PathBuf,
    /// Times and inputs, CSV with the columns of the model file
    #[arg(long, value_name = "IN.csv")]
    inputs: PathBuf,
    /// Where the trajectory goes, CSV
    #[arg(long, value_name = "OUT.csv")]
    out: PathBuf,
    /// The integrator; without it order 8, quadrature where the heading hangs on the inputs alone, or the stiff one where a
    /// model has friction
    #[arg(long, value_enum, value_name = "METHOD")]
    integrator: Option<Choice>,
    /// The longest step of rk4, s
    #[arg(long, default_value_t = 1e-3, value_parser = step, value_name = "S")]
    step: f64,
    /// Relative tolerance of the integration; rk4 reads none
    #[arg(long, default_value_t = 1e-10, value_parser = tolerance)]
    rtol: f64,
    /// Absolute tolerance of the integration
    #[arg(long, default_value_t = 1e-12, value_parser = tolerance)]
    atol: f64,
    #[command(flatten)]
    own: UserCatalogues,
}

/// A method that can be chosen.
#[derive(Clone, Copy, ValueEnum)]
enum Choice {
    /// Dormand and Prince, order 5 (the crate ode_solvers)
    Dopri5,
    /// the classical Runge–Kutta method of order 4 in even steps (the crate ode_solvers)
    Rk4,
    /// Dormand and Prince, order 8 (our own; that of ode_solvers 0.6.2 has order 1)
    Dop853,
    /// Radau IIA of order 5, implicit, for stiff equations (the crate differential-equations)
    Radau5,
}

impl Choice {
    fn method(self, step: f64) -> Method {
        match self {
            Choice::Dopri5 => Method::Dopri5,
            Choice::Rk4 => Method::Rk4 { step },
            Choice::Dop853 => Method::Dop853,
            Choice::Radau5 => Method::Radau5,
        }
    }
}

fn step(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(s) if (1e-9..=1e6).contains(&s) => Ok(s),
        _ => Err("a step lies within 1e-9 and 1e6 s".into()),
    }
}

fn tolerance(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(t) if (1e-15..=1.0).contains(&t) => Ok(t),
        _ => Err("a tolerance lies within 1e-15 and 1".into()),
    }
}

/// Carries out the command.
pub fn run(arguments: &Arguments, quiet: bool) -> Result<()> {
    not_an_input(&arguments.out, &[&arguments.inputs, &arguments.model])?;
    let progress = ProgressLine::new(quiet);
    progress.say("integrating");
    let (file, library) = &arguments.own.read(&arguments.model)?;
    let integrator = Integrator::default().with_tolerance(arguments.rtol, arguments.atol);
    if file.dynamics.is_none() {
        Model::check_motion(file)?;
    }
    let inputs = Inputs::read(&arguments.inputs, file)?;
    if !quiet {
        progress.warn(&arguments.inputs, &inputs.warnings);
    }
    let chosen = arguments.integrator.map(|choice| choice.method(arguments.step));
    let method = chosen.unwrap_or(integrator.method);
    let integrator = Integrator { method, max_steps: most_steps(inputs.time.len()), ..integrator };
    let integrator = even_steps(integrator, &inputs.time)?;
    let (signals, start) = begun(file, &inputs);
    let by_model = |integrator: &Integrator| {
        let model = Model::from_file(file, library, &inputs.roles)?;
        let pose = [start.x, start.y, start.heading].into_iter().chain(start.trailer_headings.iter().copied());
        let all: Vec<f64> = pose.chain(model.speeds_at_start(file.dynamics.as_ref())).collect();
        simulate_model(&model, &signals, &inputs.time, &all, integrator)
    };
    let table = match (&file.dynamics, chosen) {
        (Some(_), _) if !file.effects.is_empty() || !file.measured.is_empty() => {
            by_model(&integrator.for_friction(chosen.is_none() && file.has_friction()))?
        }
        (Some(_), None) => simulate_file(file, &signals, &inputs.time, &start, &integrator)?,
        (Some(_), Some(_)) => simulate_file_by(file, &signals, &inputs.time, &start, &integrator)?,
        (None, _) => by_model(&integrator)?,
    };
    drop(progress);
    check_defined(&table)?;
    write_whole_by(&arguments.out, |to| write_csv(&table, to))?;
    if !quiet {
        print(&format!("{} rows are in {}\n", table.rows(), arguments.out.display()))?;
    }
    Ok(())
}

/// The inputs as signals, and the pose to begin with.
fn begun(file: &ModelFile, inputs: &Inputs) -> (Signals, Initial) {
    let signals = Signals::of_inputs(inputs, file.input_timing);
    let start = file.initial.clone().or_else(|| inputs.pose.clone());
    (signals, start.unwrap_or_else(|| at_origin(file)))
}

/// Enough for rows far apart, and an end in seconds for a motion no integrator can follow.
fn most_steps(rows: usize) -> u32 {
    u32::try_from(rows).unwrap_or(u32::MAX).saturating_mul(100).saturating_add(1_000_000)
}

/// The most even steps of a run: some ten seconds of work.
const MOST_EVEN_STEPS: f64 = 1e7;

/// The integrator with room for the steps that even ones take: as many as the time has, and one a row more.
fn even_steps(integrator: Integrator, times: &[f64]) -> Result<Integrator> {
    let Method::Rk4 { step } = integrator.method else { return Ok(integrator) };
    let duration = times.last().zip(times.first()).map_or(0.0, |(to, from)| to - from);
    let steps = (duration / step).ceil();
    if steps > MOST_EVEN_STEPS {
        return Err(Error::input(format!("{duration} s in steps of {step} s are {steps} steps"))
            .help(format!("give a --step of {} s or more", duration / MOST_EVEN_STEPS)));
    }
    let rows = u32::try_from(times.len()).unwrap_or(u32::MAX);
    Ok(Integrator { max_steps: rows.saturating_add(steps as u32), ..integrator })
}

fn at_origin(file: &ModelFile) -> Initial {
    Initial { trailer_headings: vec![0.0; file.trailers()], ..Initial::default() }
}

fn check_defined(table: &Table) -> Result<()> {
    match table.columns.iter().flatten().all(|v| v.is_finite()) {
        true => Ok(()),
        false => Err(Error::run("the motion becomes undefined").help("see `creepage describe` for where the model is")),
    }
}

/// The table as CSV, numbers in the shortest form that reads back; a row at a time, for a long one has gigabytes.
fn write_csv(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    writeln!(to, "{}", table.names.join(","))?;
    let mut line = String::new();
    for i in 0..table.rows() {
        line.clear();
        for (k, column) in table.columns.iter().enumerate() {
            let comma = if k > 0 { "," } else { "" };
            let _ = write!(line, "{comma}{}", column[i]);
        }
        line.push('\n');
        to.write_all(line.as_bytes())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_with_what_is_undefined_is_refused() {
        let table = |v: f64| Table { names: vec!["x".into(), "y".into()], columns: vec![vec![0.0, 1.0], vec![0.0, v]] };
        assert!(check_defined(&table(-1e300)).is_ok());
        for v in [f64::NAN, f64::INFINITY] {
            assert_eq!(check_defined(&table(v)).unwrap_err().exit_code(), 1);
        }
    }
}
