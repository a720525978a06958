//! The holonomic and nonholonomic part of a description, and its RT signature by ranks.

use crate::models::{ALONE, STILL, effect, machines, reviewed_as_text, still, vehicle};
use creepage::describe::{self, Description, Holonomy, Realised, Structure};
use creepage::formula::{Exact, Expr, Symbol};
use creepage::model::{Model, Trailer};
use creepage::vehicles;
use std::time::{Duration, Instant};

fn structure(model: &Model) -> Structure {
    Structure::of(model).unwrap()
}

fn holonomy(model: &Model) -> Holonomy {
    structure(model).holonomy.unwrap_or_else(|e| panic!("{}: {e}", model.vehicle.id))
}

fn realised(model: &Model) -> Realised {
    structure(model).realisation.unwrap_or_else(|e| panic!("{}: {e}", model.vehicle.id))
}

fn texts<T: ToString>(all: &[T]) -> Vec<String> {
    all.iter().map(ToString::to_string).collect()
}

fn on_axle(count: usize) -> Vec<Trailer> {
    vec![Trailer { length: 2.5, hitch: 0.0 }; count]
}

/// id, coordinates, growth vector, holonomic, nonholonomic, integrals.
type Row = (&'static str, usize, &'static [usize], usize, usize, &'static [&'static str]);

/// Known from the table of growth vectors, the disk and the sleigh by hand.
const VEHICLES: [Row; 14] = [
    ("unicycle", 4, &[2, 3, 4], 0, 2, &[]),
    ("differential-drive", 5, &[2, 3, 4], 1, 2, &["r_1*theta_1 - r_2*theta_2 - a*phi"]),
    ("car", 5, &[2, 3, 4, 5], 0, 3, &[]),
    ("four-wheel-car", 5, &[2, 3, 4, 5], 0, 3, &[]),
    // The front wheel is a single wheel and the body its trailer.
    ("tricycle", 5, &[2, 3, 5], 0, 3, &[]),
    ("disk", 2, &[1], 1, 0, &["s - r*theta"]),
    ("sleigh", 3, &[2, 3], 0, 1, &[]),
    ("hopper", 3, &[2, 3], 0, 1, &[]),
    ("differential-drive-castor", 7, &[2, 3, 5, 6], 1, 4, &["r_1*theta_1 - r_2*theta_2 - a*phi"]),
    ("synchro-drive", 7, &[2, 3, 4], 3, 2, &["phi", "theta_1 - theta_2", "theta_1 - theta_3"]),
    (
        "skid-steer",
        7,
        &[1],
        6,
        0,
        &[
            "phi",
            "theta_1 - theta_2",
            "theta_1 - theta_3",
            "theta_1 - theta_4",
            "x*sin(phi) - y*cos(phi)",
            "x - r*theta_1*cos(phi)",
        ],
    ),
    // Two angles and a drive; each angle turns the rear wheel or the body, and a bracket of the drive frees its own rate.
    ("four-wheel-steering", 6, &[3, 5, 6], 0, 3, &[]),
    ("tracked", 5, &[2, 3, 4], 1, 2, &["r_1*theta_1 - r_2*theta_2 - a*phi"]),
    // Ahead, sideways and about, and the two translations without the wheels: five of seven.
    ("mecanum", 7, &[3, 5], 2, 2, &["r*theta_2 - r*theta_3 + a*phi + b*phi", "theta_1 + theta_2 - theta_3 - theta_4"]),
];

#[test]
fn every_vehicle_has_the_numbers_of_the_table() {
    assert_eq!(VEHICLES.len(), vehicles::all().len());
    for (id, n, growth, holonomic, nonholonomic, integrals) in VEHICLES {
        let model = vehicle(id, &[0.7, 0.3, 2.1]);
        let found = holonomy(&model);
        assert_eq!(structure(&model).coordinates.len(), n, "{id}");
        assert_eq!((found.growth.as_slice(), found.degree), (growth, growth.len()), "{id}");
        assert_eq!((found.holonomic, found.nonholonomic), (holonomic, nonholonomic), "{id}");
        assert_eq!(found.rank, holonomic + nonholonomic, "{id}");
        assert_eq!(texts(&found.integrals), integrals, "{id}");
    }
}

