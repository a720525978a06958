//! The gap: how far a model strays from the measurements after a horizon, and what noise alone would make of it.

use super::windows::MARGIN;
use crate::discrepancy::initial_state::heading_from_path::{MeasuredPose, PathHeading, heading_over, measured_at};
use crate::discrepancy::initial_state::hidden_states;
use crate::discrepancy::initial_state::pose::pose_of;
use crate::discrepancy::initial_state::speed_fit::{self, SpeedFit};
use crate::discrepancy::record::angle::wrapped;
use crate::discrepancy::record::local_polynomial;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::record::sensor_noise::Noise;
use crate::error::Result;
use crate::model::observation::{BODY_HEADING, HEADING, PLACE, POSITION};
use crate::model::{Equations, Model};
use crate::motion::{LaneStates, LaneStepper, Signals, StateSensitivity, Stepper};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use std::ops::Range;
use std::sync::OnceLock;

/// How many windows are followed side by side.
const LANES: usize = 8;

/// Sum of squared errors over windows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PredictionError {
    position: f64,
    heading: f64,
    windows: usize,
    headings: usize,
}

impl PredictionError {
    fn add(&mut self, position: [f64; 2], heading: Option<f64>) {
        self.position += position[0] * position[0] + position[1] * position[1];
        self.windows += 1;
        if let Some(h) = heading {
            let h = wrapped(h);
            self.heading += h * h;
            self.headings += 1;
        }
    }

    /// Errors of more windows.
    pub fn joined(mut self, other: PredictionError) -> PredictionError {
        self.position += other.position;
        self.heading += other.heading;
        self.windows += other.windows;
        self.headings += other.headings;
        self
    }

    /// The same with independent errors of another source beside them, window by window.
    pub fn beside(mut self, other: PredictionError) -> PredictionError {
        if other.windows > 0 {
            self.position += other.position * self.windows as f64 / other.windows as f64;
        }
        if other.headings > 0 {
            self.heading += other.heading * self.headings as f64 / other.headings as f64;
        }
        self
    }

    /// RMS position error, m.
    pub fn position_rms(&self) -> f64 {
        (self.position / self.windows as f64).sqrt()
    }

    /// RMS heading error, rad, when a heading was measured.
    pub fn heading_rms(&self) -> Option<f64> {
        (self.headings > 0).then(|| (self.heading / self.headings as f64).sqrt())
    }

    /// How many windows there were.
    pub fn windows(&self) -> usize {
        self.windows
    }
}

/// A model that predicts along a run, restarted from smoothed measurements; hidden states are carried from the
/// data before.
pub struct Rollout<'a> {
    record: &'a Record,
    equations: Equations,
    hidden: Vec<Vec<f64>>,
    /// Of a vehicle whose speeds forces change the state by the rows before a row, found when it is first asked for.
    speeds: Vec<OnceLock<Option<SpeedFit>>>,
}

