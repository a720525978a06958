//! `discover` names what was hidden, measures it, mends the gap, and names nothing where nothing is hidden.

use crate::read_back::read_back;
use crate::simulator::{Hidden, Noise, Profile, Scenario, Signal, Tractor};
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::discovery::Discovery;
use creepage::discrepancy::report::{Report, Verdict};
use creepage::discrepancy::request::Request;
use creepage::effects;
use creepage::progress::unheard;
use creepage::{OnProgress, Progress, Stage};
use std::f64::consts::FRAC_PI_2;
use std::ops::ControlFlow;
use std::sync::Mutex;

/// A short drive before motion capture.
fn drive(tractor: Tractor, hidden: Vec<Hidden>, seed: u64) -> Scenario {
    Scenario { hidden, duration: 40.0, noise: Noise::MOCAP, ..Scenario::new(tractor, seed) }
}

fn discovery(scenario: &Scenario) -> Discovery {
    heard(scenario, &unheard)
}

/// A discovery whose progress somebody hears.
fn heard(scenario: &Scenario, progress: &OnProgress) -> Discovery {
    let (file, run) = read_back(&scenario.model_toml(), &scenario.run().to_csv(9));
    let runs = [run];
    let request =
        Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[1.0, 5.0], seed: 7 };
    discover(&request, progress).unwrap()
}

/// An effect by id with its parameters.
type Answer<'a> = (&'a str, &'a [(&'a str, f64)]);

/// Demands that exactly one effect is named, the first of `answers` or one that no data tell from it.
#[track_caller]
fn named(scenario: &Scenario, answers: &[Answer]) {
    let Report { verdict, effects, gap, .. } = discovery(scenario).report;
    let ids: Vec<&str> = effects.iter().map(|e| e.id.as_str()).collect();
    assert_eq!((verdict, ids.len()), (Verdict::MissingEffect, 1), "{ids:?}");
    let answer = answers.iter().find(|(id, _)| *id == ids[0]);
    let (_, parameters) = answer.unwrap_or_else(|| panic!("named {ids:?}"));
    assert!(effects[0].evidence.delta_bic > 10.0 && effects[0].evidence.p_value < 1e-4, "{:?}", effects[0].evidence);
    assert_eq!(effects[0].parameters.len(), parameters.len());
    for (name, truth) in *parameters {
        let found = &effects[0].parameters[*name];
        let std = found.std.unwrap_or_else(|| panic!("{name} has no deviation"));
        assert!(std > 0.0 && std < 0.2 * truth.abs(), "{name}: {found:?}, in truth {truth}");
        let error = (found.value - truth).abs();
        assert!(error <= (4.0 * std).max(0.05 * truth.abs()), "{name}: {found:?}, in truth {truth}");
    }
    let second = &gap[0];
    assert_eq!(second.horizon_s, 1.0);
    let judged = second.held_out.unwrap();
    let floor = second.noise_floor;
    assert!(judged.position_rms_after < judged.position_rms_before, "{second:?}");
    assert!(judged.position_rms_after <= 1.5 * floor.position_rms, "{second:?}");
    assert!(judged.heading_rms_after.unwrap() <= 1.5 * floor.heading_rms.unwrap(), "{second:?}");
}

#[test]
fn rotation_creep_of_a_unicycle() {
    let s = drive(Tractor::Unicycle, vec![Hidden::RotationCreep { e_rc: 0.05 }], 11);
    named(&s, &[("rotation-creep", &[("e_rc", 0.05)]), ("wheel-radius", &[("scale", -0.05)])]);
}

#[test]
fn rotation_creep_of_a_car() {
    let s = drive(Tractor::Car, vec![Hidden::RotationCreep { e_rc: 0.04 }], 12);
    named(&s, &[("rotation-creep", &[("e_rc", 0.04)]), ("wheel-radius", &[("scale", -0.04)])]);
}

