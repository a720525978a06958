//! Logged inputs as smooth functions of time: a cubic spline through samples, or through the integral of means.

use super::cubic_spline::curvatures;
use crate::files::{InputTiming, Inputs, Run};
use crate::numerics::usual_step;
use std::sync::Arc;

/// What a row of the log says about its inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Timing {
    /// The value at the row's time.
    Sample,
    /// The mean since the row before, as encoder counts give it.
    IntervalMean,
}

impl From<InputTiming> for Timing {
    fn from(timing: InputTiming) -> Self {
        match timing {
            InputTiming::Sample => Timing::Sample,
            InputTiming::IntervalMean => Timing::IntervalMean,
        }
    }
}

/// Inputs between the rows of a log: a cubic spline through samples, or the derivative of the cubic spline
/// through the running integral of interval means, which keeps every mean exactly.
///
/// Before the first and after the last row the inputs keep their end values. Across a hole, a step longer than five usual ones
/// and than half a second, samples lie on a straight line and a mean is constant: a cubic would carry the slopes at its edges far
/// beyond both.
///
/// ```
/// use creepage::motion::{Signals, Timing};
/// let t = [0.0, 0.1, 0.2, 0.3, 0.4];
/// let u: Vec<f64> = t.iter().map(|t: &f64| t.powi(3)).collect();
/// let s = Signals::new(&t, &[u], Timing::Sample);
/// let (mut value, mut slope) = ([0.0], [0.0]);
/// s.at(0.25, &mut value, &mut slope);
/// assert!((value[0] - 0.015625).abs() < 1e-12 && (slope[0] - 0.1875).abs() < 1e-12);
/// ```
#[derive(Clone, Debug)]
pub struct Signals {
    knots: Arc<[f64]>,
    /// One per channel.
    timings: Arc<[Timing]>,
    channels: usize,
    /// Polynomial coefficients, interval by interval, channel by channel; copies share them.
    pieces: Arc<[[f64; 4]]>,
}

impl Signals {
    /// The signals of a log: strictly increasing times, one column a channel.
    pub fn new(time: &[f64], columns: &[Vec<f64>], timing: Timing) -> Self {
        Self::mixed(time, columns, &vec![timing; columns.len()])
    }

    /// The signals of a run: what was read as differences is the mean since the row before, whatever else is.
    pub fn of_run(run: &Run, timing: InputTiming) -> Self {
        Self::mixed(run.input_time(), &run.inputs, &timings(&run.differences, timing))
    }

    /// The signals of inputs to simulate, as [`Signals::of_run`].
    pub fn of_inputs(inputs: &Inputs, timing: InputTiming) -> Self {
        Self::mixed(&inputs.time, &inputs.columns, &timings(&inputs.differences, timing))
    }

    /// The signals of a log whose rows say one thing of one channel and another of the next.
    pub fn mixed(time: &[f64], columns: &[Vec<f64>], timings: &[Timing]) -> Self {
        let intervals = time.len().saturating_sub(1);
        let mut pieces = vec![[0.0; 4]; intervals * columns.len()];
        let holes = holes(time);
        for (c, column) in columns.iter().enumerate() {
            let of_channel = match timings[c] {
                Timing::Sample => between_holes(time, column, &holes),
                Timing::IntervalMean => {
                    between_holes(time, &running_integral(time, column), &holes).iter().map(slope).collect()
                }
            };
            of_channel.into_iter().enumerate().for_each(|(i, p)| pieces[i * columns.len() + c] = p);
        }
        Self { knots: time.into(), timings: timings.into(), channels: columns.len(), pieces: pieces.into() }
    }

