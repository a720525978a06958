//! RᵏTᵐ by ranks: which coefficients realise a motion, given what is measured.

use crate::support::described::*;
use creepage::formula::{BigRational, Exact, Symbol};
use creepage::mechanism::{Mechanism, Point, Realisation};
use creepage::{model::mechanism, vehicles};

fn rates(names: &[&str]) -> Vec<Symbol> {
    names.iter().map(|n| Symbol::from(*n)).collect()
}

fn realised(mechanism: &Mechanism, measured: &[&str], at: &Point) -> Realisation {
    mechanism.realisation(&rates(measured), at).unwrap_or_else(|e| panic!("{e}"))
}

fn names(mechanism: &Mechanism, set: &[usize]) -> Vec<String> {
    set.iter().map(|r| mechanism.constraints[*r].creep.to_string()).collect()
}

/// A train with bends that repeat, none of them a right angle.
fn train(count: usize) -> Point {
    let bends = [toward(4, 3), toward(12, -5), toward(3, 4), toward(15, -8)];
    let betas: Vec<Exact> = bends.iter().cycle().take(count).cloned().collect();
    trailers(general(), &headings(&toward(4, 3), &betas))
}

fn power(letter: char, n: usize) -> String {
    if n == 1 { letter.to_string() } else { format!("{letter}^{n}") }
}

#[test]
fn bodies_have_the_signatures_of_the_corrected_theorem() {
    let at = general().with("r_1", Exact::ratio(1, 2)).with("r_2", Exact::ratio(1, 2));
    let at = at.with("delta_r", toward(15, 8)).with("b", Exact::ratio(1, 5)).with("h", Exact::ratio(2, 7));
    let named = |id: &str| mechanism(vehicles::named(id).unwrap(), 0);
    let cases: [(&str, &[&str], &str); 7] = [
        ("unicycle", &["theta'", "phi'"], "RT"),
        ("differential-drive", &["theta_1'", "theta_2'"], "R^2T"),
        ("car", &["theta'"], "RT^2"),
        ("four-wheel-car", &["theta'"], "RT^2"),
        ("tricycle", &["theta'"], "RT^2"),
        ("four-wheel-steering", &["theta'"], "RT^2"),
        ("tracked", &["theta_1'", "theta_2'"], "R^2T"),
    ];
    for (id, measured, signature) in cases {
        let found = realised(&named(id), measured, &at);
        assert_eq!(found.signature(), signature, "{id}");
        assert!(found.is_complete && found.passive.is_empty(), "{id}");
        assert_eq!(found.sets.len(), 1, "{id}");
    }
    // The yaw rate measured too: one coefficient less.
    assert_eq!(realised(&named("differential-drive"), &["theta_1'", "theta_2'", "phi'"], &at).signature(), "RT");
}

#[test]
fn trains_have_a_traverse_coefficient_for_each_trailer() {
    let car = format!("{SINGLE_WHEEL}{FRONT_AXLE}{}", measured(&["delta"]));
    for n in 0..=10 {
        let at = train(n);
        let unicycle = realised(&of(SINGLE_WHEEL, n), &["theta'", "phi'"], &at);
        assert_eq!(unicycle.signature(), format!("R{}", power('T', n + 1)), "{n}");
        assert_eq!(unicycle.counts(), (1, n + 1));
        let steered = realised(&of(&car, n), &["theta'"], &at);
        assert_eq!(steered.signature(), format!("R{}", power('T', n + 2)), "{n}");
        let driven = realised(&of(TWO_WHEEL, n), &["theta_1'", "theta_2'"], &at);
        assert_eq!(driven.signature(), format!("R^2{}", power('T', n + 1)), "{n}");
    }
}

#[test]
fn a_set_is_regular_or_it_is_not_listed() {
    let skid = of(&wheels_at(&SKID_PLACES, None), 0);
    let found = realised(&skid, &["theta_1'", "theta_2'", "theta_3'", "theta_4'"], &general());
    assert_eq!(found.signature(), "R^2T");
    assert_eq!(names(&skid, found.canonical()), ["e_rc_1", "e_rc_2", "e_tc_w1"]);
    assert_eq!(found.passive.len(), 5);
    // By hand: rolling knows only the side of a wheel (right 1, 3; left 2, 4), direction only its axle (front 1, 2;
    // rear 3, 4). Two sides and an axle: 4·4; one side and both axles: 4·4.
    assert_eq!((found.sets.len(), found.is_complete), (32, true));
    let sides = |set: &[usize]| {
        set.iter()
            .map(|r| (r % 2, if r % 2 == 0 { r / 2 % 2 } else { r / 4 }))
            .collect::<std::collections::BTreeSet<_>>()
    };
    assert!(found.sets.iter().all(|s| sides(s).len() == 3), "{:?}", found.sets);
    // R T_front T_rear is among them.
    assert!(found.sets.iter().any(|s| names(&skid, s) == ["e_rc_1", "e_tc_w1", "e_tc_w3"]));
}