/// id, signature, canonical set, number of other sets, passive coefficients.
type Set = (&'static str, &'static str, &'static [&'static str], usize, &'static [&'static str]);

const SETS: [Set; 10] = [
    ("unicycle", "R T", &["e_rc", "e_tc"], 0, &[]),
    ("differential-drive", "R^2 T", &["e_rc_1", "e_rc_2", "e_tc"], 0, &[]),
    ("car", "R T^2", &["e_rc", "e_tc", "e_f"], 0, &[]),
    ("four-wheel-car", "R T^2", &["e_rc", "e_tc", "e_f"], 0, &[]),
    ("tricycle", "R T^2", &["e_rc", "e_tc", "e_f"], 0, &[]),
    ("disk", "R", &["e_rc"], 0, &[]),
    // The castor's angle is not measured: its direction is needed, its rolling gives its own rate.
    ("differential-drive-castor", "R^2 T^2", &["e_rc_1", "e_rc_2", "e_tc", "e_tc_c"], 0, &[]),
    // By hand: two sides and an axle, 2·2·2 sets, or a side and both axles, 4 sets.
    ("skid-steer", "R^2 T", &["e_rc_1", "e_rc_2", "e_front"], 11, &["e_rc_3", "e_rc_4", "e_rear"]),
    ("four-wheel-steering", "R T^2", &["e_rc", "e_tc", "e_f"], 0, &[]),
    ("tracked", "R^2 T", &["e_rc_1", "e_rc_2", "e_tc"], 0, &[]),
];

#[test]
fn every_vehicle_has_its_signature_by_ranks() {
    for (id, signature, canonical, others, passive) in SETS {
        let found = realised(&vehicle(id, &[0.7, 0.3, 2.1]));
        assert_eq!(found.signature.to_string(), signature, "{id}");
        assert_eq!(texts(&found.canonical), canonical, "{id}");
        assert_eq!((found.other_count, found.others.len(), found.is_complete), (others, others.min(5), true), "{id}");
        let names: Vec<String> = found.passive.iter().map(|(e, _)| e.to_string()).collect();
        assert_eq!(names, passive, "{id}");
        assert_eq!(found.unknown.len(), found.canonical.len(), "{id}");
        assert!(found.unknown.iter().all(|u| !found.measured.contains(u)), "{id}");
    }
}

#[test]
fn passive_coefficients_are_the_ones_of_a_turning_body() {
    let found = realised(&vehicle("skid-steer", &[0.7, 0.3, 2.1]));
    let [e_1, e_2, e_front] = [(1, 50), (1, 20), (-1, 10)];
    let values: Vec<(&str, (i64, i64))> = vec![
        ("e_rc_1", e_1),
        ("e_rc_2", e_2),
        ("e_front", e_front),
        ("theta_1'", (4, 1)),
        ("theta_2'", (3, 1)),
        ("theta_3'", (7, 2)),
        ("theta_4'", (5, 2)),
        ("r", (1, 2)),
        ("a", (3, 2)),
        ("b", (2, 1)),
    ];
    let value = |s: &Symbol| match values.iter().find(|(n, _)| *n == s.as_str()) {
        Some((_, (p, q))) => Exact::ratio(*p, *q),
        None => Exact::half_tangent(1, 2),
    };
    // Speed of the sides: v_l + a/2·phi' right, v_l − a/2·phi' left; front (v_t + b/2·phi')/v_l, rear with a minus.
    let number = |text: &str| Expr::parse(text).unwrap().eval(&value).unwrap().as_rational().cloned();
    let [right, left] = ["r*theta_1'*(1 - e_rc_1)", "r*theta_2'*(1 - e_rc_2)"];
    let forward = format!("(({right} + {left})/2)");
    let yaw = format!("(({right} - {left})/a)");
    let expected = [
        ("e_rc_3", format!("1 - {right}/(r*theta_3')")),
        ("e_rc_4", format!("1 - {left}/(r*theta_4')")),
        ("e_rear", format!("(e_front*{forward} - b*{yaw})/{forward}")),
    ];
    for ((name, formula), (expected_name, expected)) in found.passive.iter().zip(&expected) {
        assert_eq!(name.as_str(), *expected_name);
        let formula = formula.as_ref().unwrap_or_else(|| panic!("{name} has no formula"));
        println!("{name} = {formula}");
        assert!(!formula.mentions(&"phi".into()), "{formula}");
        assert_eq!(formula.eval(&value).unwrap().as_rational().cloned(), number(expected), "{name} = {formula}");
    }
}

