//! Motion planning under a model with its creep: inputs that lead from a pose to a pose, by direct multiple shooting and
//! sequential quadratic programming from several first guesses.

use super::b_spline::BSpline;
use super::initial_guess::{Curve, curves, followed, nearest, point, straight};
use super::limits::Limit;
use super::path::Path;
use super::sequential_quadratic_programming::solved;
use super::shooting::Shooting;
use super::tracked_point::TrackedPoint;
use super::transcription::{Point, Program, Waypoint, Weights};
use crate::error::{Error, Result};
use crate::model::{Equations, Model};
use crate::motion::{Integrator, initial_hidden, visible_state};
use crate::progress::{OnProgress, Stage, tell};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The most by which neighbours of a train are bent, rad: beyond a right angle it jack-knifes.
pub const BEND: f64 = 1.4;
/// Durations at most, as multiples of what the first guess takes.
const LONGEST: f64 = 20.0;
/// How far first guesses go on along the headings, one after another until there is a plan.
const REACHES: [f64; 3] = [1.0, 2.5, 0.5];

/// How often a plan is made again for the sake of states that begin in equilibrium, and when they do.
const MOST_STARTS: usize = 12;
const SAME_START: f64 = 1e-11;

/// What is to be planned.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// The measured pose at the beginning: x, y, heading, headings of trailers.
    pub start: Vec<f64>,
    /// Poses to pass, in their order, the goal last; a heading that does not matter is none.
    pub poses: Vec<(f64, f64, Option<f64>)>,
    /// Points to follow on the way, in place of poses to pass.
    pub path: Path,
    /// Whose pose it is: 0 for what the sensor of the tractor measures, else the trailer.
    pub of_trailer: usize,
    /// Limits of the inputs, in the model's order.
    pub limits: Vec<Limit>,
    /// The duration, s, where it is given.
    pub duration: Option<f64>,
    /// What else counts.
    pub weights: Weights,
    /// Polynomial pieces of the inputs.
    pub spans: usize,
    /// The degree of the pieces: 3 for samples of the inputs, 2 for means since the row before.
    pub degree: usize,
}

impl Task {
    /// From the origin to poses, the tractor's, within usual limits and in whatever time.
    pub fn from_origin(model: &Model, poses: Vec<(f64, f64, Option<f64>)>, spans: usize) -> Self {
        Self {
            start: vec![0.0; 3 + model.trailer_count()],
            poses,
            path: Path::default(),
            of_trailer: 0,
            limits: Limit::usual(model),
            duration: None,
            weights: Weights::default(),
            spans,
            degree: 3,
        }
    }

    /// The states of a model, its free parameters at some values, at the beginning.
    ///
    /// # Errors
    /// When no pose of the vehicle gives the measured one.
    pub fn first_states(&self, equations: &Equations, p: &[f64]) -> Result<Vec<f64>> {
        let mut states = visible_state(equations, p, &self.start)?;
        states.extend(initial_hidden(equations, p, &vec![0.0; equations.inputs.len()], &states));
        Ok(states)
    }
}

/// A plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The splines of the inputs.
    pub spline: BSpline,
    /// Their coefficients, input by input.
    pub coefficients: Vec<Vec<f64>>,
    /// How long it takes, s.
    pub duration: f64,
    /// The states it is to pass, the first one ahead.
    pub states: Vec<Vec<f64>>,
}

/// Why there is no plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Infeasible {
    /// There is one without the limits of the inputs.
    Limits,
    /// There is one that bends the train further.
    JackKnife,
    /// There is one that takes longer.
    Duration,
    /// None was found without any of them either.
    Unreached,
}