#[test]
fn a_castor_is_passive_when_its_angle_is_measured() {
    let robot = of(&format!("{TWO_WHEEL}{CASTOR}"), 0);
    let seen = realised(&robot, &["theta_1'", "theta_2'", "psi'"], &general());
    assert_eq!(seen.signature(), "R^2T");
    assert_eq!(seen.unknown, rates(&["x'", "y'", "phi'"]));
    let (mut sets, castor) = (seen.sets.clone(), 4);
    // The castor's own rolling, constraint 3, gives its rate: it has no coefficient to choose.
    assert!(sets.iter().all(|s| !s.contains(&3)) && seen.passive == [castor]);
    sets.retain(|s| s.contains(&castor));
    assert!(!sets.is_empty());
    // Not measured: its direction is needed to know where it turns.
    let unseen = realised(&robot, &["theta_1'", "theta_2'"], &general());
    assert_eq!((unseen.signature().as_str(), unseen.sets.len()), ("R^2T^2", 1));
    assert_eq!(unseen.unknown, rates(&["x'", "y'", "phi'", "psi'"]));
    // A castor with an encoder is one more rolling constraint, and rolling comes first: it tells the side slide that
    // the axle's direction told before.
    let counted = realised(&robot, &["theta_1'", "theta_2'", "theta_3'", "psi'"], &general());
    assert_eq!((counted.signature().as_str(), counted.passive.len()), ("R^3", 2));
    assert!(counted.sets.iter().any(|s| names(&robot, s) == ["e_rc_1", "e_rc_2", "e_tc"]));
}

#[test]
fn passive_coefficients_follow_from_the_chosen_ones() {
    // A further wheel h ahead of the axle and w to its left: e = (v_t + h·phi')/(v_l - w·phi').
    let robot = of(
        &format!(
            "{TWO_WHEEL}{}",
            r#"
[[wheels]]
name = "further"
forward = "h"
left = "w"
radius = "R"
rate = "theta_3'"
rotation_creep = "e_rc_3"
traverse_creep = "e_3"
"#
        ),
        0,
    );
    let at = general().with("h", Exact::ratio(3, 4)).with("w", Exact::ratio(1, 3));
    let found = realised(&robot, &["theta_1'", "theta_2'", "theta_3'"], &at);
    assert_eq!(found.signature(), "R^2T");
    assert_eq!(names(&robot, &found.passive), ["e_rc_3", "e_3"]);
    let ratio = |p: i64, q: i64| BigRational::from_parts_signed(p.into(), q.into());
    let values = [
        ("e_rc_1", ratio(1, 50)),
        ("e_rc_2", ratio(1, 20)),
        ("e_tc", ratio(-1, 10)),
        ("theta_1'", ratio(4, 1)),
        ("theta_2'", ratio(3, 1)),
        ("theta_3'", ratio(7, 2)),
        ("r", ratio(1, 2)),
        ("R", ratio(2, 3)),
        ("a", ratio(3, 2)),
        ("h", ratio(3, 4)),
        ("w", ratio(1, 3)),
    ];
    let value = |name: &str| values.iter().find(|(n, _)| *n == name).map(|(_, v)| v.clone()).unwrap();
    let wheel = |k: usize| {
        let one = ratio(1, 1);
        value("r") * value(&format!("theta_{k}'")) * (one - value(&format!("e_rc_{k}")))
    };
    let (v_l, yaw) = ((wheel(1) + wheel(2)) / ratio(2, 1), (wheel(1) - wheel(2)) / value("a"));
    let v_t = value("e_tc") * &v_l;
    let along = &v_l - value("w") * &yaw;
    let expected = [ratio(1, 1) - &along / (value("R") * value("theta_3'")), (v_t + value("h") * &yaw) / along];
    for (constraint, expected) in found.passive.iter().zip(expected) {
        let formula = robot.passive_coefficient(&found, *constraint).unwrap();
        let known = |s: &Symbol| match s.as_str() {
            "phi" => toward(4, 3),
            name => Exact::rational(value(name)),
        };
        let e = formula.eval(&known).unwrap();
        assert_eq!(e.as_rational(), Some(&expected), "{formula}");
    }
    assert!(robot.passive_coefficient(&found, found.canonical()[0]).is_none());
    assert!(robot.passive_coefficient(&found, 99).is_none());
}

