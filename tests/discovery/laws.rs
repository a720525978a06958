//! Laws of `discover`: what must not change its answer, and what it must say of data that cannot answer.

use crate::simulator::{Hidden, Log, Noise, Profile, Scenario, Tractor};
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::discovery::Discovery;
use creepage::discrepancy::report::{Named, Verdict};
use creepage::discrepancy::request::Request;
use creepage::files::{ModelFile, Run};
use creepage::progress::unheard;
use creepage::{effects, model};
use std::f64::consts::TAU;
use std::path::Path;
use std::sync::LazyLock;

/// A slipping unicycle with a biased gyro, told from noise within half a minute.
fn slipping(seed: u64) -> Scenario {
    let hidden = vec![Hidden::TraverseCreep { e_tc: 0.06 }, Hidden::YawRateBias { bias: 0.02 }];
    Scenario { hidden, duration: 30.0, noise: Noise::MOCAP, ..Scenario::new(Tractor::Unicycle, seed) }
}

fn read(folder: &Path, model: &str) -> ModelFile {
    let path = folder.join("model.toml");
    std::fs::write(&path, model).unwrap();
    ModelFile::read(&path, &model::known(effects::all())).unwrap()
}

fn runs(folder: &Path, file: &ModelFile, kind: &str, logs: &[&Log]) -> Vec<Run> {
    let run = |(i, log): (usize, &&Log)| {
        let path = folder.join(format!("{kind}_{i}.csv"));
        // Every digit: a law is not blurred by the file.
        std::fs::write(&path, log.to_csv(17)).unwrap();
        Run::read(&path, file).unwrap()
    };
    logs.iter().enumerate().map(run).collect()
}

fn discovery(model: &str, fitted: &[&Log], held_out: &[&Log]) -> Discovery {
    let folder = tempfile::tempdir().unwrap();
    let file = read(folder.path(), model);
    let (fitted, held_out) =
        (runs(folder.path(), &file, "run", fitted), runs(folder.path(), &file, "held_out", held_out));
    let request = Request {
        file: &file,
        runs: &fitted,
        held_out: &held_out,
        library: effects::all(),
        horizons: &[1.0, 5.0],
        seed: 3,
    };
    discover(&request, &unheard).unwrap()
}

fn ids(effects: &[Named]) -> Vec<&str> {
    effects.iter().map(|e| e.id.as_str()).collect()
}

const SLIPPING: [&str; 2] = ["traverse-creep", "yaw-rate-bias"];

/// A log, its model file, and what is discovered in it: what several laws compare with.
static USUAL: LazyLock<(Log, String, Discovery)> = LazyLock::new(|| {
    let scenario = slipping(1);
    let (log, model) = (scenario.run(), scenario.model_toml());
    let found = discovery(&model, &[&log], &[]);
    (log, model, found)
});

/// Demands that the usual log with its rows changed is answered the same.
#[track_caller]
fn changes_nothing(change: impl Fn(usize, &mut Vec<f64>)) {
    let (log, model, found) = &*USUAL;
    alike(found, &discovery(model, &[&changed(log, change)], &[]));
}

/// The same effects with the same values.
#[track_caller]
fn alike(a: &Discovery, b: &Discovery) {
    assert_eq!(ids(&a.report.effects), SLIPPING);
    assert_eq!(ids(&b.report.effects), SLIPPING);
    assert_eq!(a.report.verdict, b.report.verdict);
    for (a, b) in a.report.effects.iter().zip(&b.report.effects) {
        for (name, value) in &a.parameters {
            let other = &b.parameters[name];
            let close = |x: f64, y: f64, within: f64| (x - y).abs() <= within * x.abs();
            // Rounding decides where the search for the variances stops, on a likelihood that is flat there.
            let slack = 0.002 * value.std.unwrap();
            let same = close(value.value, other.value, 1e-6) || (value.value - other.value).abs() < slack;
            assert!(same, "{name}: {value:?} and {other:?}");
            assert!(close(value.std.unwrap(), other.std.unwrap(), 1e-3), "{name}: {value:?} and {other:?}");
        }
    }
}

/// A log whose rows were changed.
fn changed(log: &Log, change: impl Fn(usize, &mut Vec<f64>)) -> Log {
    let mut log = log.clone();
    log.rows.iter_mut().enumerate().for_each(|(i, row)| change(i, row));
    log
}

#[test]
fn a_rigid_motion_of_the_plane_changes_nothing() {
    let turn: f64 = 1.1;
    changes_nothing(|_, row| {
        let (x, y) = (row[1], row[2]);
        row[1] = turn.cos() * x - turn.sin() * y + 12.0;
        row[2] = turn.sin() * x + turn.cos() * y - 7.0;
        row[3] += turn;
    });
}

fn shifted_in_time(rate: f64, by: f64) -> [Discovery; 2] {
    let scenario = Scenario { rate, ..slipping(2) };
    let log = scenario.run();
    let later = changed(&log, |_, row| row[0] += by);
    let model = scenario.model_toml();
    [discovery(&model, &[&log], &[]), discovery(&model, &[&later], &[])]
}

#[test]
fn a_shift_of_time_changes_nothing() {
    // Times that binary fractions hold exactly.
    let [now, later] = shifted_in_time(32.0, 1024.0);
    alike(&now, &later);
}

#[test]
fn a_shift_of_rounded_times_is_far_below_the_deviation() {
    let [now, later] = shifted_in_time(25.0, 1000.0);
    alike(&now, &later);
    for (a, b) in now.report.effects.iter().zip(&later.report.effects) {
        for (name, a) in &a.parameters {
            let b = &b.parameters[name];
            assert!((a.value - b.value).abs() < 0.05 * a.std.unwrap(), "{name}: {a:?} and {b:?}");
        }
    }
}

