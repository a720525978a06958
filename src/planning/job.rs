//! Planning as a job: the plan, what becomes of it, and what would have become of one made without creep.

use super::correction::corrected;
use super::dead_time::DeadTime;
use super::execution::{Executed, execute, spread};
use super::infeasible::Infeasible;
use super::path::Path;
use super::plan::Plan;
use super::planner::{plan, planned_from};
use super::report::{Ideal, PlanReport, Reached, Spread};
use super::task::Task;
use crate::error::Result;
use crate::model::Model;
use crate::motion::Timing;
use crate::progress::OnProgress;

/// A plan with its report and its motion.
pub struct Planned {
    /// The plan.
    pub plan: Plan,
    /// Its report.
    pub report: PlanReport,
    /// The motion on the model.
    pub executed: Executed,
}

/// The covariance of a model's parameters: names, and rows.
pub type Covariance<'a> = (&'a [String], &'a [Vec<f64>]);

/// Plans a task on a model, and compares it with a plan made without the model's effects.
///
/// # Errors
/// When the task does not fit the model, the motion is undefined, the covariance is of another model, or the listener stops
/// the work.
pub fn planned(
    model: &Model,
    task: &Task,
    timing: Timing,
    covariance: Option<Covariance>,
    progress: &OnProgress,
) -> Result<std::result::Result<Planned, Infeasible>> {
    let found = match plan(model, task, progress)? {
        Ok(found) => found,
        Err(why) => return Ok(Err(why)),
    };
    let (found, executed) = corrected(found, model, task, timing)?;
    let ideal = match model.effects.is_empty() {
        true => None,
        false => ideal(model, task, timing, &found, progress)?,
    };
    let spread = match covariance {
        Some(covariance) => Some(spread(&found, task, model, timing, covariance)?),
        None => None,
    };
    let report = PlanReport {
        schema: 1,
        duration_s: found.arrives(),
        length_m: length(&executed),
        reversals: reversals(&executed),
        reached: reached(&executed),
        off_path_m: off_path(&executed, &task.path),
        ideal,
        spread: spread.map(|[position_m, heading_rad]| Spread { position_m, heading_rad }),
        effects: model.effects.iter().map(|e| e.label()).collect(),
    };
    Ok(Ok(Planned { plan: found, report, executed }))
}

/// What a plan made without effects does with them: the one that a search finds from the plan with them.
fn ideal(model: &Model, task: &Task, timing: Timing, with: &Plan, progress: &OnProgress) -> Result<Option<Ideal>> {
    let without = Model { effects: vec![], ..model.clone() };
    let found = match planned_from(&without, task, with)? {
        None => plan(&without, task, progress)?.ok(),
        found => found,
    };
    let Some(found) = found else { return Ok(None) };
    // Watched until its last command has acted.
    let found = Plan { dead_time: DeadTime::of(&model.equations(&[])?).unknown(), ..found };
    let executed = execute(&found, task, model, timing)?;
    Ok(Some(Ideal { duration_s: found.duration, reached: reached(&executed) }))
}

fn reached(e: &Executed) -> Reached {
    Reached { x: e.end[0], y: e.end[1], heading: e.end[2], miss_m: e.miss, miss_rad: e.heading_miss }
}

fn places(e: &Executed) -> Vec<[f64; 2]> {
    (0..e.table.rows()).map(|i| [e.table.columns[1][i], e.table.columns[2][i]]).collect()
}

fn length(e: &Executed) -> f64 {
    places(e).windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum()
}

/// Changes of the speed's sign; a thousandth of the greatest speed is rest.
fn reversals(e: &Executed) -> usize {
    let speed = e.table.column("speed").unwrap_or(&[]);
    let most = speed.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    let signs: Vec<bool> = speed.iter().filter(|v| v.abs() > 1e-3 * most).map(|v| *v > 0.0).collect();
    signs.windows(2).filter(|w| w[0] != w[1]).count()
}

fn off_path(e: &Executed, path: &Path) -> Option<f64> {
    (path.length() > 0.0).then(|| places(e).into_iter().map(|p| path.distance(p)).fold(0.0, f64::max))
}
