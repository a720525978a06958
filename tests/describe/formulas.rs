//! What `describe` prints reads back, means the same, has units, and names every symbol.

use crate::models::{self, machines, machines_with_effects, reviewed, reviewed_as_text, still, with_each_effect};
use creepage::describe::{self, Description};
use creepage::dynamics::{Dynamics, Masses, TrailerMass};
use creepage::effects::{self, Applied};
use creepage::formula::{Expr, Symbol, Unit};
use creepage::model::{Model, Trailer};
use creepage::vehicles;
use rayon::prelude::*;
use serde_json::Value;
use std::collections::BTreeSet;
use std::sync::LazyLock;

/// Every machine alone, with each effect, and those that were reviewed; one logged as speed.
fn all() -> Vec<(String, Model)> {
    let named = |m: Model| {
        let effects: Vec<String> = m.effects.iter().map(Applied::label).collect();
        (format!("{} + {} {effects:?}", m.vehicle.id, m.trailers.len()), m)
    };
    let still_with = still().iter().flat_map(with_each_effect).collect::<Vec<_>>();
    let with = machines_with_effects().into_iter().chain(still_with).map(|(m, e, t)| {
        let sizes = e.parameters.values().map(|p| p.size).collect();
        m.with_effect(Applied::new(e, t, sizes))
    });
    let mut speed = reviewed()[0].1.clone();
    speed.inputs = vec!["speed".into(), "yaw_rate".into()];
    let reviewed = reviewed().into_iter().map(|(_, m)| m);
    let later = reviewed_as_text().into_iter().map(|(_, m)| m);
    let all = machines().into_iter().chain(still()).chain(with).chain(reviewed).chain(later).chain([speed]);
    all.chain(moved_by_forces()).map(named).collect()
}

/// A train that forces move, alone and with the effects whose formulas have no number with a unit, a robot by its torques, and a
/// car whose tyres have a law with a state.
fn moved_by_forces() -> Vec<Model> {
    let train = forced_train();
    let effects =
        ["mass", "mass-centre-aside", "cornering-stiffness-front", "relaxation", "side-grip-limit", "trailer-drag"];
    let with = |id: &&str| {
        let effect = effects::all().iter().find(|e| e.id == **id).unwrap();
        let trailer = effect.per_trailer.then_some(1);
        train.clone().with_effect(Applied::new(effect, trailer, effect.parameters.values().map(|p| p.size).collect()))
    };
    let wheels = [("theta_1'".into(), 0.01), ("theta_2'".into(), 0.01)].into();
    let masses = Masses { mass: 20.0, inertia: 1.0, mass_offset: 0.05, wheels, ..Masses::default() };
    let robot = Model::new("differential-drive", &[("wheel_radius", 0.08), ("track_width", 0.4)]).unwrap();
    let robot =
        Dynamics::new(&robot, &masses).unwrap().driven_by(&["wheel_torque_left", "wheel_torque_right"]).unwrap();
    let tyres = Masses {
        mass: 900.0,
        inertia: 1100.0,
        mass_offset: 1.2,
        wheels: [("theta'".into(), 2.0)].into(),
        ..Masses::default()
    };
    let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap();
    let car = Dynamics::new(&car, &tyres).unwrap().driven_by(&["wheel_torque"]).unwrap();
    let elastic = car.clone().with_laws("elastic", &[4e4, 0.5]).unwrap();
    let slides = car.with_law("front-axle-direction", "rocard", &[4e4]).unwrap();
    let others = [robot, elastic, slides].into_iter().map(|d| d.model().unwrap());
    effects.iter().map(with).chain([train.clone()]).chain(others).collect()
}

/// What is said of all of them, found once for the tests of this file.
fn described() -> &'static [(String, Description)] {
    static ALL: LazyLock<Vec<(String, Description)>> =
        LazyLock::new(|| all().into_par_iter().map(|(name, m)| (name, Description::of(&m).unwrap())).collect());
    &ALL
}

fn parse(text: &str) -> Expr {
    Expr::parse(text).unwrap_or_else(|e| panic!("{e}"))
}

/// Some value for every name.
fn anything(s: &Symbol) -> f64 {
    s.as_str().bytes().fold(0.37, |x, b| (x * 7.3 + f64::from(b)).sin() + 1.3)
}

