//! Logs with few rows a second, as satellites and cheap loggers write them: neither the smoothing of poses nor the steps
//! of the integration may make up a disagreement.

use crate::simulator::{Hidden, Noise, Profile, Scenario, Signal, Tractor};
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::report::{Report, Verdict};
use creepage::discrepancy::request::Request;
use creepage::effects;
use creepage::files::{ModelFile, Run};
use creepage::model;
use creepage::progress::unheard;

/// What a robot logged that often says, turning slowly enough for rows a second apart.
fn answer(rate: f64, hidden: &[Hidden], seed: u64) -> Report {
    driven([11.0, 17.0], rate, hidden, seed)
}

/// The same with other periods of speed and turn.
fn driven([speed, turn]: [f64; 2], rate: f64, hidden: &[Hidden], seed: u64) -> Report {
    let usual = Scenario::new(Tractor::DifferentialDrive, seed);
    let profile = Profile { speed: Signal::wave(0.9, speed, 0.4), turn: Signal::wave(0.7, turn, 1.0) };
    let s = Scenario { profile, hidden: hidden.to_vec(), duration: 100.0, rate, noise: Noise::MOCAP, ..usual };
    let file = ModelFile::parse(&s.model_toml(), "model.toml", &model::known(effects::all())).unwrap();
    let run = Run::parse("run.csv", &s.run().to_csv(9), &file).unwrap();
    let request = Request { file: &file, runs: &[run], held_out: &[], library: effects::all(), horizons: &[], seed: 1 };
    discover(&request, &unheard).unwrap().report
}

/// The model, with what was added, predicts a second to the noise; of longer stretches there are too few to ask.
#[track_caller]
fn at_the_floor(report: &Report, rate: f64) {
    let [left, floor] =
        report.gap.first().map(|g| [g.fit.unwrap().position_rms_after, g.noise_floor.position_rms]).unwrap();
    assert!(left < 1.2 * floor, "{rate} Hz: {left} m, floor {floor} m");
}

#[test]
fn nothing_is_missing_at_any_rate() {
    for rate in [2.0, 2.6, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0] {
        let report = answer(rate, &[], 70 + rate as u64);
        assert_eq!(report.verdict, Verdict::NoMissingEffect, "{rate} Hz: {}", report.summary);
        at_the_floor(&report, rate);
        for c in report.remaining.unwrap().constraints {
            assert!(c.rms < 1.5 * c.noise, "{rate} Hz: {} {}, noise {}", c.place, c.rms, c.noise);
        }
    }
}

#[test]
fn what_is_missing_is_named_and_nothing_beside_it() {
    for rate in [1.0, 2.0, 3.0, 5.0, 7.0] {
        let report = answer(rate, &[Hidden::TrackWidth { scale: 0.05 }], 80 + rate as u64);
        let ids: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
        assert_eq!((ids, report.unnamed.len()), (vec!["track-width"], 0), "{rate} Hz: {}", report.summary);
        let scale = &report.effects[0].parameters["scale"];
        assert!((scale.value - 0.05).abs() < 0.002, "{rate} Hz: {scale:?}");
        at_the_floor(&report, rate);
    }
}

/// Inputs that change faster than they are logged: what the interpolation misses is no effect, and the report says what to do.
#[test]
fn what_comes_with_the_interpolation_is_not_named() {
    for periods in [[10.0, 13.0], [6.0, 7.0], [5.0, 6.0]] {
        let report = driven(periods, 1.0, &[], 90);
        assert_eq!(report.verdict, Verdict::NotIdentifiable, "{periods:?}: {}", report.summary);
        assert!(report.effects.is_empty() && report.unnamed.is_empty());
        let warned = &report.data.warnings[0];
        assert!(
            warned.starts_with("with every second row of the inputs left out these runs ask for other"),
            "{warned}"
        );
        assert!(report.next_experiment.unwrap().manoeuvre.starts_with("log the inputs several times as often"));
    }
}

/// What is there does not come with the interpolation, and stays while what comes goes.
#[test]
fn what_is_there_stays_where_inputs_are_logged_too_seldom() {
    for (periods, moved) in [([10.0, 13.0], 0.001), ([6.0, 7.0], 0.004)] {
        let report = driven(periods, 1.0, &[Hidden::TrackWidth { scale: 0.05 }], 190);
        assert_eq!(report.verdict, Verdict::MissingEffect, "{periods:?}: {}", report.summary);
        let ids: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
        assert_eq!((ids, report.unnamed.len()), (vec!["track-width"], 0), "{periods:?}: {}", report.summary);
        let scale = &report.effects[0].parameters["scale"];
        assert!((scale.value - 0.05).abs() < moved, "{periods:?}: {scale:?}");
        // What the interpolation may make up of the value is in its deviation: a bound, a few times what it does.
        assert!((scale.value - 0.05).abs() < 2.5 * scale.std.unwrap(), "{periods:?}: {scale:?}");
        assert!(scale.std.unwrap() < 3.0 * moved, "{periods:?}: {scale:?}");
        let left_out = report.data.warnings.iter().any(|w| w.contains("every second row of the inputs left out"));
        assert_eq!(left_out, periods[0] == 6.0, "{:?}", report.data.warnings);
    }
}

/// Four rows a turn: what is measured is taken for scatter, but the vehicle is not said to stand.
#[test]
fn poses_too_far_apart_are_not_called_a_vehicle_that_stands() {
    let report = driven([4.0, 5.0], 1.0, &[], 90);
    assert_eq!(report.verdict, Verdict::UnusableData, "{}", report.summary);
    assert!(report.summary.starts_with("The inputs say that the vehicle moves"), "{}", report.summary);
    assert!(report.next_experiment.unwrap().manoeuvre.starts_with("log the poses several times as often"));
}
