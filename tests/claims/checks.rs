//! What evidence is made of: comparing, searching for the simplest counterexample, drawing cases, reading statements.

use creepage::claims::{
    Claim, Counterexample, DerivedFormulas, Domain, Fault, Options, Outcome, Point, Sampling, Statement, Status,
    at_points, counterexample, domains, mutants, near, points, prove, read, simplest, value, value_said, verify,
    written,
};
use creepage::effects::{self, Applied};
use creepage::formula::{Exact, Expr, Fun, Scalar, Symbol};
use creepage::model::Model;
use creepage::progress::unheard;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

fn statement(equations: &[(&str, &str)]) -> Statement {
    Statement::parse(equations).unwrap()
}

fn says(fault: Result<(), Fault>) -> String {
    match fault {
        Ok(()) => "agrees".into(),
        Err(Fault::False(says)) => says,
        Err(other) => format!("{other:?}"),
    }
}

#[test]
fn numbers_are_near_to_a_share_of_their_size_and_one() {
    assert_eq!(says(near("x", 3.0, 3.39, 0.1)), "agrees");
    assert_eq!(says(near("x", -3.39, -3.0, 0.1)), "agrees");
    assert_eq!(says(near("x", 0.0, 0.1, 0.1)), "agrees");
    assert_eq!(says(near("x", 3.0, 3.5, 0.1)), "x is 3.000000000, the statement says 3.500000000");
    assert!(near("x", 0.0, 0.2, 0.1).is_err() && near("x", 3.0, -3.0, 0.5).is_err());
    assert!(near("x", f64::NAN, 0.0, 1.0).is_err() && near("x", 0.0, f64::NAN, 1.0).is_err());
}

#[test]
fn a_statement_gives_the_value_of_a_name() {
    let s = statement(&[("x", "a + 1"), ("y", "2*a"), ("z", "7/2"), ("w", "1/(a - a)")]);
    let at = |name: &str| (name == "a").then_some(3.0);
    assert_eq!(value_said(&s, "y", &at).unwrap(), 6.0);
    assert_eq!(value_said(&s, "x", &at).unwrap(), 4.0);
    assert!(matches!(value_said(&s, "w", &at), Err(Fault::False(says)) if says == "w = 1/(a - a) is undefined here"));
    assert!(matches!(value_said(&s, "v", &at), Err(Fault::Undefined(_))));
    assert_eq!((s.number("z"), s.number("v")), (Some(3.5), None));
    assert_eq!(s.said_of("y").map(ToString::to_string).as_deref(), Some("2*a"));
    assert_eq!(s.to_string(), "x = a + 1; y = 2*a; z = 7/2; w = 1/(a - a)");
    let pair = |t: &str| Expr::parse(t).unwrap();
    assert_eq!(Statement::of([(pair("x"), pair("a + 1"))]), statement(&[("x", "a + 1")]));
    assert_eq!(s.equations().len(), 4);
    assert!(Statement::parse(&[("x", "a +")]).is_err());
}

/// Every point that is looked at for a law that holds everywhere.
fn looked_at(names: &[(&str, Domain)]) -> Vec<Vec<String>> {
    let names: BTreeMap<Symbol, Domain> = names.iter().map(|(s, d)| (Symbol::new(s), *d)).collect();
    let met = std::cell::RefCell::new(Vec::new());
    let found = simplest(&names, |point| {
        met.borrow_mut().push(point.shown().into_iter().map(|(_, v)| v).collect());
        None
    });
    assert!(found.is_none());
    met.into_inner()
}

