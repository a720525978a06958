//! Vehicles whose motion has a closed form of its own, and those whose constraints give none.

use crate::models::{self, Values, effect, instant, situation, value, vehicle};
use crate::support::{Outcome, check};
use creepage::effects;
use creepage::formula::{Expr, Symbol};
use creepage::model::{Model, Trailer, known, mechanism};
use creepage::vehicles::{self, Definition, Wheel};
use proptest::prelude::*;

fn near(a: f64, b: f64) -> Outcome {
    prop_assert!((a - b).abs() <= 1e-12 * (1.0 + a.abs().max(b.abs())), "{} is not {}", a, b);
    Ok(())
}

fn motion(model: &Model, given: &[(&str, f64)]) -> Values {
    let mut s = situation(model, &[0.0]);
    s.extend(given.iter().map(|(n, v)| (Symbol::new(n), *v)));
    instant(model, &s)
}

fn get(values: &Values, name: &str) -> f64 {
    values[&Symbol::new(name)]
}

#[test]
fn a_vehicle_says_what_to_use_instead_exactly_where_it_has_no_motion() {
    for v in vehicles::all() {
        let model = vehicle(&v.id, &[1.0]);
        assert_eq!(model.definitions().is_ok(), v.moves(), "{}", v.id);
        assert_eq!(models::STILL.contains(&v.id.as_str()), !v.moves(), "{}", v.id);
        assert_eq!(models::ALONE.contains(&v.id.as_str()), !v.pulls(), "{}", v.id);
        let pulled = model.with_trailers(&[Trailer { length: 1.0, hitch: 0.2 }]);
        assert_eq!(pulled.definitions().is_ok(), v.pulls(), "{}", v.id);
        assert_eq!(known(effects::all()).vehicle(&v.id).unwrap().tractor, v.pulls(), "{}", v.id);
    }
}

#[test]
fn a_vehicle_without_motion_is_wrong_input_with_advice() {
    for (id, why, advice) in [
        ("sleigh", "the constraints of sleigh do not determine its motion by themselves", "use unicycle"),
        (
            "skid-steer",
            "the constraints of skid-steer contradict each other for general inputs",
            "an effective track_width",
        ),
    ] {
        let model = vehicle(id, &[0.3, 0.7]);
        for error in
            [model.definitions().unwrap_err(), model.equations(&[]).unwrap_err(), model.determined().unwrap_err()]
        {
            let text = error.to_string();
            assert!(error.exit_code() == 2 && text.contains(why) && text.contains(advice), "{text}");
        }
    }
    let train = vehicle("disk", &[0.3]).with_trailers(&[Trailer { length: 1.0, hitch: 0.0 }]);
    assert!(train.definitions().unwrap_err().to_string().contains("pulls no trailer"));
}

#[test]
fn a_disk_travels_along_its_heading_and_nowhere_else() {
    check(500, (-5.0..5.0f64, -2.0..2.0f64, -4.0..4.0f64, -0.5..0.5f64), |(rate, e, phi, scale)| {
        let model = vehicle("disk", &[0.3]).with_effect(effect("rotation-creep", None, &[e])).with_effect(effect(
            "wheel-radius",
            None,
            &[scale],
        ));
        let m = motion(&model, &[("wheel_rate", rate), ("phi", phi)]);
        let v = 0.3 * (1.0 + scale) * rate * (1.0 - e);
        near(get(&m, "s'"), v)?;
        near(get(&m, "x'"), v * phi.cos())?;
        near(get(&m, "y'"), v * phi.sin())?;
        prop_assert_eq!((get(&m, "phi'"), get(&m, "v_t")), (0.0, 0.0));
        // Along x: equation (8), and y stays.
        let m = motion(&model, &[("wheel_rate", rate), ("phi", 0.0)]);
        near(get(&m, "x'"), v)?;
        prop_assert_eq!(get(&m, "y'"), 0.0);
        // (11)-(12): the speed follows the wheel.
        let lag = vehicle("disk", &[0.3]).with_effect(effect("traction-creep", None, &[0.2]));
        let m = motion(&lag, &[("wheel_rate", rate), ("traction_creep.v", v)]);
        near(value(&lag.effects[0].states()[0].1, &m), (0.3 * rate - v) / 0.2)
    });
}

