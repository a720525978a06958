//! Kinematics knows no clock and no unit of length: the same path at any speed, the scaled path of a scaled vehicle.

use creepage::effects::{self, Applied};
use creepage::formula::{Expr, Symbol};
use creepage::model::{Model, Trailer};
use creepage::motion::{Formulas, Integrator, simulate};
use proptest::prelude::*;

use crate::support::{Outcome, check};

/// A vehicle with trailers and constant creeps, all lengths times `size`.
fn vehicle(kind: usize, creeps: &[f64], size: f64) -> Model {
    let lengths: &[(&str, f64)] = match kind {
        0 => &[("wheel_radius", 0.5)],
        1 => &[("wheel_radius", 0.1), ("track_width", 0.4)],
        _ => &[("wheel_radius", 0.3), ("wheelbase", 1.6)],
    };
    let scaled: Vec<(&str, f64)> = lengths.iter().map(|(name, v)| (*name, size * v)).collect();
    let trailers =
        [(1.2, 0.3), (0.8, -0.1)].map(|(length, hitch)| Trailer { length: size * length, hitch: size * hitch });
    let model = Model::new(["unicycle", "differential-drive", "car"][kind], &scaled).unwrap().with_trailers(&trailers);
    let with = |m: Model, id: &str, trailer, e: f64| {
        m.with_effect(Applied::new(effects::named(id).unwrap(), trailer, vec![e]))
    };
    let model = with(with(model, "rotation-creep", None, creeps[0]), "traverse-creep", None, creeps[1]);
    with(with(model, "trailer-traverse-creep", Some(1), creeps[2]), "trailer-traverse-creep", Some(2), creeps[3])
}

/// Where it is at t = 2/speed, its rates `speed` times those of smooth inputs, angles as they are.
fn end(model: &Model, c: &[f64], speed: f64) -> Vec<f64> {
    let rate = |k: usize| format!("speed*(3 + c_{k} + sin(speed*t*(1 + c_{k})))");
    let formula = |input: &String| match input.as_str() {
        "steering_angle" => "0.3*sin(speed*t + c_1)".to_string(),
        "yaw_rate" => "speed*c_1*cos(speed*t)".into(),
        "wheel_rate_right" => rate(1),
        _ => rate(0),
    };
    let formulas: Vec<Expr> = model.inputs.iter().map(|i| Expr::parse(&formula(i)).unwrap()).collect();
    let constants = [("c_0", c[0]), ("c_1", c[1]), ("speed", speed)].map(|(s, v)| (Symbol::from(s), v));
    let drive = Formulas::new(&formulas, &constants).unwrap();
    let exact = Integrator::default().with_tolerance(1e-12, 1e-13);
    let start = [0.0, 0.0, 0.4, 0.1, -0.2];
    simulate(&model.equations(&[]).unwrap(), &[], &drive, &start, &[0.0, 2.0 / speed], &exact).unwrap().pop().unwrap()
}

fn near(what: &str, a: f64, b: f64) -> Outcome {
    prop_assert!((a - b).abs() <= 1e-9 * (1.0 + b.abs()), "{}: {} and not {}", what, a, b);
    Ok(())
}

fn values() -> impl Strategy<Value = (usize, Vec<f64>, Vec<f64>, f64)> {
    let list = |n| prop::collection::vec(-0.3..0.3f64, n);
    (0..3usize, list(4), list(2), 0.3..4.0f64)
}

#[test]
fn the_path_does_not_depend_on_how_fast_it_is_driven() {
    check(40, values(), |(kind, creeps, c, speed)| {
        let model = vehicle(kind, &creeps, 1.0);
        let (slow, fast) = (end(&model, &c, 1.0), end(&model, &c, speed));
        (0..5).try_for_each(|k| near("state", fast[k], slow[k]))
    });
}

#[test]
fn a_vehicle_of_twice_the_size_makes_twice_the_path() {
    check(40, values(), |(kind, creeps, c, size)| {
        let (one, large) = (end(&vehicle(kind, &creeps, 1.0), &c, 1.0), end(&vehicle(kind, &creeps, size), &c, 1.0));
        // A unicycle's yaw rate is an input and no length enters it.
        (0..5).try_for_each(|k| near("state", large[k], if k < 2 { size * one[k] } else { one[k] }))
    });
}