fn same(a: &Expr, b: &Expr) -> bool {
    match (a.eval(&anything), b.eval(&anything)) {
        (Some(x), Some(y)) => (x - y).abs() <= 1e-12 * (1.0 + x.abs()),
        (None, None) => true,
        _ => false,
    }
}

#[test]
fn every_formula_reads_back_and_means_the_same() {
    for (name, d) in described() {
        for f in d.formulas() {
            assert!(same(&parse(&f.to_string()), &f), "{name}: {f}");
        }
    }
}

/// The formulas in a text: lines four columns in, with those eight columns in that continue them.
fn printed(text: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for line in text.lines() {
        match (line.strip_prefix("        "), line.strip_prefix("    ")) {
            (Some(more), _) => {
                let last = found.last_mut().unwrap();
                last.push(' ');
                last.push_str(more);
            }
            (None, Some(start)) => found.push(start.into()),
            _ => {}
        }
    }
    found
}

#[test]
fn the_text_holds_every_formula_in_readable_lines() {
    for (name, d) in described() {
        let text = describe::text(d);
        let (_, formulas) = text.split_once("## Constraints").unwrap();
        text.lines().for_each(|l| assert!(l.chars().count() <= 100, "{name}: {l}"));
        let mut read: Vec<Expr> = Vec::new();
        for line in printed(formulas) {
            if let Some(entries) = line.strip_prefix('[') {
                read.extend(entries.trim_end_matches(']').split(", ").map(parse));
                continue;
            }
            let (left, right) = line.split_once(" = ").unwrap();
            read.push(parse(if right == "0" && !Symbol::new(left).is_well_formed() { left } else { right }));
        }
        for f in d.formulas() {
            assert!(read.iter().any(|r| same(r, &f)), "{name}: {f} is not printed");
        }
    }
}

#[test]
fn the_formulas_of_every_constraint_are_among_those_of_the_description() {
    for (name, d) in described() {
        let all: BTreeSet<String> = d.formulas().iter().map(Expr::to_string).collect();
        for c in &d.constraints {
            let parts = c.parts.iter().map(|p| p.formula.clone());
            let rows = c.rows().map(|(_, row)| row);
            let each = parts.chain(rows).chain([c.generic.clone()]).chain(c.singular.clone());
            each.for_each(|f| assert!(all.contains(&f.to_string()), "{name}, {}: {f}", c.name));
        }
    }
}

#[test]
fn every_symbol_is_in_the_table_with_a_unit_and_a_meaning_and_no_two_look_alike() {
    for (name, d) in described() {
        let used: BTreeSet<Symbol> = d.formulas().iter().flat_map(Expr::symbols).collect();
        for s in used {
            let entry = d.symbols.get(&s).unwrap_or_else(|| panic!("{name}: {s}"));
            assert!(Unit::parse(&entry.unit).is_some() && !entry.meaning.is_empty(), "{name}: {s}");
        }
        let latex: BTreeSet<&str> = d.symbols.entries().iter().map(|e| e.latex.as_str()).collect();
        assert_eq!(latex.len(), d.symbols.entries().len(), "{name}");
    }
}

/// The unit of a formula by the units of the table.
fn unit(d: &Description, e: &Expr, name: &str) -> Unit {
    let of = |s: &Symbol| Unit::parse(&d.symbols.get(s).unwrap().unit).unwrap();
    e.eval(&of).unwrap_or_else(|| panic!("{name}: {e} mixes units"))
}

