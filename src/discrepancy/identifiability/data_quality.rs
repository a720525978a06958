//! The state of the data: rows, times, driving, units.

use super::check_report::{Health, RunHealth};
use super::data_finding::{DataFinding, Side};
use super::driving_statistics::{driving, quantile};
use crate::discrepancy::estimation::autocorrelation::NOTICEABLE;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::noise_model::Component;
use crate::discrepancy::preprocessing::prepared_run::LeftOut;
use crate::discrepancy::preprocessing::quantisation::coarse_inputs;
use crate::discrepancy::preprocessing::unit_errors::{SPARSE, turning_cause, way_cause};
use crate::discrepancy::record::run_record::Record;
use crate::error::Result;
use crate::files::Run;
use crate::model::Model;
use crate::model::observation::{HEADING, POSITION};
use crate::model::state::JUMPS;
use rayon::prelude::*;

/// Share of rows left out that is worth a word.
const MANY_DROPPED: f64 = 0.05;
/// Scatter of the times between rows that is worth a word.
const UNEVEN: f64 = 0.3;
/// Way and turning that the model's parameters may be wrong by without a word.
const RIGHT: [f64; 2] = [0.8, 1.25];
/// Share of the time below which a turn direction counts as never driven.
const NEVER: f64 = 0.05;
/// Speeds within this factor are one speed.
const ONE_SPEED: f64 = 1.3;
/// Rows alike that are worth a word.
const COLOURED: f64 = 3.0;

/// The state of runs before anything is fitted, and what is to know of it.
pub(crate) fn health(
    model: &Model,
    runs: &[Run],
    records: &[Record],
    left_out: &[LeftOut],
) -> Result<(Health, Vec<DataFinding>)> {
    let one = |((run, record), left_out): ((&Run, &Record), &LeftOut)| -> Result<RunHealth> {
        let noise = record.position_noise();
        driving(model, record, rows(run, record, *left_out), noise)
    };
    let each: Vec<RunHealth> = runs.par_iter().zip(records).zip(left_out).map(one).collect::<Result<_>>()?;
    let mut found = findings(model, &each, records);
    for run in runs {
        let reading = |says: &String| DataFinding::Reading { run: run.name.clone(), says: says.clone() };
        found.extend(run.warnings.iter().map(reading));
        found.extend(coarse_inputs(model, run).into_iter().map(DataFinding::CoarseInput));
    }
    Ok((Health { runs: each, ..Health::default() }, found))
}

impl Health {
    /// With what a fit of the model as given adds to it; the noise is that of neighbouring rows, as it was before the fit.
    pub(crate) fn with_fit(self, noise: &[Component], fit: &Fit, has_heading: bool) -> Self {
        Self {
            position_noise: Some(noise[POSITION].variance.sqrt()),
            heading_noise: has_heading.then(|| noise[HEADING].variance.sqrt()),
            rows_alike: Some(fit.noise_correlation_time),
            ..self
        }
    }
}

/// What a fit of the model as given tells of the data.
pub(crate) fn of_fit(fit: &Fit) -> Vec<DataFinding> {
    // What the model misses within a window looks like a slow noise.
    let alike = fit.noise_correlation_time;
    let is_coloured = alike > COLOURED && fit.unexplained.iter().all(|d| *d < NOTICEABLE);
    let most =
        (0..fit.unexplained.len()).max_by(|a, b| fit.unexplained[*a].total_cmp(&fit.unexplained[*b])).unwrap_or(0);
    let coloured = is_coloured.then_some(DataFinding::ColouredNoise(alike));
    let unexplained = (fit.unexplained[most] > NOTICEABLE).then(|| DataFinding::UnexplainedMotion(JUMPS[most].place));
    coloured.into_iter().chain(unexplained).collect()
}

/// What the rows of a run say by themselves.
fn rows(run: &Run, record: &Record, left_out: LeftOut) -> RunHealth {
    let steps: Vec<f64> = record.time.windows(2).map(|w| w[1] - w[0]).collect();
    let step = record.step();
    // Where rows were left out the log is not interrupted.
    let logged = || run.time.windows(2).map(|w| w[1] - w[0]);
    let spread = |q| quantile(steps.clone(), q).unwrap_or(step);
    let mut why_dropped = run.why_dropped.clone();
    left_out.tell(&mut why_dropped);
    RunHealth {
        run: run.name.clone(),
        rows: record.time.len(),
        rows_dropped: run.rows_dropped + left_out.rows(),
        why_dropped,
        duration_s: record.time[record.time.len() - 1] - record.time[0],
        rate_hz: 1.0 / step,
        jitter: 0.5 * (spread(0.95) - spread(0.05)) / step,
        gaps: logged().filter(|s| *s > record.gap()).count(),
        longest_gap_s: logged().fold(0.0, f64::max),
        ..RunHealth::default()
    }
}

