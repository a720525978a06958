//! What is to be planned, as arguments of commands.

use clap::{Args, ValueEnum};
use creepage::files::{InputTiming, ModelFile, read_beginning};
use creepage::model::Model;
use creepage::planning::{Limit, Path as PathToFollow, Said, Task, Weights, with_said};
use creepage::{Error, Result};
use std::path::{Path, PathBuf};

/// Goal, limits and cost.
#[derive(Args)]
pub struct TaskArguments {
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
    /// Polynomial pieces of each input
    #[arg(long, value_name = "N", default_value_t = 24, value_parser = clap::value_parser!(u16).range(4..=400))]
    pieces: u16,
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
            Self::Balanced => return Weights::default(),
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

impl TaskArguments {
    /// The task of a model.
    pub fn task(&self, file: &ModelFile, model: &Model) -> Result<Task> {
        let trailers = model.trailer_count();
        let start = match (&self.start, &file.initial) {
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
        let points = self.path.as_deref().map(path).transpose()?.unwrap_or_default();
        let said: Vec<Said> = self.limit.iter().chain(&self.rate).cloned().collect();
        let end = points.last().map(|p| (p[0], p[1], None));
        Ok(Task {
            start,
            poses: self.via.iter().copied().chain(self.goal.or(end)).collect(),
            path: PathToFollow::through(&points),
            of_trailer: self.of_trailer,
            limits: with_said(Limit::usual(model), &said)?,
            duration: self.duration,
            weights: self.cost.weights(),
            spans: usize::from(self.pieces),
            degree: if file.input_timing == InputTiming::IntervalMean { 2 } else { 3 },
        })
    }
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
