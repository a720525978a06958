//! `creepage plan`

use super::output::{Format, pretty, print};
use super::progress::ProgressLine;
use super::runs::not_an_input;
use super::user_catalogues::UserCatalogues;
use clap::{Args, ValueEnum};
use creepage::files::{InputTiming, ModelFile, read_beginning, write_whole};
use creepage::model::Model;
use creepage::motion::Timing;
use creepage::planning::{
    Limit, Path as PathToFollow, Planned, Said, Task, Weights, infeasible, plan_table, plan_text, planned, with_said,
};
use creepage::{Error, Result};
use std::path::{Path, PathBuf};

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
    /// The pose to reach
    #[arg(long, value_name = "X,Y,HEADING", allow_hyphen_values = true, value_parser = whole_pose, required_unless_present = "path")]
    goal: Option<Pose>,
    /// A pose to pass on the way, with or without a heading (repeatable)
    #[arg(long, value_name = "X,Y[,HEADING]", allow_hyphen_values = true, value_parser = pose, requires = "goal")]
    via: Vec<Pose>,
    /// A path to follow: the columns x and y of a table, m
    #[arg(long, value_name = "FILE.csv")]
    path: Option<PathBuf>,
    /// Where it begins; the model file's [initial], or the origin, when left out
    #[arg(long, value_name = "X,Y,HEADING[,TRAILER…]", allow_hyphen_values = true, value_parser = start)]
    start: Option<Start>,
    /// Whose pose is to reach the goal: 0 the tractor's sensor, 1 the axle of the trailer nearest to it, …
    #[arg(long, value_name = "N", default_value_t = 0)]
    of_trailer: usize,
    /// Limits of an input (repeatable)
    #[arg(long, value_name = "ROLE=LEAST,MOST", value_parser = Said::range)]
    limit: Vec<Said>,
    /// The most change of an input in a second (repeatable)
    #[arg(long, value_name = "ROLE=MOST", value_parser = Said::rate)]
    rate: Vec<Said>,
    /// How long it takes, s; what serves the cost best when left out
    #[arg(long, value_name = "S", value_parser = positive)]
    duration: Option<f64>,
    /// What counts besides
    #[arg(long, value_enum, default_value_t = Cost::Balanced)]
    cost: Cost,
    /// The report, or the answer of `fit --format json`, whose covariance spreads the end
    #[arg(long, value_name = "REPORT.json")]
    covariance: Option<PathBuf>,
    /// Polynomial pieces of each input
    #[arg(long, value_name = "N", default_value_t = 24, value_parser = clap::value_parser!(u16).range(4..=400))]
    pieces: u16,
    /// Where the plan goes
    #[arg(long, value_name = "PLAN.csv", default_value = "plan.csv")]
    out: PathBuf,
    /// How to print what becomes of it
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    own: UserCatalogues,
}

/// x, y and perhaps a heading.
type Pose = (f64, f64, Option<f64>);

/// A measured pose with the headings of trailers.
#[derive(Clone, Debug)]
struct Start(Vec<f64>);

#[derive(Clone, Copy, ValueEnum)]
enum Cost {
    /// time and smooth inputs
    Balanced,
    /// the shortest time
    Time,
    /// smooth inputs
    Smooth,
    /// small inputs
    Effort,
}

impl Cost {
    fn weights(self) -> Weights {
        let [time, smoothness, effort] = match self {
            Self::Balanced => [1.0, 0.1, 0.1],
            Self::Time => [1.0, 1e-3, 1e-3],
            Self::Smooth => [0.5, 1.0, 0.1],
            Self::Effort => [0.5, 0.1, 1.0],
        };
        Weights { time, smoothness, effort }
    }
}

fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(',').map(|n| n.trim().parse().ok().filter(|v: &f64| v.is_finite() && v.abs() < 1e6)).collect()
}

fn pose(text: &str) -> std::result::Result<Pose, String> {
    match numbers(text).as_deref() {
        Some([x, y]) => Ok((*x, *y, None)),
        Some([x, y, heading]) => Ok((*x, *y, Some(*heading))),
        _ => Err("write X,Y or X,Y,HEADING in m and rad".into()),
    }
}

fn whole_pose(text: &str) -> std::result::Result<Pose, String> {
    pose(text).ok().filter(|p| p.2.is_some()).ok_or_else(|| "write X,Y,HEADING in m and rad".into())
}

fn start(text: &str) -> std::result::Result<Start, String> {
    numbers(text)
        .filter(|n| n.len() >= 3)
        .map(Start)
        .ok_or_else(|| "write X,Y,HEADING in m and rad, then the trailers' headings".into())
}

fn positive(text: &str) -> std::result::Result<f64, String> {
    text.parse::<f64>()
        .ok()
        .filter(|s| (1e-3..=1e5).contains(s))
        .ok_or_else(|| "a duration lies within 0.001 and 100000 s".into())
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
    let task = task(arguments, file, &model)?;
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

fn task(arguments: &Arguments, file: &ModelFile, model: &Model) -> Result<Task> {
    let trailers = model.trailer_count();
    let start = match (&arguments.start, &file.initial) {
        (Some(Start(given)), _) => given.clone(),
        (None, Some(i)) => [i.x, i.y, i.heading].into_iter().chain(i.trailer_headings.iter().copied()).collect(),
        (None, None) => vec![0.0; 3],
    };
    let behind = start[2];
    let mut start = start;
    if start.len() > 3 + trailers {
        let message = format!("the start has headings of {} trailers, the model has {trailers}", start.len() - 3);
        return Err(Error::input(message).help("give one heading for each trailer, or none"));
    }
    start.resize(3 + trailers, behind);
    let points = arguments.path.as_deref().map(path).transpose()?.unwrap_or_default();
    let said: Vec<Said> = arguments.limit.iter().chain(&arguments.rate).cloned().collect();
    let end = points.last().map(|p| (p[0], p[1], None));
    Ok(Task {
        start,
        poses: arguments.via.iter().copied().chain(arguments.goal.or(end)).collect(),
        path: PathToFollow::through(&points),
        of_trailer: arguments.of_trailer,
        limits: with_said(Limit::usual(model), &said)?,
        duration: arguments.duration,
        weights: arguments.cost.weights(),
        spans: usize::from(arguments.pieces),
        degree: if file.input_timing == InputTiming::IntervalMean { 2 } else { 3 },
    })
}

/// The points of a path.
fn path(path: &Path) -> Result<Vec<[f64; 2]>> {
    let (header, rows) = read_beginning(path, usize::MAX)?;
    let place = |name: &str| {
        let missing =
            || Error::input(format!("no column \"{name}\"")).at_file(path).help("a path has columns x and y, in m");
        header.iter().position(|h| h.trim() == name).ok_or_else(missing)
    };
    let (x, y) = (place("x")?, place("y")?);
    let number = |i: usize, row: &[String], k: usize| {
        let found = row.get(k).and_then(|c| c.trim().parse::<f64>().ok()).filter(|v| v.is_finite());
        found.ok_or_else(|| {
            Error::input(format!("row {} has no number in column \"{}\"", i + 1, header[k]))
                .at_file(path)
                .help("fill it in")
        })
    };
    let points = rows.iter().enumerate().map(|(i, row)| Ok([number(i, row, x)?, number(i, row, y)?]));
    let points: Vec<[f64; 2]> = points.collect::<Result<_>>()?;
    match points.len() {
        0 | 1 => Err(Error::input("a path has two points at least").at_file(path).help("add points")),
        _ => Ok(points),
    }
}
