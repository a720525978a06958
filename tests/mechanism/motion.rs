//! The motion that the constraints determine: two derivations check each other, and closed forms.

use crate::models::{self, Values, at, effect, instant, random, situation, value, vehicle};
use crate::support::{Outcome, check};
use creepage::formula::Symbol;
use creepage::mechanism::{Heading, Velocity};
use creepage::model::{Model, Trailer};
use proptest::prelude::*;

fn near(a: f64, b: f64) -> Outcome {
    prop_assert!((a - b).abs() <= 1e-12 * (1.0 + a.abs().max(b.abs())), "{} is not {}", a, b);
    Ok(())
}

/// row·q̇ is zero to rounding, and some row says something.
fn annihilated(model: &Model, values: &Values) -> Outcome {
    let constraints = model.constraints();
    let independent = model.coordinates().len() - degrees_of_freedom(model);
    // Three parallel wheels say in three rows what two of them say but for one angle of steering.
    let redundant = usize::from(model.vehicle.id == "synchro-drive");
    prop_assert_eq!(constraints.len() - redundant, independent);
    prop_assert_eq!(rank(model, values), independent);
    for c in constraints {
        let terms: Vec<f64> = c.row().terms().iter().map(|(rate, k)| value(k, values) * at(values)(rate)).collect();
        let (sum, size): (f64, f64) = (terms.iter().sum(), terms.iter().map(|t| t.abs()).sum());
        prop_assert!(sum.abs() <= 1e-10 * (1.0 + size), "{}: {} of {}", c.name, sum, size);
    }
    Ok(())
}

/// What the inputs set: a differential drive and a unicycle have two rates, a steered one and a disk the wheel's alone;
/// wheels with rollers leave all three velocities.
fn degrees_of_freedom(model: &Model) -> usize {
    if model.vehicle.id == "mecanum" {
        return 3;
    }
    if model.vehicle.line || model.inputs.iter().any(|i| i == "steering_angle") { 1 } else { 2 }
}

/// The rank of the Pfaffian matrix, each row of unit length.
fn rank(model: &Model, values: &Values) -> usize {
    let rates: Vec<Symbol> = model.coordinates().iter().map(Symbol::rate).collect();
    let rows = model.constraints().into_iter().map(|c| c.row());
    let entries = rows.map(|row| rates.iter().map(|q| value(&row.coefficient(q), values)).collect::<Vec<_>>());
    let unit = entries.map(|row| nalgebra::RowDVector::from_vec(row).normalize());
    nalgebra::DMatrix::from_rows(&unit.collect::<Vec<_>>()).rank(1e-9)
}

#[test]
fn the_rows_annihilate_the_motion() {
    check(300, random(), |r| {
        let values = instant(&r.model, &situation(&r.model, &r.numbers));
        annihilated(&r.model, &values)
    });
}

#[test]
fn the_rows_annihilate_the_motion_of_every_length_of_train() {
    check(12, random(), |r| {
        for n in (0..=10).filter(|n| *n == 0 || !models::ALONE.contains(&r.model.vehicle.id.as_str())) {
            let trailers: Vec<Trailer> =
                (0..n).map(|k| Trailer { length: 1.0 + r.numbers[k].abs(), hitch: 0.5 * r.numbers[k + 11] }).collect();
            let bare = Model { effects: vec![], ..r.model.clone() }.with_trailers(&trailers);
            let model = models::creeping(&bare, &r.numbers);
            annihilated(&model, &instant(&model, &situation(&model, &r.numbers)))?;
        }
        Ok(())
    });
}

/// The motion of a model at given inputs, with heading 0.4.
fn motion(model: &Model, inputs: &[(&str, f64)]) -> Values {
    let mut s: Values = model.states().into_iter().map(|s| (s, 0.0)).collect();
    s.insert("phi".into(), 0.4);
    s.extend(inputs.iter().map(|(n, v)| (Symbol::new(n), *v)));
    instant(model, &s)
}

fn get(values: &Values, name: &str) -> f64 {
    values[&Symbol::new(name)]
}

#[test]
fn a_creeping_car_turns_as_the_theory_says() {
    let values = (-0.9..0.9f64, -5.0..5.0f64, -0.3..0.3f64, -0.3..0.3f64, -0.3..0.3f64);
    check(2000, values, |(delta, rate, e_f, e_r, e_rc)| {
        for id in ["car", "four-wheel-car"] {
            let model = [("front-traverse-creep", e_f), ("traverse-creep", e_r), ("rotation-creep", e_rc)]
                .into_iter()
                .fold(vehicle(id, &[0.3, 2.6, 2.6]), |m, (n, v)| m.with_effect(effect(n, None, &[v])));
            let (length, radius) = (model.parameters["wheelbase"], model.parameters["wheel_radius"]);
            let m = motion(&model, &[("wheel_rate", rate), ("steering_angle", delta)]);
            let v_l = radius * rate * (1.0 - e_rc);
            near(get(&m, "v_l"), v_l)?;
            near(get(&m, "v_t"), e_r * v_l)?;
            let tan = delta.tan();
            near(get(&m, "phi'"), v_l / length * ((tan + e_f) / (1.0 - e_f * tan) - e_r))?;
            near(get(&m, "x'"), v_l * 0.4f64.cos() - e_r * v_l * 0.4f64.sin())?;
            near(get(&m, "y'"), v_l * 0.4f64.sin() + e_r * v_l * 0.4f64.cos())?;
        }
        Ok(())
    });
}

