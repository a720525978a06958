//! Runs from arrays: measured poses and inputs that are at hand in memory.

use super::model::Model;
use crate::error::{Error, Result};
use crate::files::{Defined, Deviations, Run};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Measured poses, row by row.
///
/// ```
/// let still = creepage::Pose { x: vec![0.0; 9], y: vec![0.0; 9], heading: None, trailer_headings: vec![] };
/// assert_eq!(still.x.len(), 9);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// Positions along x, m.
    pub x: Vec<f64>,
    /// Positions along y, m.
    pub y: Vec<f64>,
    /// Headings, rad, without jumps; none where no sensor measures one.
    pub heading: Option<Vec<f64>>,
    /// Absolute headings of each trailer, rad, without jumps; empty where they are not measured.
    pub trailer_headings: Vec<Vec<f64>>,
}

impl Run {
    /// A run from arrays: times (s), measured poses, and inputs by their roles, all with a value a row.
    ///
    /// ```
    /// use creepage::{Pose, Run};
    /// let time: Vec<f64> = (0..100).map(|i| 0.1 * f64::from(i)).collect();
    /// let pose = Pose { x: time.clone(), y: vec![0.0; 100], heading: Some(vec![0.0; 100]), ..Pose::default() };
    /// let run = Run::new(time, pose, [("wheel_rate", vec![10.0; 100]), ("yaw_rate", vec![0.0; 100])])?;
    /// assert_eq!(run.roles, ["wheel_rate", "yaw_rate"]);
    /// # Ok::<(), creepage::Error>(())
    /// ```
    ///
    /// # Errors
    /// When arrays differ in length, a value is not finite, times do not increase, or there are fewer than two rows.
    pub fn new<'a>(time: Vec<f64>, pose: Pose, inputs: impl IntoIterator<Item = (&'a str, Vec<f64>)>) -> Result<Self> {
        let (roles, inputs): (Vec<String>, Vec<Vec<f64>>) =
            inputs.into_iter().map(|(role, column)| (role.to_string(), column)).unzip();
        let poses = [("time", &time), ("x", &pose.x), ("y", &pose.y)].map(|(name, column)| (name.to_string(), column));
        let headings = pose.heading.iter().map(|h| ("heading".to_string(), h));
        let trailers = pose.trailer_headings.iter().enumerate();
        let trailers = trailers.map(|(i, h)| (format!("heading of trailer {}", i + 1), h));
        let all = poses.into_iter().chain(headings).chain(trailers).chain(roles.iter().cloned().zip(&inputs));
        for (name, column) in all {
            check(&name, column, time.len())?;
        }
        if time.len() < 2 || time.windows(2).any(|t| t[1] <= t[0]) {
            return Err(Error::input("the times of a run must increase, and two rows are needed at least")
                .help("sort the rows, and give each time once"));
        }
        Ok(Self {
            name: "run".into(),
            path: PathBuf::new(),
            sha256: String::new(),
            time,
            x: pose.x,
            y: pose.y,
            heading: pose.heading,
            trailer_headings: pose.trailer_headings,
            measured: vec![],
            differences: vec![None; roles.len()],
            roles,
            inputs,
            defined: Defined::default(),
            deviations: Deviations::default(),
            rows_dropped: 0,
            why_dropped: BTreeMap::new(),
            warnings: vec![],
            apart: None,
        })
    }

    /// The run with what was measured beside the pose, in the order of `[measured]` in the model file and in SI units.
    ///
    /// # Errors
    /// When a column has not one finite value a row.
    pub fn measuring(mut self, columns: Vec<Vec<f64>>) -> Result<Self> {
        for (i, column) in columns.iter().enumerate() {
            check(&format!("measured column {}", i + 1), column, self.time.len())?;
        }
        self.measured = columns;
        Ok(self)
    }

    /// Reads several logs by the columns of one model.
    ///
    /// ```
    /// use creepage::{Model, Run};
    /// let model = Model::read("examples/runs/cornering/model.toml")?;
    /// let runs = Run::read_all(["examples/runs/cornering/eights.csv"], &model)?;
    /// assert_eq!(runs.len(), 1);
    /// # Ok::<(), creepage::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Run::read`], for the first log that cannot be read.
    pub fn read_all<P: AsRef<Path>>(paths: impl IntoIterator<Item = P>, model: &Model) -> Result<Vec<Self>> {
        paths.into_iter().map(|path| Self::read(path, model)).collect()
    }
}

fn check(name: &str, column: &[f64], rows: usize) -> Result<()> {
    if column.len() != rows {
        let message = format!("{name} has {} values where there are {rows} times", column.len());
        return Err(Error::input(message).help("give one value a row"));
    }
    match column.iter().position(|v| !v.is_finite()) {
        Some(row) => Err(Error::input(format!("{name} is {} in row {row}", column[row])).help("leave that row out")),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_that_are_no_run_are_refused() {
        let pose = |x: Vec<f64>| Pose { y: vec![0.0; x.len()], x, ..Pose::default() };
        let told = |time: &[f64], x: &[f64], rate: &[f64]| {
            Run::new(time.to_vec(), pose(x.to_vec()), [("wheel_rate", rate.to_vec())]).map_err(|e| e.to_string())
        };
        assert!(told(&[0.0, 1.0], &[0.0, 1.0], &[1.0, 1.0]).is_ok());
        let refused = |time: &[f64], x: &[f64], rate: &[f64], why: &str| {
            let message = told(time, x, rate).unwrap_err();
            assert!(message.contains(why), "{message}");
        };
        refused(&[0.0, 1.0], &[0.0, 1.0], &[1.0], "wheel_rate has 1 values where there are 2 times");
        refused(&[0.0, 1.0], &[0.0, f64::NAN], &[1.0, 1.0], "x is NaN in row 1");
        refused(&[0.0, 0.0], &[0.0, 1.0], &[1.0, 1.0], "must increase");
        refused(&[0.0], &[0.0], &[1.0], "two rows");
    }
}
