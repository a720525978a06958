//! Sensors whose errors do not scatter: poses that wander (filters, satellites), of which rows say less than their number, and
//! inputs that come in steps.

use crate::read_back::read_back;
use crate::simulator::{Hidden, Noise, Scenario, Tractor};
use creepage::discrepancy::check::check;
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::identifiability::Checked;
use creepage::discrepancy::report::{Report, Verdict};
use creepage::discrepancy::request::Request;
use creepage::effects;
use creepage::progress::unheard;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

/// Standard deviation of what wanders: m, and half as many rad.
const WANDERING: f64 = 0.01;

/// What `discover` says of a run whose measured pose wanders by a first-order Markov process with a correlation time, s.
fn report(scenario: &Scenario, time: f64) -> Report {
    let (file, mut run) = read_back(&scenario.model_toml(), &scenario.run().to_csv(9));
    let mut random = ChaCha8Rng::seed_from_u64(scenario.seed);
    let rows = run.time.clone();
    let mut wander = |column: &mut Vec<f64>, size: f64| {
        let mut error = random.sample::<f64, _>(StandardNormal);
        for i in 0..column.len() {
            if i > 0 {
                let kept = (-(rows[i] - rows[i - 1]) / time).exp();
                error = kept * error + (1.0 - kept * kept).sqrt() * random.sample::<f64, _>(StandardNormal);
            }
            column[i] += size * error;
        }
    };
    wander(&mut run.x, WANDERING);
    wander(&mut run.y, WANDERING);
    wander(run.heading.as_mut().unwrap(), WANDERING / 2.0);
    let runs = [run];
    let request =
        Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[1.0], seed: 5 };
    discover(&request, &unheard).unwrap().report
}

fn drive(tractor: Tractor, hidden: Vec<Hidden>, seed: u64) -> Scenario {
    Scenario { hidden, noise: Noise::MOCAP, rate: 50.0, ..Scenario::new(tractor, seed) }
}

#[test]
fn where_the_sensor_wanders_and_nothing_is_missing_nothing_is_named() {
    for (i, time) in [0.1, 1.0].into_iter().enumerate() {
        for tractor in [Tractor::Unicycle, Tractor::DifferentialDrive, Tractor::Car] {
            let report = report(&drive(tractor, vec![], 70 + i as u64), time);
            let ids: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
            assert!(ids.is_empty() && report.unnamed.is_empty(), "{tractor:?}, {time} s: {ids:?} {:?}", report.unnamed);
        }
    }
}

/// A pose that wanders within a fraction of a second is no disagreement of the model, and the floor knows how it wanders.
#[test]
fn a_sensor_that_wanders_is_no_disagreement() {
    for (seed, time) in [(75, 0.05), (76, 0.1)] {
        for tractor in [Tractor::Unicycle, Tractor::DifferentialDrive] {
            let report = report(&drive(tractor, vec![], seed), time);
            assert_eq!(
                report.verdict,
                Verdict::NoMissingEffect,
                "{tractor:?}, {time} s: {} {:?}",
                report.summary,
                report.remaining
            );
            let gap = &report.gap[0];
            let ratio = gap.held_out.as_ref().unwrap().position_rms_after / gap.noise_floor.position_rms;
            assert!((0.7..1.7).contains(&ratio), "{tractor:?}, {time} s: {ratio}");
        }
    }
}

#[test]
fn what_is_missing_is_named_although_the_sensor_wanders() {
    let track = Hidden::TrackWidth { scale: 0.05 };
    for time in [0.1, 1.0] {
        let report = report(&drive(Tractor::DifferentialDrive, vec![track], 81), time);
        assert_eq!(report.verdict, Verdict::MissingEffect);
        let ids: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
        assert_eq!(ids, ["track-width"], "{time} s");
        let found = &report.effects[0].parameters["scale"];
        let off = (found.value - 0.05) / found.std.unwrap();
        assert!(off.abs() < 3.0, "{time} s: {found:?}");
    }
}

/// Wheel rates in whole ticks: what they leave out is noise of the inputs, which nothing is missing for, and `check` says it
/// beforehand.
#[test]
fn inputs_that_come_in_steps_are_told() {
    let told = |step: f64| {
        let scenario = drive(Tractor::DifferentialDrive, vec![], 81);
        let (file, mut run) = read_back(&scenario.model_toml(), &scenario.run().to_csv(9));
        if step > 0.0 {
            run.inputs.iter_mut().flatten().for_each(|u| *u = (*u / step).round() * step);
        }
        let runs = [run];
        let request =
            Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[1.0], seed: 5 };
        let report = discover(&request, &unheard).unwrap().report;
        assert!(report.effects.is_empty(), "{}", report.summary);
        let said = |text: &String| text.contains("comes in steps of 0.40 rad/s");
        let checked = check(&Checked { file: &file, runs: &runs, library: effects::all() }, &unheard).unwrap();
        let beforehand = checked.data.findings.iter().filter(|f| f.id == "coarse-inputs" && said(&f.says)).count();
        let advised = report.next_experiment.is_some_and(|n| n.manoeuvre.contains("finer steps") && said(&n.why));
        (report.verdict, advised, report.data.warnings.iter().filter(|w| said(w)).count(), beforehand)
    };
    assert_eq!(told(0.4), (Verdict::NoMissingEffect, false, 0, 2));
    assert_eq!(told(0.0), (Verdict::NoMissingEffect, false, 0, 0));
}
