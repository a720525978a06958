//! Runs driven by forces, their friction hidden: `discover`, which knows no forces, names the creep that follows.

#[allow(dead_code)] // a car can be pushed, too
mod forced;
#[path = "support/read_back.rs"]
mod read_back;

use creepage::discrepancy::discover::{Request, discover};
use creepage::discrepancy::report::Report;
use creepage::effects;
use forced::{Body, Forced};
use read_back::read_back;

/// What `discover` says of two runs of one kind.
fn report(body: Body, law: &'static str, values: &[f64]) -> Report {
    let read = |seed: u64| {
        let run = Forced::new(body, law, values, seed);
        read_back(run.model(), &run.csv().unwrap())
    };
    let ((file, first), (_, second)) = (read(0), read(1));
    let runs = [first, second];
    let request =
        Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[1.0, 5.0], seed: 7 };
    discover(&request, &|_| ()).unwrap().report
}

/// Demands one effect, a parameter within three of its standard deviations of the truth and known to a twentieth, and a
/// held-out gap that is gone but for its noise.
#[track_caller]
fn names(report: &Report, id: &str, parameter: &str, truth: f64) {
    let ids: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
    assert_eq!(ids, [id], "{} {:?}", report.summary, report.unnamed);
    let found = &report.effects[0].parameters[parameter];
    let std = found.std.unwrap();
    assert!((found.value - truth).abs() < 3.0 * std, "{} ± {std}, not {truth}", found.value);
    assert!(std < 0.05 * truth, "± {std} of {truth}");
    for gap in &report.gap {
        let held_out = gap.held_out.as_ref().unwrap();
        assert!(held_out.position_rms_after < 1.6 * gap.noise_floor.position_rms, "{gap:?}");
        assert!(held_out.position_rms_after < held_out.position_rms_before, "{gap:?}");
    }
}

/// (18): f = −b·v_t. What the kinematics sees is m/b.
#[test]
fn the_viscous_sleigh_creeps_in_turns() {
    names(&report(Body::Sleigh, "viscous", &[100.0]), "cornering-creep", "mass_over_bT", 20.0 / 100.0);
}

/// (2): f = −k·v_t/v. Quasi-statically v_t = −(m/k)·v²·yaw rate.
#[test]
fn the_sleigh_of_rocard_creeps_under_load() {
    names(&report(Body::Sleigh, "rocard", &[2000.0]), "load-dependent-creep", "c", 20.0 / 2000.0);
}
