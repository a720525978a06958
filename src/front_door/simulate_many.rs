//! Many motions of one model over the inputs of a run: the engine of sweeps, with arrays in place of files.

use super::model::Model;
use crate::error::{Error, Result};
use crate::files::Run;
use crate::formula::{Expr, Symbol};
use crate::model::Model as VehicleModel;
use crate::motion::{Case, Ensemble, EnsembleInputs, Signals, Varied};
use crate::sweep::names;
use rayon::prelude::*;

/// The error asked for: see [`Ensemble`].
const ERROR: f64 = 1e-9;
/// Cases of a block.
const BLOCK: usize = 256;

/// Motions of one model, case by case and row by row.
///
/// ```
/// let none = creepage::Motions { pose: 3, rows: 1, cases: vec![] };
/// assert_eq!(none.poses().count(), 0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Motions {
    /// How many of the first numbers of a row are the pose: x, y, heading, headings of trailers.
    pub pose: usize,
    /// Rows of a case: the times of the run's poses.
    pub rows: usize,
    /// The cases.
    pub cases: Vec<Case>,
}

impl Motions {
    /// The poses, case by case, row by row; not a number where a motion is undefined.
    pub fn poses(&self) -> impl Iterator<Item = f64> + '_ {
        let row = |case: &Case, i: usize, k: usize| if case.is_defined() { case.row(i)[k] } else { f64::NAN };
        let of_case = move |case| (0..self.rows).flat_map(move |i| (0..self.pose).map(move |k| row(case, i, k)));
        self.cases.iter().flat_map(of_case)
    }
}

/// Simulates a model over the inputs of a run, from the first pose of the run, once for each set of values.
///
/// What varies goes by the names of a sweep's file: a parameter (`track_width`), a value of an effect of the model
/// (`rotation-creep.e_rc`), a component of the first pose (`initial.heading`). Every case is integrated twice and checked,
/// as [`Ensemble`] says; the numbers do not depend on the number of threads.
///
/// ```
/// use creepage::{Model, Run};
/// let model = Model::read("examples/runs/cornering/model.toml")?;
/// let run = Run::read("examples/runs/cornering/eights.csv", &model)?;
/// let radii: Vec<f64> = (0..5).map(|i| 0.09 + 0.005 * f64::from(i)).collect();
/// let motions = creepage::simulate_many(&model, &run, &[("wheel_radius", radii)])?;
/// assert_eq!((motions.cases.len(), motions.rows), (5, run.time.len()));
/// # Ok::<(), creepage::Error>(())
/// ```
///
/// # Errors
/// When a name is unknown, a value is out of range, the lists of values differ in length, or the motion cannot be compiled.
pub fn simulate_many(model: &Model, run: &Run, values: &[(&str, Vec<f64>)]) -> Result<Motions> {
    let vehicle = VehicleModel::from_file(&model.file, &model.library, &run.roles)?;
    let cases = values.first().map_or(0, |(_, of)| of.len());
    let varied = varied(model, &vehicle, values, cases)?;
    let log = |role: &String| Expr::sym(Symbol::new(&format!("log.{role}")));
    let inputs = EnsembleInputs {
        formulas: vehicle.inputs.iter().map(log).collect(),
        log: Some((run.roles.clone(), Signals::of_run(run, model.file.input_timing))),
        ..EnsembleInputs::default()
    };
    let start = super::discover::start(model, &vehicle, run);
    let ensemble = Ensemble::new(&vehicle, &inputs, &varied, &start, run.time[0], &run.time, ERROR)?;
    let of_case = |i: usize| values.iter().map(|(_, of)| of[i]).collect::<Vec<f64>>();
    let plan = ensemble.plan(of_case, cases)?;
    let block = |first: usize| {
        let given: Vec<Vec<f64>> = (first..cases.min(first + BLOCK)).map(of_case).collect();
        ensemble.run(&plan, &given.iter().map(Vec::as_slice).collect::<Vec<_>>())
    };
    let starts: Vec<usize> = (0..cases).step_by(BLOCK).collect();
    let found: Vec<Vec<Case>> = starts.into_par_iter().map(block).collect::<Result<_>>()?;
    Ok(Motions {
        pose: 3 + vehicle.trailer_count(),
        rows: run.time.len(),
        cases: found.into_iter().flatten().collect(),
    })
}

/// What varies, with its values held against what they may be.
fn varied(model: &Model, vehicle: &VehicleModel, values: &[(&str, Vec<f64>)], cases: usize) -> Result<Vec<Varied>> {
    if cases == 0 {
        return Err(Error::input("nothing varies").help("give a name and its values, such as track_width"));
    }
    let known = names::quantities(&model.file, vehicle);
    let one = |(name, of): &(&str, Vec<f64>)| {
        if of.len() != cases {
            let message = format!("{name} has {} values where the first has {cases}", of.len());
            return Err(Error::input(message).help("give each the same number of values, one a case"));
        }
        let (varied, allowed) = names::of_model(name, &known)?;
        match of.iter().find(|v| !allowed.holds(**v)) {
            Some(value) => Err(allowed.refusal(name, *value)),
            None => Ok(varied),
        }
    };
    values.iter().map(one).collect()
}