#[test]
fn effects_that_need_sideways_motion_do_not_apply_to_a_disk() {
    let disk = vehicle("disk", &[0.3]);
    let found: Vec<&str> = disk.applicable(effects::all()).into_iter().map(|(e, _)| e.id.as_str()).collect();
    let expected = ["rotation-creep", "wheel-radius", "traction-creep", "input-delay", "heading-misalignment", "grade"];
    assert_eq!(found, expected);
    for e in effects::all().iter().filter(|e| !e.per_trailer && !expected.contains(&e.id.as_str())) {
        let values: Vec<f64> = e.parameters.values().map(|p| p.size).collect();
        let error = disk.clone().with_effect(effect(&e.id, None, &values)).definitions().unwrap_err();
        assert!(error.to_string().contains("does not apply to the vehicle disk"), "{error}");
    }
}

#[test]
fn an_effect_needs_its_inputs_in_a_model_file_too() {
    let skid = vehicle("skid-steer", &[0.3]).with_effect(effect("unequal-rotation-creep", None, &[0.1, 0.2]));
    assert!(skid.row_definitions().unwrap_err().to_string().contains("does not apply"));
    let skid = vehicle("skid-steer", &[0.3]).with_effect(effect("rotation-creep", None, &[0.1]));
    let d = skid.row_definitions().unwrap();
    assert!(["e_rc_1", "e_rc_2", "e_rc_3", "e_rc_4"].iter().all(|e| !d.get(&Symbol::new(e)).unwrap().is_zero()));
}

#[test]
fn a_synchro_drive_goes_where_its_wheels_point_sideways_too() {
    let angles = prop_oneof![
        Just(std::f64::consts::FRAC_PI_2),
        Just(-std::f64::consts::FRAC_PI_2),
        Just(std::f64::consts::PI),
        Just(0.0),
        -4.0..4.0f64
    ];
    check(1000, (angles, -5.0..5.0f64, -0.5..0.5f64, -0.5..0.5f64, -4.0..4.0f64), |(delta, rate, e_rc, e_tc, phi)| {
        let model = Model::new("synchro-drive", &[("wheel_radius", 0.1)]).unwrap();
        let model = model.with_effect(effect("rotation-creep", None, &[e_rc]));
        let model = model.with_effect(effect("traverse-creep", None, &[e_tc]));
        let m = motion(&model, &[("wheel_rate", rate), ("steering_angle", delta), ("phi", phi)]);
        let along = 0.1 * rate * (1.0 - e_rc);
        let (sin, cos) = (phi + delta).sin_cos();
        near(get(&m, "x'"), along * (cos - e_tc * sin))?;
        near(get(&m, "y'"), along * (sin + e_tc * cos))?;
        prop_assert_eq!(get(&m, "phi'"), 0.0);
        Ok(())
    });
    let model = vehicle("synchro-drive", &[0.1, 0.5, 0.6]);
    let d = model.definitions().unwrap();
    assert!(["v_l", "v_t", "v_d", "v_n"].iter().all(|v| d.get(&Symbol::new(v)).unwrap().is_total()));
    let found: Vec<&str> = model.applicable(effects::all()).into_iter().map(|(e, _)| e.id.as_str()).collect();
    let wheels = ["rotation-creep", "wheel-radius", "traverse-creep", "steering-gain", "steering-offset"];
    let rest = ["input-delay", "heading-misalignment", "drift"];
    assert_eq!(found, [&wheels[..], &rest].concat());
}

