//! A run as the fit sees it.

use super::angle::wrapped;
use super::input_noise::InputNoise;
use super::local_polynomial;
use super::row_weights::RowWeights;
use crate::files::{InputTiming, Run};
use crate::model::freedom::{Freedom, Speed};
use crate::model::observation::{self, BODY_HEADING, Observation, PLACE};
use crate::motion::{Signals, Timing, timings};
use crate::numerics::usual_step;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// A column without any noise still has its last digit.
const LEAST_NOISE: f64 = 1e-9;
/// The noise of a column whose rows do not tell it.
const UNTOLD_NOISE: f64 = 1e-3;

/// Rows of a run: measured pose, inputs as signals.
#[derive(Clone, Debug)]
pub struct Record {
    /// Name of the run.
    pub name: String,
    /// Times, strictly increasing, s.
    pub time: Vec<f64>,
    /// Measured x, y and, when measured, heading and trailer headings, or what they are by definition; angles unwrapped.
    pub columns: Vec<Vec<f64>>,
    /// What is measured beside the pose, in the order of the model; empty where the log has none of it.
    pub quantities: Vec<Vec<f64>>,
    /// Which outputs of the vehicle they are.
    pub observation: Observation,
    /// How much each row of a column counts.
    pub weights: RowWeights,
    /// The inputs.
    pub signals: Signals,
    /// What was added to each input before it was logged.
    pub(crate) input_noise: Arc<InputNoise>,
    /// Rows that take part.
    pub rows: Range<usize>,
    pub(crate) known: Known,
}

/// What has been found out about all rows once; a copy, which may be of other rows, finds out for itself.
#[derive(Debug, Default)]
pub(crate) struct Known {
    step: OnceLock<f64>,
    noise: OnceLock<Vec<Option<f64>>>,
    quantity_noise: OnceLock<Vec<Option<f64>>>,
}

impl Clone for Known {
    fn clone(&self) -> Self {
        Self::default()
    }
}

/// What a measured column is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Channel {
    /// Its place among the columns of the record.
    pub column: usize,
    /// The output of the equations that it is compared with.
    pub output: usize,
    /// Its component of the measurement noise.
    pub noise: usize,
    /// Whether it is an angle.
    pub is_angle: bool,
}

impl Channel {
    /// Measured minus modelled or the other way round; of an angle whole turns say nothing.
    #[inline(always)]
    pub fn difference(&self, difference: f64) -> f64 {
        if self.is_angle { wrapped(difference) } else { difference }
    }
}

impl Record {
    /// A whole run.
    pub fn new(
        name: &str,
        time: Vec<f64>,
        columns: Vec<Vec<f64>>,
        has_heading: bool,
        inputs: &[Vec<f64>],
        timing: Timing,
    ) -> Self {
        let signals = Signals::new(&time, inputs, timing);
        let input_noise = Arc::new(InputNoise::of(&time, inputs, &vec![timing; inputs.len()]));
        let rows = 0..time.len();
        let trailers = columns.len() - PLACE.len() - usize::from(has_heading);
        let observation = Observation::new(trailers, has_heading, columns.len());
        let (name, known) = (name.to_string(), Known::default());
        let weights = RowWeights::default();
        let quantities = vec![];
        Self { name, time, columns, quantities, observation, weights, signals, input_noise, rows, known }
    }

    /// A run as it was read, of a vehicle with some trailers, or with that freedom.
    pub fn of_run(run: &Run, timing: InputTiming, of: impl Into<Freedom>) -> Self {
        let mut columns = vec![run.x.clone(), run.y.clone()];
        columns.extend(run.heading.clone());
        columns.extend(run.trailer_headings.iter().cloned());
        let signals = Signals::of_run(run, timing);
        let input_noise = Arc::new(InputNoise::of(run.input_time(), &run.inputs, &timings(&run.differences, timing)));
        let defined = [(PLACE[1], run.defined.y), (BODY_HEADING, run.defined.heading)];
        let defined = defined.into_iter().filter_map(|(output, is_defined)| is_defined.then_some(output));
        let of: Freedom = of.into();
        let quantities = if run.measured.len() == of.quantities.len() { run.measured.clone() } else { vec![] };
        let observation = Observation::new(of, run.heading.is_some(), columns.len()).defining(defined);
        let (name, time, rows) = (run.name.clone(), run.time.clone(), 0..run.time.len());
        let (weights, known) = (RowWeights::of_run(run), Known::default());
        Self { name, time, columns, quantities, observation, weights, signals, input_noise, rows, known }
    }

