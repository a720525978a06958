//! Columns in other units, swapped or with the wrong sign: no effect is named for them, and the answer says what they look
//! like.

use crate::simulator::{Hidden, Log, Noise, Profile, Scenario, Signal, Tractor};
use creepage::discrepancy::check::check;
use creepage::discrepancy::check::check_aligned;
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::discover::discover_aligned;
use creepage::discrepancy::identifiability::{Checked, Standing};
use creepage::discrepancy::rendering::html::html;
use creepage::discrepancy::report::{Report, Verdict};
use creepage::discrepancy::request::Request;
use creepage::effects;
use creepage::files::{ModelFile, Run};
use creepage::model;
use creepage::progress::unheard;

const TIME: usize = 0;
const X: usize = 1;
const Y: usize = 2;
const HEADING: usize = 3;
/// The first of the inputs.
const INPUT: usize = 4;

/// A slip of the one who wrote the log.
type Slip<'a> = &'a dyn Fn(&mut [f64]);

/// A drive, something hidden in it or not, and its model.
fn driven(tractor: Tractor, hidden: &[Hidden]) -> (ModelFile, Log) {
    let usual = Scenario::new(tractor, 7);
    let s = Scenario { hidden: hidden.to_vec(), duration: 30.0, rate: 20.0, noise: Noise::MOCAP, ..usual };
    (ModelFile::parse(&s.model_toml(), "model.toml", &model::known(effects::all())).unwrap(), s.run())
}

fn answers(file: &ModelFile, runs: &[Run], held_out: &[Run]) -> Report {
    let request = Request { file, runs, held_out, library: effects::all(), horizons: &[], seed: 1 };
    discover(&request, &unheard).unwrap().report
}

fn slipped(file: &ModelFile, log: &Log, slip: Slip) -> Run {
    let mut log = log.clone();
    log.rows.iter_mut().for_each(|row| slip(row));
    Run::parse("slipped.csv", &log.to_csv(9), file).unwrap()
}

/// Demands that a slip makes the data unusable, with this word in the reason and nothing named.
#[track_caller]
fn is_told(tractor: Tractor, slip: Slip, word: &str) {
    let (file, log) = driven(tractor, &[Hidden::RotationCreep { e_rc: 0.03 }]);
    let report = answers(&file, &[slipped(&file, &log, slip)], &[]);
    assert_eq!(report.verdict, Verdict::UnusableData, "{}", report.summary);
    assert!(report.summary.contains("slipped.csv") && report.summary.contains(word), "{word}: {}", report.summary);
    assert!(report.effects.is_empty() && report.unnamed.is_empty() && report.data.warnings.is_empty());
}