#[test]
fn counterexamples_are_searched_from_the_simplest_on() {
    let list = |d: Domain| looked_at(&[("x", d)]).concat();
    assert_eq!(list(Domain::Positive), ["1", "2", "1/2", "3", "1/3", "3/2", "2/3"]);
    assert_eq!(list(Domain::Nonzero), ["1", "-1", "2", "1/2", "-2", "3", "1/3"]);
    assert_eq!(list(Domain::Any), ["1", "2", "0", "-1", "1/2", "-2", "3"]);
    assert_eq!(list(Domain::Creep), ["0", "1/2", "-1/2", "1/3", "-1/3", "2/3", "1/4"]);
    let angles = ["0", "(0, 1)", "(3, 4)", "(0, -1)", "(3, -4)", "(4, 3)", "(-1, 0)"];
    let angles = angles.map(|a| if a == "0" { a.to_string() } else { format!("angle of {a}") });
    assert_eq!(list(Domain::Angle), angles);
    let pairs = looked_at(&[("x", Domain::Positive), ("y", Domain::Any)]);
    assert_eq!(pairs[..6], [["1", "1"], ["1", "2"], ["2", "1"], ["1", "0"], ["2", "2"], ["1/2", "1"]]);
    assert_eq!(pairs.len(), 49);
    assert_eq!(pairs.iter().collect::<BTreeSet<_>>().len(), 49);
}

#[test]
fn the_search_for_a_counterexample_ends() {
    let names = ["a", "b", "c", "d", "e", "f"].map(|n| (n, Domain::Positive));
    // All 7⁵ points but the 252 least simple ones; of 7⁶ as many as one waits for.
    assert_eq!(looked_at(&names[..5]).len(), 16_807 - 252);
    assert_eq!(looked_at(&names).len(), 60_000);
    assert_eq!(looked_at(&[]), [Vec::<String>::new()]);
}

#[test]
fn the_first_point_that_differs_is_told_with_both_values() {
    let at = |machine: &DerivedFormulas, left: &str, right: &str| {
        counterexample(machine, &statement(&[(left, right)]).equations()[0]).map(|c| c.to_string())
    };
    let none = DerivedFormulas::default();
    assert_eq!(at(&none, "x", "abs(x)").as_deref(), Some("x = -1: x is -1, the statement says 1"));
    assert_eq!(at(&none, "x + e", "x").as_deref(), Some("e = 1/2, x = 1: x + e is 3/2, the statement says 1"));
    assert_eq!(at(&none, "abs(x)^2", "x^2"), None);
    // Where either side is undefined nothing is said.
    assert_eq!(at(&none, "1/(x - 1)", "2").as_deref(), Some("x = 2: 1/(x - 1) is 1, the statement says 2"));
    assert_eq!(at(&none, "1/(x - x)", "2"), None);
    let doubled = DerivedFormulas::default().with_text("y", "2*x");
    assert_eq!(at(&doubled, "y", "3*x").as_deref(), Some("x = 1: y is 2, the statement says 3"));
}

#[test]
fn a_proof_says_where_a_statement_fails_and_never_less() {
    let machine = DerivedFormulas::default();
    assert_eq!(prove(&machine, &statement(&[("x + x", "2*x"), ("x - x", "0")])), Outcome::Holds { cases: 2 });
    let Outcome::Fails(found) = prove(&machine, &statement(&[("x", "x"), ("x*y", "x")])) else { panic!() };
    assert_eq!(found.values, [("x".to_string(), "1".to_string()), ("y".to_string(), "2".to_string())]);
    // No identity, and zero wherever a counterexample is looked for.
    let beyond = prove(&machine, &statement(&[("x*(x - 1)*(x - 2)*(x + 1)*(x + 2)*(x - 3)*(2*x - 1)", "0")]));
    assert!(matches!(&beyond, Outcome::Fails(c) if c.values.is_empty() && c.says.ends_with("is no identity")));
    // A slip in one equation: only that one is in question.
    assert!(matches!(prove(&machine, &statement(&[("exp(x)", "exp(x)")])), Outcome::Undefined(_)));
}

fn of(cases: u32) -> Sampling {
    Sampling { cases, seed: 11, shrink: true }
}

