//! The state of the data: rows, times, driving, units.

use super::check_report::{Finding, Health, RunHealth};
use super::driving_statistics::{driving, quantile};
use crate::discrepancy::estimation::autocorrelation::NOTICEABLE;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::noise_model::Component;
use crate::discrepancy::preprocessing::outliers::GROSS;
use crate::discrepancy::preprocessing::quantisation;
use crate::discrepancy::preprocessing::unit_errors::{SPARSE, wrong_turn, wrong_way};
use crate::discrepancy::record::run_record::Record;
use crate::error::Result;
use crate::files::Run;
use crate::model::Model;
use crate::model::observation::{HEADING, POSITION};
use crate::number_format::significant;

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

/// The state of runs before anything is fitted.
pub(crate) fn health(model: &Model, runs: &[Run], records: &[Record], gross: &[usize]) -> Result<Health> {
    let one = |((run, record), gross): ((&Run, &Record), &usize)| -> Result<RunHealth> {
        let noise = record.position_noise();
        driving(model, record, rows(run, record, *gross), noise)
    };
    let each: Vec<RunHealth> = runs.iter().zip(records).zip(gross).map(one).collect::<Result<_>>()?;
    let mut health = Health { runs: each, ..Health::default() };
    health.findings = findings(&health.runs, records);
    let of_id = |id: &str, says: String| Finding { id: id.into(), says };
    for run in runs {
        health.findings.extend(run.warnings.iter().map(|w| of_id("order", format!("{}: {w}", run.name))));
        health.findings.extend(quantisation::says(model, run).into_iter().map(|says| of_id("coarse-inputs", says)));
    }
    Ok(health)
}

impl Health {
    /// What a fit of the model as given adds to it; the noise is that of neighbouring rows, as it was before the fit.
    pub(crate) fn with_fit(mut self, noise: &[Component], fit: &Fit, has_heading: bool) -> Self {
        self.position_noise = Some(noise[POSITION].variance.sqrt());
        self.heading_noise = has_heading.then(|| noise[HEADING].variance.sqrt());
        self.rows_alike = Some(fit.noise_correlation_time);
        // What the model misses within a window looks like a slow noise.
        if fit.noise_correlation_time > COLOURED && fit.unexplained.iter().all(|d| *d < NOTICEABLE) {
            let n = significant(fit.noise_correlation_time, 2);
            self.say("coloured-noise", format!("the pose's noise is alike over {n} rows: a filtered or smoothed pose"));
        }
        let places = ["along the vehicle", "across the vehicle", "in yaw", "of trailers"];
        let most =
            (0..fit.unexplained.len()).max_by(|a, b| fit.unexplained[*a].total_cmp(&fit.unexplained[*b])).unwrap_or(0);
        if fit.unexplained[most] > NOTICEABLE {
            self.say(
                "unexplained-motion",
                format!(
                    "these runs hold motion that the model does not explain, most of it {}: `creepage discover` has \
                     something to find",
                    places[most]
                ),
            );
        }
        self
    }

    fn say(&mut self, id: &str, says: String) {
        self.findings.push(Finding { id: id.into(), says });
    }
}

/// What the rows of a run say by themselves.
fn rows(run: &Run, record: &Record, gross: usize) -> RunHealth {
    let steps: Vec<f64> = record.time.windows(2).map(|w| w[1] - w[0]).collect();
    let step = record.step();
    let spread = |q| quantile(steps.clone(), q).unwrap_or(step);
    let mut why_dropped = run.why_dropped.clone();
    if gross > 0 {
        why_dropped.insert(GROSS.into(), gross);
    }
    RunHealth {
        run: run.name.clone(),
        rows: record.time.len(),
        rows_dropped: run.rows_dropped + gross,
        why_dropped,
        duration_s: record.time[record.time.len() - 1] - record.time[0],
        rate_hz: 1.0 / step,
        jitter: 0.5 * (spread(0.95) - spread(0.05)) / step,
        gaps: steps.iter().filter(|s| **s > record.gap()).count(),
        longest_gap_s: steps.iter().copied().fold(0.0, f64::max),
        ..RunHealth::default()
    }
}

