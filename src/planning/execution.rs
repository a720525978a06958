//! The execution of a plan: rows of inputs as a robot is given them, where they lead on a model, and how far what is not known of
//! the model spreads that.

use super::initial_guess::nearest;
use super::plan::Plan;
use super::task::Task;
use super::tracked_point::TrackedPoint;
use crate::error::{Error, Result};
use crate::model::Model;
use crate::motion::{Integrator, Signals, Table, Timing, simulate_model, visible_state};
use nalgebra::{DMatrix, DVector};

/// The longest time between two rows, s.
const ROW: f64 = 0.05;

/// A plan on a model.
#[derive(Clone, Debug)]
pub struct Executed {
    /// The motion, row by row.
    pub table: Table,
    /// Where the tracked point ends: x, y, heading.
    pub end: [f64; 3],
    /// Its distance from the goal, m.
    pub miss: f64,
    /// Its heading less that of the goal, rad, where one is asked for.
    pub heading_miss: Option<f64>,
}

/// Times and inputs of a plan, input by input: values, or means since the row before.
///
/// Rows lie on the ends of the splines' pieces, so that the cubic through them, or through their running integral, is the
/// planned input exactly; where inputs wait for one another they lie beside them, and it is nearly so.
pub fn plan_rows(plan: &Plan, timing: Timing) -> (Vec<f64>, Vec<Vec<f64>>) {
    let span = plan.duration / plan.spline.spans as f64;
    let moving = plan.spline.spans * ((span / ROW).ceil() as usize).max(2);
    let waiting = (plan.dead_time.longest / plan.duration * moving as f64).ceil() as usize;
    let rows = moving + waiting;
    let at = |i: f64| plan.duration * (i / moving as f64);
    let time = (0..=rows).map(|i| at(i as f64)).collect();
    let command = |c: usize, i: f64| plan.command(c, at(i));
    let row = |c: usize, i: usize| match timing {
        Timing::Sample => command(c, i as f64),
        Timing::IntervalMean if i == 0 => command(c, 0.0),
        // Simpson's rule has no error for a piece of degree two.
        Timing::IntervalMean => {
            (command(c, i as f64 - 1.0) + 4.0 * command(c, i as f64 - 0.5) + command(c, i as f64)) / 6.0
        }
    };
    (time, (0..plan.coefficients.len()).map(|c| (0..=rows).map(|i| row(c, i)).collect()).collect())
}

/// Drives a plan on a model.
///
/// # Errors
/// When the motion is undefined on the way.
pub fn execute(plan: &Plan, task: &Task, model: &Model, timing: Timing) -> Result<Executed> {
    let (time, inputs) = plan_rows(plan, timing);
    let signals = Signals::new(&time, &inputs, timing);
    let table = simulate_model(model, &signals, &time, &task.start, &Integrator::default())?;
    let equations = model.equations(&[])?;
    let point = TrackedPoint::of(model, &equations, task.of_trailer)?;
    let last = table.rows() - 1;
    let measured: Vec<f64> = (0..equations.visible).map(|k| table.columns[1 + k][last]).collect();
    let mut z = visible_state(&equations, &[], &measured)?;
    z.resize(equations.n(), 0.0);
    let (end, _) = point.at(&z);
    let (x, y, heading) = task.poses.last().copied().unwrap_or((end[0], end[1], None));
    let (miss, heading_miss) = ((end[0] - x).hypot(end[1] - y), heading.map(|h| nearest(end[2] - h, 0.0)));
    Ok(Executed { table, end, miss, heading_miss })
}

/// The standard deviation of where a plan ends, m along its widest direction and rad, from the covariance of the model's
/// parameters, named `EFFECT PARAMETER`; to first order.
///
/// # Errors
/// When the model does not have a parameter of the covariance, or the motion is undefined.
pub fn spread(
    plan: &Plan,
    task: &Task,
    model: &Model,
    timing: Timing,
    (names, matrix): (&[String], &[Vec<f64>]),
) -> Result<[f64; 2]> {
    let p = names.len();
    let mut slopes = DMatrix::zeros(3, p);
    for (k, name) in names.iter().enumerate() {
        let step = 1e-2 * matrix[k][k].max(0.0).sqrt();
        if step == 0.0 {
            continue;
        }
        let end =
            |by: f64| execute(plan, task, &moved(model, name, by)?, timing).map(|e| DVector::from_column_slice(&e.end));
        slopes.set_column(k, &((end(step)? - end(-step)?) / (2.0 * step)));
    }
    let covariance = DMatrix::from_fn(p, p, |i, j| matrix[i][j]);
    let of_end = &slopes * covariance * slopes.transpose();
    let [a, b, c] = [of_end[(0, 0)], of_end[(0, 1)], of_end[(1, 1)]];
    let widest = 0.5 * (a + c) + (0.25 * (a - c).powi(2) + b * b).sqrt();
    Ok([widest.max(0.0).sqrt(), of_end[(2, 2)].max(0.0).sqrt()])
}

/// A model one of whose effects' parameters lies further by some amount.
fn moved(model: &Model, name: &str, by: f64) -> Result<Model> {
    let mut model = model.clone();
    let of = model.effects.iter_mut().find_map(|e| {
        let label = e.label();
        let k = e.effect.parameters.keys().position(|p| format!("{label} {p}") == name)?;
        Some(&mut e.values[k])
    });
    let missing = || {
        Error::input(format!("the covariance speaks of {name}, which the model does not have"))
            .help("give the report that the model was patched by")
    };
    *of.ok_or_else(missing)? += by;
    Ok(model)
}