    /// The signals of the same log with every second row left out, where rows follow each other evenly; `None` where fewer
    /// than four are left.
    ///
    /// ```
    /// use creepage::motion::{Signals, Timing};
    /// let t: Vec<f64> = (0..9).map(f64::from).collect();
    /// let u = |t: f64| t * t - 3.0 * t;
    /// let s = Signals::new(&t, &[t.iter().map(|t| u(*t)).collect()], Timing::Sample).thinned().unwrap();
    /// assert_eq!(s.knots(), [0.0, 2.0, 4.0, 6.0, 8.0]);
    /// let (mut value, mut slope) = ([0.0], [0.0]);
    /// s.at(5.0, &mut value, &mut slope);
    /// assert!((value[0] - u(5.0)).abs() < 1e-12);
    /// ```
    pub fn thinned(&self) -> Option<Self> {
        let kept = every_second(&self.knots);
        if kept.len() < 4 {
            return None;
        }
        let time: Vec<f64> = kept.iter().map(|i| self.knots[*i]).collect();
        let column = |c: usize| -> Vec<f64> {
            let piece = |i: usize| self.pieces[i * self.channels + c];
            match self.timings[c] {
                Timing::Sample => kept.iter().map(|i| self.value_at_knot(*i, c)).collect(),
                Timing::IntervalMean => {
                    let way = |i: usize| integral(&piece(i), self.knots[i + 1] - self.knots[i]);
                    let mean = |w: &[usize]| (w[0]..w[1]).map(way).sum::<f64>() / (self.knots[w[1]] - self.knots[w[0]]);
                    std::iter::once(0.0).chain(kept.windows(2).map(mean)).collect()
                }
            }
        };
        let columns: Vec<Vec<f64>> = (0..self.channels).map(column).collect();
        Some(Self::mixed(&time, &columns, &self.timings))
    }

    /// The sum of two signals of the same rows.
    ///
    /// ```
    /// use creepage::motion::{Signals, Timing};
    /// let of = |u: [f64; 3]| Signals::new(&[0.0, 1.0, 2.0], &[u.to_vec()], Timing::Sample);
    /// let (mut value, mut slope) = ([0.0], [0.0]);
    /// of([1.0, 2.0, 4.0]).plus(&of([0.5, 0.0, -1.0])).at(2.0, &mut value, &mut slope);
    /// assert!((value[0] - 3.0).abs() < 1e-12);
    /// ```
    pub fn plus(&self, other: &Self) -> Self {
        let sum = |(a, b): (&[f64; 4], &[f64; 4])| std::array::from_fn(|k| a[k] + b[k]);
        Self { pieces: self.pieces.iter().zip(&*other.pieces).map(sum).collect(), ..self.clone() }
    }

    fn value_at_knot(&self, i: usize, channel: usize) -> f64 {
        let last = self.knots.len() - 2;
        let [a, b, d, e] = self.pieces[i.min(last) * self.channels + channel];
        let s = if i > last { self.knots[i] - self.knots[last] } else { 0.0 };
        a + s * (b + s * (d + s * e))
    }

    /// The signals as a clock would give them that runs faster by a rate, about the middle of the log.
    ///
    /// ```
    /// use creepage::motion::{Signals, Timing};
    /// let s = Signals::new(&[0.0, 1.0, 2.0], &[vec![0.0, 1.0, 2.0]], Timing::Sample).stretched(0.5);
    /// assert_eq!(s.knots(), [-0.5, 1.0, 2.5]);
    /// let (mut value, mut slope) = ([0.0], [0.0]);
    /// s.at(1.75, &mut value, &mut slope);
    /// assert!((value[0] - 1.5).abs() < 1e-12);
    /// ```
    pub fn stretched(&self, rate: f64) -> Self {
        let (Some(first), Some(last)) = (self.knots.first(), self.knots.last()) else { return self.clone() };
        let (middle, by) = (0.5 * (first + last), 1.0 + rate);
        let piece = |[a, b, d, e]: &[f64; 4]| [*a, b / by, d / by.powi(2), e / by.powi(3)];
        Self {
            knots: self.knots.iter().map(|t| middle + (t - middle) * by).collect(),
            timings: self.timings.clone(),
            channels: self.channels,
            pieces: self.pieces.iter().map(piece).collect(),
        }
    }

