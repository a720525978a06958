//! Motion planning under a model with its creep: inputs that lead from a pose to a pose, by direct multiple shooting and
//! sequential quadratic programming from several first guesses.

use super::b_spline::BSpline;
use super::continuation::{continued, near_to};
use super::dead_time::DeadTime;
use super::infeasible::Infeasible;
use super::initial_guess::{FirstGuess, nearest, point, straight};
use super::limits::Limit;
use super::plan::Plan;
use super::reachability::{Fixed, Motions};
use super::shooting::Shooting;
use super::smoothing::{smoothed, widths};
use super::task::Task;
use super::tracked_point::TrackedPoint;
use super::transcription::{Point, Program, Waypoint};
use crate::error::{Error, Result};
use crate::model::{Equations, Model};
use crate::motion::{Integrator, Method, Signals, Timing, initial_hidden, simulate};
use crate::progress::{OnProgress, Stage, tell};
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The most by which neighbours of a train are bent, rad: beyond a right angle it jack-knifes.
pub const BEND: f64 = 1.4;
/// Durations at most, as multiples of what the first guess takes.
const LONGEST: f64 = 20.0;
/// How far first guesses go on along the headings, one after another until there is a plan.
const REACHES: [f64; 3] = [1.0, 2.5, 0.5];

/// How often a plan is made again for the sake of states that begin in equilibrium, and when they do.
const MOST_STARTS: usize = 12;
/// How a motion is integrated, and what equations may be off by, m and rad: while first guesses are followed, and in the end.
const SEARCHED: (Integrator, f64) =
    (Integrator { method: Method::Automatic, rtol: 1e-6, atol: 1e-8, max_steps: 100_000 }, 1e-6);
fn exact() -> (Integrator, f64) {
    (Integrator::default(), 1e-10)
}

/// The plan of a task, or why there is none.
///
/// # Errors
/// When the task does not fit the model, the motion is undefined at its start, or the listener stops the work.
pub fn plan(model: &Model, task: &Task, progress: &OnProgress) -> Result<std::result::Result<Plan, Infeasible>> {
    let widths = widths(model);
    let planner = Planner::of(model, task, widths[0])?;
    if let Some(fixed) = planner.unreachable(task) {
        return Ok(Err(Infeasible::Fixed(fixed)));
    }
    if let Some(mut found) = planner.best(task, Some(BEND), &REACHES, progress)? {
        for width in &widths[1..] {
            let Some(narrower) = Planner::of(model, task, *width)?.near(task, &found, near_to) else { break };
            found = narrower;
        }
        return Ok(Ok(found));
    }
    let without_limits = Task { limits: task.limits.iter().map(Limit::without_limits).collect(), ..task.clone() };
    let without_time = Task { duration: None, ..task.clone() };
    let reached =
        |task: &Task, bend: Option<f64>| Ok::<_, Error>(planner.best(task, bend, &REACHES[..1], progress)?.is_some());
    let why = if task.duration.is_some() && reached(&without_time, Some(BEND))? {
        Infeasible::Duration
    } else if reached(&without_limits, Some(BEND))? {
        Infeasible::Limits
    } else if model.trailer_count() > 0 && reached(task, None)? {
        Infeasible::JackKnife
    } else {
        Infeasible::Unreached
    };
    Ok(Err(why))
}

/// The best plan for a task that a search finds from a plan for another model of the same vehicle, of whatever duration.
///
/// # Errors
/// When the task does not fit the model.
pub(super) fn planned_from(model: &Model, task: &Task, begun: &Plan) -> Result<Option<Plan>> {
    let planner = Planner::of(model, task, 0.0)?;
    let a_usual = planner.a_usual_duration(task, &planner.guesses(task, &REACHES));
    let (program, guess) = planner.beside(task, begun, (planner.durations(task, begun.duration), a_usual));
    let found = planner.searched(program, guess, &planner.start);
    Ok(found.and_then(|found| planner.exactly(found.program, found.point, near_to)))
}

/// How a point of a program is come to from one that nearly is.
type Follow = fn(&Program, Point) -> Option<Point>;

/// A point at which the equations of a program hold.
struct Found<'a> {
    program: Program<'a>,
    point: Point,
    cost: f64,
}

pub(super) struct Planner {
    pub(super) equations: Equations,
    /// The equations with their kinks, by which states that no sensor sees begin.
    driven: Equations,
    pub(super) point: TrackedPoint,
    pub(super) start: Vec<f64>,
    dead_time: DeadTime,
    /// The width over which kinks are smoothed.
    smoothed: f64,
}

