//! What the theory says about motion, asked of the equations that the descriptions of the vehicles give.

use creepage::effects::{self, Applied};
use creepage::formula::Expr;
use creepage::model::{Model, Trailer};
use creepage::motion::{Formulas, Integrator, simulate, simulate_model};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestCaseResult, TestRunner};

fn effect(id: &str, trailer: Option<usize>, e: f64) -> Applied {
    Applied::new(effects::named(id).unwrap(), trailer, vec![e])
}

fn wheel(e_rc: f64, e_tc: f64) -> Model {
    let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    model.with_effect(effect("rotation-creep", None, e_rc)).with_effect(effect("traverse-creep", None, e_tc))
}

fn car() -> Model {
    Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap()
}

/// Formulas of wheel and yaw rate (or steering) with random coefficients, in the order of a model's inputs.
fn drive(model: &Model, wheel: &str, turn: &str, c: &[f64]) -> Formulas {
    let constants: Vec<_> = c.iter().enumerate().map(|(i, v)| (format!("c_{i}").as_str().into(), *v)).collect();
    let formula = |input: &String| Expr::parse(if input == "wheel_rate" { wheel } else { turn }).unwrap();
    Formulas::new(&model.inputs.iter().map(formula).collect::<Vec<_>>(), &constants).unwrap()
}

const WHEEL: &str = "c_0 + c_1*sin(c_2*t + c_3)";
const TURN: &str = "c_4 + c_5*cos(c_6*t)";

fn end(model: &Model, inputs: &Formulas, z0: &[f64], times: &[f64]) -> Vec<f64> {
    let equations = model.equations(&[]).unwrap();
    let exact = Integrator::default().with_tolerance(1e-12, 1e-13);
    simulate(&equations, &[], inputs, z0, times, &exact).unwrap().pop().unwrap()
}

fn near(a: f64, b: f64, tolerance: f64) -> TestCaseResult {
    prop_assert!((a - b).abs() <= tolerance * (1.0 + b.abs()), "{} and not {}", a, b);
    Ok(())
}

fn cases(n: u32) -> TestRunner {
    TestRunner::new(Config { cases: n, failure_persistence: None, ..Config::default() })
}

fn coefficients() -> impl Strategy<Value = Vec<f64>> {
    proptest::collection::vec(-2.0..2.0f64, 7)
}

/// z_c = κ·z_i with κ = (1 − e_rc)(1 + i·e_tc), for any inputs and constant coefficients (THEORY §3).
#[test]
fn crept_paths_are_similar_to_ideal_ones() {
    let checked = cases(40).run(&(coefficients(), -0.5..0.5f64, -0.5..0.5f64), |(c, e_rc, e_tc)| {
        let (ideal, crept) = (wheel(0.0, 0.0), wheel(e_rc, e_tc));
        let z_i = end(&ideal, &drive(&ideal, WHEEL, TURN, &c), &[0.0; 3], &[0.0, 3.0]);
        let z_c = end(&crept, &drive(&crept, WHEEL, TURN, &c), &[0.0; 3], &[0.0, 3.0]);
        let (re, im) = (1.0 - e_rc, (1.0 - e_rc) * e_tc);
        near(z_c[0], re * z_i[0] - im * z_i[1], 1e-10)?;
        near(z_c[1], im * z_i[0] + re * z_i[1], 1e-10)?;
        near(z_c[2], z_i[2], 1e-12)
    });
    checked.unwrap();
}

/// Turning the other way and creeping to the other side mirrors the path.
#[test]
fn the_mirrored_drive_gives_the_mirrored_path() {
    let checked = cases(30).run(&(coefficients(), -0.3..0.3f64, -0.3..0.3f64), |(c, e_rc, e_tc)| {
        for base in [Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap(), car()] {
            let turn = if base.vehicle.id == "car" { "(c_4 + c_5*cos(c_6*t))/8" } else { TURN };
            let trailers = [Trailer { length: 1.7, hitch: 0.3 }, Trailer { length: 2.0, hitch: 0.0 }];
            let base = base.with_trailers(&trailers).with_effect(effect("rotation-creep", None, e_rc));
            let with = |side: f64| {
                let tractor = base.clone().with_effect(effect("traverse-creep", None, side * e_tc));
                tractor.with_effect(effect("trailer-traverse-creep", Some(2), side * e_rc))
            };
            let mirrored_turn = format!("-({turn})");
            let (left, right) = (with(1.0), with(-1.0));
            let z0 = [0.0, 0.0, 0.3, 0.2, 0.5];
            let a = end(&left, &drive(&left, WHEEL, turn, &c), &z0, &[0.0, 1.0]);
            let b = end(&right, &drive(&right, WHEEL, &mirrored_turn, &c), &z0.map(|v| -v), &[0.0, 1.0]);
            near(a[0], b[0], 1e-9)?;
            for k in 1..5 {
                near(a[k], -b[k], 1e-9)?;
            }
        }
        Ok(())
    });
    checked.unwrap();
}

