//! Logs of positions without headings, as of satellites: the heading comes from the path, and where the vehicle stands
//! there is none.

use crate::noisy_run::noisy_run;
use crate::simulator::{Hidden, Noise, Profile, Scenario, Signal, Tractor};
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::report::{Report, Verdict};
use creepage::discrepancy::request::Request;
use creepage::effects;
use creepage::files::{ModelFile, Run};
use creepage::model;
use creepage::progress::unheard;

/// Stops for a second or two again and again, while a slope or a current goes on moving it.
fn stopping(hidden: &[Hidden], seed: u64) -> Report {
    let turn = Signal::wave(0.4, 6.2, 0.5) + Signal::wave(0.3, 4.3, 1.0);
    let profile = Profile { speed: Signal::constant(0.31) + Signal::wave(0.31, 11.6, 0.7), turn };
    let noise = Noise { position: 0.004, ..Noise::MOCAP };
    let usual = Scenario::new(Tractor::Unicycle, seed);
    let s =
        Scenario { profile, hidden: hidden.to_vec(), duration: 40.0, rate: 35.0, noise, logs_heading: false, ..usual };
    let file = ModelFile::parse(&s.model_toml(), "model.toml", &model::known(effects::all())).unwrap();
    let run = Run::parse("run.csv", &s.run().to_csv(9), &file).unwrap();
    let request = Request { file: &file, runs: &[run], held_out: &[], library: effects::all(), horizons: &[], seed: 1 };
    discover(&request, &unheard).unwrap().report
}

#[test]
fn a_slope_is_named_though_the_vehicle_stops() {
    for seed in [1, 2, 3] {
        let report = stopping(&[Hidden::SideSlope { rate: 0.03, direction: 0.7 }], seed);
        assert_eq!(report.verdict, Verdict::MissingEffect, "{seed}: {} {:?}", report.summary, report.refuted);
        let [effect] = &report.effects[..] else { panic!("{seed}: {}", report.summary) };
        assert_eq!((effect.id.as_str(), report.unnamed.len()), ("side-slope", 0));
        for (name, truth, most) in [("rate", 0.03, 5e-4), ("direction", 0.7, 0.02)] {
            let found = &effect.parameters[name];
            assert!((found.value - truth).abs() < most, "{seed}: {name} {found:?}");
        }
        // No window in which the path shows no heading is held against the model.
        for c in report.remaining.unwrap().constraints {
            assert!(c.rms < 3.0 * c.noise.max(0.01), "{seed}: {} {}, noise {}", c.place, c.rms, c.noise);
        }
    }
}

#[test]
fn nothing_is_named_where_it_only_stops() {
    for seed in [4, 5, 6] {
        let report = stopping(&[], seed);
        assert!(report.effects.is_empty() && report.unnamed.is_empty(), "{seed}: {}", report.summary);
        assert!(report.disagreement.is_empty(), "{seed}: {:?}", report.disagreement);
        assert_eq!(report.remaining.as_ref().unwrap().heading_noise, None, "no heading is measured");
        let open = [Verdict::NoMissingEffect, Verdict::NotIdentifiable];
        assert!(open.contains(&report.verdict), "{seed}: {}", report.summary);
    }
}

/// A large effect that begins a tenth of a second beside the time at which it is looked for leaves a jump that a precise sensor
/// takes for noise, and at that noise its values end elsewhere, too: time and values are moved together until nothing is left.
#[test]
fn a_large_creep_is_found_with_the_moment_it_begins() {
    let head = "vehicle = \"car\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 1.9\n";
    let time: Vec<f64> = (0..1400).map(|i| f64::from(i) / 23.4).collect();
    let of = |f: &dyn Fn(f64) -> f64| time.iter().map(|t| f(*t)).collect::<Vec<f64>>();
    let rate = of(&|t| 14.0 + 3.0 * (0.31 * t).sin() + 1.5 * (0.83 * t).cos());
    let angle = of(&|t| -0.35 + 0.15 * (0.27 * t + 0.5).sin() + 0.08 * (0.71 * t).cos());
    let inputs = vec![("wheel_rate", rate), ("steering_angle", angle)];
    for (c, limit) in [(-0.10, 0.225), (0.06, 0.1)] {
        let hidden =
            format!("[[effects]]\nid = \"saturating-creep\"\nc = {c}\nlimit = {limit}\nscope = {{ from = 22.0 }}\n");
        let truth = creepage::Model::parse(&format!("{head}{hidden}")).unwrap();
        let run = creepage::Run { heading: None, ..noisy_run(&truth, time.clone(), inputs.clone(), 1.4e-4, 8) };
        let report = creepage::discover(&creepage::Model::parse(head).unwrap(), &[run]).unwrap().report;
        let [one] = &report.effects[..] else { panic!("{}", report.summary) };
        let from = one.scope.as_ref().and_then(|s| s.from).unwrap();
        assert!(one.id == "saturating-creep" && (from - 22.0).abs() < 0.01, "{}", report.summary);
        for (name, truth) in [("c", c), ("limit", limit)] {
            let found = &one.parameters[name];
            assert!((found.value - truth).abs() < 0.01 * truth.abs(), "{name}: {found:?}");
        }
    }
}
