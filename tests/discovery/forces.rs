//! Runs driven by forces, their friction hidden: `discover`, which knows no forces, names the creep that follows.

use crate::forced::{Body, Forced};
use crate::read_back::read_back;
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::report::{Estimate, Report};
use creepage::discrepancy::request::Request;
use creepage::effects;
use creepage::progress::unheard;

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
    discover(&request, &unheard).unwrap().report
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

/// A blade that gives way more takes longer to do so: the transients tell Rocard's law from its quasi-static limit,
/// which is listed beside it.
#[test]
fn transients_tell_the_law_of_rocard_from_its_limit() {
    for stiffness in [200.0, 1000.0] {
        let report = report(Body::Sleigh, "rocard", &[stiffness]);
        names(&report, "rocard-creep", "mass_over_stiffness", 20.0 / stiffness);
        let beside = &report.effects[0].indistinguishable_from;
        assert!(beside.iter().any(|r| r.id == "load-dependent-creep" && r.why == "first order"), "{beside:?}");
    }
}

/// The rear axle of a car bears the share 1.4/2.6 of its 1000 kg. The front axle slips too, which turns the car more or
/// less than its wheels are steered: understeer. How long inertia takes to turn the car has no name in the library: the creep
/// is asked to be right to a twentieth only, and where understeer has another value while the wheels are being steered it is
/// refused with both values, and the creep takes a part of it.
#[test]
fn the_car_creeps_at_its_rear_axle() {
    let share = 1000.0 * 1.4 / 2.6;
    for (law, friction, ids) in
        [("viscous", 1.2e4, ["cornering-creep"; 2]), ("rocard", 6e4, ["rocard-creep", "load-dependent-creep"])]
    {
        let report = report(Body::Car, law, &[friction]);
        let found = report.effects.iter().find(|e| ids.contains(&e.id.as_str()));
        let found = found.unwrap_or_else(|| panic!("{law}: {} {:?}", report.summary, report.refuted));
        let value = found.parameters.values().next().unwrap();
        // Lighter on its front axle, it turns more than it is steered.
        let gradient = |values: &std::collections::BTreeMap<String, Estimate>| values["gradient"].value;
        let turning = report.effects.iter().find(|e| e.id == "understeer").map(|e| gradient(&e.parameters));
        let refused = report.refuted.iter().find(|e| e.id == "understeer").map(|e| gradient(&e.parameters));
        assert!(turning.or(refused).unwrap() < 0.0, "{law}: {turning:?} {refused:?}");
        assert!(turning.is_some() || law == "rocard", "{law}: {:?}", report.refuted);
        let most = if turning.is_some() { 0.05 } else { 1.0 / 15.0 };
        assert!((value.value * friction / share - 1.0).abs() < most, "{law}: {found:?}");
        assert!(value.std.unwrap() < 0.02 * value.value, "{law}: {found:?}");
    }
}