    /// The run with inputs that are as noisy again: one of the draws of a seed.
    pub(crate) fn with_noisier_inputs(&self, seed: u64, draw: u64) -> Record {
        self.with_inputs_changed(|noise| noise.drawn(seed, draw))
    }

    /// The run with inputs that show no noise.
    pub(crate) fn with_exact_inputs(&self) -> Record {
        Record { input_noise: InputNoise::default().into(), ..self.clone() }
    }

    /// The run whose inputs are rounded where they may be.
    pub(crate) fn with_rounded_inputs(&self) -> Record {
        Record { input_noise: self.input_noise.of_rounded().into(), ..self.clone() }
    }

    /// The run with inputs that a smoother has taken the noise from.
    pub(crate) fn with_smoothed_inputs(&self) -> Record {
        self.with_inputs_changed(InputNoise::smoothing)
    }

    /// The run with something added to its inputs, where they show noise.
    fn with_inputs_changed(&self, by: impl FnOnce(&InputNoise) -> Signals) -> Record {
        let mut changed = self.clone();
        if self.input_noise.is_there() {
            changed.signals = self.signals.plus(&by(&self.input_noise));
        }
        changed
    }

    /// The run without the rows that are not kept.
    pub(crate) fn keeping(&self, kept: impl Fn(usize) -> bool) -> Record {
        let pick = |column: &[f64]| (0..column.len()).filter(|i| kept(*i)).map(|i| column[i]).collect::<Vec<f64>>();
        let before = |end: usize| (0..end).filter(|i| kept(*i)).count();
        Record {
            time: pick(&self.time),
            columns: self.columns.iter().map(|c| pick(c)).collect(),
            quantities: self.quantities.iter().map(|c| pick(c)).collect(),
            weights: self.weights.keeping(pick),
            rows: before(self.rows.start)..before(self.rows.end),
            ..self.clone()
        }
    }

    /// What each measured column is.
    pub fn channels(&self) -> Vec<Channel> {
        let outputs: Vec<observation::Output> = observation::outputs(self.freedom().clone()).collect();
        let channel = |(column, i): (usize, &usize)| {
            let (output, of) = (*i, outputs[*i]);
            self.observation.measures(output).then_some(Channel {
                column,
                output,
                noise: of.noise,
                is_angle: of.is_angle,
            })
        };
        self.observation.columns().iter().enumerate().filter_map(channel).collect()
    }

    /// Whether the heading of the body is known, measured or by definition.
    pub fn has_heading(&self) -> bool {
        self.observation.knows(BODY_HEADING)
    }

    /// Whether a sensor measures the heading of the body.
    pub fn measures_heading(&self) -> bool {
        self.observation.measures(BODY_HEADING)
    }

    /// Trailers of the vehicle, measured or not.
    pub fn trailers(&self) -> usize {
        self.observation.trailers()
    }

    /// What of the vehicle is free at the start of every window.
    pub fn freedom(&self) -> &Freedom {
        self.observation.freedom()
    }

    /// The times of its first and its last row, s.
    pub fn span(&self) -> [f64; 2] {
        [self.time[self.rows.start], self.time[self.rows.end - 1]]
    }

    /// The run up to a time and from it on, as shares of the whole duration.
    pub fn split(&self, share: f64) -> (Record, Record) {
        let [first, last] = self.span();
        let cut = first + share * (last - first);
        let at = self.rows.start + self.time[self.rows.clone()].partition_point(|t| *t < cut);
        let part = |rows: Range<usize>| Record { rows, ..self.clone() };
        (part(self.rows.start..at), part(at..self.rows.end))
    }

    /// Standard deviation of the measured positions, m.
    pub fn position_noise(&self) -> f64 {
        PLACE.into_iter().filter_map(|c| self.noises()[c]).fold(LEAST_NOISE, f64::max)
    }

    /// Standard deviation of a column, as its rows show it.
    pub(crate) fn noise_of(&self, column: usize) -> f64 {
        self.noises()[column].unwrap_or(UNTOLD_NOISE).max(LEAST_NOISE)
    }

    /// Standard deviation of a quantity that is measured beside the pose, as its rows show it, or as it is known.
    pub(crate) fn noise_of_quantity(&self, quantity: usize) -> f64 {
        let known = self.freedom().quantities.get(quantity).copied().flatten();
        known.or(self.quantity_noises()[quantity]).unwrap_or(UNTOLD_NOISE).max(LEAST_NOISE)
    }

    /// The noise that the rows of each column show, where they do.
    pub(crate) fn noises(&self) -> &[Option<f64>] {
        self.known.noise.get_or_init(|| self.noises_of(&self.columns))
    }

    /// The same of each quantity that is measured beside the pose.
    pub(crate) fn quantity_noises(&self) -> &[Option<f64>] {
        self.known.quantity_noise.get_or_init(|| self.noises_of(&self.quantities))
    }