    /// How many channels there are.
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// The times of the rows.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Values and slopes of all channels at a time.
    pub fn at(&self, t: f64, value: &mut [f64], slope: &mut [f64]) {
        self.in_interval(self.interval(t), t, value, slope);
    }

    /// The times of the first and the last row.
    #[inline(always)]
    pub(crate) fn ends(&self) -> (f64, f64) {
        (self.knots[0], self.knots[self.knots.len() - 1])
    }

    /// The interval that holds a time, if it is not the one guessed.
    pub(crate) fn interval_from(&self, guess: usize, t: f64) -> usize {
        let inside = guess + 1 < self.knots.len() && self.knots[guess] <= t && t < self.knots[guess + 1];
        if inside { guess } else { self.interval(t) }
    }

    /// From where to where an interval is the one that counts.
    pub(crate) fn reach(&self, i: usize) -> [f64; 2] {
        let from = if i == 0 { f64::NEG_INFINITY } else { self.knots[i] };
        [from, if i + 2 >= self.knots.len() { f64::INFINITY } else { self.knots[i + 1] }]
    }

    /// The coefficients of all channels in an interval.
    pub(crate) fn pieces(&self, i: usize) -> &[[f64; 4]] {
        self.pieces.get(i * self.channels..(i + 1) * self.channels).unwrap_or(&[])
    }

    /// The interval that holds a time; beyond the ends the outermost.
    fn interval(&self, t: f64) -> usize {
        let after = self.knots.partition_point(|k| *k <= t);
        after.clamp(1, self.knots.len().max(2) - 1) - 1
    }

    /// As [`Signals::at`] for a time in a known interval, or beyond the ends of the log.
    fn in_interval(&self, i: usize, t: f64, value: &mut [f64], slope: &mut [f64]) {
        let (first, last) = (self.knots[0], self.knots[self.knots.len() - 1]);
        let inside = (first..=last).contains(&t);
        let s = t.clamp(first, last) - self.knots[i];
        for c in 0..self.channels {
            let [a, b, d, e] = self.pieces[i * self.channels + c];
            value[c] = a + s * (b + s * (d + s * e));
            slope[c] = if inside { b + s * (2.0 * d + 3.0 * s * e) } else { 0.0 };
        }
    }
}

/// What a row says about each input.
pub(crate) fn timings(differences: &[Option<f64>], timing: InputTiming) -> Vec<Timing> {
    let one = |difference: &Option<f64>| if difference.is_some() { Timing::IntervalMean } else { timing.into() };
    differences.iter().map(one).collect()
}

/// Steps of a hole, so many usual ones, and the shortest, s.
const HOLE: (f64, f64) = (5.0, 0.5);

/// Intervals of a log across which nothing was logged.
fn holes(time: &[f64]) -> Vec<usize> {
    let Some(usual) = usual_step(time) else { return vec![] };
    let least = (HOLE.0 * usual).max(HOLE.1);
    (0..time.len() - 1).filter(|i| time[i + 1] - time[*i] > least).collect()
}

/// Splines of their own between holes, and straight lines across them.
fn between_holes(t: &[f64], y: &[f64], holes: &[usize]) -> Vec<[f64; 4]> {
    let mut found = Vec::with_capacity(t.len().saturating_sub(1));
    let mut start = 0;
    for i in holes {
        found.extend(cubics(&t[start..=*i], &y[start..=*i]));
        found.push([y[*i], (y[i + 1] - y[*i]) / (t[i + 1] - t[*i]), 0.0, 0.0]);
        start = i + 1;
    }
    found.extend(cubics(&t[start..], &y[start..]));
    found
}

/// Coefficients of the spline in powers of (t − tᵢ), interval by interval.
fn cubics(t: &[f64], y: &[f64]) -> Vec<[f64; 4]> {
    let m = curvatures(t, y);
    let piece = |i: usize| {
        let h = t[i + 1] - t[i];
        let slope = (y[i + 1] - y[i]) / h - h * (2.0 * m[i] + m[i + 1]) / 6.0;
        [y[i], slope, m[i] / 2.0, (m[i + 1] - m[i]) / (6.0 * h)]
    };
    (0..t.len().saturating_sub(1)).map(piece).collect()
}