#[test]
fn traverse_creep_of_a_unicycle() {
    let s = drive(Tractor::Unicycle, vec![Hidden::TraverseCreep { e_tc: 0.05 }], 13);
    named(&s, &[("traverse-creep", &[("e_tc", 0.05)]), ("heading-misalignment", &[("offset", -0.05)])]);
}

#[test]
fn traverse_creep_of_a_differential_drive() {
    let s = drive(Tractor::DifferentialDrive, vec![Hidden::TraverseCreep { e_tc: -0.06 }], 14);
    named(&s, &[("traverse-creep", &[("e_tc", -0.06)]), ("heading-misalignment", &[("offset", 0.06)])]);
}

#[test]
fn cornering_creep_of_a_unicycle() {
    let s = drive(Tractor::Unicycle, vec![Hidden::CorneringCreep { mass_over_bt: 0.11 }], 15);
    named(&s, &[("cornering-creep", &[("mass_over_bT", 0.11)])]);
}

#[test]
fn yaw_rate_bias_of_a_unicycle() {
    let s = drive(Tractor::Unicycle, vec![Hidden::YawRateBias { bias: 0.02 }], 16);
    named(&s, &[("yaw-rate-bias", &[("bias", 0.02)])]);
}

#[test]
fn yaw_rate_scale_of_a_unicycle() {
    let s = drive(Tractor::Unicycle, vec![Hidden::YawRateScale { scale: -0.04 }], 17);
    named(&s, &[("yaw-rate-scale", &[("scale", -0.04)])]);
}

#[test]
fn track_width_of_a_differential_drive() {
    let s = drive(Tractor::DifferentialDrive, vec![Hidden::TrackWidth { scale: 0.04 }], 18);
    named(&s, &[("track-width", &[("scale", 0.04)])]);
}

/// A track that was measured between other wheels, say: it is named, and the report says that nothing wears so far.
#[test]
fn what_no_vehicle_has_is_warned_of() {
    let warned = |scale: f64| {
        let hidden = vec![Hidden::TrackWidth { scale }];
        let report = discovery(&drive(Tractor::DifferentialDrive, hidden, 30)).report;
        let ids: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
        assert_eq!(ids, ["track-width"], "{} {:?}", report.summary, report.refuted);
        report.data.warnings.into_iter().filter(|w| w.contains("far beyond the usual")).collect::<Vec<_>>()
    };
    assert_eq!(warned(0.2), [""; 0]);
    let [warning] = &warned(0.6)[..] else { panic!("one warning") };
    assert!(warning.starts_with("track-width scale = 0.60") && warning.contains("model file"), "{warning}");
}

#[test]
fn wheel_radius_mismatch_of_a_differential_drive() {
    let s = drive(Tractor::DifferentialDrive, vec![Hidden::WheelRadiusMismatch { scale: 0.02 }], 19);
    // As creep: the left wheel creeps by −0.02, the right one not at all; that has one parameter more.
    named(&s, &[("wheel-radius-mismatch", &[("scale", 0.02)])]);
}

#[test]
fn steering_offset_of_a_car() {
    let s = drive(Tractor::Car, vec![Hidden::SteeringOffset { offset: 0.02 }], 20);
    named(&s, &[("steering-offset", &[("offset", 0.02)]), ("front-traverse-creep", &[("e_tc", 0.02)])]);
}

/// On a drive that leans to one side both pull against each other, and each is worth many times its price beside the other.
#[test]
fn steering_offset_and_understeer_of_a_car_that_turns_mostly_left() {
    let hidden = vec![Hidden::SteeringOffset { offset: 0.0122 }, Hidden::Understeer { gradient: 0.00976 }];
    let phase = 300_001.0_f64;
    let profile = Profile {
        speed: Signal::constant(4.0) + Signal::wave(1.2, 17.0, phase),
        turn: Signal::constant(0.05) + Signal::wave(0.25, 9.0 + 3.0 * phase.sin(), FRAC_PI_2 + phase),
    };
    let noise = Noise { position: 0.02, heading: 0.01 };
    let mut scenario = Scenario { profile, noise, duration: 60.0, rate: 20.0, ..drive(Tractor::Car, hidden, 300_001) };
    scenario.parameters.wheelbase = 2.6;
    scenario.parameters.wheel_radius = 0.3;
    let report = discovery(&scenario).report;
    let mut found: Vec<(&str, bool)> = report
        .effects
        .iter()
        .map(|e| (e.id.as_str(), e.scope.is_none() && e.parameters.values().all(|p| p.course.is_none())))
        .collect();
    found.sort_unstable();
    assert_eq!(found, [("steering-offset", true), ("understeer", true)], "{:?}", report.refuted);
}