#[test]
fn a_tricycle_goes_by_the_cosine_of_its_steering() {
    check(1000, (-0.9..0.9f64, -5.0..5.0f64, -0.3..0.3f64), |(delta, rate, e_rc)| {
        let model = vehicle("tricycle", &[0.3, 1.7]).with_effect(effect("rotation-creep", None, &[e_rc]));
        let m = motion(&model, &[("wheel_rate", rate), ("steering_angle", delta)]);
        let speed = 0.3 * rate * (1.0 - e_rc);
        near(get(&m, "v_l"), speed * delta.cos())?;
        near(get(&m, "phi'"), speed * delta.sin() / 1.7)?;
        near(get(&m, "v_t"), 0.0)
    });
}

fn pair(effects: &[(&str, &[f64])]) -> Model {
    let bare = Model::new("differential-drive", &[("wheel_radius", 0.5), ("track_width", 1.0)]).unwrap();
    effects.iter().fold(bare, |m, (id, v)| m.with_effect(effect(id, None, v)))
}

#[test]
fn a_differential_drive_follows_its_two_wheels() {
    check(1000, (-5.0..5.0f64, -5.0..5.0f64, -0.3..0.3f64, -0.3..0.3f64), |(right, left, e_1, e_2)| {
        let model = pair(&[("unequal-rotation-creep", &[e_2, e_1]), ("traverse-creep", &[0.07])]);
        let m = motion(&model, &[("wheel_rate_right", right), ("wheel_rate_left", left)]);
        let (v_1, v_2) = (0.5 * right * (1.0 - e_1), 0.5 * left * (1.0 - e_2));
        near(get(&m, "v_l"), (v_1 + v_2) / 2.0)?;
        near(get(&m, "phi'"), v_1 - v_2)?;
        near(get(&m, "v_t"), 0.07 * (v_1 + v_2) / 2.0)
    });
}

#[test]
fn wheels_of_equal_coefficients_do_not_turn_as_equation_28_says() {
    // E16: spin in place, e = 0.1.
    let spin = [("wheel_rate_right", 4.0), ("wheel_rate_left", -4.0)];
    assert_eq!(get(&motion(&pair(&[]), &spin), "phi'"), 4.0);
    let creeping = motion(&pair(&[("rotation-creep", &[0.1])]), &spin);
    assert!((get(&creeping, "phi'") - 3.6).abs() < 1e-14 && get(&creeping, "v_l").abs() < 1e-15);
    // E17: equal rates, e = (0.02, 0.05).
    let straight = [("wheel_rate_right", 4.0), ("wheel_rate_left", 4.0)];
    let m = motion(&pair(&[("unequal-rotation-creep", &[0.05, 0.02])]), &straight);
    assert!((get(&m, "phi'") - 0.06).abs() < 1e-14);
    assert!((get(&m, "v_l") / get(&m, "phi'") - 32.166_666_666_666_67).abs() < 1e-10);
}

#[test]
fn the_wheels_of_an_axle_share_the_sideways_speed_and_not_the_coefficient() {
    // E18: v_l = 3, turning at 2 with a track of 1; the centre creeps by 0.05.
    let body = Heading::along("phi");
    let centre = Velocity::in_body("v_l", "v_t", &body);
    let values: Values = [("v_l", 3.0), ("v_t", 0.15), ("phi'", 2.0), ("phi", 0.4)].map(|(n, v)| (n.into(), v)).into();
    let creep = |left: &str| {
        let wheel = centre.at_offset(&body.left(), &creepage::formula::Expr::parse(left).unwrap());
        value(&wheel.along(&body.left()).expr(), &values) / value(&wheel.along(&body).expr(), &values)
    };
    for (left, expected) in [("-1/2", 0.0375), ("1/2", 0.075), ("0", 0.05)] {
        assert!((creep(left) - expected).abs() < 1e-15, "{left}: {}", creep(left));
    }
}

