//! The join of a fleet: from the rows of robots to what the fleet has, which robots differ, and a model for each.

use super::column::{Column, columns_of, parameter};
use super::covariates::{Covariate, days};
use super::fits::{Plan, fits};
use super::needed_effects::{Wanted, wanted};
use super::outlying_robots::Outlier;
use super::parameter_model::{Levels, ParameterModel, Said};
use super::rendering::fleet_text;
use super::report::*;
use super::robot_models::RobotModel;
use super::rows::{Discovered, Fitted, Mapped, Rows, Vote};
use crate::error::{Error, Result};
use crate::files::FleetLog;
use crate::progress::OnProgress;
use std::collections::BTreeMap;

/// Probability, over all parameters of a fleet in which no robot is odd, that one is called odd; the same for runs, and for
/// effects that a robot alone needs.
const ODD: f64 = 0.002;
/// Probability, over all parameters of a fleet that no tag matters to, that one is said to matter.
const TAG: f64 = 0.01;
/// The tag that dates are.
const DATE: &str = "date";

/// A fleet's report and what it rests on.
#[derive(Clone, Debug)]
pub struct Joined {
    /// The report.
    pub report: FleetReport,
    /// What each robot's runs said, in the order of the manifest.
    pub fitted: Vec<(Discovered, Fitted)>,
    /// What was mapped.
    pub mapped: Mapped,
    /// The model of each robot.
    pub models: Vec<RobotModel>,
}

/// Puts the rows of a fleet together; `incomplete` whether robots may be missing.
///
/// # Errors
/// When rows are missing or cannot be read, or the logs that they are of.
pub fn join(rows: &Rows, incomplete: bool, progress: &OnProgress) -> Result<Joined> {
    let mapped = rows.read()?;
    let found: Vec<(String, Option<Discovered>)> =
        mapped.manifest.robots.iter().map(|r| Ok((r.robot.clone(), rows.of(&r.robot)?))).collect::<Result<_>>()?;
    let missing: Vec<String> = found.iter().filter(|(_, d)| d.is_none()).map(|(name, _)| name.clone()).collect();
    let discovered: Vec<Discovered> = found.into_iter().filter_map(|(_, d)| d).collect();
    if discovered.is_empty() || !missing.is_empty() && !incomplete {
        let message =
            format!("{} of {} robots have no row: {}", missing.len(), mapped.manifest.robots.len(), missing.join(", "));
        return Err(Error::input(message)
            .help("run fleet map again with the same manifest; or join what there is with --incomplete"));
    }
    let wanted = wanted(&discovered);
    let plan = Plan::of(&mapped, &discovered, &wanted, ODD)?;
    let fitted = fits(&mapped, rows, &discovered, &plan, progress)?;
    let fleet = Fleet { all: discovered.into_iter().zip(fitted).collect(), wanted, plan };
    let mut report = fleet.report(&missing);
    let model = |((d, _), r): (&(Discovered, Fitted), &RobotReport)| RobotModel::of(&mapped, &fleet.plan, d, r);
    let models: Vec<RobotModel> = fleet.all.iter().zip(&report.per_robot).map(model).collect::<Result<_>>()?;
    report.per_robot.iter_mut().zip(&models).for_each(|(r, m)| r.mend.clone_from(&m.mend));
    Ok(Joined { report, fitted: fleet.all, mapped, models })
}

struct Fleet {
    all: Vec<(Discovered, Fitted)>,
    wanted: Vec<Wanted>,
    plan: Plan,
}

impl Fleet {
    fn report(&self, missing: &[String]) -> FleetReport {
        let columns = self.columns();
        let tags = self.covariates();
        let share = columns.len().max(1) as f64;
        let levels = Levels { odd: ODD / share, tag: TAG / share };
        let models: Vec<Option<ParameterModel>> =
            columns.iter().map(|c| ParameterModel::of(&c.said, &tags, levels)).collect();
        let told: Vec<(&Column, &ParameterModel)> =
            columns.iter().zip(&models).filter_map(|(c, m)| Some((c, m.as_ref()?))).collect();
        let mut report = FleetReport {
            schema: 1,
            summary: String::new(),
            robots: self.all.len(),
            runs: self.all.iter().map(|(_, f)| f.runs.len()).sum(),
            verdicts: self.verdicts(),
            effects: self.effects(&columns, &models),
            not_needed: self.not_needed(),
            odd_robots: told.iter().flat_map(|(c, m)| self.odd_robots(c, m)).collect(),
            odd_runs: told.iter().flat_map(|(c, m)| self.odd_runs(c, m)).collect(),
            own_effects: self.plan.own.iter().flat_map(|(r, votes)| votes.iter().map(|v| own_effect(r, v))).collect(),
            per_robot: (0..self.all.len()).map(|i| self.robot(i, &told)).collect(),
            warnings: fleet_text::warnings(missing, &columns.iter().map(|c| (c.name(), c.without)).collect::<Vec<_>>()),
            version: env!("CARGO_PKG_VERSION").into(),
        };
        for (column, model) in told {
            for (robot, runs) in self.over_time(column, model) {
                report.per_robot[robot].over_time.insert(column.name(), runs);
            }
        }
        report.summary = fleet_text::summary(&report);
        report
    }

    fn verdicts(&self) -> BTreeMap<String, usize> {
        let mut counts = BTreeMap::new();
        self.all.iter().for_each(|(d, _)| *counts.entry(d.verdict().id().to_string()).or_default() += 1);
        counts
    }

    /// Every parameter of the effects that the fleet shares.
    fn columns(&self) -> Vec<Column> {
        self.plan.shared.iter().flat_map(|target| columns_of(&self.all, target)).collect()
    }