impl<'a> Rollout<'a> {
    /// A model along a run.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn new(model: &Model, record: &'a Record) -> Result<Self> {
        let equations = model.equations(&[])?;
        let hidden = hidden_along(&equations, record);
        Ok(Self { hidden, speeds: not_asked(&equations, record), record, equations })
    }

    /// Whether predictions begin with a fit of the speeds there, of a vehicle whose speeds forces change.
    pub fn fits_speeds(&self) -> bool {
        self.equations.has_speeds()
    }

    /// The state by the rows before a row, of a vehicle whose speeds forces change.
    fn speeds(&self, row: usize) -> Option<&SpeedFit> {
        let fit = || speed_fit::speeds_at(&self.equations, self.record, row, speed_fit::BEFORE);
        self.speeds.get(row)?.get_or_init(fit).as_ref()
    }

    /// The state at the first of two rows, to be followed to the other: the smoothed pose and the carried hidden states.
    fn start(&self, i: usize, to: usize) -> Vec<f64> {
        if let Some(fit) = self.speeds(i) {
            return fit.state.clone();
        }
        let pose = MeasuredPose::over(&self.equations, self.record, i, self.record.time[to] - self.record.time[i]);
        let mut z = pose_of(&self.equations, &pose.measured);
        match self.hidden.get(i) {
            Some(hidden) => z.extend(hidden),
            None => z.extend(hidden_states::carried(&self.equations, &[], self.record, i, &z).z),
        }
        z
    }

    /// What was measured at a row, smoothed.
    pub fn measured(&self, i: usize) -> Vec<f64> {
        measured_at(&self.equations, self.record, i)
    }

    /// The outputs at rows `from..=to`, restarted at `from`.
    pub fn outputs(&self, from: usize, to: usize) -> Vec<Vec<f64>> {
        let mut stepper = Stepper::new(&self.equations, &self.record.signals, &[]);
        let mut arc = StateSensitivity { z: self.start(from, to), s: vec![] };
        let visible = self.equations.visible;
        let mut found = vec![stepper.outputs(&arc.z)[..visible].to_vec()];
        for i in from..to {
            stepper.advance(&mut arc, self.record.time[i], self.record.time[i + 1]);
            found.push(stepper.outputs(&arc.z)[..visible].to_vec());
        }
        found
    }

    /// What the sensor would measure along some windows, each restarted at its first row, at N rows from its first to its last.
    pub fn paths<const N: usize>(&self, windows: &[(usize, usize)]) -> Vec<[Vec<f64>; N]> {
        windows.chunks(LANES).flat_map(|some| self.side_by_side(some)).collect()
    }

    /// As [`Rollout::paths`], of so many windows as there are lanes, or fewer: the last one fills the rest.
    fn side_by_side<const N: usize>(&self, windows: &[(usize, usize)]) -> Vec<[Vec<f64>; N]> {
        let rows: [(usize, usize); LANES] = std::array::from_fn(|l| windows[l.min(windows.len() - 1)]);
        let starts = rows.map(|(from, to)| self.start(from, to));
        let mut arcs = LaneStates::of(starts.each_ref().map(|z| &z[..]));
        let mut stepper = LaneStepper::new(&self.equations, &self.record.signals, [&[]; LANES]);
        let visible = self.equations.visible;
        let mut found = vec![[const { Vec::new() }; N]; windows.len()];
        for k in 0..N {
            let at = |(from, to): (usize, usize), k: usize| from + (to - from) * k / (N - 1);
            if k > 0 {
                stepper.through(&mut arcs, &self.record.time, &rows.map(|r| at(r, k - 1)..at(r, k)));
            }
            let y = stepper.outputs_here(&arcs.z);
            found.iter_mut().enumerate().for_each(|(l, path)| path[k] = y[..visible].iter().map(|y| y[l]).collect());
        }
        found
    }

    /// The windows of a horizon that begin at some rows; none of a row from which it leads beyond the log.
    pub fn windows_from(&self, rows: &[usize], horizon: f64) -> Vec<Option<(usize, usize)>> {
        let time = &self.record.time;
        let segments = self.record.segments(MARGIN);
        let window = |&i: &usize| {
            let segment = segments.iter().find(|s| s.contains(&i))?;
            let end = i + time[i..segment.end].partition_point(|t| *t < time[i] + horizon - 0.5 * self.record.step());
            (end < segment.end).then_some((i, end))
        };
        rows.iter().map(window).collect()
    }

    /// The rows between which the run is followed, and their times.
    pub fn rows(&self) -> (Range<usize>, &[f64]) {
        (self.record.rows.clone(), &self.record.time)
    }

    /// The inputs of the run.
    pub fn signals(&self) -> &Signals {
        &self.record.signals
    }

    /// The name of the run.
    pub fn name(&self) -> &str {
        &self.record.name
    }

    /// The rows at which the non-overlapping windows of a horizon begin and end.
    pub fn windows(&self, horizon: f64) -> Vec<(usize, usize)> {
        let time = &self.record.time;
        let mut found = Vec::new();
        for segment in self.record.segments(MARGIN) {
            let mut start = segment.start;
            // Half a step early counts as on time.
            let slack = 0.5 * self.record.step();
            for i in segment {
                if time[i] - time[start] >= horizon - slack {
                    found.push((start, i));
                    start = i;
                }
            }
        }
        found
    }

    /// Errors after a horizon over non-overlapping windows.
    pub fn errors(&self, horizon: f64) -> PredictionError {
        let mut errors = PredictionError::default();
        let windows = self.windows(horizon);
        for ((_, to), [_, end]) in windows.iter().zip(self.paths(&windows)) {
            let measured = |c: usize| self.record.columns[c][*to];
            let heading = self.record.measures_heading().then(|| end[BODY_HEADING] - measured(BODY_HEADING));
            errors.add(PLACE.map(|c| end[c] - measured(c)), heading);
        }
        errors
    }

    /// What [`Rollout::errors`] would give at each horizon if this model were true, by drawing measurement noise.
    ///
    /// Noise enters twice: at the restart, whose smoothed pose it shifts and turns, and at the end. A model of
    /// a vehicle on a plane moves rigidly with its start, so no trajectory has to be integrated anew.
    ///
    /// `draws` says how often noise is drawn for each horizon.
    pub fn floors(&self, horizons: &[f64], draws: &[usize], noise: &Noise, seed: u64) -> Vec<PredictionError> {
        if self.equations.has_speeds() {
            return horizons.iter().map(|h| self.floor_of_speeds(*h, noise)).collect();
        }
        let each: Vec<Vec<Restart>> = horizons.iter().map(|h| self.restarts(*h)).collect();
        let mut errors = vec![PredictionError::default(); horizons.len()];
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        for draw in 0..draws.iter().copied().max().unwrap_or(0) {
            let noisy = noise.added_to(self.record, &mut rng);
            for ((restarts, errors), _) in each.iter().zip(&mut errors).zip(draws).filter(|(_, n)| draw < **n) {
                restarts.iter().for_each(|r| r.add_error(self.record, &noisy, errors));
            }
        }
        errors
    }

    /// As [`Rollout::floors`] of a vehicle whose speeds forces change, in closed form: what is predicted hangs on the rows
    /// before it by S·(JᵀJ)⁻¹·Sᵀ, and what it is compared with has noise of its own.
    fn floor_of_speeds(&self, horizon: f64, noise: &Noise) -> PredictionError {
        let mut floor = PredictionError::default();
        // The covariances are those of the noise that the rows show by themselves.
        let scale = noise.variance[POSITION] / self.record.position_noise().powi(2) * noise.correlation_time;
        let time = &self.record.time;
        let mut stepper = Stepper::new(&self.equations, &self.record.signals, &[]);
        for (from, to) in self.windows(horizon) {
            let Some(fit) = self.speeds(from) else { continue };
            let (first, begin) = &fit.first;
            let mut arc = begin.clone();
            (*first..to).for_each(|i| stepper.advance(&mut arc, time[i], time[i + 1]));
            let spread = speed_fit::spread(&mut stepper, &arc, &fit.covariance_at_first);
            let deviation = |i: usize, own: f64| (scale * spread[(i, i)] + own).sqrt();
            let heading = self.record.measures_heading().then(|| deviation(BODY_HEADING, noise.variance[HEADING]));
            floor.add(PLACE.map(|i| deviation(i, noise.variance[POSITION])), heading);
        }
        floor
    }

    /// By how much predictions move when the inputs are as noisy again.
    pub fn moved_by_inputs(&self, horizon: f64, seed: u64, draw: u64) -> PredictionError {
        let mut moved = PredictionError::default();
        if !self.record.input_noise.is_there() {
            return moved;
        }
        let noisier = self.record.with_noisier_inputs(seed, draw);
        let (equations, hidden) = (self.equations.clone(), self.hidden.clone());
        let beside = Rollout { speeds: not_asked(&equations, &noisier), record: &noisier, equations, hidden };
        let windows = self.windows(horizon);
        for ([_, here], [_, there]) in self.paths(&windows).iter().zip(beside.paths(&windows)) {
            let heading = self.record.measures_heading().then(|| there[BODY_HEADING] - here[BODY_HEADING]);
            moved.add(PLACE.map(|c| there[c] - here[c]), heading);
        }
        moved
    }

    /// The windows of a horizon with what noise acts on.
    fn restarts(&self, horizon: f64) -> Vec<Restart> {
        let windows = self.windows(horizon);
        let restart = |(&(from, to), [first, last]): (&(usize, usize), [Vec<f64>; 2])| {
            let smoothing = self.record.smoothing(from);
            Restart {
                to,
                clean: self.record.columns.iter().map(|c| local_polynomial::value(c, &smoothing)).collect(),
                smoothing,
                displacement: [last[0] - first[0], last[1] - first[1]],
                course: (!self.record.has_heading()).then(|| heading_over(&self.equations, self.record, from, horizon)),
            }
        };
        windows.iter().zip(self.paths(&windows)).map(restart).collect()
    }
}