#[test]
fn equations_are_compared_at_points() {
    let names = [("x", Domain::Nonzero), ("y", Domain::Any)];
    let compare = |l: &str, r: &str| at_points(&DerivedFormulas::default(), &statement(&[(l, r)]), &names, &of(50));
    assert_eq!(compare("abs(x)^2", "x^2"), Outcome::Holds { cases: 50 });
    let Outcome::Fails(found) = compare("x", "abs(x)") else { panic!() };
    assert_eq!(found.values.iter().map(|(n, _)| n.as_str()).collect::<Vec<_>>(), ["x", "y"]);
    assert!(found.says.starts_with("x is -") && found.says.contains("the statement says"), "{}", found.says);
    // What is said must be defined; what is spoken of need not be.
    let Outcome::Fails(found) = compare("x", "x*y/y") else { panic!() };
    assert!(found.says.ends_with("x*y/y is undefined"), "{}", found.says);
    assert_eq!(compare("x*y/y", "x"), Outcome::Holds { cases: 50 });
    assert_eq!(compare("x/(y - y)", "x"), Outcome::Undefined("too few cases meet the hypotheses".into()));
}

#[test]
fn as_many_cases_are_tried_as_asked_for_all_different() {
    let drawn = |s: Sampling| {
        let met = Mutex::new(Vec::new());
        let outcome = s.cases(
            0u64..1_000_000_000,
            |_| vec![],
            |v| {
                met.lock().unwrap().push(*v);
                Ok(())
            },
        );
        let mut met = met.into_inner().unwrap();
        met.sort_unstable();
        (outcome, met)
    };
    let (outcome, met) = drawn(of(250));
    assert_eq!((outcome, met.len()), (Outcome::Holds { cases: 250 }, 250));
    // Every lot has values of its own, and the same seed the same ones.
    assert!(met.iter().collect::<BTreeSet<_>>().len() > 245);
    assert_eq!(drawn(of(250)).1, met);
    assert_ne!(drawn(Sampling { seed: 12, ..of(250) }).1, met);
    assert_eq!([of(10).one_in(4).cases, of(2).one_in(4).cases, of(10).at_most(3).cases], [2, 1, 3]);
    assert_eq!(of(3).at_most(10).cases, 3);
}

#[test]
fn a_failing_case_is_made_small_where_that_is_wanted() {
    let law = |v: &u32| if *v > 10 { Err(Fault::False(format!("{v} is much"))) } else { Ok(()) };
    let run = |shrink: bool| match (Sampling { shrink, ..of(300) }).cases(
        0u32..100_000,
        |v| vec![("v".into(), v.to_string())],
        law,
    ) {
        Outcome::Fails(Counterexample { values, says }) => (values[0].1.clone(), says),
        other => panic!("{other:?}"),
    };
    assert_eq!(run(true), ("11".to_string(), "11 is much".to_string()));
    let (first, said) = run(false);
    assert_ne!(first, "11");
    assert_eq!(said, format!("{first} is much"));
}

#[test]
fn what_cannot_be_told_is_never_true() {
    let outcome = |law: fn(&u32) -> Result<(), Fault>| of(5).cases(0u32..9, |_| vec![], law);
    assert_eq!(outcome(|_| Err(Fault::Undefined("no".into()))), Outcome::Undefined("no".into()));
    let few = Outcome::Undefined("too few cases meet the hypotheses".into());
    assert_eq!(outcome(|_| Err(Fault::Outside)), few);
    assert_eq!(outcome(|v| if *v > 4 { Err(Fault::Outside) } else { Ok(()) }), Outcome::Holds { cases: 5 });
    // Looking for cases within the hypotheses ends.
    let asked = AtomicU32::new(0);
    let none = of(1).cases(
        0u32..9,
        |_| vec![],
        |_| {
            asked.fetch_add(1, Relaxed);
            Err(Fault::Outside)
        },
    );
    assert!(none == few && (4000..5000).contains(&asked.load(Relaxed)), "{none:?} {asked:?}");
}

#[test]
fn outcomes_add_up_to_the_first_that_is_not_true() {
    let (holds, fails) = (|cases| Outcome::Holds { cases }, || Outcome::failure("no"));
    assert_eq!(Outcome::all([holds(2), holds(3), holds(4)]), holds(9));
    assert_eq!(Outcome::all([holds(2), fails(), Outcome::Undefined("?".into())]), fails());
    assert!(!Outcome::all([]).holds() && !Outcome::all([]).fails());
    assert_eq!(Counterexample { values: vec![], says: "so".into() }.to_string(), "so");
    let values = [("a", "1"), ("b", "2")].map(|(n, v)| (n.to_string(), v.to_string())).to_vec();
    assert_eq!(Counterexample { values, says: "so".into() }.to_string(), "a = 1, b = 2: so");
}

