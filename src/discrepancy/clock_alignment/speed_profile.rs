//! The way and the turn of every second, from inputs and from poses: what both clocks have in common.

use crate::discrepancy::preprocessing::dead_reckoning::body_rates;
use crate::discrepancy::record::angle::wrapped;
use crate::error::Result;
use crate::files::Run;
use crate::model::Model;
use crate::motion::Timing;

/// Ways and turns are taken over this time, s.
pub(crate) const SPAN: f64 = 1.0;
/// A way shorter than this over [`SPAN`] has no direction, m.
const STILL: f64 = 0.05;

/// Running sums of way and turn by the model, at the times of the inputs.
pub(crate) struct Driven {
    pub time: Vec<f64>,
    way: Vec<f64>,
    turn: Vec<f64>,
}

impl Driven {
    /// By the model's rates at every row of inputs.
    pub fn of(model: &Model, run: &Run, timing: Timing) -> Result<Self> {
        let equations = model.equations(&[])?;
        let time = run.input_time().to_vec();
        let rates = body_rates(&equations, &run.inputs, time.len());
        let of = |k: usize| sums(&time, &rates.iter().map(|r| r[k]).collect::<Vec<f64>>(), timing);
        let (way, turn) = (of(0), of(2));
        Ok(Self { time, way, turn })
    }

    /// Way and turn in the second around a time; `None` beyond the ends.
    pub fn around(&self, t: f64) -> Option<[f64; 2]> {
        let ends = [t - 0.5 * SPAN, t + 0.5 * SPAN];
        let at = |sum: &[f64]| Some(between(&self.time, sum, ends[1])? - between(&self.time, sum, ends[0])?);
        Some([at(&self.way)?, at(&self.turn)?])
    }
}

/// The integral from the first row to each.
fn sums(time: &[f64], rate: &[f64], timing: Timing) -> Vec<f64> {
    let mut total = 0.0;
    let mut found = vec![0.0];
    for i in 1..time.len() {
        let mean = match timing {
            Timing::Sample => 0.5 * (rate[i - 1] + rate[i]),
            Timing::IntervalMean => rate[i],
        };
        total += mean * (time[i] - time[i - 1]);
        found.push(total);
    }
    found
}

/// A column between its rows; `None` beyond the ends.
fn between(time: &[f64], column: &[f64], t: f64) -> Option<f64> {
    let after = time.partition_point(|k| *k <= t);
    if time.len() < 2 || after == 0 || (after == time.len() && time[after - 1] < t) {
        return None;
    }
    let i = (after - 1).min(time.len() - 2);
    let share = (t - time[i]) / (time[i + 1] - time[i]);
    Some(column[i] + share * (column[i + 1] - column[i]))
}

/// Way and turn of the poses around times of an even grid.
pub(crate) struct Measured {
    first: f64,
    step: f64,
    values: Vec<Option<[f64; 2]>>,
}

impl Measured {
    /// From the poses of a run, at a grid of so many seconds.
    pub fn of(run: &Run, step: f64) -> Self {
        let (first, last) = (run.time[0], run.time[run.time.len() - 1]);
        let count = ((last - first) / step) as usize + 1;
        let values = (0..count).map(|i| pose_around(run, first + step * i as f64)).collect();
        Self { first, step, values }
    }

    /// Way and turn around the nearest time of the grid.
    pub fn around(&self, t: f64) -> Option<[f64; 2]> {
        let i = ((t - self.first) / self.step).round();
        if i < 0.0 { None } else { self.values.get(i as usize).copied().flatten() }
    }
}

