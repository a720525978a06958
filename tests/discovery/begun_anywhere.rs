//! States that no sensor sees, at the start of a log: nobody knows how they began, and what the poses show is enough.

use crate::simulator::{Hidden, Noise, Profile, Scenario, Signal, Tractor};
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::report::{Report, Verdict};
use creepage::discrepancy::request::Request;
use creepage::effects;
use creepage::files::{ModelFile, Run};
use creepage::model;
use creepage::progress::unheard;

const NOISE: Noise = Noise { position: 3e-4, heading: 3e-4 };

/// Slow, to and fro: what a wheel remembers over a distance it remembers for long.
fn scenario(tractor: Tractor, hidden: Hidden, seed: u64) -> Scenario {
    let speed = Signal::constant(0.15) + Signal::wave(0.35, 17.0, 0.3 * seed as f64);
    let profile = Profile { speed, turn: Signal::wave(0.3, 8.0, 0.2) };
    let usual = Scenario::new(tractor, seed);
    Scenario { hidden: vec![hidden], profile, duration: 40.0, rate: 30.0, noise: NOISE, ..usual }
}

fn report(scenario: &Scenario, known: &str) -> Report {
    let text = scenario.model_toml() + known;
    let file = ModelFile::parse(&text, "model.toml", &model::known(effects::all())).unwrap();
    let run = Run::parse("run.csv", &scenario.run().to_csv(9), &file).unwrap();
    let request =
        Request { file: &file, runs: &[run], held_out: &[], library: effects::all(), horizons: &[5.0], seed: 1 };
    discover(&request, &unheard).unwrap().report
}

const SLOW: Hidden = Hidden::RelaxationLength { e_tc: 0.05, length: 0.8 };

#[test]
fn the_true_model_explains_a_log_that_begins_anywhere() {
    let known = "[[effects]]\nid = \"relaxation-length\"\ne_tc = 0.05\nlength = 0.8\n";
    for (tractor, seed) in [(Tractor::Unicycle, 1), (Tractor::DifferentialDrive, 2), (Tractor::Unicycle, 3)] {
        let report = report(&scenario(tractor, SLOW, seed), known);
        assert_eq!(report.verdict, Verdict::NoMissingEffect, "{seed}: {}", report.summary);
        let fitted = report.gap[0].fit.as_ref().unwrap().position_rms_after;
        assert!(fitted < 2.0 * report.gap[0].noise_floor.position_rms, "{seed}: {:?}", report.gap[0]);
    }
}

#[test]
fn what_builds_up_is_found_as_exactly_as_the_poses_are_measured() {
    for (tractor, seed) in [(Tractor::Unicycle, 4), (Tractor::DifferentialDrive, 5)] {
        let report = report(&scenario(tractor, SLOW, seed), "");
        let [effect] = &report.effects[..] else { panic!("{seed}: {}", report.summary) };
        assert_eq!(effect.id, "relaxation-length");
        for (name, truth) in [("e_tc", 0.05), ("length", 0.8)] {
            let found = &effect.parameters[name];
            let std = found.std.unwrap();
            assert!((found.value - truth).abs() < 4.0 * std && std < 0.02 * truth, "{seed}: {name} {found:?}");
        }
        let held_out = report.gap[0].held_out.as_ref().unwrap().position_rms_after;
        assert!(held_out < 2.0 * report.gap[0].noise_floor.position_rms, "{seed}: {:?}", report.gap[0]);
    }
}

/// What forgets within the lead is where its inputs drive it, whatever the poses say.
#[test]
fn a_slide_that_forgets_is_found_as_before() {
    let hidden = Hidden::CorneringCreep { mass_over_bt: 0.1 };
    let report = report(&scenario(Tractor::Unicycle, hidden, 6), "");
    let ids: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
    assert_eq!(ids, ["cornering-creep"], "{}", report.summary);
    let found = &report.effects[0].parameters["mass_over_bT"];
    assert!((found.value - 0.1).abs() < 4.0 * found.std.unwrap(), "{found:?}");
}
