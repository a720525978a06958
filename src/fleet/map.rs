//! The map over a fleet: `discover` on every run of each robot, robot by robot, resumable and in shards.
//!
//! A run is asked alone, for a floor or a tyre may differ from the next one, and values that differ look like effects that
//! move with time to a call that takes them for one. What a robot has is what half of its runs name at least; only where no
//! run names anything all are asked in one call, which sees what is too small for one.

use super::rows::{Answer, Discovered, Mapped, Rows, Vote, identity};
use crate::discrepancy::calibration::targets::Target;
use crate::discrepancy::discover::discover_aligned;
use crate::discrepancy::discovery::Discovery;
use crate::discrepancy::report::{Named, Verdict};
use crate::discrepancy::request::Request;
use crate::error::{Error, Result};
use crate::files::{EffectEntry, FleetLog, Robot, Run};
use crate::front_door::Model;
use crate::model::Model as VehicleModel;
use crate::progress::{Counter, OnProgress, Stage, unheard};
use crate::sweep::Shard;
use rayon::prelude::*;

/// What a map did.
#[derive(Debug, Default)]
pub struct Outcome {
    /// Robots of the shard.
    pub robots: usize,
    /// Of these, robots that were there from an earlier map.
    pub found: usize,
    /// Robots whose files cannot be used, and why.
    pub failed: Vec<(String, Error)>,
}

/// Asks `discover` of every robot of a shard.
///
/// # Errors
/// When rows cannot be written, or the listener stops the work. A robot whose files cannot be used fails alone.
pub fn map(mapped: &Mapped, rows: &Rows, shard: Shard, progress: &OnProgress) -> Result<Outcome> {
    rows.begin(mapped)?;
    let all = &mapped.manifest.robots;
    let robots = &all[shard.of(all.len())];
    let counter = Counter::begin(progress, Stage::Robots, robots.len())?;
    let one = |robot: &Robot| {
        let done = discovered(mapped, rows, robot);
        counter.one()?;
        match done {
            Ok(kept) => Ok(Ok(kept)),
            // A row that cannot be written ends the work: the next one could not be written either.
            Err(Failure::Rows(e)) => Err(e),
            Err(Failure::Robot(e)) => Ok(Err((robot.robot.clone(), e))),
        }
    };
    let done: Vec<std::result::Result<bool, (String, Error)>> = robots.par_iter().map(one).collect::<Result<_>>()?;
    let mut outcome = Outcome { robots: robots.len(), ..Outcome::default() };
    for one in done {
        match one {
            Ok(kept) => outcome.found += usize::from(kept),
            Err(failed) => outcome.failed.push(failed),
        }
    }
    Ok(outcome)
}

enum Failure {
    Robot(Error),
    Rows(Error),
}

/// Asks `discover` of a robot, unless its row is there; whether it was.
fn discovered(mapped: &Mapped, rows: &Rows, robot: &Robot) -> std::result::Result<bool, Failure> {
    let identity = identity(mapped, robot, "discover").map_err(Failure::Robot)?;
    if rows.kept(&robot.robot, &identity).is_some() {
        return Ok(true);
    }
    let (model, runs) = model_and_runs(mapped, robot).map_err(Failure::Robot)?;
    let (runs, together) = answers(&model, &runs).map_err(Failure::Robot)?;
    let named = together.as_ref().map_or_else(|| shared(&runs), |a| a.named.clone());
    let row = Discovered { identity, robot: robot.clone(), named, runs, together };
    rows.keep(&row).map_err(Failure::Rows)?;
    Ok(false)
}

/// What each run says, and what all say in one call where none names anything.
fn answers(model: &Model, runs: &[Run]) -> Result<(Vec<Answer>, Option<Answer>)> {
    let alone: Vec<Answer> = runs.par_iter().map(|r| answer(model, std::slice::from_ref(r))).collect::<Result<_>>()?;
    let is_silent = runs.len() > 1 && alone.iter().all(|a| a.named.is_empty());
    Ok((alone, if is_silent { Some(answer(model, runs)?) } else { None }))
}

/// The effects that half of the answers name at least, the evidence summed, the weakest probability kept.
fn shared(answers: &[Answer]) -> Vec<Vote> {
    let asked = answers.iter().filter(|a| a.report.verdict != Verdict::UnusableData).count();
    let mut found: Vec<(Vote, usize)> = vec![];
    for vote in answers.iter().flat_map(|a| &a.named) {
        match found.iter_mut().find(|(v, _)| v.is_same(vote)) {
            Some((known, count)) => {
                *count += 1;
                known.evidence.delta_bic += vote.evidence.delta_bic;
                known.evidence.p_value = known.evidence.p_value.max(vote.evidence.p_value);
            }
            None => found.push((vote.clone(), 1)),
        }
    }
    found.into_iter().filter(|(_, count)| 2 * count >= asked).map(|(vote, _)| vote).collect()
}

fn answer(model: &Model, runs: &[Run]) -> Result<Answer> {
    VehicleModel::check_motion(&model.file)?;
    let (file, library) = (&model.file, &model.library[..]);
    let request = Request { file, runs, held_out: &[], library, horizons: &[], seed: 0 };
    let found = discover_aligned(&request, None, &unheard)?;
    Ok(Answer { named: votes(&found, model), report: found.report })
}

/// A robot's model.
pub(super) fn model(mapped: &Mapped, robot: &Robot) -> Result<Model> {
    Model::read_with(&robot.model, mapped.vehicles.as_deref(), mapped.effects.as_deref())
}

/// A robot's model and its runs.
pub(super) fn model_and_runs(mapped: &Mapped, robot: &Robot) -> Result<(Model, Vec<Run>)> {
    let model = model(mapped, robot)?;
    let read = |log: &FleetLog| match &log.truth {
        Some(truth) => Run::read_apart(&log.log, truth, &model.file),
        None => Run::read(&log.log, &model.file),
    };
    let runs = robot.logs.iter().map(read).collect::<Result<_>>()?;
    Ok((model, runs))
}

/// What a discovery names, each with the entry that it gives to the model file.
fn votes(found: &Discovery, model: &Model) -> Vec<Vote> {
    let of_library = |e: &&EffectEntry| model.library.iter().any(|l| l.id == e.id);
    let entries = found.added.iter().filter(of_library);
    let vote = |(named, entry): (&Named, &EffectEntry)| Vote {
        target: Target::of(&entry.id, entry.input.as_deref(), entry.trailer).to_string(),
        says: named.says.clone(),
        in_part: entry.scope.is_some() || entry.course.is_some(),
        identical: named.indistinguishable_from.iter().filter(|r| r.why == "identical").map(|r| r.id.clone()).collect(),
        evidence: named.evidence.clone(),
        parameters: named.parameters.clone(),
    };
    found.report.effects.iter().zip(entries).filter(|(named, entry)| named.id == entry.id).map(vote).collect()
}