/// A window as noise sees it.
struct Restart {
    to: usize,
    /// The measurements smoothed around its start, and the weights of the smoothing.
    clean: Vec<f64>,
    smoothing: Vec<(usize, f64)>,
    /// How far the model moves in it.
    displacement: [f64; 2],
    /// A heading that is taken from the path inherits the noise of its positions.
    course: Option<PathHeading>,
}

impl Restart {
    fn add_error(&self, record: &Record, noisy: &[Vec<f64>], errors: &mut PredictionError) {
        let shift = |c: usize| local_polynomial::value(&noisy[c], &self.smoothing) - self.clean[c];
        let moved = |i: usize| PLACE.map(|c| noisy[c][i] - record.columns[c][i]);
        let turn = wrapped(self.course.as_ref().map_or_else(|| shift(BODY_HEADING), |c| c.error(moved)));
        let (sin, cos) = turn.sin_cos();
        let d = self.displacement;
        let turned = [(cos - 1.0) * d[0] - sin * d[1], sin * d[0] + (cos - 1.0) * d[1]];
        let end = |c: usize| noisy[c][self.to] - record.columns[c][self.to];
        let error = PLACE.map(|c| shift(c) + turned[c] - end(c));
        errors.add(error, record.measures_heading().then(|| turn - end(BODY_HEADING)));
    }
}