/// The plan of a task, or why there is none.
///
/// # Errors
/// When the task does not fit the model, the motion is undefined at its start, or the listener stops the work.
pub fn plan(model: &Model, task: &Task, progress: &OnProgress) -> Result<std::result::Result<Plan, Infeasible>> {
    let planner = Planner::of(model, task)?;
    if let Some(found) = planner.best(task, Some(BEND), &REACHES, progress)? {
        return Ok(Ok(found));
    }
    let without_limits = Task { limits: task.limits.iter().map(unlimited).collect(), ..task.clone() };
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

/// The same input without limits worth the name: both ways, tenfold, at any rate; a steering angle up to where it locks.
fn unlimited(limit: &Limit) -> Limit {
    let most = if limit.rests { 10.0 * limit.scale() } else { limit.scale().max(1.5) };
    Limit { range: [-most, most], rate: 1e3 * most, ..limit.clone() }
}

struct Planner {
    equations: Equations,
    point: TrackedPoint,
    start: Vec<f64>,
}

impl Planner {
    fn of(model: &Model, task: &Task) -> Result<Self> {
        let equations = model.equations(&[])?;
        let point = TrackedPoint::of(model, &equations, task.of_trailer)?;
        let start = task.first_states(&equations, &[])?;
        if task.limits.len() != equations.logged() {
            return Err(Error::run("a limit is missing for an input of the model"));
        }
        Ok(Self { equations, point, start })
    }

    /// The best of the plans that the search finds from its first guesses.
    fn best(&self, task: &Task, bend: Option<f64>, reaches: &[f64], progress: &OnProgress) -> Result<Option<Plan>> {
        let spline = BSpline { degree: task.degree, spans: task.spans };
        let (first, _) = self.point.at(&self.start);
        let spans = legs(task.spans, task.poses.len());
        let through = self.poses(task, first);
        let guesses: Vec<Vec<Curve>> = match task.path.length() > 0.0 {
            true => vec![followed(&task.path, first, task.spans)],
            false => reaches.iter().map(|reach| curves(&through, &spans, *reach)).collect(),
        };
        let (tried, all) = (AtomicUsize::new(0), guesses.iter().map(Vec::len).sum());
        let search = |curve: &Curve| {
            let on_body =
                Curve { poses: self.on_body(&curve.poses, task), ahead: curve.ahead.clone(), length: curve.length };
            let usual = self.usual_duration(&on_body, &task.limits);
            let duration = task.duration.map_or([0.02 * usual, LONGEST * usual], |d| [d, d]);
            let begin = task.duration.unwrap_or(usual);
            let guess = point(&on_body, &self.start, &self.equations, &task.limits, spline, begin);
            let program = self.program(task, spline, bend, (duration, begin), (&curve.poses, &spans));
            let found = self.begun_at_rest(program, guess);
            tell(progress, Stage::FirstGuesses, tried.fetch_add(1, Ordering::Relaxed) + 1, all)?;
            Ok(found)
        };
        for round in &guesses {
            let found: Vec<Option<(Plan, f64)>> = round.par_iter().map(search).collect::<Result<_>>()?;
            if let Some((plan, _)) = found.into_iter().flatten().min_by(|a, b| a.1.total_cmp(&b.1)) {
                return Ok(Some(plan));
            }
        }
        Ok(None)
    }

    /// The plan of a program from a guess. States that no sensor sees begin in equilibrium under the inputs that the plan begins
    /// with, as they do where a plan is driven: planned again until both agree.
    fn begun_at_rest(&self, mut program: Program, guess: Point) -> Option<(Plan, f64)> {
        let visible = self.equations.visible;
        let mut found = solved(&program, guess)?;
        for _ in 0..MOST_STARTS {
            let first = program.shooting.first_inputs(&found.0.coefficients, found.0.duration);
            let hidden = initial_hidden(&self.equations, &[], &first, &self.start[..visible]);
            let off = hidden.iter().zip(&program.start[visible..]).map(|(a, b)| (a - b).abs() / (1.0 + a.abs()));
            if off.fold(0.0, f64::max) <= SAME_START {
                break;
            }
            program.start.splice(visible.., hidden);
            found = solved(&program, found.0)?;
        }
        let (Point { states, coefficients, duration }, cost) = found;
        let states = std::iter::once(program.start).chain(states).collect();
        Some((Plan { spline: program.shooting.spline, coefficients, duration, states }, cost))
    }

    /// The start, then the poses to pass, a heading that does not matter along the way to the next.
    fn poses(&self, task: &Task, first: [f64; 3]) -> Vec<[f64; 3]> {
        let mut all = vec![first];
        for (i, (x, y, heading)) in task.poses.iter().enumerate() {
            let [x0, y0, before] = all[i];
            let on = task.poses.get(i + 1).map_or((*x, *y, x0, y0), |(x1, y1, _)| (*x1, *y1, x0, y0));
            let along = (on.1 - on.3).atan2(on.0 - on.2);
            all.push([*x, *y, nearest(heading.unwrap_or(along), before)]);
        }
        all
    }

    /// Poses of the tracked point as poses of the body, as if a train were straight.
    fn on_body(&self, poses: &[[f64; 3]], task: &Task) -> Vec<[f64; 3]> {
        let straight = |heading: f64| straight(&self.start, &self.equations, [0.0, 0.0, heading]);
        let offset = self.point.at(&straight(0.0)).0;
        let turn = if task.of_trailer == 0 { offset[2] } else { 0.0 };
        let body = |[x, y, heading]: &[f64; 3]| {
            let at = self.point.at(&straight(heading - turn)).0;
            [x - at[0], y - at[1], heading - turn]
        };
        poses.iter().map(body).collect()
    }

    /// A duration in which limits let a curve be followed with ease.
    fn usual_duration(&self, curve: &Curve, limits: &[Limit]) -> f64 {
        let mut w = self.equations.workspace(&[]);
        let mut rates = vec![0.0; self.equations.n()];
        let mut full: Vec<f64> = limits.iter().map(|l| if l.rests { l.scale() } else { 0.0 }).collect();
        full.resize(self.equations.inputs.len(), 0.0);
        self.equations.rates(&mut w, &self.start, &full, &mut rates);
        let speed = rates[0].hypot(rates[1]).max(1e-3);
        let turned: f64 = curve.poses.windows(2).map(|p| (p[1][2] - p[0][2]).abs()).sum();
        let slowest = limits.iter().map(|l| l.scale() / l.rate).fold(0.0, f64::max);
        2.5 * curve.length / speed + 1.5 * turned + 2.0 * slowest
    }

    fn program<'a>(
        &'a self,
        task: &'a Task,
        spline: BSpline,
        bend: Option<f64>,
        (duration, usual): ([f64; 2], f64),
        (guess, spans): (&[[f64; 3]], &[usize]),
    ) -> Program<'a> {
        let integrator = Integrator::default();
        let shooting = Shooting { equations: &self.equations, parameters: &[], begins: 0.0, spline, integrator };
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
        }
    }
}

/// How many spans each leg has.
fn legs(spans: usize, legs: usize) -> Vec<usize> {
    let end = |i: usize| spans * i / legs.max(1);
    (0..legs).map(|i| end(i + 1) - end(i)).collect()
}