    fn noises_of(&self, columns: &[Vec<f64>]) -> Vec<Option<f64>> {
        let rows = || self.rows.clone();
        columns.iter().map(|column| local_polynomial::noise(&self.time[rows()], column.get(rows())?)).collect()
    }

    /// The usual time between rows, s.
    pub fn step(&self) -> f64 {
        *self.known.step.get_or_init(|| usual_step(&self.time[self.rows.clone()]).unwrap_or(f64::NAN))
    }

    /// The time between rows from which on a log is interrupted, s.
    pub fn gap(&self) -> f64 {
        (5.0 * self.step()).max(0.5)
    }

    /// Stretches without a gap, a margin away from the ends of the log so that inputs can be looked up
    /// earlier and later than they were logged.
    pub fn segments(&self, margin: f64) -> Vec<Range<usize>> {
        let gap = self.gap();
        let (first, last) = (self.time[0] + margin, self.time[self.time.len() - 1] - margin);
        let mut segments: Vec<Range<usize>> = Vec::new();
        for i in self.rows.clone().filter(|i| (first..=last).contains(&self.time[*i])) {
            match segments.last_mut() {
                Some(s) if s.end == i && self.time[i] - self.time[i - 1] <= gap => s.end = i + 1,
                _ => segments.push(i..i + 1),
            }
        }
        segments.retain(|s| s.len() >= 4);
        segments
    }

    /// The measured values at a row as outputs of the equations; what is not measured is zero.
    pub fn measured(&self, i: usize) -> Vec<f64> {
        let mut y: Vec<f64> = self.columns.iter().map(|c| c[i]).collect();
        if !self.has_heading() {
            y.insert(BODY_HEADING, 0.0);
        }
        self.completed(y, i)
    }

    /// The measured values smoothed around a row; a missing heading is the direction of travel.
    ///
    /// Rows before those that take part help too, later ones never: what is held out stays closed.
    pub fn smoothed(&self, i: usize) -> Vec<f64> {
        let weights = self.smoothing(i);
        let mut y: Vec<f64> = self.columns.iter().map(|c| local_polynomial::value(c, &weights)).collect();
        if !self.has_heading() {
            y.insert(BODY_HEADING, self.course(i));
        }
        self.completed(y, i)
    }

    /// Measured values with what no column gives: a trailer is taken to follow straight, speeds are slopes.
    fn completed(&self, mut y: Vec<f64>, i: usize) -> Vec<f64> {
        y.resize(self.outputs() - self.freedom().speeds.len(), y[BODY_HEADING]);
        y.extend(self.speeds(i, y[BODY_HEADING]));
        y
    }

    /// Speeds that no column gives, by the slopes of those that are there; what no slope tells is zero.
    fn speeds(&self, i: usize, heading: f64) -> Vec<f64> {
        let of = &self.freedom().speeds;
        let Some(weights) = (!of.is_empty()).then(|| self.course_weights(i)).flatten() else {
            return vec![0.0; of.len()];
        };
        let slope = |c: usize| local_polynomial::value(&self.columns[c], &weights);
        let (vx, vy, (sin, cos)) = (slope(PLACE[0]), slope(PLACE[1]), heading.sin_cos());
        let mut trailers = (BODY_HEADING + usize::from(self.has_heading())..self.columns.len()).map(slope);
        let one = |speed: &Speed| match speed {
            Speed::Along => vx * cos + vy * sin,
            Speed::Across => vy * cos - vx * sin,
            Speed::Yaw if self.has_heading() => slope(BODY_HEADING),
            Speed::Trailer => trailers.next().unwrap_or(0.0),
            Speed::Yaw | Speed::Wheel => 0.0,
        };
        of.iter().map(one).collect()
    }

    /// How many outputs the equations have.
    fn outputs(&self) -> usize {
        observation::outputs(self.freedom().clone()).count()
    }

    /// The weights of the smoothing around a row.
    pub fn smoothing(&self, i: usize) -> Vec<(usize, f64)> {
        local_polynomial::weights(&self.time, 0..self.rows.end, i)
    }

    /// Direction of travel at a row, rad; backward travel is not known and not corrected here.
    fn course(&self, i: usize) -> f64 {
        let Some(weights) = self.course_weights(i) else { return 0.0 };
        let [x, y] = PLACE.map(|c| local_polynomial::value(&self.columns[c], &weights));
        y.atan2(x)
    }