impl Planner {
    /// Of a model whose kinks are smoothed over a width.
    pub(super) fn of(model: &Model, task: &Task, width: f64) -> Result<Self> {
        let driven = model.equations(&[])?;
        let start = task.first_states(&driven, &[])?;
        let model = smoothed(model, &task.limits, width);
        let equations = match &model {
            Cow::Borrowed(_) => driven.clone(),
            Cow::Owned(model) => model.equations(&[])?,
        };
        let point = TrackedPoint::of(&model, &equations, task.of_trailer)?;
        if task.limits.len() != equations.logged() {
            return Err(Error::run("a limit is missing for an input of the model"));
        }
        let dead_time = DeadTime::of(&equations);
        Ok(Self { equations, driven, point, start, dead_time, smoothed: width })
    }

    /// What a pose of a task asks for, and no input changes.
    fn unreachable(&self, task: &Task) -> Option<Fixed> {
        let spline = BSpline { degree: task.degree, spans: 1 };
        let (equations, begins, integrator) = (&self.equations, self.dead_time.longest, Integrator::default());
        let shooting = Shooting { equations, parameters: &[], begins, spline, integrator };
        let motions = Motions::sampled(&shooting, &self.start, &self.point, &task.limits);
        task.poses.iter().find_map(|pose| motions.unreachable(*pose))
    }

    /// The best of the plans that the search finds from its first guesses.
    fn best(&self, task: &Task, bend: Option<f64>, reaches: &[f64], progress: &OnProgress) -> Result<Option<Plan>> {
        let spline = BSpline { degree: task.degree, spans: task.spans };
        let spans = task.legs();
        let guesses = self.guesses(task, reaches);
        let a_usual = self.a_usual_duration(task, &guesses);
        let (tried, all) = (AtomicUsize::new(0), guesses.iter().map(Vec::len).sum());
        let search = |FirstGuess { poses, on_body, usual }: &FirstGuess| {
            let begin = self.moving(task).unwrap_or(*usual);
            let (guess, begins) = point(on_body, &self.start, &self.equations, &task.limits, spline, begin);
            let program = self.program(task, spline, bend, (self.durations(task, *usual), a_usual), (poses, &spans));
            let found = self.searched(program, guess, &begins);
            tell(progress, Stage::FirstGuesses, tried.fetch_add(1, Ordering::Relaxed) + 1, all)?;
            Ok(found)
        };
        for round in &guesses {
            let found: Vec<Option<Found>> = round.par_iter().map(search).collect::<Result<_>>()?;
            let mut found: Vec<Found> = found.into_iter().flatten().collect();
            found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
            if let Some(plan) = found.into_iter().find_map(|found| self.exactly(found.program, found.point, near_to)) {
                return Ok(Some(plan));
            }
        }
        Ok(None)
    }

