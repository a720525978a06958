//! Fits of every run of a fleet with the effects that the fleet needs, significant or not: a run that says little of an
//! effect says that, and is not left out for it.

use super::map::{model, model_and_runs};
use super::needed_effects::Wanted;
use super::rows::{Discovered, Fitted, FittedRun, Mapped, Rows, Vote, identity};
use crate::discrepancy::calibration::calibrate::calibrate;
use crate::discrepancy::calibration::targets::{Target, resolved};
use crate::discrepancy::calibration_report::{CalibratedEffect, CalibratedValue, Calibration, Standing};
use crate::discrepancy::preprocessing::input_effects::on_inputs;
use crate::discrepancy::report::Estimate;
use crate::discrepancy::request::{Request, common_roles};
use crate::error::Result;
use crate::files::{FleetLog, Robot, Run};
use crate::front_door::Model;
use crate::model::Model as VehicleModel;
use crate::progress::{Counter, OnProgress, Stage, unheard};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Robots whose runs are asked whether they tell an effect from those before it.
const PROBES: usize = 3;

/// What is fitted to the runs of a fleet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    /// The effects that the fleet needs.
    pub shared: Vec<String>,
    /// Effects that it would need if its runs told them from those before.
    pub untold: Vec<String>,
    /// Effects that one robot needs beside them.
    pub own: BTreeMap<String, Vec<Vote>>,
}

impl Plan {
    /// What is fitted to the runs of a robot.
    pub fn targets(&self, robot: &str) -> Vec<String> {
        let own = self.own.get(robot).into_iter().flatten().filter(|v| !v.in_part).map(|v| v.target.clone());
        self.shared.iter().cloned().chain(own).collect()
    }

    /// The plan of a fleet, `level` the probability that a robot gets an effect of its own where none needs one.
    pub fn of(mapped: &Mapped, rows: &[Discovered], wanted: &[Wanted], level: f64) -> Result<Self> {
        let mut plan = Self::default();
        for one in wanted.iter().filter(|w| w.is_needed) {
            match plan.shared.is_empty() || is_told(mapped, rows, &plan.shared, one)? {
                true => plan.shared.push(one.target.clone()),
                false => plan.untold.push(one.target.clone()),
            }
        }
        let known = |v: &Vote| wanted.iter().any(|w| plan.shared.contains(&w.target) && w.names.contains(&v.target));
        let own = |row: &Discovered| {
            let chances = (rows.len() * model(mapped, &row.robot)?.library.len()) as f64;
            let strong = |v: &&Vote| v.evidence.p_value * chances < level && (v.in_part || !known(v));
            let of = |vote: &Vote| match vote.in_part {
                true => Ok(Some(vote.clone())),
                false => beside(mapped, &row.robot, &plan.shared, vote),
            };
            let found: Vec<Option<Vote>> = row.named.iter().filter(strong).map(of).collect::<Result<_>>()?;
            Ok((row.robot.robot.clone(), found.into_iter().flatten().collect()))
        };
        let own: Vec<(String, Vec<Vote>)> =
            rows.par_iter().filter(|r| !r.named.is_empty()).map(own).collect::<Result<_>>()?;
        plan.own = own.into_iter().filter(|(_, found)| !found.is_empty()).collect();
        Ok(plan)
    }
}

/// Whether the runs of robots that name an effect tell it from those that are fitted already.
fn is_told(mapped: &Mapped, rows: &[Discovered], shared: &[String], one: &Wanted) -> Result<bool> {
    let (mut told, mut asked) = (0, 0);
    for row in rows.iter().filter(|r| one.robots.contains(&r.robot.robot)).take(PROBES) {
        let (model, runs) = model_and_runs(mapped, &row.robot)?;
        let all: Vec<String> = shared.iter().chain([&one.target]).cloned().collect();
        told += usize::from(fitted(&model, &runs, &all)?.verdict == Standing::Fitted);
        asked += 1;
    }
    Ok(2 * told > asked)
}

/// An effect, with its values, that a robot's runs ask for beside those that the fleet shares; none where they do not.
fn beside(mapped: &Mapped, robot: &Robot, shared: &[String], vote: &Vote) -> Result<Option<Vote>> {
    let (model, runs) = model_and_runs(mapped, robot)?;
    let all: Vec<String> = shared.iter().chain([&vote.target]).cloned().collect();
    let found = fitted(&model, &runs, &all)?;
    let asked = |e: &&CalibratedEffect| found.verdict == Standing::Fitted && e.delta_bic.is_some_and(|d| d > 0.0);
    let value = |p: &CalibratedValue| Estimate { value: p.value, std: p.std, unit: p.unit.clone(), course: None };
    let values = |e: &CalibratedEffect| e.parameters.iter().map(|(name, p)| (name.clone(), value(p))).collect();
    let with = |parameters| Vote { parameters, ..vote.clone() };
    Ok(found.effects.last().filter(asked).map(values).map(with))
}

/// The fit of those effects that apply to runs.
fn fitted(model: &Model, runs: &[Run], targets: &[String]) -> Result<Calibration> {
    let (file, library) = (&model.file, &model.library[..]);
    let vehicle = VehicleModel::from_file(file, library, &common_roles(runs, &[])?)?;
    let expanded = on_inputs(library, &vehicle, runs);
    let targets: Vec<Target> = targets.iter().map(|t| t.parse()).collect::<Result<_>>()?;
    let applies = |t: &Target| resolved(std::slice::from_ref(t), &vehicle, &expanded, library).is_ok();
    let targets: Vec<Target> = targets.into_iter().filter(applies).collect();
    let request = Request { file, runs, held_out: &[], library, horizons: &[], seed: 0 };
    Ok(calibrate(&request, &targets, None, &unheard)?.calibration)
}

/// The fits of every run of every robot, those that are there kept.
pub fn fits(
    mapped: &Mapped,
    rows: &Rows,
    of: &[Discovered],
    plan: &Plan,
    progress: &OnProgress,
) -> Result<Vec<Fitted>> {
    let counter = Counter::begin(progress, Stage::FleetFits, of.len())?;
    let one = |row: &Discovered| {
        let fitted = fit_of(mapped, rows, &row.robot, plan)?;
        counter.one()?;
        Ok(fitted)
    };
    of.par_iter().map(one).collect()
}

fn fit_of(mapped: &Mapped, rows: &Rows, robot: &Robot, plan: &Plan) -> Result<Fitted> {
    let targets = plan.targets(&robot.robot);
    let identity = identity(mapped, robot, &format!("fit {}", targets.join(",")))?;
    if let Some(kept) = rows.kept_fit(&robot.robot, &identity) {
        return Ok(kept);
    }
    let (model, runs) = model_and_runs(mapped, robot)?;
    let one = |(log, run): (&FleetLog, &Run)| {
        let calibration = fitted(&model, std::slice::from_ref(run), &targets)?;
        Ok(FittedRun { run: log.run.clone(), calibration })
    };
    let runs = robot.logs.iter().zip(&runs).map(one).collect::<Result<_>>()?;
    let row = Fitted { identity, targets, runs };
    rows.keep_fit(&robot.robot, &row)?;
    Ok(row)
}