fn power(letter: char, n: usize) -> String {
    if n == 1 { letter.to_string() } else { format!("{letter}^{n}") }
}

#[test]
fn trains_of_up_to_three_trailers_have_the_numbers_of_the_table() {
    let wheel: [&[usize]; 5] = [&[2, 3, 4], &[2, 3, 5], &[2, 3, 5, 6], &[2, 3, 5, 6, 7], &[2, 3, 5, 6, 7, 8]];
    let car: [&[usize]; 4] = [&[2, 3, 4, 5], &[2, 3, 4, 5, 6], &[2, 3, 4, 5, 7], &[2, 3, 4, 5, 7, 8]];
    for v in vehicles::all().iter().filter(|v| v.pulls()) {
        for n in 0..=3 {
            let model = vehicle(&v.id, &[0.7, 0.3, 2.1]).with_trailers(&on_axle(n));
            let (label, found) = (format!("{} + {n}", v.id), holonomy(&model));
            let alone = VEHICLES.iter().find(|row| row.0 == v.id).unwrap();
            // A trailer adds a coordinate and a nonholonomic constraint.
            assert_eq!(structure(&model).coordinates.len(), alone.1 + n, "{label}");
            assert_eq!((found.holonomic, found.nonholonomic), (alone.3, alone.4 + n), "{label}");
            assert_eq!(found.growth.last(), Some(&(alone.1 + n - alone.3)), "{label}");
            assert_eq!(found.integrals.len(), alone.5.len(), "{label}");
            match v.id.as_str() {
                // Two wheels tell heading and mean angle: a single wheel, and the integral.
                "unicycle" | "differential-drive" => assert_eq!(found.growth, wheel[n], "{label}"),
                "car" | "four-wheel-car" => assert_eq!(found.growth, car[n], "{label}"),
                // A single wheel with the body as its first trailer.
                "tricycle" => assert_eq!(found.growth, wheel[n + 1], "{label}"),
                "four-wheel-steering" => assert_eq!(found.growth[..2], [3, 5], "{label}"),
                // The first trailer turns by a bracket of the translations.
                "mecanum" => assert_eq!(found.growth[..2], [3, 5 + n.min(1)], "{label}"),
                _ => assert_eq!(found.growth[..2], [2, 3], "{label}"),
            }
            let rolling = match v.id.as_str() {
                "unicycle" => (1, 1),
                "differential-drive" | "tracked" => (2, 1),
                "differential-drive-castor" => (2, 2),
                "synchro-drive" | "mecanum" => continue,
                _ => (1, 2),
            };
            let by_ranks = realised(&model);
            let expected = format!("{} {}", power('R', rolling.0), power('T', rolling.1 + n));
            assert_eq!(by_ranks.signature.to_string(), expected, "{label}");
            let last = by_ranks.canonical.last().map(ToString::to_string);
            assert!(n == 0 || last == Some(format!("e_tc_{n}")), "{label}: {last:?}");
        }
    }
}