fn findings(model: &Model, runs: &[RunHealth], records: &[Record]) -> Vec<DataFinding> {
    let mut found: Vec<DataFinding> = runs.iter().flat_map(of_run).collect();
    found.extend(turns(runs).filter(|_| !model.vehicle.line));
    found.extend(speeds(runs));
    found.extend(records.iter().all(|r| !r.has_heading()).then_some(DataFinding::NoHeading));
    found
}

fn of_run(r: &RunHealth) -> Vec<DataFinding> {
    let run = || r.run.clone();
    let (step, all) = (1.0 / r.rate_hz, r.rows + r.rows_dropped);
    let is_wrong = |x: &f64| !(RIGHT[0]..RIGHT[1]).contains(x);
    let dropped = || DataFinding::RowsDropped { run: run(), dropped: r.rows_dropped, all, why: r.why_dropped.clone() };
    let gaps = || DataFinding::Interrupted { run: run(), times: r.gaps, longest: r.longest_gap_s };
    let way = |ratio| DataFinding::Way { run: run(), ratio, cause: way_cause(ratio, step) };
    let turning = |ratio| DataFinding::Turning { run: run(), ratio, cause: turning_cause(ratio) };
    let found = [
        (r.rows_dropped as f64 > MANY_DROPPED * all as f64).then(dropped),
        (r.gaps > 0).then(gaps),
        (step > SPARSE).then(|| DataFinding::TimeUnit { run: run(), step }),
        (r.jitter > UNEVEN).then(|| DataFinding::UnevenTimes { run: run(), jitter: r.jitter }),
        r.way_ratio.filter(is_wrong).map(way),
        r.turn_ratio.filter(is_wrong).map(turning),
    ];
    found.into_iter().flatten().collect()
}

/// Runs that hardly turn, or to one side only, by the share of the time of all of them.
fn turns(runs: &[RunHealth]) -> Option<DataFinding> {
    let share = |f: &dyn Fn(&RunHealth) -> f64| {
        let total: f64 = runs.iter().map(|r| r.duration_s).sum();
        runs.iter().map(|r| f(r) * r.duration_s).sum::<f64>() / total.max(f64::MIN_POSITIVE)
    };
    match (share(&|r| r.left) < NEVER, share(&|r| r.right) < NEVER) {
        (true, true) => Some(DataFinding::NoTurns),
        (true, false) => Some(DataFinding::OneTurnDirection(Side::Right)),
        (false, true) => Some(DataFinding::OneTurnDirection(Side::Left)),
        _ => None,
    }
}