/// Driving the inputs backward in time with opposite rates brings the vehicle back: creep is proportional to speed.
#[test]
fn the_reversed_drive_returns() {
    let checked = cases(30).run(&(coefficients(), -0.3..0.3f64, -0.3..0.3f64), |(c, e_rc, e_tc)| {
        let model = wheel(e_rc, e_tc).with_trailers(&[Trailer { length: 1.5, hitch: 0.2 }]);
        let z0 = [0.3, -0.4, 0.5, 0.2];
        let there = end(&model, &drive(&model, WHEEL, TURN, &c), &z0, &[0.0, 1.5]);
        let (wheel, turn) = (WHEEL.replace("*t", "*(1.5 - t)"), TURN.replace("*t", "*(1.5 - t)"));
        let back = drive(&model, &format!("-({wheel})"), &format!("-({turn})"), &c);
        let home = end(&model, &back, &there, &[0.0, 1.5]);
        home.iter().zip(z0).try_for_each(|(a, b)| near(*a, b, 1e-8))?;
        // The integrator's own way back agrees.
        let home = end(&model, &drive(&model, WHEEL, TURN, &c), &there, &[1.5, 0.0]);
        home.iter().zip(z0).try_for_each(|(a, b)| near(*a, b, 1e-8))
    });
    checked.unwrap();
}

/// A rigid motion of the start is a rigid motion of the path; a shift of time changes nothing.
#[test]
fn the_plane_has_no_preferred_place_direction_or_time() {
    let strategy = (coefficients(), -3.0..3.0f64, -3.0..3.0f64, -3.0..3.0f64, -50.0..50.0f64);
    let checked = cases(30).run(&strategy, |(c, x, y, turned, later)| {
        let model = wheel(0.04, -0.07).with_effect(effect("load-dependent-creep", None, 0.03));
        let model = model.with_effect(effect("cornering-creep", None, 0.2));
        let model = model.with_trailers(&[Trailer { length: 1.5, hitch: 0.2 }]);
        let z0 = [0.2, 0.1, 0.5, 0.3, 0.05];
        let a = end(&model, &drive(&model, WHEEL, TURN, &c), &z0, &[0.0, 1.5]);
        let place = |z: &[f64]| {
            let (sin, cos) = turned.sin_cos();
            vec![x + cos * z[0] - sin * z[1], y + sin * z[0] + cos * z[1], z[2] + turned, z[3] + turned, z[4]]
        };
        let shifted = |f: &str| f.replace("*t", "*(t - c_7)");
        let c = [&c[..], &[later]].concat();
        let inputs = drive(&model, &shifted(WHEEL), &shifted(TURN), &c);
        let b = end(&model, &inputs, &place(&z0), &[later, later + 1.5]);
        b.iter().zip(place(&a)).try_for_each(|(b, a)| near(*b, a, 1e-9))
    });
    checked.unwrap();
}

/// Rates of a model at a state under inputs given by name.
fn rates(model: &Model, z: &[f64], wheel: f64, turn: f64) -> Vec<f64> {
    let equations = model.equations(&[]).unwrap();
    let u: Vec<f64> = model.inputs.iter().map(|i| if i == "wheel_rate" { wheel } else { turn }).collect();
    let mut rates = vec![0.0; z.len()];
    equations.rates(&mut equations.workspace(&[]), z, &u, &mut rates);
    rates
}