#[test]
fn the_numbers_do_not_depend_on_the_lengths_but_on_which_are_zero() {
    for (id, _, growth, holonomic, nonholonomic, _) in VEHICLES {
        for values in [[0.1234567, 0.7654321, 1.9], [3.0, 2.0, 5.0]] {
            let found = holonomy(&vehicle(id, &values));
            assert_eq!(
                (found.growth.as_slice(), found.holonomic, found.nonholonomic),
                (growth, holonomic, nonholonomic)
            );
        }
    }
    let train = |hitch: f64| vehicle("unicycle", &[0.3]).with_trailers(&[Trailer { length: 2.5, hitch }; 3]);
    assert_eq!(holonomy(&train(0.0)).growth, [2, 3, 5, 6, 7]);
    assert_eq!(holonomy(&train(0.3)).growth, [2, 3, 5, 7]);
    // An effect on the hitches counts as a length.
    let patched = (1..=3).fold(train(0.0), |m, i| m.with_effect(effect("hitch-offset", Some(i), &[0.3])));
    assert_eq!(holonomy(&patched).growth, [2, 3, 5, 7]);
}

#[test]
fn what_is_logged_decides_what_is_measured() {
    let mut wheel = vehicle("unicycle", &[0.3]);
    assert_eq!(texts(&realised(&wheel).measured), ["theta'"]);
    let train = wheel.clone().with_trailers(&[Trailer { length: 2.5, hitch: 0.3 }]);
    assert_eq!(texts(&realised(&train).measured), ["phi'", "theta'"]);
    wheel.inputs = vec!["speed".into(), "yaw_rate".into()];
    assert_eq!(texts(&realised(&wheel).measured), ["theta'"]);
    assert_eq!(realised(&wheel).signature.to_string(), "R T");
    wheel.inputs = vec!["yaw_rate".into()];
    // The wheel then turns as it must, and one direction does not tell a velocity.
    assert!(structure(&wheel).realisation.unwrap_err().contains("do not determine x', y'"));
    assert_eq!(texts(&realised(&vehicle("car", &[0.3, 2.6])).measured), ["theta'"]);
}

#[test]
fn what_cannot_be_computed_is_said_in_words() {
    let sleigh = structure(&still()[0]).realisation.unwrap_err();
    assert_eq!(sleigh, "the constraints do not determine x', y', phi' at this point".replace(", phi'", ""));
    let synchro = vehicle("synchro-drive", &[0.1]);
    assert!(structure(&synchro).realisation.unwrap_err().contains("two constraints have the coefficient e_rc"));
    // A wheel mounted at an angle of 0.3 rad, whose sine is no rational number.
    let mut skewed = vehicle("car", &[0.3, 2.6]);
    skewed.vehicle.define.get_mut(&Symbol::from("delta")).unwrap().formula = Expr::parse("0.3").unwrap();
    let found = structure(&skewed);
    assert!(found.holonomy.unwrap_err().contains("no exact value"));
    assert!(found.realisation.unwrap_err().contains("no exact value"));
    // A length that is no number.
    let broken = vehicle("differential-drive", &[0.3, f64::NAN]);
    assert!(structure(&broken).holonomy.unwrap_err().contains("no exact value"));
    // Straight driving with a trailer: integrable, by a function that is not tried.
    let straight = vehicle("skid-steer", &[0.7, 0.3, 2.1]).with_trailers(&on_axle(1));
    let found = holonomy(&straight);
    assert_eq!((found.holonomic, found.nonholonomic, found.integrals.len()), (7, 0, 6));
    let text = describe::text(&Description::of(&straight).unwrap());
    assert!(text.contains("6 found, 1 more exist"), "{text}");
}