#[test]
fn a_castor_follows_and_does_not_steer() {
    let numbers = (-5.0..5.0f64, -5.0..5.0f64, -4.0..4.0f64, -4.0..4.0f64, -0.3..0.3f64);
    check(500, numbers, |(left, right, gamma, phi, e)| {
        let parameters = [("wheel_radius", 0.1), ("track_width", 0.4)];
        let castor = [("castor_offset", -0.3), ("castor_trail", 0.05), ("castor_wheel_radius", 0.03)];
        let inputs = [("wheel_rate_left", left), ("wheel_rate_right", right), ("phi", phi), ("gamma", gamma)];
        let creeps = [
            effect("unequal-rotation-creep", None, &[e, 0.1]),
            effect("traverse-creep", None, &[-e]),
            effect("side-slope", None, &[1.0, 0.2]),
        ];
        let [bare, with] = [
            ("differential-drive", parameters.to_vec()),
            ("differential-drive-castor", [&parameters[..], &castor].concat()),
        ]
        .map(|(id, p)| creeps.iter().cloned().fold(Model::new(id, &p).unwrap(), Model::with_effect));
        let (body, m) = (motion(&bare, &inputs[..3]), motion(&with, &inputs));
        for name in ["x'", "y'", "phi'", "v_l", "v_t"] {
            prop_assert_eq!(get(&body, name), get(&m, name));
        }
        // The contact, by differences of its place: it moves along the castor, as fast as its wheel rolls.
        let place = |h: f64| {
            let at = |q: &str, start: f64| start + h * get(&m, &format!("{q}'"));
            let (x, y, phi, gamma) = (at("x", 0.0), at("y", 0.0), at("phi", phi), at("gamma", gamma));
            let psi = phi + gamma;
            [x - 0.3 * phi.cos() - 0.05 * psi.cos(), y - 0.3 * phi.sin() - 0.05 * psi.sin()]
        };
        let (a, b) = (place(-1e-6), place(1e-6));
        let [vx, vy] = [0, 1].map(|k| (b[k] - a[k]) / 2e-6);
        let (sin, cos) = (phi + gamma).sin_cos();
        prop_assert!((vy * cos - vx * sin).abs() < 1e-7, "slides by {}", vy * cos - vx * sin);
        prop_assert!((vx * cos + vy * sin - 0.03 * get(&m, "theta_c'")).abs() < 1e-7);
        Ok(())
    });
    // It swings to trail: forward driving turns it back to zero.
    let m = motion(
        &vehicle("differential-drive-castor", &[0.1]),
        &[("wheel_rate_left", 1.0), ("wheel_rate_right", 1.0), ("gamma", 0.2)],
    );
    assert!(get(&m, "gamma'") < 0.0);
}

#[test]
fn mechanisms_have_the_coordinates_and_the_rank_of_the_theory() {
    for (id, expected, constraints, independent) in [
        ("disk", "s theta", 1, 1),
        ("sleigh", "x y phi", 1, 1),
        ("differential-drive-castor", "x y phi gamma theta_1 theta_2 theta_c", 5, 5),
        ("synchro-drive", "x y phi delta theta_1 theta_2 theta_3", 6, 5),
        ("skid-steer", "x y phi theta_1 theta_2 theta_3 theta_4", 6, 6),
        ("four-wheel-car", "x y phi delta theta", 3, 3),
        ("tracked", "x y phi theta_1 theta_2", 3, 3),
        ("mecanum", "x y phi theta_1 theta_2 theta_3 theta_4", 4, 4),
    ] {
        let m = mechanism(vehicles::named(id).unwrap(), 0);
        let names: Vec<&str> = m.coordinates.iter().map(Symbol::as_str).collect();
        assert_eq!((names.join(" ").as_str(), m.constraints.len()), (expected, constraints), "{id}");
        // Straight wheels and turned ones: three wheels leave no angle of steering at which the body could turn.
        for delta in [0.0, 0.7, std::f64::consts::FRAC_PI_2] {
            let at = |s: &Symbol| match s.as_str() {
                "delta" => delta,
                name => name.bytes().fold(0.3, |x, b| (x * 7.3 + f64::from(b)).sin() + 1.3),
            };
            let rows = m.ideal_rows();
            let entry = |i: usize, j: usize| rows[i].coefficient(&m.coordinates[j].rate()).eval(&at).unwrap();
            let matrix = nalgebra::DMatrix::from_fn(rows.len(), m.coordinates.len(), entry);
            assert_eq!(matrix.rank(1e-9), independent, "{id} at {delta}");
        }
    }
}