#[test]
fn values_are_drawn_from_the_whole_of_their_domain() {
    let mut runner = TestRunner::deterministic();
    let mut drawn =
        |d: Domain| -> Vec<Exact> { (0..400).map(|_| value(d).new_tree(&mut runner).unwrap().current()).collect() };
    let numbers = |values: Vec<Exact>| values.iter().map(Exact::to_f64).collect::<Vec<f64>>();
    let signs = |values: &[f64]| {
        let count = |p: fn(f64) -> bool| values.iter().filter(|v| p(**v)).count();
        [count(|v| v < 0.0) > 100, count(|v| v == 0.0) > 0, count(|v| v > 0.0) > 100]
    };
    let any = numbers(drawn(Domain::Any));
    assert_eq!(signs(&any), [true; 3]);
    assert_eq!(signs(&numbers(drawn(Domain::Nonzero))), [true, false, true]);
    assert_eq!(signs(&numbers(drawn(Domain::Positive))), [false, false, true]);
    let creeps = numbers(drawn(Domain::Creep));
    assert!(signs(&creeps) == [true; 3] && creeps.iter().all(|e| e.abs() < 1.0));
    let sines = drawn(Domain::Angle).iter().map(|a| Exact::call(Fun::Sin, a)).collect();
    assert_eq!(signs(&numbers(sines)), [true; 3]);
}

#[test]
fn letters_and_uses_tell_the_domain() {
    let formulas =
        [Expr::parse("sin(phi) + e_1*r_2 + a*L - d_1 + m*I + J*b").unwrap(), Expr::parse("x*e + ex").unwrap()];
    let found = domains(&formulas);
    let of = |d: Domain| found.iter().filter(|(_, v)| **v == d).map(|(s, _)| s.as_str()).collect::<BTreeSet<_>>();
    assert_eq!(of(Domain::Angle), BTreeSet::from(["phi"]));
    assert_eq!(of(Domain::Creep), BTreeSet::from(["e", "e_1"]));
    assert_eq!(of(Domain::Positive), BTreeSet::from(["r_2", "a", "L", "d_1", "m", "I", "J", "b"]));
    assert_eq!(of(Domain::Any), BTreeSet::from(["x", "ex"]));
}

#[test]
fn a_point_has_values_by_name() {
    let point = |x: i64| Point::new([("x".into(), Exact::ratio(x, 2)), ("phi".into(), Exact::half_tangent(1, 2))]);
    assert_eq!(point(3).number("x"), 1.5);
    assert!(point(3).number("y").is_nan() && point(3).get(&"y".into()).is_none());
    assert_eq!(point(3).get(&"phi".into()).map(|v| written(&v)).as_deref(), Some("angle of (3, 4)"));
    let shown = [("x", "3/2"), ("phi", "angle of (3, 4)")].map(|(n, v)| (n.to_string(), v.to_string()));
    assert_eq!(point(3).shown(), shown);
    assert!(point(3) == point(3) && point(3) != point(5));
    let drawn = points(&[("x", Domain::Positive), ("e", Domain::Creep)]);
    let drawn = drawn.new_tree(&mut TestRunner::deterministic()).unwrap().current();
    assert_eq!(drawn.shown().iter().map(|(n, _)| n.as_str()).collect::<Vec<_>>(), ["x", "e"]);
}

