//! Ways to drive to a goal beside one another: plans alone, feedback on the ideal model, with creep observed, on the model.

use super::closed_loop::{Belief, Coefficient, Driven, Vehicle, drive, measured};
use super::commands::Commands;
use super::reference::Reference;
use super::report::{Observed, SensorDeviation, TrackingReport, WayReport};
use crate::error::{Error, Result};
use crate::model::{Equations, Model};
use crate::motion::{Integrator, simulate};
use crate::planning::{Infeasible, Plan, Task, nearest, plan};
use crate::progress::{OnProgress, Stage, tell};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// How feedback is tried.
#[derive(Clone, Copy, Debug)]
pub struct Trials {
    /// Time between two samples, s.
    pub sample: f64,
    /// Deviations of a measured position, m, and heading, rad.
    pub noise: [f64; 2],
    /// Drives of each way with feedback; a plan alone is driven once.
    pub drives: usize,
    /// How many samples the controller looks ahead.
    pub horizon: usize,
    /// How long the vehicle is led on behind the end of its plan, s.
    pub settling: f64,
    /// Of the noise.
    pub seed: u64,
}

/// A way with its drives.
pub struct Way {
    /// `ideal-plan`, `ideal`, `observer`, `model-plan` or `model`.
    pub id: &'static str,
    /// What it is led along.
    pub reference: Reference,
    /// Its drives.
    pub drives: Vec<Driven>,
}

/// What came of all ways.
pub struct Tracked {
    /// Numbers.
    pub report: TrackingReport,
    /// Drives.
    pub ways: Vec<Way>,
}

/// A model, compiled, with the plan that was made on it.
struct Known {
    equations: Equations,
    start: Vec<f64>,
    plan: Plan,
    reference: Reference,
}