/// φ̇ = v_l/L·[(tan δ + e_F)/(1 − e_F·tan δ) − e_R] (THEORY §4b.3).
#[test]
fn the_yaw_rate_of_a_creeping_car() {
    let strategy = (-3.0..3.0f64, -0.6..0.6f64, -0.3..0.3f64, -0.3..0.3f64, -0.3..0.3f64, 0.1..9.0f64);
    let checked = cases(200).run(&strategy, |(phi, delta, e_r, e_f, e_rc, wheel)| {
        let crept = car().with_effect(effect("traverse-creep", None, e_r));
        let crept = crept.with_effect(effect("rotation-creep", None, e_rc));
        let crept = crept.with_effect(effect("front-traverse-creep", None, e_f));
        let found = rates(&crept, &[1.0, 2.0, phi], wheel, delta);
        let (v, tan) = (0.3 * wheel * (1.0 - e_rc), delta.tan());
        near(found[2], v / 2.6 * ((tan + e_f) / (1.0 - e_f * tan) - e_r), 1e-12)?;
        near(found[0], v * (phi.cos() - e_r * phi.sin()), 1e-12)?;
        near(found[1], v * (phi.sin() + e_r * phi.cos()), 1e-12)?;
        let rear = car().with_effect(effect("traverse-creep", None, e_r));
        near(rates(&rear, &[0.0, 0.0, phi], wheel, delta)[2], 0.3 * wheel / 2.6 * (tan - e_r), 1e-12)?;
        let front = car().with_effect(effect("front-traverse-creep", None, e_f));
        let expected = 0.3 * wheel / 2.6 * (tan + e_f) / (1.0 - e_f * tan);
        near(rates(&front, &[0.0, 0.0, phi], wheel, delta)[2], expected, 1e-12)
    });
    checked.unwrap();
}

/// The recursion of THEORY §4c, which knows only the axle ahead, against what the constraints give.
#[test]
fn trailers_follow_the_recursion_of_the_theory() {
    let numbers = proptest::collection::vec(-0.4..0.4f64, 20);
    let checked = cases(100).run(&(numbers, 1usize..5), |(r, n)| {
        let trailers: Vec<Trailer> = (0..n).map(|i| Trailer { length: 1.5 + r[i], hitch: r[5 + i] }).collect();
        let mut model = wheel(r[15], r[16]).with_trailers(&trailers);
        for i in 1..=n {
            model = model.with_effect(effect("trailer-traverse-creep", Some(i), r[10 + i - 1]));
        }
        let mut z = vec![0.0, 0.0, 1.0 + r[17]];
        (0..n).for_each(|i| z.push(1.0 + 2.0 * r[i]));
        let (wheel_rate, yaw_rate) = (4.0 + r[18], r[19]);
        let found = rates(&model, &z, wheel_rate, yaw_rate);
        let (mut v, mut vt, mut rate) = (0.5 * wheel_rate * (1.0 - r[15]), 0.0, yaw_rate);
        vt += v * r[16];
        for i in 0..n {
            let (beta, e) = (z[2 + i] - z[3 + i], r[10 + i]);
            let h = vt - trailers[i].hitch * rate;
            let next = v * beta.cos() - h * beta.sin();
            rate = (v * beta.sin() + h * beta.cos() - e * next) / trailers[i].length;
            (v, vt) = (next, e * next);
            near(found[3 + i], rate, 1e-12)?;
        }
        Ok(())
    });
    checked.unwrap();
}

/// d_i·cos α_i·θ̇_i = V_{i−1}·sin(χ_{i−1} − χ_i) with courses χ = θ + arctan e (THEORY §4c), hitched on the axle.
#[test]
fn trailers_in_courses() {
    let checked = cases(100).run(&proptest::collection::vec(-0.5..0.5f64, 10), |r| {
        let trailers = [Trailer { length: 1.5, hitch: 0.0 }, Trailer { length: 0.9, hitch: 0.0 }];
        let mut model = wheel(0.0, r[0]).with_trailers(&trailers);
        for (i, e) in r.iter().enumerate().take(3).skip(1) {
            model = model.with_effect(effect("trailer-traverse-creep", Some(i), *e));
        }
        let z = [0.0, 0.0, r[3], 2.0 * r[4], 2.0 * r[5]];
        let found = rates(&model, &z, 4.0, r[6]);
        let course = |i: usize| z[2 + i] + r[i].atan();
        let mut speed = 2.0 / r[0].atan().cos();
        for (i, trailer) in (1..).zip(trailers) {
            let (turn, alpha) = (course(i - 1) - course(i), r[i].atan());
            near(trailer.length * alpha.cos() * found[2 + i], speed * turn.sin(), 1e-12)?;
            // The hitch's velocity along the trailer is the trailer's forward speed.
            speed *= (course(i - 1) - z[2 + i]).cos() / alpha.cos();
        }
        Ok(())
    });
    checked.unwrap();
}

