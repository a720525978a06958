//! A run in two files, inputs and measured poses, each with a clock and a rate of its own.

use super::cells::{self, Cells};
use super::columns::Resolved;
use super::csv_table::Numbers;
use super::log_file::Log;
use super::reading;
use super::run::{self, Apart, Deviations, Run, arrange, difference, enough};
use super::time_stamp::Origin;
use super::trajectories;
use crate::error::{Error, Result};
use crate::files::model::model_file::ModelFile;
use crate::numerics::usual_step;
use std::collections::BTreeMap;
use std::path::Path;

/// How the clock of the poses reads against the clock of the inputs.
///
/// t = τ + offset + drift·(τ − at)
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | t | s | time by the clock of the poses |
/// | τ | s | time by the clock of the inputs |
/// | at | s | a time by the clock of the inputs, in the middle of the run |
///
/// ```
/// use creepage::files::Clock;
/// let clock = Clock { offset: 0.3, drift: 0.01, at: 50.0 };
/// assert!((clock.of(60.0) - 60.4).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    /// s
    pub offset: f64,
    /// Seconds a second.
    pub drift: f64,
    /// s
    pub at: f64,
}

/// Why a pose is left out of an aligned run.
const WITHOUT: &str = "pose at a time without inputs";

impl Clock {
    /// The time of the poses at a time of the inputs.
    pub fn of(&self, input: f64) -> f64 {
        input + self.offset + self.drift * (input - self.at)
    }
}

impl Run {
    /// The times of the inputs, which are those of the rows where both were logged together, s.
    pub fn input_time(&self) -> &[f64] {
        self.apart.as_ref().map_or(&self.time, |a| &a.time)
    }

    /// Reads inputs and poses from two files by the columns of a model file; their clocks are not aligned yet.
    ///
    /// # Errors
    /// As [`Run::read`], for either file.
    pub fn read_apart(inputs: impl AsRef<Path>, truth: impl AsRef<Path>, model: &ModelFile) -> Result<Self> {
        let (inputs, truth) = (inputs.as_ref(), truth.as_ref());
        Self::of_two((inputs, Log::open(inputs)?), (truth, || Log::open(truth)), model)
    }

    /// The same of texts that are at hand; where one has none it is read from the file of its name.
    ///
    /// # Errors
    /// As [`Run::read`], for either.
    pub fn parse_apart([inputs, truth]: [(&str, Option<&str>); 2], model: &ModelFile) -> Result<Self> {
        let open = |(name, text): (&str, Option<&str>)| {
            text.map_or_else(|| Log::open(Path::new(name)), |text| Log::of_text(Path::new(name), text))
        };
        Self::of_two((Path::new(inputs.0), open(inputs)?), (Path::new(truth.0), || open(truth)), model)
    }

    fn of_two(
        (inputs, sheet): (&Path, Log),
        (truth, poses_of): (&Path, impl FnOnce() -> Result<Log>),
        model: &ModelFile,
    ) -> Result<Self> {
        let (time, found) = model.columns.resolve_inputs(sheet.header()).map_err(|e| sheet.at_header(e))?;
        let cells: Vec<&Cells> = std::iter::once(&time).chain(found.iter().map(|i| &i.cells)).collect();
        let (driven, mut warnings) = read(sheet, &cells, &[], inputs)?;
        let (pose, measured, more) = poses((truth, poses_of()?), driven.origin, model)?;
        warnings.extend(more.into_iter().map(|w| format!("{}: {w}", truth.display())));
        let truth_sha256 = measured.sha256.clone();
        let dropped = joined(&driven.dropped, &measured.dropped);
        let run = Self::build(inputs, pose, measured, warnings).before_filter_of(&model.sensor);
        let mut columns = driven.columns.into_iter();
        let time = columns.next().unwrap_or_default();
        let apart = Apart { time, truth: truth.to_path_buf(), truth_sha256, one_clock: false };
        Ok(Self {
            sha256: driven.sha256,
            inputs: run::inputs(&apart.time, columns, &cells[1..]),
            differences: cells[1..].iter().map(|cells| difference(cells)).collect(),
            roles: found.iter().map(|i| i.role.clone()).collect(),
            rows_dropped: dropped.values().sum(),
            why_dropped: dropped,
            apart: Some(apart),
            ..run
        })
    }