/// Plans a task on a model and on the same one without its effects, and drives both plans with the model as the vehicle.
///
/// # Errors
/// When the task does not fit the model, a motion is undefined, or the listener stops the work.
pub fn tracked(
    model: &Model,
    task: &Task,
    trials: &Trials,
    progress: &OnProgress,
) -> Result<std::result::Result<Tracked, Infeasible>> {
    let truth = match known(model, task, trials, progress)? {
        Ok(known) => known,
        Err(why) => return Ok(Err(why)),
    };
    let without = Model { effects: vec![], ..model.clone() };
    let ideal = match model.effects.is_empty() {
        true => None,
        false => known(&without, task, trials, progress)?.ok(),
    };
    let (observing, coefficients, truth_of_these) = observer(model);
    let observing = observing.free_equations()?;
    let begin: Vec<f64> = coefficients.iter().map(|c| c.begin).collect();
    let watched = task.first_states(&observing, &begin)?;
    let belief = |equations, start, observed| Belief {
        equations,
        start,
        observed,
        limits: &task.limits,
        horizon: trials.horizon,
    };
    let mut ways: Vec<(&'static str, &Known, Option<Belief>)> = vec![];
    if let Some(ideal) = &ideal {
        ways.push(("ideal-plan", ideal, None));
        ways.push(("ideal", ideal, Some(belief(&ideal.equations, &ideal.start, &[]))));
        if !coefficients.is_empty() {
            ways.push(("observer", ideal, Some(belief(&observing, &watched, &coefficients))));
        }
    }
    ways.push(("model-plan", &truth, None));
    ways.push(("model", &truth, Some(belief(&truth.equations, &truth.start, &[]))));
    // A plan alone is driven alike whatever the sensor says.
    let drives_of = |belief: &Option<Belief>| if belief.is_some() { trials.drives } else { 1 };
    let (done, all) = (AtomicUsize::new(0), ways.iter().map(|(_, _, belief)| drives_of(belief)).sum());
    let driven = |(id, known, belief): &(&'static str, &Known, Option<Belief>)| -> Result<Way> {
        let vehicle = Vehicle {
            equations: &truth.equations,
            start: &truth.start,
            noise: trials.noise,
            sample: trials.sample,
            samples: known.reference.poses.len() - 1,
        };
        let one = |i: usize| {
            let mut rng = ChaCha8Rng::seed_from_u64(trials.seed);
            rng.set_stream(i as u64);
            let found = drive(&vehicle, &known.reference, belief.as_ref(), &mut rng)?;
            tell(progress, Stage::Drives, done.fetch_add(1, Ordering::Relaxed) + 1, all)?;
            Ok(found)
        };
        let drives = (0..drives_of(belief)).into_par_iter().map(one).collect::<Result<_>>()?;
        Ok(Way { id, reference: known.reference.clone(), drives })
    };
    let found: Vec<Way> = ways.iter().map(driven).collect::<Result<_>>()?;
    let reports = found.iter().zip(&ways).map(|(way, (_, known, _))| of_way(way, known.plan.arrives())).collect();
    let observed =
        found.iter().find(|w| w.id == "observer").map_or(vec![], |w| observed(w, &coefficients, &truth_of_these));
    let report = TrackingReport {
        schema: 1,
        sample_s: trials.sample,
        noise: SensorDeviation { position_m: trials.noise[0], heading_rad: trials.noise[1] },
        drives: trials.drives,
        effects: model.effects.iter().map(|e| e.label()).collect(),
        ways: reports,
        observed,
    };
    Ok(Ok(Tracked { report, ways: found }))
}

fn known(
    model: &Model,
    task: &Task,
    trials: &Trials,
    progress: &OnProgress,
) -> Result<std::result::Result<Known, Infeasible>> {
    let plan = match plan(model, task, progress)? {
        Ok(plan) => plan,
        Err(why) => return Ok(Err(why)),
    };
    let equations = model.equations(&[])?;
    let start = task.first_states(&equations, &[])?;
    let reference = reference(&equations, &start, &plan, trials)?;
    Ok(Ok(Known { equations, start, plan, reference }))
}

/// A plan at the samples, with the poses to which its commands lead the model that it was made on.
fn reference(equations: &Equations, start: &[f64], plan: &Plan, trials: &Trials) -> Result<Reference> {
    let samples = (plan.arrives() / trials.sample).ceil() as usize;
    if samples > MOST_SAMPLES {
        return Err(Error::input(format!("{samples} samples are more than {MOST_SAMPLES}")).help("sample less often"));
    }
    let settling = (trials.settling / trials.sample).ceil() as usize;
    let inputs = 0..plan.coefficients.len();
    let at = |k: usize| inputs.clone().map(|input| plan.command(input, k as f64 * trials.sample)).collect();
    let rows: Vec<Vec<f64>> = (0..=samples + settling).map(at).collect();
    let times: Vec<f64> = (0..rows.len()).map(|k| k as f64 * trials.sample).collect();
    let mut commands = Commands::from(0.0, rows[0].clone());
    times.iter().zip(&rows).skip(1).for_each(|(t, row)| commands.then(*t, row.clone()));
    let states = simulate(equations, &[], &commands, start, &times, &Integrator::default())?;
    Ok(Reference { poses: states.iter().map(|z| measured(equations, z)).collect(), commands: rows })
}

/// Samples at most.
const MOST_SAMPLES: usize = 100_000;

/// The model with every coefficient free that may be zero and of either sign, these as they are at the beginning, zero, and
/// the values that the vehicle has. Time constants and the like are held as they are.
fn observer(model: &Model) -> (Model, Vec<Coefficient>, Vec<f64>) {
    let mut model = model.clone();
    let (mut found, mut truth) = (vec![], vec![]);
    for effect in &mut model.effects {
        effect.free = effect.effect.vanishes_first();
        if !effect.free {
            continue;
        }
        let label = effect.label();
        for ((name, p), value) in effect.effect.parameters.iter().zip(&mut effect.values) {
            // Of what is known of the vehicle only how large such a thing may be.
            let size = p.size.max(value.abs());
            truth.push(std::mem::replace(value, 0.0));
            found.push(Coefficient { name: format!("{label} {name}"), begin: 0.0, size, range: p.range });
        }
    }
    (model, found, truth)
}

fn of_way(way: &Way, duration: f64) -> WayReport {
    let last = way.reference.poses.len() - 1;
    let off = |driven: &Driven, k: usize| {
        let (is, wanted) = (&driven.poses[k], &way.reference.poses[k]);
        [(is[0] - wanted[0]).hypot(is[1] - wanted[1]), nearest(is[2] - wanted[2], 0.0).abs()]
    };
    let rms = |i: usize| {
        let squares = way.drives.iter().flat_map(|d| (0..=last).map(move |k| off(d, k)[i].powi(2)));
        (squares.sum::<f64>() / (way.drives.len() * (last + 1)) as f64).sqrt()
    };
    let ends: Vec<[f64; 2]> = way.drives.iter().map(|d| off(d, last)).collect();
    let mean = |i: usize| ends.iter().map(|e| e[i]).sum::<f64>() / ends.len() as f64;
    WayReport {
        id: way.id.to_string(),
        duration_s: duration,
        off_plan_m: rms(0),
        off_plan_rad: rms(1),
        end_m: mean(0),
        worst_end_m: ends.iter().map(|e| e[0]).fold(0.0, f64::max),
        end_rad: mean(1),
    }
}

fn observed(way: &Way, coefficients: &[Coefficient], truth: &[f64]) -> Vec<Observed> {
    let of = |(i, (c, true_value)): (usize, (&Coefficient, &f64))| {
        let all = || way.drives.iter().map(|d| d.coefficients[i]);
        let n = way.drives.len() as f64;
        Observed {
            name: c.name.clone(),
            true_value: *true_value,
            found: all().map(|v| v[0]).sum::<f64>() / n,
            error: (all().map(|v| (v[0] - true_value).powi(2)).sum::<f64>() / n).sqrt(),
            deviation: all().map(|v| v[1]).sum::<f64>() / n,
        }
    };
    coefficients.iter().zip(truth).enumerate().map(of).collect()
}