/// The integral of a piece over an interval of this length.
fn integral([a, b, d, e]: &[f64; 4], h: f64) -> f64 {
    h * (a + h * (b / 2.0 + h * (d / 3.0 + h * e / 4.0)))
}

/// Rows without every second one; beside an interruption all stay.
fn every_second(time: &[f64]) -> Vec<usize> {
    let Some(usual) = usual_step(time) else { return (0..time.len()).collect() };
    let mut kept = vec![0];
    for i in 1..time.len() {
        let before = kept[kept.len() - 1];
        let spare = before + 1 == i && time.get(i + 1).is_some_and(|next| next - time[before] < 3.0 * usual);
        if !spare {
            kept.push(i);
        }
    }
    kept
}

fn slope([_, b, d, e]: &[f64; 4]) -> [f64; 4] {
    [*b, 2.0 * d, 3.0 * e, 0.0]
}

/// The integral from the first row to each row.
pub(crate) fn running_integral(t: &[f64], mean: &[f64]) -> Vec<f64> {
    let mut total = 0.0;
    let steps = t.windows(2).zip(&mean[1..]);
    let sums = steps.map(|(w, m)| {
        total += m * (w[1] - w[0]);
        total
    });
    std::iter::once(0.0).chain(sums).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(s: &Signals, t: f64) -> f64 {
        let (mut v, mut d) = ([0.0], [0.0]);
        s.at(t, &mut v, &mut d);
        v[0]
    }

    /// Halving the step divides the error by 16 for samples and by 8 for means.
    #[test]
    fn interpolation_has_its_order() {
        for (timing, order) in [(Timing::Sample, 4.0), (Timing::IntervalMean, 3.0)] {
            let error = |n: usize| {
                let t: Vec<f64> = (0..=n).map(|i| i as f64 / n as f64).collect();
                let column = match timing {
                    Timing::Sample => t.iter().map(|t| (3.0 * t).sin()).collect(),
                    Timing::IntervalMean => {
                        let h = 1.0 / n as f64;
                        t.iter().map(|t| ((3.0 * (t - h)).cos() - (3.0 * t).cos()) / (3.0 * h)).collect()
                    }
                };
                let s = Signals::new(&t, &[column], timing);
                (100..900).map(|i| (value(&s, i as f64 / 1e3) - (3.0 * i as f64 / 1e3).sin()).abs()).fold(0.0, f64::max)
            };
            let measured = (error(90) / error(180)).log2();
            assert!((measured - order).abs() < 0.3, "{timing:?}: order {measured}");
        }
    }

    #[test]
    fn interval_means_are_kept() {
        let t = [0.0, 0.2, 0.3, 0.7, 0.8];
        let mean = vec![9.0, 1.0, -2.0, 0.5, 3.0];
        let s = Signals::new(&t, std::slice::from_ref(&mean), Timing::IntervalMean);
        for i in 1..t.len() {
            let (a, b) = (t[i - 1], t[i]);
            let simpson = (value(&s, a) + 4.0 * value(&s, (a + b) / 2.0) + value(&s, b - 1e-15)) / 6.0;
            assert!((simpson - mean[i]).abs() < 1e-9, "{simpson} instead of {}", mean[i]);
        }
    }

    /// Means over pairs of intervals are kept; rows beside an interruption stay.
    #[test]
    fn every_second_row_is_left_out() {
        let t = [0.0, 1.0, 2.0, 3.0, 4.0, 10.0, 11.0, 12.0, 13.0];
        let mean = vec![9.0, 1.0, -2.0, 0.5, 3.0, 2.0, 1.0, 0.0, 5.0];
        let s = Signals::new(&t, std::slice::from_ref(&mean), Timing::IntervalMean).thinned().unwrap();
        assert_eq!(s.knots(), [0.0, 2.0, 4.0, 10.0, 12.0, 13.0]);
        for (w, expected) in s.knots().windows(2).zip([-0.5, 1.75, 2.0, 0.5, 5.0]) {
            let found = (value(&s, w[0]) + 4.0 * value(&s, (w[0] + w[1]) / 2.0) + value(&s, w[1] - 1e-12)) / 6.0;
            assert!((found - expected).abs() < 1e-6, "{found} instead of {expected}");
        }
        // What is an interruption hangs on the usual step alone.
        for scale in [1e-3, 1e3] {
            let scaled = t.map(|t| scale * t);
            let kept = Signals::new(&scaled, std::slice::from_ref(&mean), Timing::Sample).thinned().unwrap();
            assert_eq!(kept.knots(), [0.0, 2.0, 4.0, 10.0, 12.0, 13.0].map(|t| scale * t));
        }
        let samples = Signals::new(&t, &[mean], Timing::Sample).thinned().unwrap();
        assert_eq!([0.0, 4.0, 12.0, 13.0].map(|t| value(&samples, t)), [9.0, 3.0, 0.0, 5.0]);
        assert!(Signals::new(&t[..4], &[vec![0.0; 4]], Timing::Sample).thinned().is_none());
    }

    /// A channel of means beside one of samples: each is what it is alone.
    #[test]
    fn channels_may_say_different_things() {
        let t = [0.0, 0.2, 0.3, 0.7, 0.8];
        let columns = [vec![9.0, 1.0, -2.0, 0.5, 3.0], vec![1.0, 2.0, 4.0, 3.0, 0.0]];
        let both = [Timing::IntervalMean, Timing::Sample];
        let mixed = Signals::mixed(&t, &columns, &both);
        for (c, timing) in both.into_iter().enumerate() {
            let alone = Signals::new(&t, &columns[c..=c], timing);
            let (mut v, mut d) = ([0.0; 2], [0.0; 2]);
            mixed.at(0.45, &mut v, &mut d);
            assert_eq!(v[c], value(&alone, 0.45));
        }
        assert_eq!(timings(&[None, Some(0.0)], InputTiming::Sample), [Timing::Sample, Timing::IntervalMean]);
    }

    /// Slopes at the edges of a minute without rows lead nowhere; beside it each part is as if it were alone.
    #[test]
    fn a_hole_is_crossed_on_a_straight_line() {
        let time: Vec<f64> = (0..40).map(|i| 0.1 * f64::from(i) + if i < 20 { 0.0 } else { 60.0 }).collect();
        let column: Vec<f64> = time.iter().map(|t| (3.0 * t).sin()).collect();
        let alone =
            |rows: std::ops::Range<usize>| Signals::new(&time[rows.clone()], &[column[rows].to_vec()], Timing::Sample);
        let s = Signals::new(&time, std::slice::from_ref(&column), Timing::Sample);
        let middle = 0.5 * (time[19] + time[20]);
        assert!((value(&s, middle) - 0.5 * (column[19] + column[20])).abs() < 1e-12);
        assert_eq!([1.234, 1.85].map(|t| value(&s, t)), [1.234, 1.85].map(|t| value(&alone(0..20), t)));
        assert!([62.05, 63.3].into_iter().all(|t| (value(&s, t) - value(&alone(20..40), t)).abs() < 1e-12));
        let means = Signals::new(&time, std::slice::from_ref(&column), Timing::IntervalMean);
        assert!([2.0, middle, 61.0].into_iter().all(|t| (value(&means, t) - column[20]).abs() < 1e-9));
    }

    #[test]
    fn beyond_the_log_inputs_keep_their_end_values() {
        let s = Signals::new(&[0.0, 1.0, 2.0], &[vec![1.0, 2.0, 5.0]], Timing::Sample);
        assert_eq!((value(&s, -3.0), value(&s, 9.0)), (1.0, 5.0));
    }

    /// A faster clock changes the times and the slopes, not the values.
    #[test]
    fn a_stretched_signal_has_the_same_values() {
        let time = [1.0, 1.4, 2.0, 2.7, 3.0, 4.0];
        let columns = [time.map(|t: f64| (2.0 * t).sin()).to_vec(), time.map(|t: f64| t * t).to_vec()];
        for timing in [Timing::Sample, Timing::IntervalMean] {
            let s = Signals::new(&time, &columns, timing);
            for rate in [-0.3, 1e-3, 0.7] {
                let stretched = s.stretched(rate);
                let (mut v, mut d, mut w, mut e) = ([0.0; 2], [0.0; 2], [0.0; 2], [0.0; 2]);
                for t in [1.1, 1.9, 2.5, 2.8, 3.9] {
                    s.at(t, &mut v, &mut d);
                    stretched.at(2.5 + (t - 2.5) * (1.0 + rate), &mut w, &mut e);
                    for c in 0..2 {
                        assert!(
                            (v[c] - w[c]).abs() < 1e-13 && (d[c] - e[c] * (1.0 + rate)).abs() < 1e-12,
                            "{timing:?} {t}"
                        );
                    }
                }
            }
        }
    }

    /// A guess may be wrong, the interval never is; it counts from where it begins to where the next one does.
    #[test]
    fn intervals_are_found_from_any_guess() {
        let s = Signals::new(&[0.0, 1.0, 3.0, 4.0], &[vec![0.0; 4]], Timing::Sample);
        for t in [-1.0, 0.0, 0.5, 1.0, 2.9, 3.0, 3.5, 4.0, 5.0] {
            let wanted = s.interval(t);
            (0..4).for_each(|guess| assert_eq!(s.interval_from(guess, t), wanted, "{t} from {guess}"));
            let [from, to] = s.reach(wanted);
            assert!(from <= t && t < to, "{t}");
        }
        assert_eq!([0, 1, 2].map(|i| s.reach(i)), [[f64::NEG_INFINITY, 1.0], [1.0, 3.0], [3.0, f64::INFINITY]]);
    }

    #[test]
    fn the_integral_of_a_piece_is_exact() {
        assert_eq!(integral(&[1.0, 2.0, 3.0, 4.0], 2.0), 2.0 + 4.0 + 8.0 + 16.0);
        assert_eq!(integral(&[1.0, -2.0, 6.0, -8.0], 0.5), 0.5 - 0.25 + 0.25 - 0.125);
    }

    /// Four rows that are left are enough; channels are not mixed up; a step is long that is thrice the usual one.
    #[test]
    fn thinned_signals_have_every_channel() {
        assert_eq!(every_second(&[0.0, 1.0, 3.0, 4.0, 5.0, 6.0, 7.0]), [0, 1, 2, 4, 6]);
        assert_eq!(every_second(&[0.0, 0.1, 0.2, 0.3, 1.3, 2.3, 3.3, 4.3, 5.3, 6.3]), [0, 2, 4, 6, 8, 9]);
        let time: Vec<f64> = (0..7).map(f64::from).collect();
        let columns = [time.clone(), time.iter().map(|t| 10.0 - t * t).collect()];
        for (timing, wanted) in [(Timing::Sample, [4.0, -6.0]), (Timing::IntervalMean, [3.5, -2.5])] {
            let thin = Signals::new(&time, &columns, timing).thinned().unwrap();
            assert_eq!(thin.knots(), [0.0, 2.0, 4.0, 6.0]);
            let mean = |c: usize| match timing {
                Timing::Sample => thin.value_at_knot(2, c),
                Timing::IntervalMean => integral(&thin.pieces(1)[c], 2.0) / 2.0,
            };
            assert!((mean(0) - wanted[0]).abs() < 1e-12 && (mean(1) - wanted[1]).abs() < 1e-12, "{timing:?}");
        }
        assert!(Signals::new(&time[..6], &columns.map(|c| c[..6].to_vec()), Timing::Sample).thinned().is_some());
    }
}