/// Straight towing: tan(γ/2) = tan(γ₀/2)·e^{−kt}, γ = β + α₀ − α₁, k = v/(d·cos α₀·cos α₁) (THEORY §4c).
#[test]
fn straight_towing_has_its_closed_form() {
    let strategy = (-0.3..0.3f64, -0.3..0.3f64, -2.0..2.0f64, 0.5..4.0f64, 0.3..4.0f64);
    let checked = cases(40).run(&strategy, |(e_0, e_1, beta, length, t)| {
        let model = wheel(0.0, e_0).with_trailers(&[Trailer { length, hitch: 0.0 }]);
        let model = model.with_effect(effect("trailer-traverse-creep", Some(1), e_1));
        let inputs = drive(&model, "2", "0", &[]);
        let (a_0, a_1) = (e_0.atan(), e_1.atan());
        let phi = 0.4;
        let z = end(&model, &inputs, &[0.0, 0.0, phi, phi - beta], &[0.0, t]);
        let gamma = |beta: f64| ((beta + a_0 - a_1) / 2.0).tan();
        let k = 1.0 / (length * a_0.cos() * a_1.cos());
        near(gamma(phi - z[3]), gamma(beta) * (-k * t).exp(), 1e-9)
    });
    checked.unwrap();
}

/// What the table says is what was measured: the start is the measured pose, and speeds are those of the motion.
#[test]
fn the_table_of_a_simulation_is_consistent() {
    let model =
        car().with_trailers(&[Trailer { length: 2.0, hitch: 0.3 }]).with_effect(effect("traverse-creep", None, 0.1));
    let lever = Applied::new(effects::named("lever-arm").unwrap(), None, vec![0.5, -0.2]);
    let model = model.with_effect(lever).with_effect(effect("heading-misalignment", None, 0.3));
    let model = model.with_effect(effect("cornering-creep", None, 0.2)).with_effect(effect("input-delay", None, 0.1));
    let inputs = drive(&model, "6 + sin(t)", "0.2*sin(2*t)", &[]);
    let times: Vec<f64> = (0..=3000).map(|i| 1e-3 * f64::from(i)).collect();
    let start = [1.0, -2.0, 0.7, 0.5];
    let table = simulate_model(&model, &inputs, &times, &start, &Integrator::default()).unwrap();
    let names = ["time", "x", "y", "heading", "trailer_heading_1", "speed", "lateral_speed", "yaw_rate"];
    assert_eq!(table.names[..8], names);
    assert_eq!(table.names[8], "cornering_creep.w");
    assert_eq!(table.rows(), times.len());
    let column = |name: &str| table.column(name).unwrap();
    for (name, v) in names[1..5].iter().zip(start) {
        assert!((column(name)[0] - v).abs() < 1e-12, "{name}: {}", column(name)[0]);
    }
    let slope = |name: &str, i: usize| (column(name)[i + 1] - column(name)[i - 1]) / 2e-3;
    for i in [1, 500, 1500, 2999] {
        let phi = column("heading")[i] - 0.3;
        let (sin, cos) = phi.sin_cos();
        let yaw = slope("heading", i);
        // The lever arm turns with the body.
        let vx = slope("x", i) + yaw * (0.5 * sin - 0.2 * cos);
        let vy = slope("y", i) - yaw * (0.5 * cos + 0.2 * sin);
        assert!((column("yaw_rate")[i] - yaw).abs() < 1e-5);
        assert!((column("speed")[i] - (vx * cos + vy * sin)).abs() < 1e-5);
        assert!((column("lateral_speed")[i] - (vy * cos - vx * sin)).abs() < 1e-5);
        // The inputs act 0.1 s late.
        assert!((column("speed")[i] - 0.3 * (6.0 + (times[i] - 0.1).sin())).abs() < 1e-12);
    }
}