#[test]
fn a_machine_derives_what_it_names() {
    let wheel = DerivedFormulas::of("unicycle");
    let text = |m: &DerivedFormulas, name: &str| m.formula(name).map(ToString::to_string);
    assert_eq!(wheel.written_out("v_t").to_string(), wheel.written_out("v_n").to_string());
    assert!(prove(&wheel, &statement(&[("v_t", "e_tc*v_l")])).holds());
    // Parameters and creeps are free, the chain from wheel to pose is not.
    for free in ["r", "e_rc", "e_tc", "theta'"] {
        assert_eq!(text(&wheel, free), None, "{free}");
    }
    assert!(["v_l", "v_t", "x'", "y'"].iter().all(|n| wheel.formula(n).is_some()));
    let train = DerivedFormulas::train("unicycle", 2);
    assert!(train.formula("v_2").is_some() && wheel.formula("v_1").is_none() && train.formula("d_1").is_none());
    assert!(train.formula("e_tc_1").is_none());
    assert!(DerivedFormulas::of("no such vehicle").formula("v_l").is_none());
    let m = DerivedFormulas::default().with_text("a", "b + 1").with_text("b", "c^2").with_text("broken", "1 +");
    assert_eq!((text(&m, "a").as_deref(), text(&m, "broken")), (Some("b + 1"), None));
    assert_eq!(m.written_out("a").to_string(), "c^2 + 1");
    assert!(m.written_out("z").is_zero());
    let freed = m.clone().freeing(&["b"]);
    assert_eq!((text(&freed, "a").as_deref(), text(&freed, "b")), (Some("b + 1"), None));
    let (formulas, free) = m.rests_on(&Expr::parse("2*a + x").unwrap());
    assert_eq!(
        formulas.iter().map(ToString::to_string).collect::<BTreeSet<_>>(),
        BTreeSet::from(["2*a + x", "b + 1", "c^2"].map(String::from))
    );
    assert_eq!(free, BTreeSet::from(["c".into(), "x".into()]));
    let values = m.values(&|_: &Symbol| 3.0);
    assert_eq!((values[&"a".into()], values[&"b".into()], values[&"c".into()]), (10.0, 9.0, 3.0));
}

#[test]
fn every_piece_of_evidence_has_a_seed_of_its_own_and_sabotage_few_cases() {
    let told = std::sync::Arc::new(Mutex::new(Vec::new()));
    let claim = (0..40).fold(Claim::new("seeds", Status::Sampled, ""), |claim, i| {
        let told = told.clone();
        claim.sample("", &[("x", "x + 1")], move |_, s| {
            told.lock().unwrap().push((i, s.seed, s.cases, s.shrink));
            Outcome::Holds { cases: 1 }
        })
    });
    verify(&[claim], &Options { cases: 500, seed: 5 }, &unheard).unwrap();
    let told = told.lock().unwrap().clone();
    let seeds: BTreeSet<u64> = told.iter().map(|t| t.1).collect();
    assert_eq!(seeds.len(), 40);
    assert!(seeds.iter().filter(|s| **s > u64::from(u32::MAX)).count() > 30);
    for i in 0..40 {
        let mut of = told.iter().filter(|t| t.0 == i).map(|t| (t.2, t.3));
        assert_eq!(of.next(), Some((500, true)));
        assert!(of.all(|sabotage| sabotage == (60, false)));
    }
}

#[test]
fn a_file_states_what_its_claims_are() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("claims.toml");
    let law = "cot(phi + atan(e)) = (cot(phi) - e)/(1 + e*cot(phi))";
    let slip = "cot(phi + atan(e)) = (cot(phi) + e)/(1 + e*cot(phi))";
    let entry = |id: &str, rest: &str| format!("[[claim]]\nid = \"{id}\"\nstatus = \"{id}\"\n{rest}\n");
    let (true_one, false_one) = (format!("equations = [\"{law}\"]"), format!("printed = [\"{slip}\"]"));
    let text = [
        entry("proved", &true_one),
        entry("corrected", &format!("{true_one}\n{false_one}")),
        entry("refuted", &false_one),
        entry("open", ""),
    ];
    std::fs::write(&path, text.concat()).unwrap();
    let claims = read(&path, creepage::vehicles::all()).unwrap();
    let stated: Vec<Status> = claims.iter().map(|c| c.stated).collect();
    assert_eq!(stated, [Status::Proved, Status::Corrected, Status::Refuted, Status::Open]);
    assert_eq!(claims[0].evidence[0].equations.len(), 1);
    let made = verify(&claims, &Options { cases: 10, seed: 1 }, &unheard).unwrap();
    let earned: Vec<Status> = made.entries.iter().map(|e| e.earned).collect();
    assert_eq!((earned[0], earned[1], earned[3]), (Status::Proved, Status::Corrected, Status::Open));
    let sound = |i: usize| made.entries[i].shown.iter().all(|s| s.survivors.is_empty() && s.sabotages > 0);
    assert!(made.cases() == 2 && sound(0) && sound(1) && made.kills().1 > 2);
}

