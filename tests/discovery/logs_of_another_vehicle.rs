//! A log of another vehicle than the model file says: the vehicle that explains it is told, and no cause is named.

use crate::noisy_run::noisy_run;
use creepage::{Model, Pose, Report, Run, Verdict};

const PARAMETERS: &str = "[parameters]\nwheel_radius = 0.2\nwheelbase = 1.4\n";
/// How far a wheel is from the middle of its axle, m.
const HALF_TRACK: f64 = 0.35;

fn model(vehicle: &str) -> Model {
    let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
    std::fs::write(file.path(), format!("vehicle = \"{vehicle}\"\n{PARAMETERS}")).unwrap();
    Model::read(file.path()).unwrap()
}

fn time() -> Vec<f64> {
    (0..1200).map(|i| 0.05 * f64::from(i)).collect()
}

fn rates(seed: u64) -> Vec<f64> {
    time().iter().map(|t| 5.0 + 2.0 * (0.3 * t + seed as f64).sin()).collect()
}

fn angles(seed: u64) -> Vec<f64> {
    time().iter().map(|t| 0.4 * (0.31 * t + seed as f64).sin() + 0.15 * (0.83 * t).cos()).collect()
}

/// A run of a vehicle, logged with other columns than those that drove it.
fn logged(vehicle: &str, seed: u64, columns: impl Fn(f64, f64) -> [f64; 2]) -> Run {
    let driven = vec![("wheel_rate", rates(seed)), ("steering_angle", angles(seed))];
    let run = noisy_run(&model(vehicle), time(), driven, 3e-3, seed);
    let logged = rates(seed).into_iter().zip(angles(seed)).map(|(w, d)| columns(w, d));
    let [rate, angle] = logged.fold([vec![], vec![]], |[mut rate, mut angle], [w, d]| {
        rate.push(w);
        angle.push(d);
        [rate, angle]
    });
    let pose = Pose { x: run.x, y: run.y, heading: run.heading, ..Pose::default() };
    Run::new(run.time, pose, vec![("wheel_rate", rate), ("steering_angle", angle)]).unwrap()
}

fn answer(vehicle: &str, columns: impl Fn(f64, f64) -> [f64; 2]) -> Report {
    let runs = [logged(vehicle, 1, &columns), logged(vehicle, 2, &columns)];
    creepage::discover(&model("car"), &runs).unwrap().report
}

#[track_caller]
fn tells(report: &Report, mend: &str) {
    assert_eq!(report.verdict, Verdict::Unexplained, "{}", report.summary);
    assert!(report.effects.is_empty() && report.unnamed.is_empty(), "{}", report.summary);
    let found = report.data.findings.iter().find(|f| f.id == "other-vehicle").expect("told");
    assert!(found.mend.as_deref().is_some_and(|m| m.starts_with(mend)), "{found:?}");
    assert!(report.summary.contains(&found.says.trim_end_matches('.')[..60]), "{}", report.summary);
}

#[test]
fn a_tricycle_is_told_from_a_car() {
    tells(&answer("tricycle", |w, d| [w, d]), "vehicle = \"tricycle\"");
}

/// tan δ = L/R about a centre of turning at R to the left, and R − b for a wheel that is b to the left.
#[test]
fn the_angle_of_one_front_wheel_is_told() {
    let of_wheel = |d: f64| (1.4 * d.tan() / (1.4 - HALF_TRACK * d.tan())).atan();
    let report = answer("car", |w, d| [w, of_wheel(d)]);
    tells(&report, "[[effects]]\nid = \"steering-of-one-wheel\"\nleft = 0.3");
}

/// The wheel on the right goes about the same centre, further out in a turn to the left.
#[test]
fn the_rate_of_one_rear_wheel_is_told() {
    let report = answer("car", |w, d| [w * (1.0 + HALF_TRACK * d.tan() / 1.4), d]);
    tells(&report, "[[effects]]\nid = \"rate-of-one-wheel\"\nleft = -0.3");
}

/// An effect of the vehicle as it is stays one.
#[test]
fn a_car_stays_a_car() {
    let report = answer("car", |w, d| [w, 1.08 * d + 0.02]);
    assert!(report.data.findings.iter().all(|f| f.id != "other-vehicle"), "{}", report.summary);
    let mut names: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
    names.sort_unstable();
    assert_eq!(names, ["steering-gain", "steering-offset"], "{}", report.summary);
}