fn pose_around(run: &Run, t: f64) -> Option<[f64; 2]> {
    let ends = [t - 0.5 * SPAN, t + 0.5 * SPAN];
    let i = run.time.partition_point(|k| *k <= ends[0]);
    let j = run.time.partition_point(|k| *k <= ends[1]);
    // A hole in the poses says nothing of the motion in it.
    if i == 0 || run.time[i - 1..(j + 1).min(run.time.len())].windows(2).any(|w| w[1] - w[0] > SPAN) {
        return None;
    }
    let at = |column: &[f64], t: f64| between(&run.time, column, t);
    let chord = |from: f64, to: f64| Some([at(&run.x, to)? - at(&run.x, from)?, at(&run.y, to)? - at(&run.y, from)?]);
    let [dx, dy] = chord(ends[0], ends[1])?;
    match &run.heading {
        Some(heading) => {
            let middle = at(heading, t)?;
            Some([dx * middle.cos() + dy * middle.sin(), at(heading, ends[1])? - at(heading, ends[0])?])
        }
        None => {
            // Without a heading the direction of travel turns.
            let (a, b) = (chord(ends[0], t)?, chord(t, ends[1])?);
            let long = |c: [f64; 2]| c[0].hypot(c[1]) > 0.5 * STILL;
            let turn = if long(a) && long(b) { 2.0 * wrapped(b[1].atan2(b[0]) - a[1].atan2(a[0])) } else { 0.0 };
            Some([dx.hypot(dy), turn])
        }
    }
}

#[cfg(test)]
impl Driven {
    /// Given the way and the turn a second at some times.
    pub fn sampled(time: &[f64], rates: &[[f64; 2]]) -> Self {
        let of = |c: usize| sums(time, &rates.iter().map(|r| r[c]).collect::<Vec<_>>(), Timing::Sample);
        Self { time: time.to_vec(), way: of(0), turn: of(1) }
    }
}

#[cfg(test)]
impl Measured {
    /// Given the way and the turn at a grid from zero.
    pub fn sampled(step: f64, values: &[[f64; 2]]) -> Self {
        Self { first: 0.0, step, values: values.iter().copied().map(Some).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::unicycle_file;

    /// A circle at a speed, turning at 0.6 rad/s, positions alone.
    fn circle(speed: f64) -> Run {
        let file = unicycle_file("");
        let (rate, mut text) = (0.6, String::from("time,x,y,wheel_rate,yaw_rate\n"));
        for t in (0..100).map(|i| 0.05 * f64::from(i)) {
            let (sin, cos) = (rate * t + 2.0_f64).sin_cos();
            text += &format!("{t},{},{},{speed},{rate}\n", speed / rate * sin, -speed / rate * cos);
        }
        Run::parse("run.csv", &text, &file).unwrap()
    }

    #[test]
    fn a_path_without_headings_turns_where_it_is_long_enough_to_have_a_direction() {
        for speed in [0.06, 0.3, 2.0] {
            let [way, turn] = pose_around(&circle(speed), 2.5).unwrap();
            assert!((way / speed - 1.0).abs() < 0.02 && (turn - 0.6).abs() < 0.02, "{way} {turn} at {speed}");
        }
        let [way, turn] = pose_around(&circle(0.04), 2.5).unwrap();
        assert!(way < STILL && turn == 0.0, "{way} {turn}");
    }

    /// Whether the hole in the poses is in the second, or right behind it.
    #[test]
    fn a_hole_in_the_poses_says_nothing_of_the_motion_in_it() {
        let mut run = circle(0.5);
        let keep: Vec<usize> = (0..run.time.len()).filter(|i| !(1.0..2.6).contains(&run.time[*i])).collect();
        for column in [&mut run.time, &mut run.x, &mut run.y] {
            *column = keep.iter().map(|i| column[*i]).collect();
        }
        let is_told = |t: f64| pose_around(&run, t).is_some();
        assert_eq!([0.5, 0.6, 1.2, 1.8, 2.3, 2.5, 3.2].map(is_told), [false, false, false, false, false, false, true]);
        let is_told = |t: f64| pose_around(&circle(0.5), t).is_some();
        assert_eq!([0.3, 0.5, 0.6, 4.4, 4.6].map(is_told), [false, true, true, true, false]);
    }
}
