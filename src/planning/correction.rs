//! A plan brought to its goal as it is driven, by Broyden's method (Nocedal and Wright, *Numerical Optimization*, 2006, 11.1): rows
//! are not quite the planned inputs where these wait for one another, or bend between rows, and kinks are planned for smoothed.

use super::execution::{Executed, execute};
use super::plan::Plan;
use super::planner::Planner;
use super::sequential_quadratic_programming::restored;
use super::task::Task;
use crate::error::Result;
use crate::model::Model;
use crate::motion::Timing;
use nalgebra::{DMatrix, DVector};

/// Plans at most that are made for another goal.
const PLANS: usize = 8;
/// How often a change of the goal that leads no nearer is halved.
const HALVINGS: i32 = 2;
/// An end that is at the goal, m and rad.
const REACHED: f64 = 1e-9;

/// A plan and what becomes of its rows: as far as they lead beside the goal a plan near it is made for another goal, until the rows
/// of that one lead to the goal, or no nearer.
///
/// # Errors
/// When the motion is undefined.
pub fn corrected(found: Plan, model: &Model, task: &Task, timing: Timing) -> Result<(Plan, Executed)> {
    let mut best = (found.clone(), execute(&found, task, model, timing)?);
    let Some(goal) = task.poses.last().filter(|_| size(&best.1) > REACHED) else { return Ok(best) };
    let off = |executed: &Executed| {
        let place = [executed.end[0] - goal.0, executed.end[1] - goal.1];
        DVector::from_vec(place.into_iter().chain(executed.heading_miss).collect())
    };
    let planner = Planner::of(model, task, found.smoothed)?;
    let mut aim = DVector::zeros(off(&best.1).len());
    // Where the goal of a plan is moved, its end moves as much.
    let mut inverse: DMatrix<f64> = DMatrix::identity(aim.len(), aim.len());
    let mut halvings = 0;
    for _ in 0..PLANS {
        if size(&best.1) <= REACHED || halvings > HALVINGS {
            break;
        }
        let step: DVector<f64> = -0.5_f64.powi(halvings) * (&inverse * off(&best.1));
        let Some(plan) = planner.near(&aimed(task, &(&aim + &step)), &found, restored) else {
            halvings += 1;
            continue;
        };
        let driven = execute(&plan, task, model, timing)?;
        learn(&mut inverse, &step, &(off(&driven) - off(&best.1)));
        halvings = if size(&driven) < size(&best.1) { 0 } else { halvings + 1 };
        if halvings == 0 {
            (aim, best) = (aim + step, (plan, driven));
        }
    }
    Ok(best)
}

/// Broyden's update of an inverse Jacobian by a step and the change that it brought.
fn learn(inverse: &mut DMatrix<f64>, step: &DVector<f64>, change: &DVector<f64>) {
    let foreseen = &*inverse * change;
    let along = inverse.tr_mul(step);
    let weight = step.dot(&foreseen);
    if weight.abs() > 1e-3 * step.norm_squared() {
        *inverse += (step - foreseen) * along.transpose() / weight;
    }
}

/// The task with its goal moved.
fn aimed(task: &Task, by: &DVector<f64>) -> Task {
    let mut task = task.clone();
    if let Some((x, y, heading)) = task.poses.last_mut() {
        *x += by[0];
        *y += by[1];
        *heading = heading.zip(by.get(2)).map(|(h, by)| h + by);
    }
    task
}

/// How far a plan ends from its goal, m and rad.
fn size(executed: &Executed) -> f64 {
    executed.miss.max(executed.heading_miss.unwrap_or(0.0).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A linear map of two variables is inverted within four steps.
    #[test]
    fn a_linear_map_is_learnt() {
        let map = DMatrix::from_row_slice(2, 2, &[1.4, 0.3, -0.2, 0.6]);
        let mut at: DVector<f64> = DVector::from_column_slice(&[0.3, -0.8]);
        let mut inverse: DMatrix<f64> = DMatrix::identity(2, 2);
        for _ in 0..4 {
            let step: DVector<f64> = -(&inverse * (&map * &at));
            learn(&mut inverse, &step, &(&map * &step));
            at += step;
        }
        assert!(at.norm() < 1e-12, "{at}");
    }
}