#[test]
fn the_order_of_runs_changes_nothing() {
    let (one, two) = (slipping(3), slipping(4));
    let (first, second) = (one.run(), two.run());
    let model = one.model_toml();
    alike(&discovery(&model, &[&first, &second], &[]), &discovery(&model, &[&second, &first], &[]));
}

#[test]
fn wrapped_headings_are_unwrapped() {
    // Begun just short of half a turn.
    let scenario = Scenario { start: [0.0, 0.0, 3.1], ..slipping(5) };
    let log = scenario.run();
    let wrapped = Scenario { wrap_heading: true, ..scenario.clone() }.run();
    let headings = |log: &Log| log.column("phi");
    let jumps = headings(&wrapped).windows(2).filter(|w| (w[1] - w[0]).abs() > 3.0).count();
    assert!(jumps > 0 && headings(&log) != headings(&wrapped), "this drive never turns past half a turn");
    let model = scenario.model_toml();
    alike(&discovery(&model, &[&log], &[]), &discovery(&model, &[&wrapped], &[]));
}

#[test]
fn a_seed_gives_one_report_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = slipping(6);
    let file = read(folder.path(), &scenario.model_toml());
    let runs = runs(folder.path(), &file, "run", &[&scenario.run()]);
    let report = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let request =
            Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[], seed: 5 };
        let found = pool.install(|| discover(&request, &unheard)).unwrap();
        serde_json::to_string(&found.report).unwrap()
    };
    let alone = report(1);
    assert_eq!(alone, report(2));
    assert_eq!(alone, report(2));
}

/// The measured pose in ruins.
fn ruined(i: usize, row: &mut [f64]) {
    let k = i as f64;
    row[1] += 5.0 * (0.7 * k).sin() - 30.0;
    row[2] -= 4.0 * (1.3 * k).cos() + 20.0;
    row[3] += (0.9 * k).sin();
}

#[track_caller]
fn same_choice(a: &Discovery, b: &Discovery) {
    assert_eq!(ids(&a.report.effects), SLIPPING);
    assert_eq!(a.report.effects, b.report.effects);
    assert_eq!((a.report.verdict, &a.report.steps), (b.report.verdict, &b.report.steps));
    assert_eq!(a.report.disagreement, b.report.disagreement);
    let gap = |d: &Discovery| d.report.gap[0].held_out.unwrap().position_rms_after;
    assert!(gap(b) > 10.0 * gap(a), "the ruin must show where it is judged: {} {}", gap(a), gap(b));
}

#[test]
fn the_held_out_quarter_never_influences_the_choice() {
    // The last fitted window begins a third of a second before the cut: smoothing there could reach across.
    let scenario = Scenario { duration: 29.1, ..slipping(7) };
    let log = scenario.run();
    let cut = 0.75 * scenario.duration;
    let broken = changed(&log, |i, row| {
        if row[0] >= cut {
            ruined(i, row);
        }
    });
    let model = scenario.model_toml();
    same_choice(&discovery(&model, &[&log], &[]), &discovery(&model, &[&broken], &[]));
}

#[test]
fn a_held_out_file_never_influences_the_choice() {
    let (scenario, other) = (slipping(8), slipping(9).run());
    let broken = changed(&other, |i, row| {
        ruined(i, row);
        row[4] *= 3.0;
        row[5] -= 1.0;
    });
    let (log, model) = (scenario.run(), scenario.model_toml());
    same_choice(&discovery(&model, &[&log], &[&other]), &discovery(&model, &[&log], &[&broken]));
}

#[test]
fn the_patched_model_has_nothing_missing() {
    let scenario = slipping(10);
    let log = scenario.run();
    let folder = tempfile::tempdir().unwrap();
    let file = read(folder.path(), &scenario.model_toml());
    let first = discovery(&scenario.model_toml(), &[&log], &[]);
    assert_eq!(ids(&first.report.effects), SLIPPING);
    let again = discovery(&first.patched(&file), &[&log], &[]);
    assert_eq!((again.report.verdict, ids(&again.report.effects)), (Verdict::NoMissingEffect, vec![]));
    // What was after is now before.
    let (after, before) = (first.report.gap[0].held_out.unwrap(), again.report.gap[0].held_out.unwrap());
    assert!((after.position_rms_after / before.position_rms_before - 1.0).abs() < 1e-9);
}

#[test]
fn a_short_run_cannot_tell() {
    let scenario = Scenario { duration: 5.0, ..slipping(11) };
    let found = discovery(&scenario.model_toml(), &[&scenario.run()], &[]);
    assert_eq!((found.report.verdict, ids(&found.report.effects)), (Verdict::NotIdentifiable, vec![]));
    assert!(found.report.next_experiment.is_some() && found.added.is_empty());
}

#[test]
fn a_vehicle_that_stands_cannot_be_judged() {
    let profile = Profile::constant(0.0, 0.0);
    let scenario = Scenario { profile, hidden: vec![], ..slipping(12) };
    let found = discovery(&scenario.model_toml(), &[&scenario.run()], &[]);
    assert_eq!((found.report.verdict, ids(&found.report.effects)), (Verdict::UnusableData, vec![]));
    assert!(found.report.summary.contains("does not move"), "{}", found.report.summary);
    assert!(found.added.is_empty());
}

#[test]
fn full_turns_of_every_heading_change_nothing() {
    changes_nothing(|_, row| row[3] += 3.0 * TAU);
}