#[test]
fn what_cannot_act_is_not_chosen() {
    // A trailer at a right angle stands: its coefficient cannot say how it slides.
    let bent = trailers(general(), &headings(&toward(4, 3), &[toward(0, 1)]));
    let error = of(SINGLE_WHEEL, 1).realisation(&rates(&["theta'", "phi'"]), &bent).unwrap_err();
    assert!(error.to_string().contains("do not determine x', y', phi_1'"), "{error}");
    // Nothing measured: a wheel whose rate is not known has no coefficient.
    assert!(of(SINGLE_WHEEL, 0).realisation(&[], &general()).is_err());
    // A coefficient of two constraints is refused.
    let shared = SINGLE_WHEEL.replace("e_tc", "e_rc");
    let error = of(&shared, 0).realisation(&rates(&["theta'", "phi'"]), &general()).unwrap_err();
    assert!(error.to_string().contains("e_rc"), "{error}");
    // A point without values is refused with the constraint it is about.
    let error = of(SINGLE_WHEEL, 0).realisation(&rates(&["theta'", "phi'"]), &Point::default()).unwrap_err();
    assert!(error.to_string().contains("theta'"), "{error}");
}

#[test]
fn more_sets_than_can_be_listed_are_said_to_be_incomplete() {
    let places: Vec<(String, String)> = (0..12).map(|k| (k.to_string(), (k * k).to_string())).collect();
    let places: Vec<(&str, &str)> = places.iter().map(|(f, l)| (f.as_str(), l.as_str())).collect();
    let many = of(&wheels_at(&places, Some("psi")), 0);
    let encoders: Vec<String> = (1..=12).map(|k| format!("theta_{k}'")).collect();
    let encoders: Vec<&str> = encoders.iter().map(String::as_str).collect();
    let found = realised(&many, &encoders, &general());
    assert!(!found.is_complete && found.sets.len() == 1000 && found.signature() == "R^2T");
    assert_eq!(found.canonical(), [0, 2, 1]);
}

/// A differential drive with one more wheel that is steered, its place written as a difference and a quotient.
const STEERED_BEHIND: &str = r#"
[[wheels]]
name = "further"
forward = "h/k - c"
left = "w"
steering = "mu"
traverse_creep = "e_further"
"#;

#[test]
fn a_steered_wheel_is_passive_and_its_coefficient_does_not_depend_on_the_heading() {
    let robot = of(&format!("{TWO_WHEEL}{STEERED_BEHIND}{}", measured(&["mu"])), 0);
    let names = [("h", 3, 4), ("k", 5, 2), ("c", 2, 3), ("w", 1, 3)];
    let at = names.iter().fold(general(), |p, (name, n, d)| p.with(*name, Exact::ratio(*n, *d)));
    let found = realised(&robot, &["theta_1'", "theta_2'"], &at.with("mu", toward(4, 3)));
    assert_eq!(found.passive, [3]);
    let [ahead, seen] =
        [robot.passive_coefficient_ahead(&found, 3).unwrap(), robot.passive_coefficient(&found, 3).unwrap()];
    assert!(!ahead.mentions(&"phi".into()), "{ahead}");
    let value = |name: &str| match name {
        "phi" => 0.4_f64,
        "mu" => 0.7,
        "theta_1'" => 4.0,
        "theta_2'" => 3.0,
        "e_rc_1" => 0.02,
        "e_rc_2" => 0.05,
        "e_tc" => -0.1,
        "r" => 0.5,
        "a" => 1.5,
        "h" => 0.75,
        "k" => 2.5,
        "c" => 0.6,
        "w" => 0.3,
        _ => panic!("{name}"),
    };
    // By hand: the velocity of the contact along the body and across it, then along the wheel and across it.
    let [right, left] = [0.5 * 4.0 * 0.98, 0.5 * 3.0 * 0.95];
    let (v_l, yaw) = ((right + left) / 2.0, (right - left) / 1.5);
    let (u, w) = (v_l - 0.3 * yaw, -0.1 * v_l + (0.75 / 2.5 - 0.6) * yaw);
    let (sin, cos) = 0.7_f64.sin_cos();
    let expected = (w * cos - u * sin) / (u * cos + w * sin);
    for formula in [ahead, seen] {
        let e = formula.eval(&|s| value(s.as_str())).unwrap();
        assert!((e - expected).abs() < 1e-12, "{e}, by hand {expected}: {formula}");
    }
}