#[test]
fn a_castor_as_long_as_it_stands_ahead_has_an_integral_that_is_not_tried() {
    // With l_c = d_c = d and u = tan(gamma/2) the castor obeys u' = -(s'/d)*u - phi' up to signs, and
    // r_c*theta_c - s - d*ln(1 + u^2) stays constant, s the way of the middle of the axle.
    let lengths = [
        ("castor_offset", 0.3),
        ("castor_trail", 0.3),
        ("castor_wheel_radius", 0.1),
        ("track_width", 0.5),
        ("wheel_radius", 0.2),
    ];
    let start = Instant::now();
    let robot = Model::new("differential-drive-castor", &lengths).unwrap();
    let words = structure(&robot).holonomy.unwrap_err();
    assert!(words.contains("of 5 independent constraints at least 1 and at most 2 are holonomic"), "{words}");
    let train = structure(&robot.clone().with_trailers(&on_axle(5)));
    assert!(train.holonomy.unwrap_err().contains("at least 1 and at most 2"));
    println!("{:?}", start.elapsed());
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
    let d = Description::of(&robot).unwrap();
    assert!(describe::text(&d).contains("growth vector: not computed; of 5 independent"));
    assert!(describe::latex(&d).contains("growth vector: not computed; of 5 independent"));
    let json = describe::json(&d);
    assert_eq!(json["structure"]["holonomy"]["not_computed"], words);
}

#[test]
fn parameters_left_open_are_named() {
    let (_, synchro) = reviewed_as_text().into_iter().find(|(name, _)| *name == "synchro-drive").unwrap();
    assert_eq!(texts(&structure(&synchro).open), ["track_width", "wheelbase"]);
    let text = describe::text(&Description::of(&synchro).unwrap()).replace('\n', " ");
    assert!(text.contains("leaves track_width, wheelbase open"), "{text}");
    // The four-wheel car has no track width in its rows.
    let car = Model::new("four-wheel-car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap();
    assert!(structure(&car).open.is_empty());
}

#[test]
fn long_trains_are_answered_quickly_and_in_words() {
    let car = vehicle("car", &[0.3, 2.6]);
    for n in [40, 100] {
        let start = Instant::now();
        let found = structure(&car.clone().with_trailers(&on_axle(n)));
        assert!(start.elapsed() < Duration::from_secs(1), "{n}: {:?}", start.elapsed());
        assert_eq!(found.coordinates.len(), 5 + n);
        assert!(found.holonomy.unwrap_err().contains(&format!("at most 5 trailers, and the model has {n}")));
        assert!(found.realisation.unwrap_err().contains(&format!("at most 20 trailers, and the model has {n}")));
    }
    let start = Instant::now();
    let d = Description::of(&car.clone().with_trailers(&on_axle(40))).unwrap();
    let (text, json) = (describe::text(&d), describe::json(&d));
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
    assert!(text.contains("holonomic part and growth vector: not computed"));
    assert!(text.contains("RT signature by ranks: not computed") && !text.contains("growth vector: ("));
    assert!(json["structure"]["holonomy"]["not_computed"].is_string());
    assert!(json["structure"]["realisation"]["not_computed"].is_string());
    // In between: ranks, but no brackets.
    let found = structure(&car.with_trailers(&on_axle(6)));
    assert!(found.holonomy.is_err() && found.realisation.unwrap().signature.to_string() == "R T^8");
}

#[test]
fn five_trailers_are_quick() {
    let hitched: Vec<Trailer> = (0..5).map(|k| Trailer { length: 2.5 + 0.137 * f64::from(k), hitch: 0.31 }).collect();
    let start = Instant::now();
    let found = holonomy(&vehicle("car", &[0.3123, 2.6457]).with_trailers(&hitched));
    assert!(start.elapsed() < Duration::from_secs(8), "{:?}", start.elapsed());
    assert_eq!((found.growth.last(), found.nonholonomic), (Some(&10), 8));
}

/// The number or words after a label.
fn after<'t>(text: &'t str, label: &str) -> &'t str {
    let start = text.find(label).unwrap_or_else(|| panic!("{label} is missing:\n{text}")) + label.len();
    text[start..].split(['\n', ';']).next().unwrap().split(", nonholonomic").next().unwrap()
}

fn numbers(v: &serde_json::Value) -> Vec<u64> {
    v.as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).collect()
}

