//! A clock that jumps within a run: from one time on the pose lags the inputs by another delay.

use crate::discrepancy::record::local_polynomial::median;
use crate::files::Run;
use nalgebra::{DMatrix, DVector, SMatrix, SVector, Vector2, Vector3};
use std::ops::Range;

/// Windows over which a delay is told, and how far one lies behind the other, s.
const WINDOW: f64 = 8.0;
const APART: f64 = 1.0;
/// Delays that are tried, s.
const LONGEST: f64 = 1.0;
const STEP: f64 = 0.025;
/// Shares of the turning that a window may leave at its best delay, and that it leaves at another.
const LEFT: f64 = 0.02;
const TELLS: f64 = 4.0;
/// A jump, s and in rows, and in spreads of the delays on either side.
const JUMP: f64 = 0.1;
const ROWS: f64 = 2.0;
const SPREADS: f64 = 5.0;
/// Windows on either side.
const FEWEST: usize = 5;

/// A jump of a clock.
#[derive(Clone, Debug, PartialEq)]
pub struct ClockJump {
    /// Name of the run.
    pub run: String,
    /// When, s.
    pub at: f64,
    /// How much later the pose is from then on, s.
    pub by: f64,
}

/// Headings as measured and as reckoned.
struct Turning<'a> {
    time: &'a [f64],
    measured: &'a [f64],
    reckoned: &'a [f64],
}

/// The jump of the clock of one sensor of a run, where its turns tell one.
pub fn clock_jump(run: &Run, [_, _, reckoned]: &[Vec<f64>; 3]) -> Option<ClockJump> {
    let turning = Turning { time: &run.time, measured: run.heading.as_ref()?, reckoned };
    let (first, last) = (run.time[0] + LONGEST, run.time[run.time.len() - 1] - LONGEST);
    let starts = (0..).map(|k| first + APART * f64::from(k)).take_while(|t| t + WINDOW <= last).take(2000);
    let delays: Vec<[f64; 2]> = starts.filter_map(|t| Some([t + 0.5 * WINDOW, turning.delay(t)?])).collect();
    let row = (last - first) / run.time.len() as f64;
    step(&delays, row).map(|[at, by]| ClockJump { run: run.name.clone(), at, by })
}

impl Turning<'_> {
    /// The delay of the measured turns behind the reckoned ones within a window, where it tells one.
    fn delay(&self, from: f64) -> Option<f64> {
        let rows = self.time.partition_point(|t| *t < from)..self.time.partition_point(|t| *t <= from + WINDOW);
        if rows.len() < 20 {
            return None;
        }
        // Where nothing turns no delay leaves less than another.
        let without = self.level(rows.clone()).filter(|left| *left > 1e-3 * rows.len() as f64)?;
        let tried = (LONGEST / STEP).round() as i32;
        let misfit =
            |k: i32| self.misfit(rows.clone(), STEP * f64::from(k)).map_or(f64::INFINITY, |with| with / without);
        let each: Vec<f64> = (-tried..=tried).map(|k| misfit(k).max(0.0)).collect();
        let best = (0..each.len()).min_by(|a, b| each[*a].total_cmp(&each[*b]))?;
        let far = (JUMP / STEP) as usize;
        let (before, after) = (*each.get(best.checked_sub(far)?)?, *each.get(best + far)?);
        let tells = each[best] < LEFT && before.min(after) > TELLS * each[best].max(1e-9);
        tells.then(|| STEP * (best as f64 - f64::from(tried)))
    }

    /// The measured turning about its mean and trend, a sum of squares.
    fn level(&self, rows: Range<usize>) -> Option<f64> {
        self.left::<2>(rows, |_, since| Vector2::new(1.0, since))
    }

    /// What the reckoned turning at a delay leaves of it.
    fn misfit(&self, rows: Range<usize>, delay: f64) -> Option<f64> {
        let last = self.time.len() - 1;
        let at_middle = self.reckoned[rows.start + rows.len() / 2];
        let mut next = self.time.partition_point(|t| *t < self.time[rows.start] - delay).clamp(1, last);
        self.left::<3>(rows, |i, since| {
            let t = self.time[i] - delay;
            while next < last && self.time[next] < t {
                next += 1;
            }
            let share = (t - self.time[next - 1]) / (self.time[next] - self.time[next - 1]);
            let reckoned = self.reckoned[next - 1] + share * (self.reckoned[next] - self.reckoned[next - 1]);
            Vector3::new(1.0, since, reckoned - at_middle)
        })
    }

    /// The sum of squares that regressors leave of the measured headings; they are asked row by row, with the time since the
    /// middle.
    fn left<const N: usize>(
        &self,
        rows: Range<usize>,
        mut regressors: impl FnMut(usize, f64) -> SVector<f64, N>,
    ) -> Option<f64> {
        let (mut normal, mut right, mut all) = (SMatrix::<f64, N, N>::zeros(), SVector::<f64, N>::zeros(), 0.0);
        let middle = rows.start + rows.len() / 2;
        for i in rows {
            let row = regressors(i, self.time[i] - self.time[middle]);
            let y = self.measured[i] - self.measured[middle];
            normal += row * row.transpose();
            right += y * row;
            all += y * y;
        }
        let normal = DMatrix::from_column_slice(N, N, normal.as_slice());
        let right = DVector::from_column_slice(right.as_slice());
        normal.cholesky().map(|c| all - right.dot(&c.solve(&right)))
    }
}

/// The place and size of the one step in delays that are alike on either side of it.
fn step(delays: &[[f64; 2]], row: f64) -> Option<[f64; 2]> {
    let usual = |part: &[[f64; 2]]| median(&mut part.iter().map(|d| d[1]).collect::<Vec<_>>());
    let spread = |part: &[[f64; 2]], middle: f64| part.iter().map(|d| (d[1] - middle).abs()).sum::<f64>();
    let split = |k: usize| {
        let (a, b) = delays.split_at(k);
        let (before, after) = (usual(a)?, usual(b)?);
        Some((spread(a, before) + spread(b, after), before, after))
    };
    let candidates = (FEWEST..delays.len().saturating_sub(FEWEST)).filter_map(|k| Some((k, split(k)?)));
    let (k, (left, before, after)) = candidates.min_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
    let by = after - before;
    let is_step = by.abs() > JUMP.max(ROWS * row) && by.abs() > SPREADS * left / delays.len() as f64;
    is_step.then(|| [0.5 * (delays[k - 1][0] + delays[k][0]), by])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_step_is_told_and_a_drift_is_none() {
        let delays = |of: &dyn Fn(f64) -> f64| (0..50).map(|k| [f64::from(k), of(f64::from(k))]).collect::<Vec<_>>();
        let found = step(&delays(&|t| if t < 20.0 { 0.0 } else { 0.25 }), 0.05).unwrap();
        assert!((found[0] - 19.5).abs() < 1.0 && (found[1] - 0.25).abs() < 1e-9, "{found:?}");
        assert_eq!(step(&delays(&|t| 0.005 * t), 0.05), None);
        assert_eq!(step(&delays(&|t| 0.02 * (t % 2.0)), 0.05), None);
    }
}