    /// The weights of the velocity that the direction of travel is taken from.
    fn course_weights(&self, i: usize) -> Option<Vec<(usize, f64)>> {
        local_polynomial::slope_weights(&self.time, 0..self.rows.end, i)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(columns: Vec<Vec<f64>>, has_heading: bool) -> Record {
        let time: Vec<f64> = (0..5).map(|i| 100.0 + f64::from(i)).collect();
        Record::new("run.csv", time, columns, has_heading, &[vec![1.0; 5]], Timing::Sample)
    }

    #[test]
    fn a_row_is_compared_in_the_order_of_the_outputs() {
        let column = |from: f64| (0..5).map(|i| from + f64::from(i)).collect::<Vec<f64>>();
        let whole = record(vec![column(10.0), column(20.0), column(30.0), column(40.0)], true);
        assert_eq!(whole.measured(2), [12.0, 22.0, 32.0, 42.0]);
        let places = record(vec![column(10.0), column(20.0)], false);
        assert_eq!(places.measured(3), [13.0, 23.0, 0.0]);
        let towed = record(vec![column(10.0), column(20.0), column(40.0)], false);
        assert_eq!(towed.measured(1), [11.0, 21.0, 0.0, 41.0]);
        assert_eq!(towed.channels().iter().map(|c| c.output).collect::<Vec<_>>(), [0, 1, 3]);
    }

    /// Where no heading is measured the smoothed one is that of the path, and a trailer is taken to follow it.
    #[test]
    fn a_missing_heading_is_the_direction_of_travel() {
        let rows: Vec<f64> = (0..40).map(f64::from).collect();
        let along = |x: f64, y: f64| {
            let columns = vec![rows.iter().map(|i| 5.0 + x * i).collect(), rows.iter().map(|i| y * i - 2.0).collect()];
            let time = rows.iter().map(|i| 0.1 * i).collect();
            let observation = Observation::new(1, false, 2);
            Record { observation, ..Record::new("run.csv", time, columns, false, &[vec![1.0; 40]], Timing::Sample) }
        };
        for (x, y) in [(0.3, 0.4), (-0.3, 0.4), (0.4, -0.3), (-0.1, -0.1)] {
            for i in [0, 20, 39] {
                let smoothed = along(x, y).smoothed(i);
                let heading = y.atan2(x);
                let expected = [5.0 + x * i as f64, y * i as f64 - 2.0, heading, heading];
                let near = smoothed.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9);
                assert!(near && smoothed.len() == 4, "{x} {y} {i}: {smoothed:?}");
            }
        }
    }

    /// A vehicle on a line needs no y: it is zero with the heading, so that a pose is whole, and neither is a measurement.
    #[test]
    fn on_a_line_the_place_along_it_is_all_that_is_measured() {
        let known = crate::model::known(crate::effects::all());
        let text = |more: &str| format!("vehicle = \"disk\"\n[parameters]\nwheel_radius = 0.5\n[columns]\n{more}");
        let file = |more: &str| crate::files::ModelFile::parse(&text(more), "model.toml", &known).unwrap();
        let read = |log: &str, more: &str| Run::parse("run.csv", log, &file(more));
        let log = "time,x,wheel_rate\n0,0.5,1\n1,0.75,1\n2,1,1\n";
        let run = read(log, "").unwrap();
        let record = Record::of_run(&run, InputTiming::Sample, 0);
        assert_eq!(record.measured(1), [0.75, 0.0, 0.0]);
        assert_eq!(record.channels().iter().map(|c| (c.column, c.output)).collect::<Vec<_>>(), [(0, 0)]);
        assert!(record.has_heading() && !record.measures_heading());
        let problem = crate::discrepancy::estimation::problem::Problem::new(vec![record], None, None);
        let estimated = problem.variances.components().iter().filter(|c| c.is_estimated).map(|c| c.id);
        assert_eq!(estimated.collect::<Vec<_>>(), ["position", "along"]);
        // A log that has the column is read by it, and one that is named must be there.
        let both = read("time,x,y,heading,wheel_rate\n0,0.5,2,1,1\n1,0.75,2,1,1\n", "").unwrap();
        let record = Record::of_run(&both, InputTiming::Sample, 0);
        assert_eq!((record.measured(1), record.channels().len()), (vec![0.75, 2.0, 1.0], 3));
        let turned = read("time,x,heading,wheel_rate\n0,0.5,1,1\n1,0.75,1,1\n", "").unwrap();
        let record = Record::of_run(&turned, InputTiming::Sample, 0);
        assert_eq!(record.channels().iter().map(|c| (c.column, c.output)).collect::<Vec<_>>(), [(0, 0), (2, 2)]);
        let error = read(log, "y = \"y\"").unwrap_err().to_string();
        assert!(error.contains("column \"y\" is missing"), "{error}");
    }
}