    /// Tags and dates as columns of a design.
    fn covariates(&self) -> Vec<Covariate> {
        let logs = || self.logs();
        let names: std::collections::BTreeSet<&String> = logs().flat_map(|l| l.tags.keys()).collect();
        let dates: Vec<Option<&str>> = logs().map(|l| l.date.as_deref()).collect();
        let of_tag = |name: &&String| {
            let values: Vec<Option<&str>> = logs().map(|l| l.tags.get(*name).map(String::as_str)).collect();
            Covariate::of(name, &values)
        };
        Covariate::of(DATE, &dates).into_iter().chain(names.iter().filter_map(of_tag)).collect()
    }

    fn effects(&self, columns: &[Column], models: &[Option<ParameterModel>]) -> Vec<FleetEffect> {
        let of = |target: &String| {
            let wanted = self.wanted.iter().find(|w| w.target == *target)?;
            let mine = columns.iter().zip(models).filter(|(c, _)| c.effect == *target);
            Some(FleetEffect {
                effect: target.clone(),
                says: wanted.says.clone(),
                also_named: wanted.names.iter().filter(|n| *n != target).cloned().collect(),
                named_by: wanted.robots.len(),
                delta_bic: wanted.delta_bic,
                q_value: wanted.q_value,
                parameters: mine.map(|(c, m)| (c.parameter.clone(), parameter(c, m.as_ref()))).collect(),
            })
        };
        self.plan.shared.iter().filter_map(of).collect()
    }

    fn not_needed(&self) -> Vec<NotNeeded> {
        let left = self.wanted.iter().filter(|w| !self.plan.shared.contains(&w.target));
        left.map(|w| NotNeeded {
            effect: w.target.clone(),
            robots: w.robots.clone(),
            q_value: w.q_value,
            not_told_apart: self.plan.untold.contains(&w.target),
        })
        .collect()
    }

    fn odd_robots(&self, column: &Column, model: &ParameterModel) -> Vec<OddRobot> {
        let odd = |o: &Outlier| {
            let value = model.robots.get(&o.which)?;
            Some(column.odd(self.name(o.which), None, [value.own, value.own_std, model.mean()], o))
        };
        model.odd_robots.iter().filter_map(odd).collect()
    }

    fn odd_runs(&self, column: &Column, model: &ParameterModel) -> Vec<OddRobot> {
        let odd = |o: &Outlier| {
            let said = column.said.iter().find(|s| s.run == o.which)?;
            let others = model.robots.get(&said.robot)?.own;
            let run = self.runs().nth(o.which)?.to_string();
            Some(column.odd(self.name(said.robot), Some(run), [said.value, said.std, others], o))
        };
        model.odd_runs.iter().filter_map(odd).collect()
    }

    fn logs(&self) -> impl Iterator<Item = &FleetLog> {
        self.all.iter().flat_map(|(d, _)| &d.robot.logs)
    }

    fn name(&self, robot: usize) -> &str {
        &self.all[robot].0.robot.robot
    }

    fn runs(&self) -> impl Iterator<Item = &str> {
        self.all.iter().flat_map(|(_, f)| f.runs.iter().map(|r| r.run.as_str()))
    }

    fn robot(&self, i: usize, told: &[(&Column, &ParameterModel)]) -> RobotReport {
        let (discovered, fitted) = &self.all[i];
        let value = |(column, model): &(&Column, &ParameterModel)| {
            let v = model.robots.get(&i)?;
            let finite = |x: f64| Some(x).filter(|x| x.is_finite());
            let told = ValueOfRobot {
                value: v.value,
                std: v.std,
                own: v.own,
                own_std: v.own_std,
                z: finite(v.z),
                q_value: finite(v.q_value),
                is_odd: model.odd_robots.iter().any(|o| o.which == i),
            };
            Some((column.name(), told))
        };
        RobotReport {
            robot: discovered.robot.robot.clone(),
            runs: fitted.runs.len(),
            verdict: discovered.verdict().id().into(),
            values: told.iter().filter_map(value).collect(),
            over_time: BTreeMap::new(),
            mend: vec![],
        }
    }
}

impl Fleet {
    /// What the dated runs of each robot say of a parameter, by date; of robots that have several.
    fn over_time(&self, column: &Column, model: &ParameterModel) -> BTreeMap<usize, Vec<RunValue>> {
        let dates: Vec<Option<&String>> = self.logs().map(|l| l.date.as_ref()).collect();
        let names: Vec<&str> = self.runs().collect();
        let one = |s: &Said| {
            let date = dates.get(s.run).copied().flatten()?;
            let is_odd = model.odd_runs.iter().any(|o| o.which == s.run);
            let run = names.get(s.run)?.to_string();
            Some((days(date)?, RunValue { run, date: date.clone(), value: s.value, std: s.std, is_odd }))
        };
        let mut of_robots: BTreeMap<usize, Vec<(f64, RunValue)>> = BTreeMap::new();
        column.said.iter().for_each(|s| of_robots.entry(s.robot).or_default().extend(one(s)));
        let several = of_robots.into_iter().filter(|(_, runs)| runs.len() > 1);
        let by_date = |(robot, mut runs): (usize, Vec<(f64, RunValue)>)| {
            runs.sort_by(|a, b| a.0.total_cmp(&b.0));
            (robot, runs.into_iter().map(|(_, run)| run).collect())
        };
        several.map(by_date).collect()
    }
}

fn own_effect(robot: &str, vote: &Vote) -> OwnEffect {
    let mut own = OwnEffect {
        robot: robot.into(),
        effect: vote.target.clone(),
        in_part: vote.in_part,
        parameters: vote.parameters.clone(),
        evidence: vote.evidence.clone(),
        says: String::new(),
    };
    own.says = fleet_text::own(&own);
    own
}