fn findings(runs: &[RunHealth], records: &[Record]) -> Vec<Finding> {
    let mut found = vec![];
    let mut say = |id: &str, says: String| found.push(Finding { id: id.into(), says });
    for r in runs {
        let name = &r.run;
        let all = (r.rows + r.rows_dropped) as f64;
        if r.rows_dropped as f64 > MANY_DROPPED * all {
            let why: Vec<String> = r.why_dropped.iter().map(|(why, n)| format!("{why}: {n}")).collect();
            say("rows-dropped", format!("{name}: {} of {all} rows are left out ({})", r.rows_dropped, why.join(", ")));
        }
        if r.gaps > 0 {
            let longest = significant(r.longest_gap_s, 3);
            say("gaps", format!("{name}: the log is interrupted {} times, by {longest} s at most", r.gaps));
        }
        if 1.0 / r.rate_hz > SPARSE {
            let step = significant(1.0 / r.rate_hz, 3);
            say("time-unit", format!("{name}: rows are {step} s apart: is time in seconds?"));
        }
        if r.jitter > UNEVEN {
            let percent = significant(100.0 * r.jitter, 2);
            say(
                "uneven-times",
                format!("{name}: times between rows scatter by {percent} %: are they those of measuring?"),
            );
        }
        if let Some(ratio) = r.way_ratio.filter(|x| !(RIGHT[0]..RIGHT[1]).contains(x)) {
            say("way", format!("{name}: {}", wrong_way(ratio, 1.0 / r.rate_hz)));
        }
        if let Some(ratio) = r.turn_ratio.filter(|x| !(RIGHT[0]..RIGHT[1]).contains(x)) {
            say("turning", format!("{name}: {}", wrong_turn(ratio)));
        }
    }
    let share = |f: &dyn Fn(&RunHealth) -> f64| {
        let total: f64 = runs.iter().map(|r| r.duration_s).sum();
        runs.iter().map(|r| f(r) * r.duration_s).sum::<f64>() / total.max(f64::MIN_POSITIVE)
    };
    let (left, right) = (share(&|r| r.left), share(&|r| r.right));
    match (left < NEVER, right < NEVER) {
        (true, true) => say("no-turns", "these runs hardly turn: what acts in turns does not show".into()),
        (true, false) | (false, true) => {
            let side = if left < NEVER { "right" } else { "left" };
            say(
                "one-turn-direction",
                format!("these runs turn to the {side} only: a bias, a constant creep and a wrong scale look alike"),
            );
        }
        _ => {}
    }
    let slow = runs.iter().filter_map(|r| r.speed).map(|s| s[0]).fold(f64::INFINITY, f64::min);
    let fast = runs.iter().filter_map(|r| r.speed).map(|s| s[2]).fold(0.0, f64::max);
    if fast > 0.0 && fast < ONE_SPEED * slow {
        let speed = significant(fast, 2);
        say(
            "one-speed",
            format!("these runs have one speed, {speed} m/s: what grows with speed looks like what does not"),
        );
    }
    if records.iter().all(|r| !r.has_heading) {
        say("no-heading", "no heading is measured: it is told from the path, and small angles hide in it".into());
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::unicycle_file;

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

    #[test]
    fn each_fault_of_a_run_is_told_by_itself() {
        let said = |r: RunHealth| {
            let found = findings(&[usual(), r], &[]);
            found
                .into_iter()
                .filter(|f| f.id != "no-heading")
                .map(|f| format!("{}: {}", f.id, f.says))
                .collect::<Vec<_>>()
        };
        assert_eq!(said(usual()), [""; 0]);
        let why_dropped = [("no pose".to_string(), 2), ("no input".to_string(), 4)].into();
        let cases = [
            (
                RunHealth { rows: 94, rows_dropped: 6, why_dropped, ..usual() },
                "rows-dropped: a.csv: 6 of 100 rows are left out (no input: 4, no pose: 2)",
            ),
            (
                RunHealth { gaps: 1, longest_gap_s: 2.5, ..usual() },
                "gaps: a.csv: the log is interrupted 1 times, by 2.50 s at most",
            ),
            (RunHealth { rate_hz: 0.02, ..usual() }, "time-unit: a.csv: rows are 50.0 s apart: is time in seconds?"),
            (
                RunHealth { jitter: 0.42, ..usual() },
                "uneven-times: a.csv: times between rows scatter by 42 %: are they those of measuring?",
            ),
            (
                RunHealth { way_ratio: Some(0.79), ..usual() },
                "way: a.csv: the measured way is 0.790 times what the model drives: check wheel_radius and the units of \
                 position and wheel rate",
            ),
            (
                RunHealth { turn_ratio: Some(1.26), ..usual() },
                "turning: a.csv: the measured turning is 1.26 times the model's: check track_width or wheelbase, and the \
                 units of heading and yaw rate",
            ),
        ];
        for (run, expected) in cases {
            assert_eq!(said(run), [expected]);
        }
    }

    /// What one run lacks another may have: shares of the time are those of all runs, by how long they last.
    #[test]
    fn turns_and_speeds_are_those_of_all_runs() {
        let ids = |runs: &[RunHealth]| {
            let found = findings(runs, &[]);
            found.into_iter().filter(|f| f.id != "no-heading").map(|f| f.id + &f.says).collect::<Vec<_>>().join("; ")
        };
        let lefts = RunHealth { right: 0.0, ..usual() };
        let straight = RunHealth { left: 0.0, ..lefts.clone() };
        assert!(ids(std::slice::from_ref(&straight)).starts_with("no-turns"));
        assert!(ids(std::slice::from_ref(&lefts)).starts_with("one-turn-directionthese runs turn to the left only"));
        let rights = RunHealth { left: 0.01, ..usual() };
        assert!(ids(std::slice::from_ref(&rights)).starts_with("one-turn-directionthese runs turn to the right only"));
        assert_eq!(ids(&[lefts.clone(), usual()]), "");
        assert!(ids(&[RunHealth { duration_s: 1000.0, ..lefts }, usual()]).starts_with("one-turn-direction"));
        let speed = |slow, fast| RunHealth { speed: Some([slow, slow, fast]), ..usual() };
        assert!(ids(&[speed(1.0, 1.1), speed(0.9, 1.0)]).starts_with("one-speedthese runs have one speed, 1.1 m/s"));
        assert_eq!(ids(&[speed(1.0, 1.1), speed(0.5, 0.6)]), "");
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
        let told = rows(&run, &record, 3);
        let close = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(close(told.duration_s, 5.8) && close(told.rate_hz, 10.0) && close(told.longest_gap_s, 2.0), "{told:?}");
        // Of 39 steps five are 0.14 s and five 0.06 s.
        assert!(close(told.jitter, 0.4), "{told:?}");
        assert_eq!((told.rows, told.rows_dropped, told.gaps, told.why_dropped[GROSS]), (40, 3, 1, 3));
    }
}