#[test]
fn a_trailer_follows_as_the_theory_says() {
    let numbers = (-3.0..3.0f64, -0.3..0.3f64, -0.3..0.3f64, prop_oneof![Just(0.0), -1.0..1.0f64], -2.0..2.0f64);
    check(1000, (numbers, -5.0..5.0f64, -2.0..2.0f64), |((beta, e_0, e_1, hitch, turn), speed, length)| {
        let length = 0.5 + length.abs();
        let trailers = [Trailer { length, hitch }];
        let model = vehicle("unicycle", &[1.0])
            .with_trailers(&trailers)
            .with_effect(effect("traverse-creep", None, &[e_0]))
            .with_effect(effect("trailer-traverse-creep", Some(1), &[e_1]));
        let inputs = [("wheel_rate", speed), ("yaw_rate", turn), ("phi_1", 0.4 - beta)];
        let m = motion(&model, &inputs);
        let h = e_0 * speed - hitch * turn;
        let v_1 = speed * beta.cos() - h * beta.sin();
        near(get(&m, "v_1"), v_1)?;
        near(get(&m, "vt_1"), e_1 * v_1)?;
        near(length * get(&m, "phi_1'"), speed * beta.sin() + h * beta.cos() - e_1 * v_1)
    });
}

#[test]
fn the_effects_on_a_wheel_do_what_the_contract_says() {
    let numbers = (-3.0..3.0f64, -3.0..3.0f64, -2.0..2.0f64, -2.0..2.0f64, 0.05..0.9f64);
    check(500, numbers, |(rate, turn, state, other, k)| {
        let with = |id: &str, values: &[f64], state_name: &str| {
            let model = vehicle("unicycle", &[0.5]).with_effect(effect(id, None, values));
            let m = motion(
                &model,
                &[("wheel_rate", rate), ("yaw_rate", turn), (state_name, state), ("x", 1.0), ("y", 2.0)],
            );
            let rates = model.effects[0].states();
            let rate_of_state = rates.first().map_or(0.0, |(_, r)| value(r, &m));
            (m, rate_of_state)
        };
        let (v, phi) = (0.5 * rate, 0.4f64);
        let (m, rate_of_state) = with("cornering-creep", &[k], "cornering_creep.w");
        near(get(&m, "v_t"), state)?;
        near(rate_of_state, -turn * v - state / k)?;
        let (m, rate_of_state) = with("traction-creep", &[k], "traction_creep.v");
        near(get(&m, "v_l"), state)?;
        near(rate_of_state, (v - state) / k)?;
        // By name: e_tc, length.
        let (m, rate_of_state) = with("relaxation-length", &[other, k], "relaxation_length.u");
        near(get(&m, "v_t"), state)?;
        near(rate_of_state, (other * v - state) * v.abs() / k)?;
        near(get(&with("load-dependent-creep", &[k], "x").0, "v_t"), -k * v * v * turn)?;
        // By name: direction, rate.
        near(get(&with("side-slope", &[other, k], "x").0, "v_t"), k * (other - phi).sin())?;
        near(get(&with("traverse-creep", &[other], "x").0, "v_t"), other * v)?;
        near(get(&with("rotation-creep", &[k], "x").0, "v_l"), v * (1.0 - k))?;
        near(get(&with("wheel-radius", &[k], "x").0, "v_l"), v * (1.0 + k))?;
        near(get(&with("yaw-rate-bias", &[other], "x").0, "phi'"), turn + other)?;
        near(get(&with("yaw-rate-scale", &[k], "x").0, "phi'"), turn * (1.0 + k))?;
        let (m, _) = with("drift", &[other, k], "x");
        near(get(&m, "x'"), v * phi.cos() + other)?;
        near(get(&m, "y'"), v * phi.sin() + k)?;
        let (m, _) = with("lever-arm", &[other, k], "x");
        near(get(&m, "x_m"), 1.0 + other * phi.cos() - k * phi.sin())?;
        near(get(&m, "y_m"), 2.0 + other * phi.sin() + k * phi.cos())?;
        near(get(&with("heading-misalignment", &[other], "x").0, "heading_m"), phi + other)?;
        near(get(&with("input-delay", &[other], "x").0, "delay"), other)
    });
}

#[test]
fn a_sliding_wheel_loses_energy() {
    check(500, (0.5..4.0f64, -3.0..3.0f64, 0.01..0.9f64), |(v, turn, k)| {
        let model = vehicle("unicycle", &[0.5]).with_effect(effect("cornering-creep", None, &[k])).with_effect(effect(
            "traction-creep",
            None,
            &[0.2],
        ));
        // No torque: the wheel turns as fast as the vehicle travels. v·v' + w·w' = −w²/k for unit mass.
        let inputs =
            [("wheel_rate", 2.0 * v), ("yaw_rate", turn), ("traction_creep.v", v), ("cornering_creep.w", 0.3 * v)];
        let m = motion(&model, &inputs);
        let of =
            |name: &str| model.effects.iter().flat_map(|e| e.states()).find(|(s, _)| s.as_str() == name).unwrap().1;
        let power = v * value(&of("traction_creep.v"), &m) + 0.3 * v * value(&of("cornering_creep.w"), &m);
        near(power, -0.09 * v * v / k)
    });
}
