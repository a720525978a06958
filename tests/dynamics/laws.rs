//! The laws of contact in motion: what they make of a steady turn, and how a deflection fades.

use creepage::dynamics::{Dynamics, Masses, Start, laws, simulate_dynamics};
use creepage::formula::Expr;
use creepage::model::Model;
use creepage::motion::{Formulas, Integrator, Method, Table};

/// A body of 2 kg on a blade, held at a speed by a push that makes good what friction takes, turning at a given rate.
fn turning(law: &str, values: &[f64], speed: f64, yaw_rate: f64, seconds: f64) -> Table {
    let model = Model::new("sleigh", &[("mass", 2.0), ("inertia", 1.0), ("mass_offset", 0.5)]).unwrap();
    let masses = Masses { mass: 2.0, inertia: 1.0, mass_offset: 0.0, ..Masses::default() };
    let sleigh = Dynamics::new(&model, &masses).unwrap().with_law("blade-direction", law, values).unwrap();
    let start =
        Start { pose: vec![0.0; 3], speed, yaw_rate: Some(yaw_rate), lateral_speed: Some(0.0), ..Start::default() };
    let by = Integrator { method: Method::Radau5, ..Integrator::default() };
    let times: Vec<f64> = (0..=100).map(|i| f64::from(i) / 100.0 * seconds).collect();
    simulate_dynamics(&sleigh, &Formulas::new(&[], &[]).unwrap(), &times, &start, &by).unwrap()
}

fn last(table: &Table, name: &str) -> f64 {
    *table.column(name).unwrap().last().unwrap()
}

#[test]
fn every_law_pulls_back_and_its_parameters_are_its_own() {
    for law in laws() {
        let known = ["slip", "speed", "deflection"];
        for s in law.force.symbols().into_iter().chain(law.rate.iter().flat_map(Expr::symbols)) {
            assert!(known.contains(&s.as_str()) || law.parameters.iter().any(|p| p.name == s.as_str()), "{s}");
        }
        // Slips so that the force (after a deflection has built up) is against the slip.
        let at = |name: &str, slip: f64, deflection: f64| match name {
            "slip" => slip,
            "speed" => 2.0,
            "deflection" => deflection,
            _ => 3.0,
        };
        for slip in [0.4, -0.7] {
            let deflection = if law.rate.is_some() { -slip } else { 0.0 };
            let force = law.force.eval(&|s| at(s.as_str(), slip, deflection)).unwrap();
            assert!(force * slip < 0.0, "{}: {force}", law.id);
        }
    }
}

/// Quasi-static: viscous v_t = −(m/b)·v·ω, Rocard v_t = −(m/k)·v²·ω, elastic the same as Rocard.
#[test]
fn in_a_slow_turn_each_law_creeps_in_its_own_way() {
    for (speed, yaw_rate) in [(1.0, 0.05), (2.0, -0.05), (-1.5, 0.04)] {
        let viscous = turning("viscous", &[400.0], speed, yaw_rate, 1.0);
        let said = -2.0 / 400.0 * last(&viscous, "speed") * yaw_rate;
        assert!((last(&viscous, "lateral_speed") / said - 1.0).abs() < 1e-3, "viscous at {speed}");
        for (law, values) in [("rocard", &[800.0][..]), ("elastic", &[800.0, 0.05])] {
            let table = turning(law, values, speed, yaw_rate, 1.0);
            let v = last(&table, "speed");
            let said = -2.0 / 800.0 * v * v.abs() * yaw_rate;
            let found = last(&table, "lateral_speed");
            assert!((found / said - 1.0).abs() < 2e-3, "{law} at {speed}: {found} {said}");
        }
    }
}

/// Twice as fast, the same law: viscous creep twice the speed, Rocard's four times (E15).
#[test]
fn rocard_creeps_with_the_square_of_the_speed() {
    let slip = |law: &str, speed: f64| last(&turning(law, &[900.0], speed, 0.05, 0.5), "lateral_speed");
    assert!((slip("viscous", 2.0) / slip("viscous", 1.0) - 2.0).abs() < 1e-2);
    assert!((slip("rocard", 2.0) / slip("rocard", 1.0) - 4.0).abs() < 1e-2);
}

/// Energy falls by what friction takes, and never rises without a push; a spring may give back.
#[test]
fn friction_takes_what_the_body_loses() {
    for (law, values) in [("viscous", &[20.0][..]), ("rocard", &[20.0])] {
        let table = turning(law, values, 2.0, 0.5, 1.0);
        let (energy, power) = (table.column("energy").unwrap(), table.column("friction_power").unwrap());
        let lost: f64 = power.windows(2).map(|w| (w[0] + w[1]) / 200.0).sum();
        assert!((energy[100] - energy[0] - lost).abs() < 2e-3 * lost.abs(), "{law}: {lost}");
        assert!(lost < -0.01 && power.iter().all(|p| *p <= 0.0));
    }
}

/// The elastic law from rest: no singularity, and the force is that of a spring.
#[test]
fn the_elastic_law_is_defined_at_rest() {
    let model = Model::new("sleigh", &[("mass", 2.0), ("inertia", 1.0), ("mass_offset", 0.5)]).unwrap();
    let masses = Masses { mass: 2.0, inertia: 1.0, ..Masses::default() };
    let sleigh = Dynamics::new(&model, &masses).unwrap().with_law("blade-direction", "elastic", &[100.0, 0.5]).unwrap();
    let sleigh = sleigh.driven_by(&["lateral_force"]).unwrap();
    let start = Start { pose: vec![0.0; 3], lateral_speed: Some(0.0), yaw_rate: Some(0.0), ..Start::default() };
    let by = Integrator { method: Method::Radau5, ..Integrator::default() };
    let push = Formulas::new(&[Expr::parse("3").unwrap()], &[]).unwrap();
    let times: Vec<f64> = (0..=100).map(|i| f64::from(i) / 100.0).collect();
    let table = simulate_dynamics(&sleigh, &push, &times, &start, &by).unwrap();
    // 2·y'' = 3 − 200·y: y' = (3/√(2·200))·sin(10·t).
    for (t, v) in times.iter().zip(table.column("lateral_speed").unwrap()) {
        assert!((v - 0.15 * (10.0 * t).sin()).abs() < 1e-7, "{t}: {v}");
    }
}