    /// A run whose inputs and poses are topics of one bag; times begin with the second of the first input.
    pub(crate) fn read_bag(path: &Path, model: &ModelFile) -> Result<Self> {
        let mut run = Self::read_apart(path, path, model)?;
        let Some(apart) = &mut run.apart else { return Ok(run) };
        // Files of a folder keep their times.
        let start = apart.time.first().filter(|_| !path.is_dir()).map_or(0.0, |t| t.floor());
        apart.one_clock = true;
        apart.time.iter_mut().chain(&mut run.time).for_each(|t| *t -= start);
        let run = run.aligned(&Clock { offset: 0.0, drift: 0.0, at: 0.0 });
        match run.time.len() {
            0 | 1 => Err(Error::input("its poses have no inputs at their times").at_file(path).help(
                "check the stamps of both topics, or name the bag under --truth as well, and its clocks are aligned",
            )),
            _ => Ok(run),
        }
    }

    /// The run with its inputs by the clock of the poses; poses without inputs around them are left out.
    pub fn aligned(&self, clock: &Clock) -> Self {
        let Some(apart) = &self.apart else { return self.clone() };
        let time: Vec<f64> = apart.time.iter().map(|t| clock.of(*t)).collect();
        let kept = covered(&time, &self.time);
        let pick = |column: &Vec<f64>| kept.iter().map(|i| column[*i]).collect::<Vec<f64>>();
        let lost = self.time.len() - kept.len();
        let mut why_dropped = self.why_dropped.clone();
        if lost > 0 {
            *why_dropped.entry(WITHOUT.into()).or_default() += lost;
        }
        let apart = Some(Apart { time, ..apart.clone() });
        Self { rows_dropped: self.rows_dropped + lost, why_dropped, apart, ..self.with_poses(pick) }
    }

    /// The poses up to a share of the time from the first to the last.
    pub fn beginning(&self, share: f64) -> Self {
        let (Some(first), Some(last)) = (self.time.first(), self.time.last()) else { return self.clone() };
        self.until(first + share * (last - first))
    }

    /// The poses up to a time.
    pub fn until(&self, time: f64) -> Self {
        let end = self.time.partition_point(|t| *t <= time);
        self.with_poses(|column| column[..end].to_vec())
    }

    /// The run with some of its poses: what is taken of each of their columns, the times among them.
    pub(crate) fn with_poses(&self, take: impl Fn(&Vec<f64>) -> Vec<f64>) -> Self {
        Self {
            time: take(&self.time),
            x: take(&self.x),
            y: take(&self.y),
            heading: self.heading.as_ref().map(&take),
            trailer_headings: self.trailer_headings.iter().map(&take).collect(),
            measured: self.measured.iter().map(&take).collect(),
            deviations: Deviations {
                x: self.deviations.x.as_ref().map(&take),
                y: self.deviations.y.as_ref().map(&take),
                heading: self.deviations.heading.as_ref().map(&take),
            },
            ..self.clone()
        }
    }
}

/// The poses of a file: by the columns of the model file, or as those of a benchmark.
fn poses(
    (truth, mut sheet): (&Path, Log),
    origin: Origin,
    model: &ModelFile,
) -> Result<(Resolved, Numbers, Vec<String>)> {
    // Where the inputs' times are seconds as they stand, so are those of the poses.
    sheet.counted_from(Origin(origin.0.or(Some(0))));
    let pose = match model.columns.resolve_truth(sheet.header()) {
        Ok(pose) => pose,
        Err(_) if trajectories::is_kitti(sheet.header()) => {
            let (pose, mut measured) = trajectories::kitti(sheet, truth)?;
            let warnings = arrange(&mut measured);
            return Ok((pose, measured, warnings));
        }
        Err(error) => trajectories::recognised(sheet.header(), origin).ok_or_else(|| sheet.at_header(error))?,
    };
    let (measured, more) = read(sheet, &pose.needed(), &pose.spare(), truth)?;
    Ok((pose, measured, more))
}

