//! `creepage plan`

use super::output::{Format, pretty, print};
use super::plan_task::TaskArguments;
use super::progress::ProgressLine;
use super::runs::not_an_input;
use super::user_catalogues::UserCatalogues;
use clap::Args;
use creepage::files::write_whole;
use creepage::model::Model;
use creepage::motion::Timing;
use creepage::planning::{Planned, infeasible, plan_table, plan_text, planned};
use creepage::{Error, Result};
use std::path::PathBuf;

/// Find inputs that reach a pose under the model as it is, with its creep
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage plan report/model.patched.toml --goal 2,1,1.57 --out plan.csv
  creepage plan model.toml --goal 0,-1.2,0 --limit wheel_rate=-8,8 --rate steering_angle=0.5 --covariance report/report.json
  creepage plan train.toml --goal=-6,2,0 --of-trailer 2 --cost smooth
  creepage plan model.toml --path lane.csv --duration 20

Poses are what the sensor measures: x and y in m, the heading in rad, counter-clockwise. PLAN.csv has a row every 50 ms or less,
in the columns of the model file, so that `creepage simulate MODEL.toml --inputs PLAN.csv` drives it. Limits that are not given:
speed 1 m/s, yaw rate 1 rad/s, steering angle 0.6 rad, each reached from rest in a second, steering in half. What drives is at
rest at both ends. Beside the plan stands what one made without the model's effects would have missed by.
Exit code 0 when the goal is reached, 1 when it cannot be, with the reason; 2 for unusable input.")]
pub struct Arguments {
    /// The model, with what it is known to miss
    #[arg(value_name = "MODEL.toml")]
    model: PathBuf,
    #[command(flatten)]
    task: TaskArguments,
    /// The report, or the answer of `fit --format json`, whose covariance spreads the end
    #[arg(long, value_name = "REPORT.json")]
    covariance: Option<PathBuf>,
    /// Where the plan goes
    #[arg(long, value_name = "PLAN.csv", default_value = "plan.csv")]
    out: PathBuf,
    /// How to print what becomes of it
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    own: UserCatalogues,
}

/// Carries out the command.
pub fn run(arguments: &Arguments, quiet: bool) -> Result<()> {
    not_an_input(&arguments.out, &[&arguments.model])?;
    let (file, library) = &arguments.own.read(&arguments.model)?;
    file.no_forces("plan")?;
    Model::check_motion(file)?;
    let model = Model::of_file(file, library)?;
    let covariance = arguments.covariance.as_deref().map(super::export::covariance).transpose()?;
    let timing = Timing::from(file.input_timing);
    let task = arguments.task.task(file, &model)?;
    let progress = ProgressLine::new(quiet);
    progress.say("planning");
    let found =
        planned(&model, &task, timing, covariance.as_ref().map(|(names, rows)| (&names[..], &rows[..])), &|p| {
            progress.hear(p)
        })?;
    drop(progress);
    let found = found.map_err(|why| {
        let (message, help) = infeasible(why, task.duration);
        Error::run(message).help(help)
    })?;
    let (table, left) = plan_table(&found.plan, &found.executed, &model, file, timing);
    write_whole(&arguments.out, table.as_bytes())?;
    told(arguments, &found, &left, quiet)
}

fn told(arguments: &Arguments, found: &Planned, left: &[String], quiet: bool) -> Result<()> {
    for role in left {
        eprintln!(
            "creepage: warning: the model file reads {role} in a way that a plan is not written in; its column is \"{role}\", in SI units"
        );
    }
    match arguments.format {
        Format::Json => {
            let json = serde_json::to_value(&found.report).map_err(|e| Error::run(format!("no JSON: {e}")))?;
            print(&pretty(&json))
        }
        Format::Text if !quiet => {
            print(&format!("{}The plan is in {}\n", plan_text(&found.report), arguments.out.display()))
        }
        Format::Text => Ok(()),
    }
}
