//! Runs that are too short to say anything, beside others: their silence is no answer, and changes none.

use crate::simulator::{Hidden, Noise, Profile, Scenario, Signal, Tractor};
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::report::{Report, Verdict};
use creepage::discrepancy::request::Request;
use creepage::effects;
use creepage::files::{ModelFile, Run};
use creepage::model;
use creepage::progress::unheard;

fn scenario(hidden: &[Hidden], duration: f64, seed: u64) -> Scenario {
    let speed = Signal::constant(0.9) + Signal::wave(0.25, 11.0, 0.0);
    let profile = Profile { speed, turn: Signal::wave(0.5, 7.0, 1.0) };
    let usual = Scenario::new(Tractor::Unicycle, seed);
    Scenario { hidden: hidden.to_vec(), profile, duration, rate: 20.0, noise: Noise::MOCAP, ..usual }
}

fn read(scenario: &Scenario, name: &str) -> (ModelFile, Run) {
    let file = ModelFile::parse(&scenario.model_toml(), "model.toml", &model::known(effects::all())).unwrap();
    let run = Run::parse(name, &scenario.run().to_csv(9), &file).unwrap();
    (file, run)
}

fn discovered(file: &ModelFile, runs: &[Run], held_out: &[Run]) -> Report {
    let request = Request { file, runs, held_out, library: effects::all(), horizons: &[1.0], seed: 1 };
    discover(&request, &unheard).unwrap().report
}

#[test]
fn one_that_fills_no_window_is_left_out_and_told() {
    let hidden = [Hidden::RotationCreep { e_rc: 0.03 }];
    let (file, long) = read(&scenario(&hidden, 30.0, 1), "long.csv");
    let (_, held_out) = read(&scenario(&hidden, 12.0, 2), "held_out.csv");
    let tiny = |seed: u64| read(&scenario(&hidden, 1.0, seed), &format!("tiny-{seed}.csv")).1;
    let runs = [long, tiny(3), tiny(4), tiny(5)];
    let report = discovered(&file, &runs, &[held_out]);
    let ids: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
    assert_eq!((report.verdict, &ids[..]), (Verdict::MissingEffect, &["rotation-creep"][..]), "{}", report.summary);
    let told = |name: &str| report.data.warnings.iter().any(|w| w.starts_with(name) && w.contains("too short"));
    assert_eq!(
        ["long", "tiny-3", "tiny-4", "tiny-5"].map(told),
        [false, true, true, true],
        "{:?}",
        report.data.warnings
    );
}

/// A single window is compared with no next one: nothing is known of how well its model describes it.
#[test]
fn one_of_a_single_window_does_not_hide_that_the_inputs_are_of_another_drive() {
    let (file, mut run) = read(&scenario(&[], 30.0, 11), "run.csv");
    let other = scenario(&[], 30.0, 12);
    let turning = Profile { speed: Signal::wave(0.9, 4.0, 0.0), turn: Signal::wave(0.9, 3.0, 0.4) };
    run.inputs = read(&Scenario { profile: turning, ..other }, "other.csv").1.inputs;
    let (_, held_out) = read(&scenario(&[], 12.0, 13), "held_out.csv");
    let (_, single) = read(&scenario(&[], 1.8, 14), "single.csv");
    let alone = discovered(&file, std::slice::from_ref(&run), std::slice::from_ref(&held_out));
    assert_eq!(alone.verdict, Verdict::UnusableData, "{}", alone.summary);
    let beside = discovered(&file, &[run, single], &[held_out]);
    assert_eq!(beside.verdict, Verdict::UnusableData, "{}", beside.summary);
}

/// Inputs at 5 Hz that go to and fro in 0.6 s: what lies between their rows looks like an effect.
#[test]
fn one_whose_inputs_cannot_be_thinned_does_not_keep_the_others_from_it() {
    let speed = Signal::constant(1.0) + Signal::wave(0.4, 1.0 / 1.7, 0.0);
    let turn = Signal::wave(0.6, 1.0 / 1.7, 0.0) + Signal::wave(0.3, 12.6, 0.0);
    let drive = |duration: f64, seed: u64| {
        let usual = scenario(&[], duration, seed);
        Scenario { profile: Profile { speed: speed.clone(), turn: turn.clone() }, rate: 5.0, ..usual }
    };
    let (file, run) = read(&drive(60.0, 31), "run.csv");
    let (_, held_out) = read(&drive(20.0, 33), "held_out.csv");
    let (_, few) = read(&drive(2.0, 32), "few.csv");
    let alone = discovered(&file, std::slice::from_ref(&run), std::slice::from_ref(&held_out));
    let beside = discovered(&file, &[run, few], &[held_out]);
    assert!(alone.effects.is_empty() && beside.effects.is_empty(), "{}\n{}", alone.summary, beside.summary);
    assert_eq!(alone.verdict, beside.verdict, "{}\n{}", alone.summary, beside.summary);
}

/// The floor weighs runs as the gap does: by their windows.
#[test]
fn a_long_slow_run_and_a_short_fast_one_have_the_floor_of_both() {
    let noise = Noise { heading: 0.01, ..Noise::MOCAP };
    let at = |speed: f64, duration: f64, seed: u64| {
        let speed = Signal::constant(speed) + Signal::wave(0.2 * speed, 9.0, 0.0);
        let profile = Profile { speed, turn: Signal::wave(0.4, 12.0, 0.0) };
        Scenario { profile, noise, ..scenario(&[], duration, seed) }
    };
    let (file, fitted) = read(&at(1.0, 40.0, 41), "fitted.csv");
    let (slow, fast) = (read(&at(0.1, 120.0, 42), "slow.csv").1, read(&at(8.0, 12.0, 43), "fast.csv").1);
    let report = discovered(&file, &[fitted], &[slow, fast]);
    let [gap] = &report.gap[..] else { panic!("one horizon was asked for") };
    let (after, floor) = (gap.held_out.as_ref().unwrap().position_rms_after, gap.noise_floor.position_rms);
    assert!((after / floor - 1.0).abs() < 0.35, "{after} over {floor}");
}

/// The held-out run alone is long enough for the horizon.
#[test]
fn steps_are_told_only_where_the_fitted_runs_reach() {
    let hidden = [Hidden::RotationCreep { e_rc: 0.05 }];
    let (file, run) = read(&scenario(&hidden, 15.0, 51), "run.csv");
    let (_, held_out) = read(&scenario(&hidden, 40.0, 52), "held_out.csv");
    let request = Request {
        file: &file,
        runs: &[run],
        held_out: &[held_out],
        library: effects::all(),
        horizons: &[30.0],
        seed: 1,
    };
    let report = discover(&request, &unheard).unwrap().report;
    assert_eq!((report.effects.len(), report.steps.len()), (1, 0), "{:?}", report.steps);
    assert!(report.gap.iter().all(|g| g.fit.is_none() && g.held_out.is_some()));
}