fn speeds(runs: &[RunHealth]) -> Option<DataFinding> {
    let slow = runs.iter().filter_map(|r| r.speed).map(|s| s[0]).fold(f64::INFINITY, f64::min);
    let fast = runs.iter().filter_map(|r| r.speed).map(|s| s[2]).fold(0.0, f64::max);
    (fast > 0.0 && fast < ONE_SPEED * slow).then_some(DataFinding::OneSpeed(fast))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::unicycle_file;
    use crate::discrepancy::preprocessing::unit_errors::{TurningCause, WayCause};
    use crate::wording::GROSS;
    use std::collections::BTreeMap;

    /// A run with nothing to say about.
    fn usual() -> RunHealth {
        RunHealth {
            run: "a.csv".into(),
            rows: 95,
            rows_dropped: 5,
            duration_s: 10.0,
            rate_hz: 10.0,
            speed: Some([0.5, 1.0, 1.5]),
            left: 0.4,
            right: 0.4,
            way_ratio: Some(1.0),
            turn_ratio: Some(1.0),
            ..RunHealth::default()
        }
    }

    /// A vehicle that turns.
    fn plane() -> Model {
        crate::discrepancy::fixtures::unicycle(&[])
    }

    #[test]
    fn each_fault_of_a_run_is_found_by_itself() {
        let found = |r: RunHealth| {
            let found = findings(&plane(), &[usual(), r], &[]);
            found.into_iter().filter(|f| *f != DataFinding::NoHeading).collect::<Vec<_>>()
        };
        let run = || "a.csv".to_string();
        assert_eq!(found(usual()), []);
        let why: BTreeMap<String, usize> = [("no pose".to_string(), 2), ("no input".to_string(), 4)].into();
        let cases = [
            (
                RunHealth { rows: 94, rows_dropped: 6, why_dropped: why.clone(), ..usual() },
                DataFinding::RowsDropped { run: run(), dropped: 6, all: 100, why },
            ),
            (
                RunHealth { gaps: 1, longest_gap_s: 2.5, ..usual() },
                DataFinding::Interrupted { run: run(), times: 1, longest: 2.5 },
            ),
            (RunHealth { rate_hz: 0.02, ..usual() }, DataFinding::TimeUnit { run: run(), step: 50.0 }),
            (RunHealth { jitter: 0.42, ..usual() }, DataFinding::UnevenTimes { run: run(), jitter: 0.42 }),
            (
                RunHealth { way_ratio: Some(0.79), ..usual() },
                DataFinding::Way { run: run(), ratio: 0.79, cause: WayCause::Unknown },
            ),
            (
                RunHealth { turn_ratio: Some(1.26), ..usual() },
                DataFinding::Turning { run: run(), ratio: 1.26, cause: TurningCause::Unknown },
            ),
        ];
        for (run, expected) in cases {
            assert_eq!(found(run), [expected]);
        }
    }

    /// What one run lacks another may have: shares of the time are those of all runs, by how long they last.
    #[test]
    fn turns_and_speeds_are_those_of_all_runs() {
        let of = |runs: &[RunHealth]| findings(&plane(), runs, &[]).into_iter().find(|f| *f != DataFinding::NoHeading);
        let lefts = RunHealth { right: 0.0, ..usual() };
        let straight = RunHealth { left: 0.0, ..lefts.clone() };
        assert_eq!(of(std::slice::from_ref(&straight)), Some(DataFinding::NoTurns));
        assert_eq!(of(std::slice::from_ref(&lefts)), Some(DataFinding::OneTurnDirection(Side::Left)));
        let rights = RunHealth { left: 0.01, ..usual() };
        assert_eq!(of(std::slice::from_ref(&rights)), Some(DataFinding::OneTurnDirection(Side::Right)));
        assert_eq!(of(&[lefts.clone(), usual()]), None);
        let long = RunHealth { duration_s: 1000.0, ..lefts };
        assert_eq!(of(&[long, usual()]), Some(DataFinding::OneTurnDirection(Side::Left)));
        let speed = |slow, fast| RunHealth { speed: Some([slow, slow, fast]), ..usual() };
        assert_eq!(of(&[speed(1.0, 1.1), speed(0.9, 1.0)]), Some(DataFinding::OneSpeed(1.1)));
        assert_eq!(of(&[speed(1.0, 1.1), speed(0.5, 0.6)]), None);
    }

    /// Rows a tenth of a second apart from 5 s on, some of which are late, and a hole of two seconds.
    #[test]
    fn times_are_told_as_they_are() {
        let file = unicycle_file("");
        let mut log = String::from("time,x,y,heading,wheel_rate,yaw_rate\n");
        let time = (0..40)
            .map(|i| 5.0 + 0.1 * f64::from(i) + if i > 30 { 1.9 } else { 0.0 } + if i % 8 == 3 { 0.04 } else { 0.0 });
        time.for_each(|t| log += &format!("{t},0,0,0,1,0\n"));
        let run = Run::parse("run.csv", &log, &file).unwrap();
        let record = Record::of_run(&run, file.input_timing, 0);
        let told = rows(&run, &record, LeftOut { gross: 3, ..LeftOut::default() });
        let close = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(close(told.duration_s, 5.8) && close(told.rate_hz, 10.0) && close(told.longest_gap_s, 2.0), "{told:?}");
        // Of 39 steps five are 0.14 s and five 0.06 s.
        assert!(close(told.jitter, 0.4), "{told:?}");
        assert_eq!((told.rows, told.rows_dropped, told.gaps, told.why_dropped[GROSS]), (40, 3, 1, 3));
    }
}
