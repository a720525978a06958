//! Runs in which more is amiss than the library can say: what all of their parts share is named, and nothing else.

use crate::read_back::read_back;
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::report::{Report, Verdict};
use creepage::discrepancy::request::Request;
use creepage::effects::{self, Effect};
use creepage::files::Run;
use creepage::progress::unheard;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};

const MODEL: &str = r#"
vehicle = "unicycle"
[parameters]
wheel_radius = 1.0
[columns]
time = "t"
x = "x"
y = "y"
heading = "phi"
speed = "v"
yaw_rate = "w"
"#;

/// Load-dependent creep, s²/m.
const CREEP: f64 = 0.012;
/// Seconds of a run, rows a second, steps a row.
const DURATION: f64 = 40.0;
const RATE: f64 = 10.0;
const STEPS: usize = 20;
/// Of x, y (m) and heading (rad).
const NOISE: f64 = 0.003;

/// What is hidden in a run: the scale of its gyro, load-dependent creep, and a rotation creep by speed and yaw rate.
struct Hidden {
    scale: f64,
    creep: f64,
    law: fn(f64, f64) -> f64,
}

/// A ramp of the speed from rest to 3 m/s at constant curvature.
fn ramp(curvature: f64, hidden: &Hidden, seed: u64) -> String {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let noise = Normal::new(0.0, NOISE).unwrap();
    let speed = |t: f64| 3.0 * t / DURATION;
    let (mut pose, h) = ([0.0_f64, 0.0, 0.4 * seed as f64], 1.0 / RATE / STEPS as f64);
    let mut text = String::from("t,x,y,phi,v,w\n");
    for i in 0..(DURATION * RATE) as usize {
        let t = i as f64 / RATE;
        let [x, y, phi] = pose.map(|p| p + noise.sample(&mut random));
        text += &format!("{t},{x},{y},{phi},{},{}\n", speed(t), curvature * speed(t));
        for k in 0..STEPS {
            let t = t + (k as f64 + 0.5) * h;
            let (v, w) = (speed(t), curvature * speed(t) * (1.0 + hidden.scale));
            let along = v * (1.0 - (hidden.law)(v, w));
            let across = -hidden.creep * along * along * w;
            let (sin, cos) = (pose[2] + 0.5 * h * w).sin_cos();
            pose = [
                pose[0] + h * (along * cos - across * sin),
                pose[1] + h * (along * sin + across * cos),
                pose[2] + h * w,
            ];
        }
    }
    text
}

/// Three ramps, two to the left and one to the right, and what is said of them.
fn report(hidden: [Hidden; 3]) -> Report {
    let logs: Vec<String> =
        [0.6, 0.8, -0.6].iter().zip(&hidden).zip(1..).map(|((k, hidden), seed)| ramp(*k, hidden, seed)).collect();
    let (file, _) = read_back(MODEL, &logs[0]);
    let runs: Vec<Run> = logs.iter().map(|log| read_back(MODEL, log).1).collect();
    let wanted =
        ["load-dependent-creep", "yaw-rate-scale", "rotation-creep", "traction-creep", "input-delay", "lever-arm"];
    let library: Vec<Effect> = effects::all().iter().filter(|e| wanted.contains(&e.id.as_str())).cloned().collect();
    let request = Request { file: &file, runs: &runs, held_out: &[], library: &library, horizons: &[1.0], seed: 7 };
    discover(&request, &unheard).unwrap().report
}

/// Demands both effects that all runs have, each within three of its deviations, and no other.
#[track_caller]
fn both_and_no_other(report: &Report) {
    let mut ids: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
    ids.sort_unstable();
    assert_eq!(ids, ["load-dependent-creep", "yaw-rate-scale"], "{} {:?}", report.summary, report.refuted);
    for effect in &report.effects {
        let truth = if effect.id == "yaw-rate-scale" { -0.03 } else { CREEP };
        for value in effect.parameters.values() {
            let std = value.std.unwrap();
            assert!((value.value - truth).abs() < 3.0 * std && std < 0.2 * truth.abs(), "{} {value:?}", effect.id);
        }
    }
}