#[test]
fn every_formula_has_one_unit() {
    let [speed, second] = ["m/s", "s"].map(|u| Unit::parse(u).unwrap());
    for (name, d) in described() {
        let of = |s: &Symbol| Unit::parse(&d.symbols.get(s).unwrap().unit).unwrap();
        for e in &d.definitions {
            assert!(unit(d, &e.formula, name).fits(&of(&e.name)), "{name}: {} = {}", e.name, e.formula);
        }
        for e in &d.states {
            let rate = creepage::formula::Scalar::mul(&unit(d, &e.formula, name), &second);
            assert!(rate.fits(&of(&e.name)), "{name}: rate of {} = {}", e.name, e.formula);
        }
        for c in &d.constraints {
            let speed = if c.kind.letter == 'S' { unit(d, &c.generic, name) } else { speed };
            let zero = [c.generic.clone()].into_iter().chain(c.rows().map(|(_, row)| row));
            zero.for_each(|row| assert!(unit(d, &row, name).fits(&speed), "{name}: {row}"));
            let times = |e: &Expr, s: &Symbol| e * &Expr::sym(s.clone());
            let by_q = c.jacobian.q.iter().map(|(q, r)| times(&r.expr(), q));
            let by_rate = c.jacobian.rates.iter().map(|(rate, k)| times(k, rate));
            by_q.chain(by_rate).for_each(|t| assert!(unit(d, &t, name).fits(&speed), "{name}: {t}"));
            assert!(unit(d, &c.jacobian.e.expr(), name).fits(&speed), "{name}: {}", c.name);
            for p in &c.parts {
                let slot = c.kind.slots.iter().find(|s| s.name.as_str() == p.label).unwrap();
                let found = unit(d, &p.formula, name);
                // A momentum may be an angular or a linear one.
                let wanted = slot.unit.as_ref().map(|u| Unit::parse(u).unwrap());
                assert!(wanted.is_none_or(|u| found.fits(&u)), "{name}: {}", p.formula);
            }
        }
    }
}

#[test]
fn the_latex_is_balanced() {
    for (name, d) in described() {
        let text = describe::latex(d);
        let count = |part: &str| text.matches(part).count();
        let plain = text.replace(r"\{", "").replace(r"\}", "").replace(r"\$", "");
        let mut depth = 0i32;
        for c in plain.chars() {
            depth += i32::from(c == '{') - i32::from(c == '}');
            assert!(depth >= 0, "{name}");
        }
        assert_eq!(depth, 0, "{name}");
        assert_eq!(plain.matches('$').count() % 2, 0, "{name}");
        assert_eq!(count(r"\left"), count(r"\right"), "{name}");
        assert_eq!(count(r"\bigl"), count(r"\bigr"), "{name}");
        for environment in ["document", "align*", "longtable"] {
            assert_eq!(
                count(&format!(r"\begin{{{environment}}}")),
                count(&format!(r"\end{{{environment}}}")),
                "{name}"
            );
        }
        assert!(count(r"\begin{document}") == 1 && text.is_ascii(), "{name}");
        let outside: String = plain.split('$').step_by(2).collect();
        let tables = outside.split(r"\begin{align*}").map(|p| p.split(r"\end{align*}").last().unwrap());
        tables.for_each(|p| assert!(!p.replace(r"\_", "").contains(['_', '^']), "{name}: {p}"));
        // Each line of a display closes what it opens.
        for line in text.lines().filter(|l| l.contains(r"\left")) {
            assert_eq!(line.matches(r"\left").count(), line.matches(r"\right").count(), "{name}: {line}");
        }
    }
}

/// Every `{text, latex}` of a JSON value.
fn texts(v: &Value, found: &mut Vec<String>) {
    match v {
        Value::Array(a) => a.iter().for_each(|v| texts(v, found)),
        Value::Object(o) => {
            if let (Some(text), Some(_), 2) = (o.get("text"), o.get("latex"), o.len()) {
                found.push(text.as_str().unwrap().into());
            }
            o.values().for_each(|v| texts(v, found));
        }
        _ => {}
    }
}

#[test]
fn the_json_holds_every_formula_and_every_symbol() {
    for (name, d) in described() {
        let json = describe::json(d);
        let mut found = Vec::new();
        texts(&json, &mut found);
        for f in d.formulas() {
            assert!(found.contains(&f.to_string()), "{name}: {f}");
        }
        assert_eq!(json["symbols"].as_array().unwrap().len(), d.symbols.entries().len());
        assert_eq!(json["pfaffian"]["columns"].as_array().unwrap().len(), d.coordinates.len());
        assert_eq!(
            json["constraints"].as_array().unwrap().len(),
            d.signature.counts.iter().map(|(_, n)| n).sum::<usize>()
        );
    }
}