/// Demands the same of `check`, before anything is fitted.
#[track_caller]
fn is_told_at_once(tractor: Tractor, slip: Slip, word: &str) {
    is_told(tractor, slip, word);
    let (file, log) = driven(tractor, &[]);
    let runs = [slipped(&file, &log, slip)];
    let answer = check(&Checked { file: &file, runs: &runs, library: effects::all() }, &unheard).unwrap();
    assert_eq!(answer.verdict, Standing::UnusableData, "{}", answer.summary);
    assert!(answer.summary.contains(word), "{word}: {}", answer.summary);
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;

#[test]
fn times_that_are_no_seconds() {
    for unit in [1e3, 1e6, 1e9] {
        is_told_at_once(Tractor::Unicycle, &|row| row[TIME] *= unit, "is time in seconds");
        is_told_at_once(Tractor::Car, &|row| row[TIME] *= unit, "is time in seconds");
    }
}

#[test]
fn inputs_in_other_units() {
    let wheels = |row: &mut [f64]| row[INPUT..].iter_mut().for_each(|u| *u /= DEGREE);
    is_told_at_once(Tractor::DifferentialDrive, &wheels, "are in degrees per second");
    is_told_at_once(Tractor::Unicycle, &|row| row[INPUT + 1] /= DEGREE, "in degrees");
    is_told_at_once(Tractor::Car, &|row| row[INPUT] *= 1e3, "are the inputs in SI units?");
    is_told_at_once(Tractor::Unicycle, &|row| row[INPUT] *= 1e3, "is a speed in millimetres per second");
}

#[test]
fn poses_in_other_units() {
    let by = |factor: f64| move |row: &mut [f64]| [X, Y].into_iter().for_each(|c| row[c] *= factor);
    is_told_at_once(Tractor::Unicycle, &by(1e3), "the position is in millimetres");
    is_told_at_once(Tractor::Car, &by(1e2), "the position is in centimetres");
    let globe = |row: &mut [f64]| {
        row[X] = 9.2 + row[X] / 75e3;
        row[Y] = 48.7 + row[Y] / 111e3;
    };
    is_told_at_once(Tractor::DifferentialDrive, &globe, "degrees of latitude and longitude");
    is_told_at_once(Tractor::Car, &|row| row[HEADING] /= DEGREE, "heading in degrees");
}

#[test]
fn mirror_images() {
    for tractor in [Tractor::Unicycle, Tractor::Car] {
        is_told_at_once(tractor, &|row| row.swap(X, Y), "x and y are swapped");
        is_told_at_once(tractor, &|row| row[Y] = -row[Y], "y has the wrong sign");
    }
    is_told_at_once(Tractor::Unicycle, &|row| row[HEADING] = -row[HEADING], "the heading counts clockwise");
    is_told_at_once(Tractor::Unicycle, &|row| row[INPUT + 1] = -row[INPUT + 1], "yaw_rate has the wrong sign");
}

/// A wheel rate in turns per minute is no wheel of another size: nothing is named, and the line to paste is told.
#[test]
fn turns_per_minute_are_a_unit() {
    let per_minute = |row: &mut [f64]| row[INPUT] *= 60.0 / std::f64::consts::TAU;
    is_told_at_once(Tractor::Unicycle, &per_minute, "is in turns per minute (rpm)");
    is_told_at_once(Tractor::Unicycle, &per_minute, "unit = \"rpm\"");
}

/// A gyro that says a straight drive turns has a bias; nobody mixed up its units.
#[test]
fn a_bias_on_a_straight_line_is_no_slip() {
    let profile = Profile { speed: Signal::wave(0.9, 11.0, 0.4), turn: Signal::constant(-0.03) };
    let hidden = vec![Hidden::YawRateBias { bias: 0.03 }];
    let usual = Scenario::new(Tractor::Unicycle, 7);
    let s = Scenario { hidden, profile, duration: 30.0, rate: 20.0, noise: Noise::MOCAP, ..usual };
    let file = ModelFile::parse(&s.model_toml(), "model.toml", &model::known(effects::all())).unwrap();
    let report = answers(&file, &[Run::parse("straight.csv", &s.run().to_csv(9), &file).unwrap()], &[]);
    let [found] = &report.effects[..] else { panic!("{}", report.summary) };
    assert_eq!(found.id, "yaw-rate-bias");
}

/// The measured path and the model's, side by side, show a mirror image at once; there is no other model to show.
#[test]
fn the_picture_shows_what_is_wrong() {
    let (file, log) = driven(Tractor::Unicycle, &[]);
    let runs = [slipped(&file, &log, &|row| row.swap(X, Y))];
    let request = Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[], seed: 1 };
    let found = discover(&request, &unheard).unwrap();
    let [path] = &found.pictures.paths[..] else { panic!("{:?}", found.pictures.paths.len()) };
    assert!(!path.before.is_empty() && path.after.is_empty());
    let page = html(&found.report, &found.pictures);
    assert!(page.contains(">model as given<") && page.contains("restarted at every ring.</"), "{page}");
    assert!(!page.contains(">patched model<"));
}

/// A run that is held out is looked at, too, and so are inputs with a clock of their own.
#[test]
fn no_way_in_leads_past() {
    let (file, log) = driven(Tractor::Unicycle, &[]);
    let milliseconds = slipped(&file, &log, &|row| row[TIME] *= 1e3);
    let usual = slipped(&file, &log, &|_| ());
    assert_eq!(answers(&file, std::slice::from_ref(&usual), &[]).verdict, Verdict::NoMissingEffect);
    let held_out = answers(&file, &[usual], std::slice::from_ref(&milliseconds));
    assert!(held_out.verdict == Verdict::UnusableData && held_out.summary.contains("is time in seconds"));
    let dir = tempfile::tempdir().unwrap();
    let path = |name: &str| dir.path().join(name);
    let part = |columns: std::ops::Range<usize>, unit: f64| {
        let line = |row: &Vec<f64>| {
            let cells: Vec<String> = std::iter::once(row[TIME] * unit)
                .chain(row[columns.clone()].iter().copied())
                .map(|v| v.to_string())
                .collect();
            cells.join(",")
        };
        let head = [&log.columns[..1], &log.columns[columns.clone()]].concat().join(",");
        format!("{head}\n{}\n", log.rows.iter().map(line).collect::<Vec<_>>().join("\n"))
    };
    std::fs::write(path("in.csv"), part(INPUT..log.columns.len(), 1e3)).unwrap();
    std::fs::write(path("poses.csv"), part(X..INPUT, 1.0)).unwrap();
    let apart = [Run::read_apart(path("in.csv"), path("poses.csv"), &file).unwrap()];
    let request = Request { file: &file, runs: &apart, held_out: &[], library: effects::all(), horizons: &[], seed: 1 };
    let report = discover_aligned(&request, None, &unheard).unwrap().report;
    assert!(
        report.verdict == Verdict::UnusableData && report.summary.contains("is time in seconds"),
        "{}",
        report.summary
    );
    let answer =
        check_aligned(&Checked { file: &file, runs: &apart, library: effects::all() }, None, &unheard).unwrap();
    assert!(answer.verdict == Standing::UnusableData && answer.summary.contains("is time in seconds"));
}
