//! Drag on a momentum: what is kept, what is remembered, and what the limits are.

use crate::support::check;
use creepage::connection::{Drag, Path};
use creepage::formula::{Expr, Symbol, identical};
use creepage::mechanism::Momentum;
use proptest::prelude::*;
use std::f64::consts::TAU;

const ENERGY: &str = "I*psi'^2/2 + m*(l + d)^2*(psi' + theta')^2/2 + m*l'^2/2";

fn parse(text: &str) -> Expr {
    Expr::parse(text).unwrap()
}

fn drag(dissipation: &str) -> Drag {
    let turn = [("psi".into(), Expr::int(1))];
    Drag::of(&Momentum::of(&parse(ENERGY), &turn).unwrap(), &parse(dissipation), &turn).unwrap()
}

fn air() -> Drag {
    drag("c_b*psi'^2/2 + c_l*(psi' + theta')^2/2")
}

fn known(c_b: f64, c_l: f64) -> [(&'static str, f64); 5] {
    [("I", 1.0), ("m", 0.4), ("d", 0.6), ("c_b", c_b), ("c_l", c_l)]
}

#[test]
fn the_sum_is_kept_through_any_motion() {
    let drag = air();
    let kept = drag.memory(&["l".into()]).unwrap();
    assert_eq!(identical(&kept, &parse("c_b*psi + c_l*(psi + theta)")), Some(true));
    let motions = (prop::array::uniform4(-1.0..1.0f64), 0.0..2.0f64, 0.0..2.0f64, [-1.0..1.0f64, -0.5..0.5f64]);
    check(20, motions, |(c, c_b, c_l, start)| {
        let path = [("l", "1 + c_0*sin(t)/2"), ("theta", "c_1*t + c_2*cos(3*t) + c_3")];
        let path = Path::new(&path, [0.2, 4.0]).unwrap();
        let names = ["c_0", "c_1", "c_2", "c_3"].into_iter().zip(c);
        let values: Vec<(&str, f64)> = names.chain(known(c_b, c_l)).collect();
        let end = drag.after(&path, start, &values).unwrap();
        let sum = |[psi, p]: [f64; 2], t: f64| {
            let theta = path.at(t, &values).unwrap()[1];
            p + kept
                .eval(&|s: &Symbol| match s.as_str() {
                    "psi" => psi,
                    "theta" => theta,
                    "c_b" => c_b,
                    _ => c_l,
                })
                .unwrap()
        };
        prop_assert!((sum(end, 4.0) - sum(start, 0.2)).abs() < 1e-11, "{:?}", end);
        // It is the sum that is kept, not the momentum.
        prop_assert!(c_b + c_l < 0.2 || (end[1] - start[1]).abs() > 1e-6);
        Ok(())
    });
}

fn leg() -> Path {
    Path::new(&[("l", "1/2 + 3/10*cos(t)"), ("theta", "4/5*sin(t)")], [0.0, TAU]).unwrap()
}

fn held(until: f64) -> Path {
    Path::new(&[("l", "4/5"), ("theta", "0")], [0.0, until]).unwrap()
}

#[test]
fn the_error_falls_with_drag_at_a_fixed_time() {
    let psi = |c: f64| air().after(&leg(), [0.0; 2], &known(c, c / 2.0)).unwrap()[0];
    let ideal = psi(0.0);
    assert!((ideal + 0.29741719748508).abs() < 1e-12);
    let error = |k: i32| (psi(10f64.powi(-k)) - ideal).abs();
    for (k, ratio) in [(1, 8.3108), (2, 9.8067), (3, 9.9804)] {
        assert!((error(k) / error(k + 1) - ratio).abs() < 1e-3, "{k}: {}", error(k) / error(k + 1));
    }
}

#[test]
fn the_limits_do_not_commute() {
    for c in [1.0, 0.1, 1e-3] {
        let swung = air().after(&leg(), [0.0; 2], &known(c, c / 2.0)).unwrap();
        let last = air().after(&held(60.0 / c), swung, &known(c, c / 2.0)).unwrap();
        assert!(last[0].abs() < 1e-10 && last[1].abs() < 1e-10, "{c}: {last:?}");
        // Open motions do not come back: psi tends to -c_l/(c_b + c_l) of what the leg has turned.
        let open = Path::new(&[("l", "1/2"), ("theta", "t")], [0.0, 1.5]).unwrap();
        let swung = air().after(&open, [0.0; 2], &known(c, c / 2.0)).unwrap();
        let last = air().after(&held(60.0 / c), swung, &known(c, c / 2.0)).unwrap();
        assert!((last[0] + 1.5 / 3.0).abs() < 1e-9, "{c}: {last:?}");
    }
    let ideal = air().after(&leg(), [0.0; 2], &known(0.0, 0.0)).unwrap();
    let last = air().after(&held(1e3), ideal, &known(0.0, 0.0)).unwrap();
    assert!((last[0] - ideal[0]).abs() < 1e-12 && (ideal[0] + 0.2974).abs() < 1e-4);
}

#[test]
fn drag_that_grows_with_the_leg_remembers_nothing() {
    let grows = drag("c_b*psi'^2/2 + c_l*(l + d)^2*(psi' + theta')^2/2");
    assert_eq!(grows.memory(&["l".into()]), None);
    assert_eq!((grows.is_exact(&["l".into()]), air().is_exact(&["l".into()])), (Some(false), Some(true)));
    let swung = grows.after(&leg(), [0.0; 2], &known(0.1, 0.05)).unwrap();
    let last = grows.after(&held(600.0), swung, &known(0.1, 0.05)).unwrap();
    assert!((last[0] + 0.336789627).abs() < 1e-8, "{last:?}");
    // A coefficient that depends on the position is still the rate of a function.
    let by_place = drag("(1 + psi^2)*psi'^2/2");
    assert_eq!((by_place.is_exact(&["l".into(), "theta".into()]), by_place.memory(&[])), (Some(true), None));
}

#[test]
fn what_is_no_drag_is_refused() {
    let turn = [("psi".into(), Expr::int(1))];
    let momentum = Momentum::of(&parse(ENERGY), &turn).unwrap();
    let said = |text: &str| Drag::of(&momentum, &parse(text), &turn).unwrap_err().to_string();
    assert!(said("c_b*psi'").contains("does not vanish at rest"));
    assert!(said("c_b*psi'^3").contains("not linear in rates"));
    assert!(air().after(&leg(), [0.0; 2], &[]).unwrap_err().to_string().contains("which has no value"));
}

/// A symmetry that moves what the drag does not act on: that part has no force, and none is made up for it.
#[test]
fn what_feels_no_drag_adds_none() {
    let energy = parse("m*x'^2/2 + m*y'^2/2 + I*psi'^2/2");
    let turn = [("x".into(), parse("-y")), ("y".into(), parse("x")), ("psi".into(), Expr::int(1))];
    let momentum = Momentum::of(&energy, &turn).unwrap();
    let drag = Drag::of(&momentum, &parse("c*psi'^2/2"), &turn).unwrap();
    assert_eq!(drag.force.to_string(), "c*psi'");
    let error = Drag::of(&momentum, &parse("c*psi'"), &turn).unwrap_err();
    assert!(error.to_string().contains("does not vanish at rest"), "{error}");
}
