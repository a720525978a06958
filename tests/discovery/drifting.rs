//! A car that drifts is outside the model: it is refused before any fit, with a sentence that says where and how much.

use creepage::discrepancy::discover::discover;
use creepage::discrepancy::report::{Report, Verdict};
use creepage::discrepancy::request::Request;
use creepage::effects;
use creepage::files::{ModelFile, Run};
use creepage::model;
use creepage::progress::unheard;
use std::fmt::Write as _;

const CAR: &str = "vehicle = \"car\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 2.6\n[columns]\ntime = \"t\"\nx = \"x\"\ny = \"y\"\nheading = \"phi\"\n";

/// A slip angle that is there from one time to another, s.
fn during(t: f64, [from, to]: [f64; 2]) -> f64 {
    0.5 * ((5.0 * (t - from)).tanh() - (5.0 * (t - to)).tanh())
}

/// A car that goes about 6 m/s and slides at an angle three times, for three seconds each; its path bends as it is steered.
fn log(slip: f64) -> String {
    let (mut x, mut y, mut course) = (0.0, 0.0, 0.2_f64);
    let mut text = "t,x,y,phi,wheel_rate,steering_angle\n".to_string();
    let (step, inner) = (0.05, 10);
    for i in 0..1200 {
        let t = step * f64::from(i);
        let speed = |t: f64| 6.0 + (0.5 * t).sin();
        let delta = |t: f64| 0.15 * (0.8 * t).sin() + 0.05 * (0.27 * t).cos();
        let beta =
            |t: f64| slip * [[12.0, 15.0], [24.0, 27.0], [37.0, 40.0]].iter().map(|s| during(t, *s)).sum::<f64>();
        let noise = |k: f64| 2e-3 * (f64::from(i * i) * 0.7 + k).sin();
        let measured = [x + noise(0.0), y + noise(1.0), course + beta(t) + noise(2.0)];
        writeln!(text, "{t},{},{},{},{},{}", measured[0], measured[1], measured[2], speed(t) / 0.3, delta(t)).unwrap();
        for k in 0..inner {
            let t = t + step * (f64::from(k) + 0.5) / f64::from(inner);
            let h = step / f64::from(inner);
            course += h * speed(t) / 2.6 * delta(t).tan();
            x += h * speed(t) * course.cos();
            y += h * speed(t) * course.sin();
        }
    }
    text
}

fn discovered(slip: f64) -> Report {
    let file = ModelFile::parse(CAR, "model.toml", &model::known(effects::all())).unwrap();
    let run = Run::parse("slide.csv", &log(slip), &file).unwrap();
    let library = effects::all();
    let request = Request { file: &file, runs: &[run], held_out: &[], library, horizons: &[1.0], seed: 1 };
    discover(&request, &unheard).unwrap().report
}

#[test]
fn a_drift_is_refused_and_told() {
    let report = discovered(40_f64.to_radians());
    assert_eq!(report.verdict, Verdict::UnusableData, "{}", report.summary);
    let said = ["The vehicle drifts: in slide.csv from", "slides at 39°", "beyond 30° for 17 % of the time driven"];
    assert!(said.iter().all(|words| report.summary.contains(words)), "{}", report.summary);
    assert!(report.effects.is_empty() && report.steps.is_empty());
}

/// Slides of 8° are for the fit to judge.
#[test]
fn a_slide_of_a_few_degrees_is_not_refused() {
    let report = discovered(8_f64.to_radians());
    assert_ne!(report.verdict, Verdict::UnusableData, "{}", report.summary);
}