/// A wheel that turns faster and faster than it rolls, up to a limit that is another in every run: without a name, a
/// constant rotation creep stands in for it, and a lever arm for the load-dependent creep.
#[test]
fn what_stands_in_for_a_law_is_not_named() {
    let hidden = |law| Hidden { scale: -0.03, creep: CREEP, law };
    let report = report([
        hidden(|v, w| 0.1 * (1.0 - (-(v * w).powi(2) / 4.0).exp())),
        hidden(|v, w| 0.05 * (1.0 - (-(v * w).powi(2) / 8.0).exp())),
        hidden(|v, w| 0.15 * (1.0 - (-(v * w).powi(2) / 4.0).exp())),
    ]);
    assert_eq!(report.verdict, Verdict::MissingEffect, "{} {:?}", report.summary, report.refuted);
    both_and_no_other(&report);
    assert!(report.summary.contains("differs between parts"), "{}", report.summary);
    let warnings = report.data.warnings.join("\n");
    assert!(warnings.contains("rotation-creep"), "{warnings}");
    // On ramps a lever arm imitates lateral creep: other speeds tell them apart.
    let creep = report.effects.iter().find(|e| e.id == "load-dependent-creep").unwrap();
    let rivals: Vec<&str> = creep.indistinguishable_from.iter().map(|r| r.id.as_str()).collect();
    assert!(rivals.contains(&"lever-arm"), "{rivals:?}");
    let next = report.next_experiment.unwrap();
    assert!(next.why.contains("lever-arm") && next.manoeuvre.matches("m/s").count() > 1, "{next:?}");
}

/// The same limit in all runs: an equation for it, and no constant rotation creep beside it.
#[test]
fn what_all_parts_share_has_an_equation() {
    let hidden = || Hidden { scale: -0.03, creep: CREEP, law: |v, w| 0.1 * (1.0 - (-(v * w).powi(2) / 4.0).exp()) };
    let report = report([hidden(), hidden(), hidden()]);
    assert_eq!(report.verdict, Verdict::UnnamedEffect, "{}", report.summary);
    both_and_no_other(&report);
    assert!(report.unnamed.iter().all(|u| u.place == "rotation constraint"), "{:?}", report.unnamed);
}

/// Gyros of another scale in every run: the model is wrong, and no value of anything is right for all.
#[test]
fn runs_that_share_nothing_name_nothing() {
    let hidden = |scale| Hidden { scale, creep: 0.0, law: |_, _| 0.0 };
    let report = report([hidden(-0.05), hidden(0.04), hidden(0.01)]);
    assert_eq!((report.verdict, report.effects.len()), (Verdict::Unexplained, 0), "{}", report.summary);
    assert!(
        report.summary.contains("Model and measurement disagree") && report.next_experiment.is_some(),
        "{}",
        report.summary
    );
}

/// A law in one of three runs: what stands in for it moves from part to part, and its deviations say so.
#[test]
fn deviations_are_as_wide_as_parts_scatter() {
    let hidden = |law| Hidden { scale: -0.03, creep: CREEP, law };
    let report =
        report([hidden(|v, w| 0.1 * (1.0 - (-(v * w).powi(2) / 4.0).exp())), hidden(|_, _| 0.0), hidden(|_, _| 0.0)]);
    both_and_no_other(&report);
    let creep = report.effects.iter().find(|e| e.id == "load-dependent-creep").unwrap();
    let c = &creep.parameters["c"];
    // Rows alone would tell it to a thousandth.
    let std = c.std.unwrap();
    assert!((c.value - CREEP).abs() < 2.0 * std && std > 0.05 * CREEP, "{c:?}");
}