#[test]
fn signatures_are_those_of_the_theory() {
    (0..=10).into_par_iter().for_each(|n| {
        let trailers = vec![creepage::model::Trailer { length: 1.0, hitch: 0.0 }; n];
        for (id, r, t) in [
            ("unicycle", 1, 1),
            ("differential-drive", 2, 1),
            ("car", 1, 2),
            ("four-wheel-car", 1, 2),
            ("tricycle", 1, 2),
            ("differential-drive-castor", 3, 2),
            ("synchro-drive", 3, 3),
            ("four-wheel-steering", 1, 2),
            ("tracked", 2, 1),
            ("mecanum", 4, 0),
        ] {
            let d = Description::of(&models::vehicle(id, &[1.0]).with_trailers(&trailers)).unwrap();
            assert_eq!((d.signature.count('R'), d.signature.count('T')), (r, t + n), "{id} + {n}");
        }
    });
    for (id, r, t) in [("disk", 1, 0), ("sleigh", 0, 1), ("skid-steer", 4, 2)] {
        let d = Description::of(&models::vehicle(id, &[1.0])).unwrap();
        assert_eq!((d.signature.count('R'), d.signature.count('T')), (r, t), "{id}");
    }
}

#[test]
fn the_front_axle_of_a_car_is_the_row_of_the_paper_up_to_sign() {
    let d = Description::of(&reviewed()[2].1).unwrap();
    let paper = parse("cos(delta)*L*phi' - sin(phi + delta)*x' + cos(phi + delta)*y'");
    assert!((&d.constraints[2].ideal.expr() + &paper).tidy().is_zero());
}

#[test]
fn the_row_of_a_model_holds_its_effects() {
    let d = Description::of(&reviewed()[4].1).unwrap();
    let row = |k: usize| d.constraints[k].model.to_string();
    assert_eq!(row(0), "cos(phi)*x' + sin(phi)*y' - r*(1 - rotation_creep.e_rc)*theta'");
    assert_eq!(row(1), "sin(phi)*x' - cos(phi)*y'");
    assert!(row(2).contains("front_traverse_creep.e_tc") && row(2).contains("wheelbase*(1 + wheelbase.scale)"));
    assert!(row(2).contains("sin(phi + steering_angle*(1 + steering_gain.scale))"), "{}", row(2));
    let beside: Vec<&str> = d.beside_rows.iter().map(Symbol::as_str).collect();
    assert_eq!(beside, ["v_t", "x'", "y'"]);
}

#[test]
fn the_catalogues_parse_and_hold_these_entries() {
    let ids: Vec<&str> = vehicles::all().iter().map(|v| v.id.as_str()).collect();
    let first = ["unicycle", "differential-drive", "car", "four-wheel-car", "tricycle"];
    let later = ["disk", "sleigh", "hopper", "differential-drive-castor", "synchro-drive", "skid-steer"];
    let latest = ["four-wheel-steering", "tracked", "mecanum"];
    assert_eq!(ids, first.into_iter().chain(later).chain(latest).collect::<Vec<_>>());
    let ids: Vec<&str> = effects::all().iter().map(|e| e.id.as_str()).collect();
    let expected = [
        "rotation-creep",
        "wheel-radius",
        "wheel-radius-mismatch",
        "unequal-rotation-creep",
        "traction-creep",
        "traverse-creep",
        "cornering-creep",
        "load-dependent-creep",
        "rocard-creep",
        "relaxation-length",
        "side-slope",
        "yaw-rate-scale",
        "yaw-rate-bias",
        "track-width",
        "steering-gain",
        "steering-offset",
        "front-traverse-creep",
        "wheelbase",
        "understeer",
        "input-delay",
        "heading-misalignment",
        "lever-arm",
        "sensor-bias",
        "sensor-scale",
        "drift",
        "trailer-traverse-creep",
        "trailer-length",
        "hitch-offset",
        "odometry-yaw-per-speed",
        "odometry-speed-per-yaw",
        "grade",
        "saturating-creep",
        "input-lag",
        "input-backlash",
        "input-truncation",
        "input-offset",
        "steering-of-one-wheel",
        "rate-of-one-wheel",
        "input-dead-band",
        "input-saturation",
        "castor-swing",
        "mass",
        "inertia",
        "mass-centre-ahead",
        "mass-centre-aside",
        "drive-gain",
        "back-emf",
        "drive-friction",
        "gear-backlash",
        "rolling-resistance",
        "viscous-drag",
        "air-drag",
        "turning-drag",
        "hill",
        "traction",
        "cornering-stiffness-rear",
        "cornering-stiffness-front",
        "load-transfer",
        "relaxation",
        "side-grip-limit",
        "traction-limit",
        "trailer-mass",
        "trailer-drag",
        "trailer-cornering-stiffness",
    ];
    assert_eq!(ids, expected);
    // An effect on one input or one sensor is one of a vehicle only once that is named.
    for e in effects::all().iter().filter(|e| !e.per_input && !e.per_quantity) {
        assert!(e.parameters.values().all(|p| Unit::parse(&p.unit).is_some() && p.range[0] < p.range[1]), "{}", e.id);
        let applies = |m: &Model| !m.applicable(std::slice::from_ref(e)).is_empty();
        let by_forces = applies(&forced_train());
        assert!(machines().iter().any(applies) || by_forces, "{}", e.id);
        // What holds a contact is nothing of a vehicle that its inputs move.
        assert!(e.place != "contact force" || !machines().iter().any(applies), "{}", e.id);
    }
}

