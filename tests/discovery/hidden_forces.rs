//! Hidden effects on vehicles that forces move: runs of an independent simulator, put before `discover`.

use crate::forces_simulator::{Drive, Make, Secret};
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::discovery::Discovery;
use creepage::discrepancy::report::{Report, Verdict};
use creepage::discrepancy::request::Request;
use creepage::dynamics::known;
use creepage::effects;
use creepage::files::{ModelFile, Run};
use creepage::progress::unheard;

/// A run, and what `discover` says of it; the model that it patched, too.
fn found(make: Make, seed: u64, secret: Option<Secret>) -> (Report, ModelFile, Run) {
    let run = Drive { make, seed, seconds: 24.0, secret, sensors: false }.runs(1).remove(0);
    let file = parse(&run.model);
    let run = Run::parse("run.csv", &run.csv, &file).unwrap();
    let discovery = asked(&file, &run);
    let patched = parse(&discovery.patched(&file));
    (discovery.report, patched, run)
}

pub fn parse(text: &str) -> ModelFile {
    ModelFile::parse(text, "model.toml", &known(effects::all())).unwrap()
}

pub fn asked(file: &ModelFile, run: &Run) -> Discovery {
    let runs = std::slice::from_ref(run);
    let request = Request { file, runs, held_out: &[], library: effects::all(), horizons: &[1.0], seed: 1 };
    discover(&request, &unheard).unwrap()
}

fn secret(id: &'static str, name: &'static str, value: f64) -> Option<Secret> {
    Some(Secret { id, trailer: None, values: vec![(name, value)] })
}

#[test]
fn where_nothing_is_hidden_nothing_is_named() {
    let (report, _, _) = found(Make::DifferentialDrive, 11, None);
    assert_eq!(report.verdict, Verdict::NoMissingEffect, "{}", report.summary);
}

/// Named with its size, and gone from what is held out.
#[test]
fn a_missing_force_is_named_with_its_size() {
    for (make, id, name, value) in
        [(Make::Sleigh, "viscous-drag", "rate", 0.12), (Make::DifferentialDrive, "mass", "scale", 0.25)]
    {
        let (report, patched, run) = found(make, 12, secret(id, name, value));
        let ids: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
        assert_eq!(ids, [id], "{}", report.summary);
        let estimate = &report.effects[0].parameters[name];
        let std = estimate.std.unwrap();
        assert!((estimate.value - value).abs() < 4.0 * std + 2e-3, "{id}: {} ± {std}, not {value}", estimate.value);
        let gap = &report.gap[0];
        let held_out = gap.held_out.as_ref().unwrap();
        assert!(held_out.position_rms_after < 1.6 * gap.noise_floor.position_rms, "{gap:?}");
        // With it nothing is missing any more.
        if make == Make::Sleigh {
            let after = asked(&patched, &run).report;
            assert_eq!(after.verdict, Verdict::NoMissingEffect, "{}", after.summary);
        }
    }
}