fn read(sheet: Log, needed: &[&Cells], more: &[&Cells], path: &Path) -> Result<(Numbers, Vec<String>)> {
    let mut numbers = reading::read(sheet, needed, more)?;
    cells::mark_absent(&mut numbers, needed.len());
    let warnings = arrange(&mut numbers);
    enough(&numbers).map_err(|e| e.at_file(path))?;
    Ok((numbers, warnings))
}

fn joined(a: &BTreeMap<String, usize>, b: &BTreeMap<String, usize>) -> BTreeMap<String, usize> {
    let mut sum = a.clone();
    b.iter().for_each(|(why, n)| *sum.entry(why.clone()).or_default() += n);
    sum
}

/// The times around which inputs were logged: not before the first, not behind the last, not within a gap.
fn covered(inputs: &[f64], times: &[f64]) -> Vec<usize> {
    let gap = usual_step(inputs).map_or(0.0, |s| (5.0 * s).max(0.5));
    let inside = |t: f64| {
        let after = inputs.partition_point(|i| *i <= t);
        match after {
            0 => false,
            n if n == inputs.len() => inputs[n - 1] == t,
            n => inputs[n] - inputs[n - 1] <= gap,
        }
    };
    (0..times.len()).filter(|i| inside(times[*i])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_need_inputs_around_them() {
        let inputs: Vec<f64> = (0..10).chain(20..30).map(|i| 0.1 * f64::from(i)).collect();
        let times = [-0.01, 0.0, 0.55, 0.95, 1.5, 2.0, 2.9, 2.91];
        assert_eq!(covered(&inputs, &times), [1, 2, 5, 6]);
        assert!(covered(&[], &times).is_empty());
    }

    /// What is left out for its time is counted with what was left out before, by its reason and altogether.
    #[test]
    fn poses_without_inputs_are_counted() {
        let model = ModelFile::parse(
            "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1.0\n",
            "model.toml",
            &crate::model::known(crate::effects::all()),
        );
        let folder = tempfile::tempdir().unwrap();
        let [inputs, poses] = ["in.csv", "poses.csv"].map(|name| folder.path().join(name));
        let row = |i: i32, cells: &str| format!("{},{cells}\n", 0.1 * f64::from(i));
        let rows = |range: std::ops::Range<i32>, cells: &str| range.map(|i| row(i, cells)).collect::<String>();
        std::fs::write(&inputs, format!("time,wheel_rate,yaw_rate\n{}", rows(0..50, "1,0.5"))).unwrap();
        std::fs::write(&poses, format!("time,x,y,heading\n{}99,,0,0\n", rows(-5..50, "0,0,0"))).unwrap();
        let run = Run::read_apart(&inputs, &poses, &model.unwrap()).unwrap();
        let aligned = run.aligned(&Clock { offset: 0.0, drift: 0.0, at: 0.0 });
        assert_eq!((run.time.len(), run.rows_dropped), (55, 1));
        assert_eq!((aligned.time.len(), aligned.rows_dropped), (50, 6));
        assert_eq!(aligned.why_dropped.values().sum::<usize>(), 6);
        assert_eq!(aligned.why_dropped[WITHOUT], 5);
    }

    /// A gap is told by the usual step, whatever the shortest ones are.
    #[test]
    fn a_gap_is_five_usual_steps() {
        let slow: Vec<f64> = [0.0, 0.01, 0.02, 1.0, 2.0, 3.0, 7.0, 13.0].to_vec();
        assert_eq!(covered(&slow, &[0.5, 2.5, 5.0, 10.0]), [0, 1, 2]);
    }
}
