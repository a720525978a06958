//! The clocks to what the data can tell: by the fit of the model, offset and drift with their deviations.

use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::preprocessing::outliers::without_gross_errors;
use crate::discrepancy::record::run_record::Record;
use crate::effects::{Applied, of_clock};
use crate::error::Result;
use crate::files::{Clock, ModelFile, Run};
use crate::model::{Fineness, Model};

/// Rounds of offset and drift.
const ROUNDS: usize = 8;
/// A step within this share of its deviation is none.
const ARRIVED: f64 = 0.1;
/// By how much the first drift that is tried moves the ends of a run, s.
const TRIED: f64 = 0.05;
/// How often a drift is looked for further away.
const STRIDES: usize = 6;
const EFFORT: Effort = Effort { passes: 8, enough: 1e-3, fineness: Fineness::Full, ..Effort::SCREENING };

/// A clock with its deviations.
#[derive(Clone, Copy, Debug)]
pub struct Fitted {
    /// The clock.
    pub clock: Clock,
    /// Standard deviation of its offset, s.
    pub offset_std: Option<f64>,
    /// Standard deviation of its drift.
    pub drift_std: Option<f64>,
    /// Deviance a measured value.
    pub misfit: f64,
    /// Measured values.
    pub rows: f64,
    /// The first and the last time of the poses that are in it, s.
    pub covers: [f64; 2],
    /// How many of them in a row are alike.
    pub variance_inflation: f64,
}

/// The clock of a run by a fit of a model that begins at a clock; effects of the model that are free are fitted beside.
///
/// # Errors
/// When the model's formulas are malformed.
pub fn refined(run: &Run, model: &Model, file: &ModelFile, clock: Clock) -> Result<Option<Fitted>> {
    let delay = of_clock().filter(|_| run.apart.is_some());
    let Some(delay) = delay else { return Ok(None) };
    let mut model = model.clone();
    model.effects.retain(|e| !e.effect.is_of_clock());
    let model = model.with_effect(Applied::new(delay, None, vec![0.0]).freed());
    let clock = middle(run, clock);
    let mut found = Fitted {
        clock,
        offset_std: None,
        drift_std: None,
        misfit: f64::INFINITY,
        rows: 0.0,
        covers: [0.0; 2],
        variance_inflation: 1.0,
    };
    for _ in 0..ROUNDS {
        let Some(round) = Round::at(run, &model, file, found.clock)? else { return Ok(None) };
        let drift = round.drift()?;
        let offset = round.delay;
        let step = drift.map_or(0.0, |(step, _)| step);
        found.clock.offset += offset;
        found.clock.drift += step;
        found.offset_std = round.offset_std;
        found.rows = round.problem.records.iter().map(|r| (r.time.len() * r.columns.len()) as f64).sum();
        let time = &round.problem.records[0].time;
        found.covers = [time[0], time[time.len() - 1]];
        found.misfit = round.fit.deviance / found.rows;
        found.variance_inflation = round.fit.variance_inflation();
        found.drift_std = drift.and_then(|(_, std)| std);
        let small = |step: f64, std: Option<f64>| std.is_none_or(|s| step.abs() < ARRIVED * s);
        if small(offset, found.offset_std) && small(step, found.drift_std) {
            break;
        }
    }
    Ok(Some(found))
}

impl Fitted {
    /// How many of the measured values another clock's fit has not.
    pub(crate) fn alone(&self, other: &Self) -> f64 {
        let [from, to] = self.covers;
        let common = (to.min(other.covers[1]) - from.max(other.covers[0])).max(0.0);
        if to > from { self.rows * (1.0 - common / (to - from)) } else { 0.0 }
    }
}

/// A clock whose offset is stated for the middle of the poses: there it is independent of the drift.
fn middle(run: &Run, clock: Clock) -> Clock {
    let poses = [run.time[0], run.time[run.time.len() - 1]];
    let inputs = run.input_time();
    let ends = [clock.of(inputs[0]).max(poses[0]), clock.of(inputs[inputs.len() - 1]).min(poses[1])];
    let at = 0.5 * (ends[0] + ends[1]);
    // The time of the inputs where the poses' clock reads so.
    let input = (at - clock.offset + clock.drift * clock.at) / (1.0 + clock.drift);
    clock.restated(input)
}

/// One fit at a clock.
struct Round<'a> {
    run: &'a Run,
    file: &'a ModelFile,
    clock: Clock,
    problem: Problem,
    fit: Fit,
    delay: f64,
    offset_std: Option<f64>,
    /// Half of the time that the fit covers, s.
    reach: f64,
}