/// The right sides one slip away from a formula.
fn slips(formula: &str) -> Vec<Expr> {
    mutants(&statement(&[("y", formula)])).iter().map(|m| m.statement.equations()[0].right.clone()).collect()
}

#[test]
fn a_slip_is_made_in_every_part_and_leaves_the_rest() {
    let parts = [
        ("b + 2", "b + 3"),
        ("2 - b", "3 - b"),
        ("2*b", "3*b"),
        ("b/2", "b/3"),
        ("(b + 2)^3", "(b + 3)^3"),
        ("-(b + 2)", "-(b + 3)"),
        ("sin(b + 2)", "sin(b + 3)"),
    ];
    let functions = ["sin cos", "cos sin", "tan cot", "cot tan", "atan tan", "exp tanh", "sqrt abs"];
    let calls =
        functions.map(|pair| pair.split_once(' ').unwrap()).map(|(f, g)| (format!("{f}(b)"), format!("{g}(b)")));
    for (from, to) in parts.map(|(f, t)| (f.to_string(), t.to_string())).into_iter().chain(calls) {
        let wanted = Expr::parse(&to).unwrap();
        let found = slips(&from);
        assert_eq!(found.iter().filter(|e| **e == wanted).count(), 1, "{from}: {to} not once among {found:?}");
    }
    // An index slips to one of the same letter and order.
    let found = slips("e_1*e_2 + f_2*e_3'");
    let has = |e: &str| found.contains(&Expr::parse(e).unwrap());
    assert!(has("e_2*e_2 + f_2*e_3'") && has("e_1*e_1 + f_2*e_3'"), "{found:?}");
    for other in ["e_1*e_2 + e_2*e_3'", "e_1*e_2 + f_2*e_1", "f_2*e_2 + f_2*e_3'", "e_3'*e_2 + f_2*e_3'"] {
        assert!(!has(other), "{other}: {found:?}");
    }
}

#[test]
fn beyond_the_normal_form_values_tell_what_a_slip_changes() {
    let is_slip = |from: &str, to: &str| slips(from).contains(&Expr::parse(to).unwrap());
    assert!(is_slip("abs(x)/10", "abs(x)/11") && is_slip("9*abs(x)", "10*abs(x)") && is_slip("abs(x)", "-abs(x)"));
    assert!(!is_slip("9*abs(-x)", "9*abs(x)") && !is_slip("abs(-x)/9", "abs(x)/9"));
    assert!(is_slip("a*abs(x)", "a/abs(x)") && !is_slip("a*abs(-x)", "a*abs(x)"));
    // Where nothing has a value nothing is the same.
    assert!(is_slip("ln(-2 - abs(x))", "ln(-3 - abs(x))"));
}

#[test]
fn a_machine_keeps_coefficients_that_several_effects_make() {
    let made = Model::new("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.4)]).unwrap();
    let effect = |id: &str| effects::named(id).map(|e| Applied::new(e, None, e.starts().swap_remove(0))).unwrap();
    let made = made.with_effect(effect("rotation-creep")).with_effect(effect("unequal-rotation-creep"));
    let machine = DerivedFormulas::of_model(&made);
    let coefficient = machine.formula("e_rc_1").unwrap();
    assert!(
        ["rotation_creep.e_rc", "unequal_rotation_creep.e_right"].iter().all(|s| coefficient.mentions(&(*s).into()))
    );
    // One that no effect makes is free.
    assert!(machine.formula("e_tc").is_none());
}
