//! Drives that are not alike: what one of them shows is named, though the others, which hardly show it, could not have
//! foretold it; what is asked of all of them is not.

use crate::simulator::{Hidden, Noise, Profile, Scenario, Signal, Tractor};
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::estimation::fit::Effort;
use creepage::discrepancy::estimation::problem::Problem;
use creepage::discrepancy::record::run_record::Record;
use creepage::discrepancy::report::{Named, Report, Verdict};
use creepage::discrepancy::request::Request;
use creepage::effects::{self, Applied};
use creepage::files::{ModelFile, Run};
use creepage::model::{self, Model};
use creepage::progress::unheard;

/// Straight ahead but for what no driver can help: 4 mrad/s, or 4 mrad of steering.
fn straight() -> Profile {
    let speed = Signal::constant(0.9) + Signal::wave(0.15, 9.0, 0.3);
    Profile { speed, turn: Signal::wave(0.004, 5.0, 0.0) }
}

/// To the left throughout.
fn curved() -> Profile {
    let speed = Signal::constant(0.9) + Signal::wave(0.25, 11.0, 0.0);
    Profile { speed, turn: Signal::constant(0.35) + Signal::wave(0.15, 7.0, 1.0) }
}

fn scenario(tractor: Tractor, hidden: &[Hidden], profile: Profile, seed: u64) -> Scenario {
    let usual = Scenario::new(tractor, seed);
    Scenario { hidden: hidden.to_vec(), profile, duration: 25.0, rate: 20.0, noise: Noise::MOCAP, ..usual }
}

/// What a user would have of some drives.
fn logged(drives: &[Scenario]) -> (ModelFile, Vec<Run>) {
    let file = ModelFile::parse(&drives[0].model_toml(), "model.toml", &model::known(effects::all())).unwrap();
    let run = |(i, s): (usize, &Scenario)| Run::parse(&format!("run-{i}.csv"), &s.run().to_csv(9), &file).unwrap();
    let runs = drives.iter().enumerate().map(run).collect();
    (file, runs)
}

fn discovered(drives: &[Scenario]) -> Report {
    let (file, runs) = logged(drives);
    let request =
        Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[1.0], seed: 1 };
    discover(&request, &unheard).unwrap().report
}

/// Demands that one drive that turns and up to three that do not are answered with one effect.
#[track_caller]
fn named(tractor: Tractor, hidden: Hidden, parameter: &str, truth: f64) {
    for others in 1..=3 {
        let hidden = [hidden];
        let ahead = (0..others).map(|seed| scenario(tractor, &hidden, straight(), 10 + seed));
        let drives: Vec<Scenario> = ahead.chain([scenario(tractor, &hidden, curved(), 20)]).collect();
        let report = discovered(&drives);
        let ids: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
        assert_eq!((report.verdict, &ids[..]), (Verdict::MissingEffect, &[hidden[0].id().unwrap()][..]), "{others}");
        let found = &report.effects[0].parameters[parameter];
        assert!((found.value - truth).abs() < 4.0 * found.std.unwrap(), "{found:?}");
    }
}

#[test]
fn the_track_width_shows_where_it_turns() {
    named(Tractor::DifferentialDrive, Hidden::TrackWidth { scale: 0.05 }, "scale", 0.05);
}

#[test]
fn the_scale_of_a_gyro_shows_where_it_turns() {
    named(Tractor::Unicycle, Hidden::YawRateScale { scale: -0.04 }, "scale", -0.04);
}

#[test]
fn creep_with_the_load_shows_where_it_turns() {
    named(Tractor::Unicycle, Hidden::LoadDependentCreep { c: 0.05 }, "c", 0.05);
}

#[test]
fn the_gain_of_the_steering_shows_where_it_turns() {
    named(Tractor::Car, Hidden::SteeringGain { scale: 0.06 }, "scale", 0.06);
}

/// No way is gone of which most could be missed; wheels that creep alike turn as ones farther apart do.
#[test]
fn a_turn_on_the_spot_shows_the_track_width_or_creep() {
    let turn = Signal::constant(0.9) + Signal::wave(0.3, 6.0, 0.0);
    let profile = Profile { speed: Signal::constant(0.0), turn };
    let hidden = [Hidden::TrackWidth { scale: 0.05 }];
    let drive = Scenario { rate: 50.0, ..scenario(Tractor::DifferentialDrive, &hidden, profile, 53) };
    let report = discovered(&[drive]);
    let named =
        |e: &Named| [vec![e.id.clone()], e.indistinguishable_from.iter().map(|r| r.id.clone()).collect()].concat();
    let all: Vec<Vec<String>> = report.effects.iter().map(named).collect();
    assert_eq!((report.verdict, all.len()), (Verdict::MissingEffect, 1), "{}", report.summary);
    assert!(["rotation-creep", "track-width"].iter().all(|id| all[0].iter().any(|a| a == id)), "{all:?}");
}

/// Gyros of opposite scale: each drive alone would name one, the other says it is not so.
#[test]
fn what_the_drives_contradict_is_not_named() {
    let turn = |scale, seed| scenario(Tractor::Unicycle, &[Hidden::YawRateScale { scale }], curved(), seed);
    let report = discovered(&[turn(0.05, 1), turn(-0.03, 2)]);
    let ids: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
    assert_eq!((report.verdict, &ids[..]), (Verdict::Unexplained, &[][..]));
}

/// By how much less deviance each of two runs is missed with the scale of a gyro as the other run gives it.
fn missed_less(scales: [f64; 2]) -> f64 {
    let drive = |(seed, scale)| scenario(Tractor::Unicycle, &[Hidden::YawRateScale { scale }], curved(), seed);
    let (file, runs) = logged(&[(1, scales[0]), (2, scales[1])].map(drive));
    let model = Model::from_file(&file, effects::all(), &runs[0].roles).unwrap();
    let problem = Problem::new(runs.iter().map(|r| Record::of_run(r, file.input_timing, 0)).collect(), None, None);
    let fit = |model: &Model| {
        let effort = Effort { passes: 20, ..Effort::FULL };
        problem.fit(model, &problem.starts(model).unwrap(), &problem.variances, effort).unwrap().unwrap()
    };
    let scale = Applied::new(effects::named("yaw-rate-scale").unwrap(), None, vec![0.0]).freed();
    let without = fit(&model);
    problem.missed_less(&fit(&model.with_effect(scale)), &without).unwrap()
}

/// Two runs are parts of their own: blocks of both would tell each what it says itself.
#[test]
fn a_run_is_asked_what_the_other_says() {
    let (alike, unlike) = (missed_less([0.05, 0.05]), missed_less([0.05, 0.01]));
    assert!(alike > 100.0 && unlike < 0.0, "{alike} {unlike}");
}

#[test]
fn nothing_is_named_where_nothing_is_hidden() {
    for seed in 0..3 {
        let ahead = scenario(Tractor::DifferentialDrive, &[], straight(), 30 + seed);
        let report = discovered(&[ahead, scenario(Tractor::DifferentialDrive, &[], curved(), 40 + seed)]);
        assert_eq!((report.verdict, report.effects.len()), (Verdict::NoMissingEffect, 0));
    }
}