impl<'a> Round<'a> {
    fn at(run: &'a Run, model: &Model, file: &'a ModelFile, clock: Clock) -> Result<Option<Self>> {
        let aligned = run.aligned(&clock);
        if aligned.time.len() < 2 {
            return Ok(None);
        }
        let record = Record::of_run(&aligned, file.input_timing, model.freedom());
        let (record, _) = without_gross_errors(&record, &model.fixed())?;
        let problem = Problem::new(vec![record], file.noise.position, file.noise.heading);
        if problem.windows() == 0 {
            return Ok(None);
        }
        let starts = problem.starts(model)?;
        let Some(fit) = problem.fit(model, &starts, &problem.variances, Effort::FULL)? else { return Ok(None) };
        let Some(at) = place(model) else { return Ok(None) };
        let variance = fit.variance(at);
        let time = &problem.records[0].time;
        let reach = 0.5 * (time[time.len() - 1] - time[0]);
        Ok(Some(Self {
            delay: fit.p[at],
            offset_std: variance.map(f64::sqrt).filter(|s| s.is_finite()),
            run,
            file,
            clock,
            problem,
            fit,
            reach,
        }))
    }

    /// The deviance with the clock running faster by a rate, everything else at its best.
    fn deviance(&self, rate: f64) -> Result<f64> {
        let Some(apart) = &self.run.apart else { return Ok(f64::INFINITY) };
        let clock = Clock { drift: self.clock.drift + rate, ..self.clock };
        let time: Vec<f64> = apart.time.iter().map(|t| clock.of(*t)).collect();
        let mut problem = self.problem.clone();
        let timings = crate::motion::timings(&self.run.differences, self.file.input_timing);
        problem.records[0].signals = crate::motion::Signals::mixed(&time, &self.run.inputs, &timings);
        let fit = problem.fit(&self.fit.model, &self.fit.window_states, &self.fit.variances, EFFORT)?;
        Ok(fit.map_or(f64::INFINITY, |f| f.deviance))
    }

    /// The step of the drift to the lowest deviance, and its deviation; `None` where the deviance does not tell.
    fn drift(&self) -> Result<Option<(f64, Option<f64>)>> {
        let mut h = TRIED / self.reach;
        let mut at = 0.0;
        let mut here = self.deviance(0.0)?;
        for _ in 0..STRIDES {
            let (down, up) = (self.deviance(at - h)?, self.deviance(at + h)?);
            let bend = up - 2.0 * here + down;
            let vertex = 0.5 * h * (down - up) / bend;
            if bend > 0.0 && vertex.abs() <= h {
                let std = (2.0 * h * h / bend).sqrt();
                at += vertex;
                // Far beyond its own deviation a parabola says little of the lowest point.
                if h <= 4.0 * std {
                    return Ok(Some((at, Some(std * self.fit.variance_inflation().sqrt()))));
                }
                h = 2.0 * std;
                here = self.deviance(at)?;
            } else if up.min(down) < here {
                at += if up < down { h } else { -h };
                here = up.min(down);
            } else {
                return Ok(None);
            }
        }
        Ok(Some((at, None)))
    }
}

/// Where the delay stands among the free parameters.
fn place(model: &Model) -> Option<usize> {
    let mut at = 0;
    for e in model.free_effects() {
        if e.effect.is_of_clock() {
            return Some(at);
        }
        at += e.values.len();
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::unicycle_file;

    /// Poses from 10 s to 30 s and inputs that end when the poses' clock reads 32.27 s.
    #[test]
    fn the_offset_is_stated_for_the_middle_of_what_both_have() {
        let file = unicycle_file("");
        let log = "time,x,y,heading,wheel_rate,yaw_rate\n10,0,0,0,1,0\n20,1,0,0,1,0\n30,2,0,0,1,0\n";
        let run = Run::parse("run.csv", log, &file).expect("a run");
        let clock = Clock { offset: 2.0, drift: 0.01, at: 3.0 };
        let stated = middle(&run, clock);
        assert!((clock.of(stated.at) - 0.5 * (12.07 + 30.0)).abs() < 1e-12, "{stated:?}");
        assert!((stated.of(17.0) - clock.of(17.0)).abs() < 1e-12 && stated.drift == clock.drift);
    }

    #[test]
    fn values_are_alone_where_the_other_clock_has_none() {
        let clock = Clock { offset: 0.0, drift: 0.0, at: 0.0 };
        let covering = |covers: [f64; 2]| Fitted {
            clock,
            offset_std: None,
            drift_std: None,
            misfit: 1.0,
            rows: 600.0,
            covers,
            variance_inflation: 1.0,
        };
        let own = covering([10.0, 40.0]);
        let cases = [
            ([10.0, 40.0], 0.0),
            ([20.0, 60.0], 200.0),
            ([0.0, 25.0], 300.0),
            ([15.0, 30.0], 300.0),
            ([50.0, 90.0], 600.0),
        ];
        for (covers, alone) in cases {
            assert!((own.alone(&covering(covers)) - alone).abs() < 1e-9, "{covers:?}");
        }
        assert_eq!(covering([10.0, 10.0]).alone(&own), 0.0);
    }
}