/// As many states as there are rows, of a vehicle whose speeds forces change; of another none.
fn not_asked(equations: &Equations, record: &Record) -> Vec<OnceLock<Option<SpeedFit>>> {
    let rows = if equations.has_speeds() { record.time.len() } else { 0 };
    (0..rows).map(|_| OnceLock::new()).collect()
}

/// Hidden states at every row of a log, from how they begin by its first rows; empty when there are none, and where they
/// follow speeds that are fitted.
fn hidden_along(equations: &Equations, record: &Record) -> Vec<Vec<f64>> {
    if equations.n() == equations.visible || equations.has_speeds() {
        return vec![];
    }
    let mut stepper = Stepper::new(equations, &record.signals, &[]);
    let visible = |i: usize| record.measured(i);
    let pose = pose_of(equations, &measured_at(equations, record, 0));
    let mut hidden = hidden_states::at_start(equations, record, &pose);
    let mut found = Vec::with_capacity(record.time.len());
    for i in 0..record.time.len() {
        found.push(hidden.clone());
        if i + 1 < record.time.len() {
            let mut arc = StateSensitivity { z: [visible(i), hidden].concat(), s: vec![] };
            stepper.advance(&mut arc, record.time[i], record.time[i + 1]);
            hidden = arc.z[equations.visible..].to_vec();
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{KNOWN, WEAVING, equations, logged, unicycle};

    /// Windows side by side, more than there are lanes and of different lengths, end where each ends alone.
    #[test]
    fn windows_side_by_side_end_as_alone() {
        let (equations, p) = equations(&KNOWN);
        // Of the first half every fifth row is missing.
        let time = (0..600).filter(|i| *i > 300 || i % 5 != 3).map(|i| 0.05 * f64::from(i)).collect();
        let record = logged((&equations, &p), time, WEAVING, &vec![0.0; equations.n()], 1e-3);
        let predictor = Rollout::new(&unicycle(&KNOWN), &record).unwrap();
        for horizon in [0.33, 2.0, 12.0] {
            let windows = predictor.windows(horizon);
            let mut lengths: Vec<usize> = windows.iter().map(|(from, to)| to - from).collect();
            lengths.dedup();
            assert!(windows.len() > 1 && (lengths.len() > 1 || horizon > 1.0), "{lengths:?}");
            for ((from, to), [first, last]) in windows.iter().zip(predictor.paths(&windows)) {
                let alone = predictor.outputs(*from, *to);
                assert_eq!((&alone[0], &alone[to - from]), (&first, &last));
            }
            for ((from, to), path) in windows.iter().zip(predictor.paths::<5>(&windows)) {
                let alone = predictor.outputs(*from, *to);
                let at = |k: usize| &alone[(to - from) * k / 4];
                assert!((0..5).all(|k| &path[k] == at(k)));
            }
        }
        // Windows that begin anywhere end where the horizon does, and none of them beyond the log.
        let rows: Vec<usize> = (0..record.time.len()).collect();
        let anywhere: Vec<(usize, usize)> = predictor.windows_from(&rows, 2.0).into_iter().flatten().collect();
        assert!(anywhere.len() > 300 && anywhere.last().unwrap().1 < record.time.len());
        for (from, to) in anywhere {
            assert!((record.time[to] - record.time[from] - 2.0).abs() < 0.11, "{from} {to}");
        }
    }
}