#[test]
fn input_delay_of_a_car() {
    let s = drive(Tractor::Car, vec![Hidden::InputDelay { delay: 0.08 }], 21);
    named(&s, &[("input-delay", &[("delay", 0.08)])]);
}

#[test]
fn input_delay_of_a_unicycle() {
    let s = drive(Tractor::Unicycle, vec![Hidden::InputDelay { delay: 0.12 }], 22);
    named(&s, &[("input-delay", &[("delay", 0.12)])]);
}

#[test]
fn lever_arm_of_a_car() {
    let s = drive(Tractor::Car, vec![Hidden::LeverArm { a: 0.3, b: -0.2 }], 23);
    named(&s, &[("lever-arm", &[("a", 0.3), ("b", -0.2)])]);
}

#[test]
fn lever_arm_of_a_unicycle() {
    let s = drive(Tractor::Unicycle, vec![Hidden::LeverArm { a: -0.1, b: 0.07 }], 24);
    named(&s, &[("lever-arm", &[("a", -0.1), ("b", 0.07)])]);
}

#[track_caller]
fn nothing(tractor: Tractor, seeds: [u64; 2]) {
    for seed in seeds {
        let found = discovery(&drive(tractor, vec![], seed));
        let ids: Vec<&str> = found.report.effects.iter().map(|e| e.id.as_str()).collect();
        assert_eq!((found.report.verdict, ids), (Verdict::NoMissingEffect, vec![]), "seed {seed}");
        assert!(found.added.is_empty() && found.report.steps.is_empty());
        let second = &found.report.gap[0];
        let judged = second.held_out.unwrap();
        assert_eq!(judged.position_rms_after, judged.position_rms_before);
        assert!(judged.position_rms_after <= 1.5 * second.noise_floor.position_rms, "{second:?}");
    }
}

/// Where nothing remains no equation is looked for: it would cost as much as all names together.
#[test]
fn no_equation_is_sought_where_nothing_remains() {
    let said = Mutex::new(vec![]);
    let listener = |p: Progress| {
        said.lock().unwrap().push(p.stage);
        ControlFlow::Continue(())
    };
    heard(&drive(Tractor::Unicycle, vec![], 31), &listener);
    let said = said.into_inner().unwrap();
    assert!(!said.is_empty() && !said.contains(&Stage::UnnamedTerms), "{said:?}");
}

#[test]
fn nothing_hidden_in_a_unicycle() {
    nothing(Tractor::Unicycle, [31, 32]);
}

#[test]
fn nothing_hidden_in_a_differential_drive() {
    nothing(Tractor::DifferentialDrive, [33, 34]);
}

#[test]
fn nothing_hidden_in_a_car() {
    nothing(Tractor::Car, [35, 36]);
}

#[test]
fn the_best_of_a_library_is_not_named_for_luck() {
    // Of seventy such runs the one whose noise looks most like an effect: BIC alone would name it.
    let found = discovery(&Scenario { duration: 20.0, ..drive(Tractor::Unicycle, vec![], 126) });
    assert_eq!((found.report.verdict, found.report.effects.len()), (Verdict::NoMissingEffect, 0));
    let best = found.pictures.candidates.iter().map(|c| c.delta_bic).fold(f64::MIN, f64::max);
    assert!(best > 0.0, "pick another seed: {best}");
}