fn names(v: &serde_json::Value) -> String {
    let names: Vec<&str> = v.as_array().unwrap().iter().map(|n| n.as_str().unwrap()).collect();
    if names.is_empty() { "none".into() } else { names.join(", ") }
}

#[test]
fn text_and_json_agree() {
    assert!(STILL.iter().all(|id| ALONE.contains(id)));
    for model in machines().into_iter().chain(still()) {
        let d = Description::of(&model).unwrap();
        let (text, latex, json) = (describe::text(&d), describe::latex(&d), describe::json(&d));
        let (_, section) = text.split_once("## Holonomic and nonholonomic part").unwrap();
        let (section, _) = section.split_once("## Equations of motion").unwrap();
        // As a long line is wrapped.
        let section = section.replace("\n  ", " ").replace("   ", "\n");
        let holonomy = &json["structure"]["holonomy"];
        for (label, key) in [("constraints: ", "rank"), ("of which holonomic: ", "holonomic")] {
            let shown = after(&section, label).split(',').next().unwrap();
            assert_eq!(shown, holonomy[key].to_string(), "{section}");
        }
        assert!(section.contains(&format!(", nonholonomic: {}\n", holonomy["nonholonomic"])), "{section}");
        assert!(section.contains(&format!("degree of nonholonomy: {}\n", holonomy["degree_of_nonholonomy"])));
        let vector: Vec<String> = texts(&numbers(&holonomy["growth_vector"]));
        assert_eq!(after(&section, "growth vector: "), format!("({})", vector.join(", ")));
        for integral in holonomy["integrals"].as_array().unwrap() {
            assert!(section.contains(&format!(" = {}\n", integral["text"].as_str().unwrap())), "{section}");
            assert!(latex.contains(integral["latex"].as_str().unwrap()), "{latex}");
        }
        let realisation = &json["structure"]["realisation"];
        if let Some(why) = realisation["not_computed"].as_str() {
            assert_eq!(after(&section, "RT signature by ranks: not computed; "), why.split(';').next().unwrap());
            continue;
        }
        assert_eq!(after(&section, "RT signature by ranks: "), realisation["signature"]["text"].as_str().unwrap());
        let signature = realisation["signature"]["latex"].as_str().unwrap();
        assert!(latex.contains(&format!("RT signature by ranks: ${signature}$")), "{latex}");
        for (label, key) in [
            ("measured rates in the rows: ", "measured"),
            ("rates in the rows that are not measured: ", "unknown"),
            ("the canonical set: ", "canonical"),
        ] {
            assert_eq!(after(&section, label), names(&realisation[key]), "{section}");
        }
        let others = realisation["other_sets_found"].as_u64().unwrap();
        let shown = after(&section, "other smallest sets: ");
        assert!(shown.starts_with(&if others == 0 { "none".into() } else { others.to_string() }), "{shown}");
        let passive: Vec<serde_json::Value> =
            realisation["passive"].as_array().unwrap().iter().map(|p| p["creep"].clone()).collect();
        assert_eq!(after(&section, "which follow from the canonical set: "), names(&passive.into()));
    }
}

#[test]
fn the_count_by_form_is_not_the_signature_by_ranks() {
    // Five constraints have a coefficient, four coefficients make the motion.
    let d = Description::of(&vehicle("differential-drive-castor", &[0.3, 0.04])).unwrap();
    let (text, json) = (describe::text(&d), describe::json(&d));
    assert!(text.contains("- constraints by form: R^3 T^2 (a count") && !text.contains("- signature:"));
    assert!(text.contains("- RT signature by ranks: R^2 T^2\n"));
    assert!(describe::latex(&d).contains("Constraints by form: $R^{3}\\,T^{2}$"));
    assert_eq!(json["constraints_by_form"]["text"], "R^3 T^2");
    assert_eq!(json["structure"]["realisation"]["signature"]["text"], "R^2 T^2");
    assert!(json["signature"].is_null());
}