    /// The program of a task with a range of durations and a usual one, and a plan as a point of it: what no sensor sees is as at the
    /// start where it is not the same.
    fn beside<'a>(&'a self, task: &'a Task, plan: &Plan, durations: ([f64; 2], f64)) -> (Program<'a>, Point) {
        let visible = self.equations.visible;
        let seen = |z: &Vec<f64>| [&z[..visible], &self.start[visible..]].concat();
        let states: Vec<Vec<f64>> = match plan.states[0].len() == self.start.len() {
            true => plan.states[1..].to_vec(),
            false => plan.states[1..].iter().map(seen).collect(),
        };
        let poses: Vec<[f64; 3]> = states.iter().map(|z| self.point.at(z).0).collect();
        let program = self.program(task, plan.spline, Some(BEND), durations, (&poses, &task.legs()));
        (program, Point { states, coefficients: plan.coefficients.clone(), duration: plan.duration })
    }

    /// The plan for a task near one for the task or another, as `follow` comes to it.
    pub(super) fn near(&self, task: &Task, plan: &Plan, follow: Follow) -> Option<Plan> {
        let (program, guess) = self.beside(task, plan, (self.durations(task, plan.duration), plan.duration));
        self.exactly(program, guess, follow)
    }

    /// How long the motion itself may take of a duration that is given.
    pub(super) fn moving(&self, task: &Task) -> Option<f64> {
        task.duration.map(|d| (d - self.dead_time.longest).max(1e-3))
    }

    /// The least and the most that a motion may take whose first guess takes a while.
    fn durations(&self, task: &Task, guessed: f64) -> [f64; 2] {
        self.moving(task).map_or([0.02 * guessed, LONGEST * guessed], |d| [d, d])
    }

    /// The best plan of a program from a guess and the state that it begins with.
    fn searched<'a>(&self, mut program: Program<'a>, guess: Point, begins: &[f64]) -> Option<Found<'a>> {
        let point = continued(&mut program, guess, begins)?;
        let (program, point) = self.begun_at_rest(program, point)?;
        Some(Found { cost: program.cost(&point), program, point })
    }

    /// The plan near one that the search found, as `follow` comes to it.
    fn exactly(&self, mut program: Program, guess: Point, follow: Follow) -> Option<Plan> {
        (program.shooting.integrator, program.tolerance) = exact();
        let point = follow(&program, guess)?;
        let (program, Point { states, coefficients, duration }) = self.begun_at_rest(program, point)?;
        let states = std::iter::once(program.start).chain(states).collect();
        let (spline, dead_time, smoothed) = (program.shooting.spline, self.dead_time.clone(), self.smoothed);
        Some(Plan { spline, coefficients, duration, dead_time, smoothed, states })
    }

    /// A plan whose states that no sensor sees begin in equilibrium under the inputs that it begins with, as they do where it is
    /// driven, and while inputs wait time goes on: planned again until both agree.
    fn begun_at_rest<'a>(&self, mut program: Program<'a>, mut point: Point) -> Option<(Program<'a>, Point)> {
        for _ in 0..MOST_STARTS {
            let first = program.shooting.first_inputs(&point.coefficients, point.duration);
            let begun = self.begun(&first)?;
            let off = begun.iter().zip(&program.start).map(|(a, b)| (a - b).abs() / (1.0 + a.abs()));
            if off.fold(0.0, f64::max) <= 0.1 * program.tolerance {
                break;
            }
            program.start = begun;
            point = near_to(&program, point)?;
        }
        Some((program, point))
    }

    /// The states when the motion begins, under the inputs that it begins with; none where they are undefined.
    fn begun(&self, first: &[f64]) -> Option<Vec<f64>> {
        if self.dead_time.longest == 0.0 {
            return Some(self.in_equilibrium(first));
        }
        // Held, inputs have no slope.
        let logged = self.equations.logged();
        let held: Vec<f64> = (0..first.len()).map(|i| if i < logged { first[i] } else { 0.0 }).collect();
        let times = [0.0, self.dead_time.longest];
        let columns: Vec<Vec<f64>> = held[..logged].iter().map(|u| vec![*u; 2]).collect();
        let inputs = Signals::new(&times, &columns, Timing::Sample);
        let states = self.in_equilibrium(&held);
        simulate(&self.driven, &[], &inputs, &states, &times, &Integrator::default()).ok()?.pop()
    }

    /// The pose at the start, with what no sensor sees in equilibrium under inputs.
    pub(super) fn in_equilibrium(&self, inputs: &[f64]) -> Vec<f64> {
        let mut states = self.start[..self.equations.visible].to_vec();
        states.extend(initial_hidden(&self.driven, &[], inputs, &states));
        states
    }

    fn program<'a>(
        &'a self,
        task: &'a Task,
        spline: BSpline,
        bend: Option<f64>,
        (duration, usual): ([f64; 2], f64),
        (guess, spans): (&[[f64; 3]], &[usize]),
    ) -> Program<'a> {
        let (begins, (integrator, tolerance)) = (self.dead_time.longest, SEARCHED);
        let shooting = Shooting { equations: &self.equations, parameters: &[], begins, spline, integrator };
        let mut at = 0;
        let waypoints = task.poses.iter().zip(spans).map(|((x, y, heading), spans)| {
            at += spans;
            // A heading counts by whole turns as the guess arrives.
            let arrives = self.point.at(&straight(&self.start, &self.equations, guess[at - 1])).0[2];
            Waypoint { span: at - 1, pose: (*x, *y, heading.map(|h| nearest(h, arrives))) }
        });
        Program {
            waypoints: waypoints.collect(),
            shooting,
            start: self.start.clone(),
            point: &self.point,
            path: task.path.clone(),
            limits: &task.limits,
            bend,
            duration,
            usual,
            weights: task.weights,
            tolerance,
        }
    }
}