/// A car with a trailer that forces move, every contact viscous.
fn forced_train() -> Model {
    let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap();
    let car = car.with_trailers(&[Trailer { length: 2.0, hitch: 0.3 }]);
    let wheels = [("theta'".into(), 2.0)].into();
    let trailers = vec![TrailerMass { mass: 500.0, inertia: 600.0, mass_offset: 0.2 }];
    let masses = Masses { mass: 1200.0, inertia: 1500.0, mass_offset: 1.2, wheels, trailers, ..Masses::default() };
    let car = Dynamics::new(&car, &masses).unwrap().driven_by(&["wheel_torque"]).unwrap();
    car.with_laws("viscous", &[2e4]).unwrap().model().unwrap()
}

/// Worked through from the first to the last, by the values of the table, the printed equations give the rates that are integrated;
/// where a law holds a contact its row is not said to hold.
#[test]
fn printed_equations_under_forces_are_those_that_are_integrated() {
    for model in moved_by_forces() {
        let d = Description::of(&model).unwrap();
        assert!(!d.speeds.is_empty() && d.effects.len() == model.effects.len());
        let equations = model.equations(&[]).unwrap();
        let z: Vec<f64> = (0..equations.n()).map(|i| 0.3 + 0.1 * (i as f64 * 2.3).sin()).collect();
        let u: Vec<f64> = (0..equations.inputs.len()).map(|i| 0.4 - 0.15 * i as f64).collect();
        let mut known: std::collections::BTreeMap<Symbol, f64> =
            d.symbols.entries().iter().filter_map(|e| Some((e.symbol.clone(), e.value?))).collect();
        known.extend(equations.states.iter().cloned().zip(z.iter().copied()));
        known.extend(equations.inputs.iter().cloned().zip(u.iter().copied()));
        for e in &d.definitions {
            let value = e.formula.eval(&|s| known.get(s).copied().unwrap_or_else(|| panic!("{s} comes later")));
            known.insert(e.name.clone(), value.unwrap());
        }
        let of_effects: std::collections::BTreeMap<Symbol, _> =
            model.effects.iter().flat_map(Applied::states).collect();
        let mut rates = vec![0.0; z.len()];
        equations.rates(&mut equations.workspace(&[]), &z, &u, &mut rates);
        for (state, rate) in equations.states.iter().zip(rates) {
            let printed = known.get(&state.rate()).copied().unwrap_or_else(|| {
                let rate = &of_effects[state];
                assert!(describe::text(&d).contains(&format!("{state}' = ")), "{state}' is not printed");
                rate.eval(&|s| known[s]).unwrap()
            });
            assert!((printed - rate).abs() < 1e-9 * (1.0 + rate.abs()), "{state}: {printed} {rate}");
        }
        let held = d.constraints.iter().filter(|c| c.held_by.is_some()).count();
        assert_eq!(describe::text(&d).matches("a force holds it in place of the row").count(), held);
        assert_eq!(describe::text(&d).matches("Row of the model as it stands").count(), d.constraints.len() - held);
    }
}