#[test]
fn the_front_wheels_of_a_car_stand_at_ackermanns_angles() {
    let numbers = (-0.7..0.7f64, -5.0..5.0f64, -0.2..0.2f64, -0.2..0.2f64, -0.2..0.2f64);
    check(500, numbers, |(delta, rate, e_f, e_r, e_rc)| {
        let creeps = [("front-traverse-creep", e_f), ("traverse-creep", e_r), ("rotation-creep", e_rc)];
        let bare = Model::new("four-wheel-car", &[("wheel_radius", 0.3), ("wheelbase", 2.6), ("track_width", 1.5)]);
        let model = creeps.into_iter().fold(bare.unwrap(), |m, (id, e)| m.with_effect(effect(id, None, &[e])));
        let m = motion(&model, &[("wheel_rate", rate), ("steering_angle", delta)]);
        let (v_l, v_t, turn) = (get(&m, "v_l"), get(&m, "v_t"), get(&m, "phi'"));
        for (side, angle, creep, front, rear) in
            [(-0.75, "delta_fr", "e_fr", "theta_3'", "theta_1'"), (0.75, "delta_fl", "e_fl", "theta_4'", "theta_2'")]
        {
            // The line of the rear axle and that of the wheel meet above the centre of turning.
            near(get(&m, angle), (2.6 * delta.sin()).atan2(2.6 * delta.cos() - side * delta.sin()))?;
            let (ahead, left) = (v_l - side * turn, v_t + 2.6 * turn);
            let (sin, cos) = get(&m, angle).sin_cos();
            near(get(&m, front), (ahead * cos + left * sin) / 0.3)?;
            near(get(&m, rear), ahead / (0.3 * (1.0 - e_rc)))?;
            if rate.abs() > 0.1 {
                near(get(&m, creep), (left * cos - ahead * sin) / (ahead * cos + left * sin))?;
                prop_assert!(e_f != 0.0 || e_r != 0.0 || get(&m, creep).abs() < 1e-12);
            }
        }
        Ok(())
    });
    // Where the track is not given the motion is the same, to the last bit that of a car, and the wheels have no angles.
    let turning = [("wheel_rate", 4.0), ("steering_angle", 0.3)];
    let plain = motion(&Model::new("four-wheel-car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap(), &turning);
    let car = motion(&vehicle("car", &[0.3, 2.6]), &turning);
    assert!(get(&plain, "delta_fr").is_nan());
    assert_eq!(["x'", "y'", "phi'"].map(|n| get(&plain, n)), ["x'", "y'", "phi'"].map(|n| get(&car, n)));
}

#[test]
fn both_axles_of_a_car_steer() {
    check(500, (-0.7..0.7f64, -0.7..0.7f64, -5.0..5.0f64, -0.2..0.2f64), |(front, rear, rate, e)| {
        let model = Model::new("four-wheel-steering", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap();
        let model = model.with_effect(effect("traverse-creep", None, &[e]));
        let inputs = [("wheel_rate", rate), ("steering_angle", front), ("steering_angle_rear", rear)];
        let m = motion(&model, &inputs);
        let course = rear + e.atan();
        let speed = 0.3 * rate / e.atan().cos();
        near(get(&m, "v_l"), speed * course.cos())?;
        near(get(&m, "v_t"), speed * course.sin())?;
        near(get(&m, "phi'"), speed * (front - course).sin() / (2.6 * front.cos()))
    });
}

#[test]
fn tracks_roll_at_their_centres_of_rotation() {
    let centres = (-0.2..0.2f64, -0.2..0.2f64);
    check(500, (-5.0..5.0f64, -5.0..5.0f64, centres), |(right, left, (icr_forward_offset, icr_left_offset))| {
        let lengths = [
            ("wheel_radius", 0.1),
            ("track_width", 0.8),
            ("icr_forward_offset", icr_forward_offset),
            ("icr_left_offset", icr_left_offset),
        ];
        let m = motion(
            &Model::new("tracked", &lengths).unwrap(),
            &[("wheel_rate_right", right), ("wheel_rate_left", left)],
        );
        // Martinez and others: v_x = (V_r*y_l - V_l*y_r)/(y_l - y_r), v_y = (V_l - V_r)*x/(y_l - y_r).
        let (v_r, v_l, y_l, y_r) = (0.1 * right, 0.1 * left, icr_left_offset + 0.4, icr_left_offset - 0.4);
        near(get(&m, "v_l"), (v_r * y_l - v_l * y_r) / (y_l - y_r))?;
        near(get(&m, "v_t"), (v_l - v_r) * icr_forward_offset / (y_l - y_r))?;
        near(get(&m, "phi'"), (v_r - v_l) / (y_l - y_r))
    });
}

#[test]
fn four_mecanum_wheels_move_the_body_by_least_squares() {
    check(500, (prop::array::uniform4(-9.0..9.0f64), -0.3..0.3f64), |(rates, e)| {
        let lengths = [("wheel_radius", 0.05), ("track_width", 0.4), ("wheelbase", 0.3)];
        let model = Model::new("mecanum", &lengths).unwrap().with_effect(effect("rotation-creep", None, &[e]));
        let names = ["front_right", "front_left", "rear_right", "rear_left"].map(|n| format!("wheel_rate_{n}"));
        let inputs: Vec<(&str, f64)> = names.iter().map(String::as_str).zip(rates).collect();
        let m = motion(&model, &inputs);
        // Row by row: place ahead and to the left, tangent of the roller's angle.
        let wheels = [(0.15, -0.2, 1.0), (0.15, 0.2, -1.0), (-0.15, -0.2, -1.0), (-0.15, 0.2, 1.0)];
        let rows = nalgebra::DMatrix::from_fn(4, 3, |i, j| {
            let (ahead, left, tan): (f64, f64, f64) = wheels[i];
            [1.0, tan, tan * ahead - left][j]
        });
        let speeds = nalgebra::DVector::from_iterator(4, rates.iter().map(|rate| 0.05 * (1.0 - e) * rate));
        let least = rows.svd(true, true).solve(&speeds, 1e-12).unwrap();
        near(get(&m, "v_l"), least[0])?;
        near(get(&m, "v_t"), least[1])?;
        near(get(&m, "phi'"), least[2])
    });
    // What skids is no motion.
    let lengths = [("wheel_radius", 0.05), ("track_width", 0.4), ("wheelbase", 0.3)];
    let names = [("wheel_rate_front_right", 1.0), ("wheel_rate_front_left", 1.0), ("wheel_rate_rear_right", -1.0)];
    let m =
        motion(&Model::new("mecanum", &lengths).unwrap(), &[&names[..], &[("wheel_rate_rear_left", -1.0)]].concat());
    assert_eq!(["v_l", "v_t", "phi'"].map(|n| get(&m, n)), [0.0; 3]);
}

#[test]
fn three_omni_wheels_move_the_body_anywhere() {
    let all = creepage::extensions::vehicles_with_own("examples/omni/omni.toml").unwrap();
    let own = all.iter().find(|v| v.id == "three-omni").unwrap();
    let model = Model::of(own, &[("wheel_radius", 0.05), ("circle_radius", 0.2)]).unwrap();
    check(300, prop::array::uniform3(-9.0..9.0f64), |rates| {
        let names = ["wheel_rate_front_right", "wheel_rate_front_left", "wheel_rate_rear"];
        let inputs: Vec<(&str, f64)> = names.into_iter().zip(rates).collect();
        let m = motion(&model, &inputs);
        let [right, left, rear] = rates.map(|rate| 0.05 * rate);
        near(get(&m, "v_l"), (right - left) / 3f64.sqrt())?;
        near(get(&m, "v_t"), (right + left - 2.0 * rear) / 3.0)?;
        near(get(&m, "phi'"), (right + left + rear) / 0.6)
    });
}

/// A car with one more wheel.
fn car_with(wheel: Wheel) -> Model {
    let mut model = vehicle("car", &[0.3, 2.6]);
    model.vehicle.wheels.push(wheel);
    model
}

#[test]
fn rows_that_are_left_over_must_follow_from_the_others() {
    let car = vehicles::named("car").unwrap();
    let front = car.wheels[1].clone();
    // The same row twice says nothing new.
    assert!(car_with(front.clone()).definitions().is_ok());
    // Another coefficient: the rows agree for wheels that do not creep, and only for them.
    let other = Wheel { traverse_creep: Some("e_2".into()), ..front };
    assert!(car_with(other).definitions().is_err());
    // A wheel h to the left of a unicycle turns as fast as the inputs say, or contradicts them.
    let beside = Wheel { left: Expr::sym("h"), rate: Some("theta_2'".into()), traverse_creep: None, ..unicycle() };
    let with_rate = |formula: &str| {
        let mut model = Model::new("unicycle", &[("wheel_radius", 0.3)]).unwrap();
        let formula = Expr::parse(formula).unwrap();
        let rate = Definition { formula, unit: "rad/s".into(), meaning: "rate of the wheel beside".into() };
        model.vehicle.define.insert("theta_2'".into(), rate);
        model.vehicle.wheels.push(beside.clone());
        model.definitions()
    };
    assert!(with_rate("theta' - h*phi'/(r*(1 - e_rc))").is_ok());
    for wrong in [
        "theta' + h*phi'/(r*(1 - e_rc))",
        "theta' - 1.000001*h*phi'/(r*(1 - e_rc))",
        "theta' - h*phi'/r",
        "theta'",
        "wheel_rate_2",
    ] {
        let error = with_rate(wrong).unwrap_err();
        assert!(error.to_string().contains("the constraints of unicycle contradict each other"), "{wrong}: {error}");
    }
}

fn unicycle() -> Wheel {
    vehicles::named("unicycle").unwrap().wheels[0].clone()
}
