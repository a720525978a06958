//! One formula, many readings: all of them agree.

use crate::support::rounding::Rounded;
use crate::support::tree::{NAMES, formulas, functions, named, points, small_formulas};
use crate::support::{Outcome, check};
use creepage::formula::{Dual, Expr, Graph, Program, Symbol, exact_f64, nearest_f64};
use nalgebra::{DVector, RowDVector};
use num_dual::{Derivative, Dual2_64, Dual2DVec64, Dual64, DualDVec64, HyperDual64};
use proptest::prelude::*;

type Point = [f64; 8];

fn rounded(e: &Expr, at: &Point) -> Option<Rounded> {
    e.eval(&|s| Rounded::exact(named(at, s.as_str())))
}

fn value(e: &Expr, at: &Point) -> Option<f64> {
    e.eval(&|s| named(at, s.as_str()))
}

fn compiled(e: &Expr) -> (Program, Graph) {
    let mut graph = Graph::default();
    let id = graph.insert(e);
    (Program::compile(&graph, &NAMES.map(Symbol::new), &[id]).unwrap(), graph)
}

fn run(program: &Program, at: &Point) -> Option<f64> {
    let mut out = [0.0];
    program.run(at, &mut program.registers(), &mut out);
    assert!(out[0].is_finite() || out[0].is_nan(), "an undefined result is NaN, not {}", out[0]);
    out[0].is_finite().then_some(out[0])
}

/// A reading is defined and lies within the bound.
fn agrees(reading: &str, expected: Rounded, found: Option<f64>) -> Outcome {
    let good = found.is_some_and(|v| expected.allows(v, 4.0));
    prop_assert!(good, "{}: {:?} is not {:?}", reading, found, expected);
    Ok(())
}

#[test]
fn every_carrier_gives_the_value_wherever_rounding_leaves_no_doubt() {
    check(4000, (formulas(), points()), |(e, at)| {
        let Some(expected) = rounded(&e, &at) else { return Ok(()) };
        let slope = |k: usize| [0.5, -1.0, 0.0][k % 3];
        let index = |s: &Symbol| NAMES.iter().position(|n| *n == s.as_str()).unwrap();
        agrees("f64", expected, value(&e, &at))?;
        agrees("dual", expected, e.eval(&|s| Dual(Dual64::new(at[index(s)], slope(index(s))))).map(|d| d.0.re))?;
        let second = |s: &Symbol| Dual(Dual2_64::new(at[index(s)], slope(index(s)), 0.0));
        agrees("second order", expected, e.eval(&second).map(|d| d.0.re))?;
        let hyper = |s: &Symbol| Dual(HyperDual64::new(at[index(s)], slope(index(s)), 1.0, 0.0));
        agrees("hyper-dual", expected, e.eval(&hyper).map(|d| d.0.re))?;
        let unit = |s: &Symbol| (0..8).map(|k| f64::from(k == index(s))).collect::<Vec<_>>();
        let vector = |s: &Symbol| Derivative::some(DVector::from_vec(unit(s)));
        agrees("vector", expected, e.eval(&|s| Dual(DualDVec64::new(at[index(s)], vector(s)))).map(|d| d.0.re))?;
        let row = |s: &Symbol| Derivative::some(RowDVector::from_vec(unit(s)));
        let second = |s: &Symbol| Dual(Dual2DVec64::new(at[index(s)], row(s), Derivative::none()));
        agrees("vector of second order", expected, e.eval(&second).map(|d| d.0.re))
    });
}

#[test]
fn the_carrier_that_bounds_rounding_decides_often_enough() {
    let (mut decided, mut tried) = (0, 0);
    let counts = std::cell::RefCell::new((&mut decided, &mut tried));
    check(2000, (formulas(), points()), |(e, at)| {
        let mut counts = counts.borrow_mut();
        *counts.0 += u32::from(rounded(&e, &at).is_some());
        *counts.1 += u32::from(value(&e, &at).is_some());
        Ok(())
    });
    assert!(tried > 500 && decided > tried / 2, "{decided} of {tried}");
}

#[test]
fn substituting_numbers_gives_the_value() {
    check(2000, (formulas(), points()), |(e, at)| {
        let Some(expected) = rounded(&e, &at) else { return Ok(()) };
        let number = |s: &Symbol| exact_f64(named(&at, s.as_str())).map(|v| Expr::number(&v));
        let written = e.substitute(&number);
        prop_assert!(written.symbols().is_empty());
        agrees("substituted", expected, value(&written, &at))
    });
}

#[test]
fn renaming_by_substitution_changes_nothing_else() {
    check(1000, (formulas(), points()), |(e, at)| {
        let renamed = e.substitute(&|s| Some(Expr::sym(format!("{}_2", s.as_str().replace(['\'', '.'], "")).as_str())));
        let back = |s: &Symbol| {
            let k = NAMES.iter().position(|n| s.as_str() == format!("{}_2", n.replace(['\'', '.'], "")));
            at[k.unwrap()]
        };
        let Some(expected) = rounded(&e, &at) else { return Ok(()) };
        agrees("renamed", expected, renamed.eval(&back))
    });
}

#[test]
fn tidying_keeps_the_value() {
    check(1500, (small_formulas(), points()), |(e, at)| {
        let tidied = e.tidy();
        let (Some(a), Some(b)) = (rounded(&e, &at), rounded(&tidied, &at)) else { return Ok(()) };
        prop_assert!((a.value - b.value).abs() <= 4.0 * (a.error + b.error), "{:?}: {:?} or {:?}", tidied, a, b);
        Ok(())
    });
}

#[test]
fn tidying_collects_like_terms() {
    let table = [
        ("(a + b)*(a - b) + b^2", "a^2"),
        ("x - x", "0"),
        ("2*x + 3*x - x/2", "9*x/2"),
        ("(a + b)^3 - a^3 - b^3", "3*a*b^2 + 3*a^2*b"),
        ("-(a - b)", "-a + b"),
        ("a/b - a*(1/b)", "0"),
        ("x*sin(y)*x", "sin(y)*x^2"),
        ("x^-2*x^2", "x^-2*x^2"),
        ("(1/x)^0", "1"),
        ("2/3*x + x/3", "x"),
    ];
    for (text, tidy) in table {
        assert_eq!(Expr::parse(text).unwrap().tidy().to_string(), tidy, "{text}");
    }
}

#[test]
fn tidying_leaves_a_product_alone_that_would_not_end() {
    let names: Vec<_> = (0..20).map(|k| format!("(a{k} + b{k})")).collect();
    let product = names.join("*");
    let tidied = Expr::parse(&format!("{product} + x - {product} + x")).unwrap().tidy();
    assert_eq!(tidied.to_string(), "2*x");
    let value = |e: &Expr| e.eval(&|s| if s.as_str() == "a7" { 2.0 } else { 0.5 });
    for text in [product.clone(), format!("({product})^3 - x"), format!("({product}*x + 1)/({product})")] {
        let e = Expr::parse(&text).unwrap();
        let (a, b) = (value(&e).unwrap(), value(&e.tidy()).unwrap());
        assert!((a - b).abs() < 1e-12 * a.abs(), "{a} and {b}");
    }
    let long = Expr::parse(&names[..14].join("*")).unwrap().tidy();
    assert_eq!(long.to_string().matches(" + ").count(), (1 << 14) - 1);
    assert_eq!(Expr::parse(&long.to_string()).unwrap(), long);
    assert!(Expr::parse("(a + b + c + d)^8").unwrap().tidy().to_string().matches(" + ").count() > 150);
    assert!(Expr::parse("((a + b + c + d)^8)^8").unwrap().tidy().to_string().starts_with('('));
}

/// Whether every number of a graph is a double, so that folding constants rounds nothing.
fn folds_exactly(graph: &Graph) -> bool {
    (0..graph.len()).all(|id| match graph.op(id) {
        creepage::formula::Op::Num(v) => exact_f64(nearest_f64(v)).as_ref() == Some(v),
        _ => true,
    })
}

#[test]
fn a_program_gives_exactly_the_value_of_the_formula_and_is_undefined_with_it() {
    let compared = std::cell::Cell::new((0, 0));
    check(6000, (small_formulas(), points()), |(e, at)| {
        let (program, graph) = compiled(&e);
        if folds_exactly(&graph) {
            let (expected, found) = (value(&e, &at), run(&program, &at));
            prop_assert_eq!(found, expected, "{:?}", e);
            let (defined, undefined) = compared.get();
            compared.set((defined + u32::from(found.is_some()), undefined + u32::from(found.is_none())));
        }
        Ok(())
    });
    assert!(compared.get().0 > 1000 && compared.get().1 > 1000, "{:?}", compared);
}

#[test]
fn a_program_of_any_formula_gives_the_value_within_rounding() {
    check(3000, (formulas(), points()), |(e, at)| {
        let (program, _) = compiled(&e);
        let Some(expected) = rounded(&e, &at) else { return Ok(()) };
        agrees("program", expected, run(&program, &at))?;
        let duals = at.map(|v| Dual(Dual64::new(v, 1.0)));
        agrees("program in duals", expected, Some(program.run_in(&duals)[0].0.re))
    });
}

#[test]
fn a_program_runs_alike_in_both_ways_on_any_input_however_wild() {
    let wild = prop_oneof![
        Just(f64::NAN),
        Just(f64::INFINITY),
        Just(-1e200),
        Just(1e300),
        Just(1e-300),
        Just(0.0),
        Just(-0.0),
        -3.0..3.0f64
    ];
    check(6000, (small_formulas(), prop::array::uniform8(wild)), |(e, at)| {
        let (program, graph) = compiled(&e);
        let found = run(&program, &at);
        let other = program.run_in(&at)[0];
        prop_assert_eq!(found, other.is_finite().then_some(other), "{:?}", e);
        // What has a value keeps it; only 0·x of an overflow may gain one.
        let expected = value(&e, &at);
        prop_assert!(!folds_exactly(&graph) || expected.is_none() || found == expected, "{:?}: {:?}", e, expected);
        Ok(())
    });
}

#[test]
fn folding_never_defines_what_is_undefined() {
    let table =
        ["0*(1/x)", "0/x", "1/x - 1/x", "ln(x) - ln(x)", "(1/x)^0", "0*sqrt(x - 1)", "ln(x - 1)^0", "0*x^-1", "x/x"];
    for text in table {
        let e = Expr::parse(text).unwrap();
        let (program, graph) = compiled(&e);
        assert_eq!(value(&e, &[0.0; 8]), None, "{text}");
        assert_eq!(run(&program, &[0.0; 8]), None, "{text}");
        assert_eq!(value(&graph.expr(graph.len() - 1), &[0.0; 8]), None, "{text}");
        let same = e.substitute(&|_| None);
        assert_eq!(value(&same, &[0.0; 8]), None, "{text} became {same}");
    }
}

#[test]
fn an_overflow_inside_a_program_stays_undefined() {
    for text in ["(x*y)^-1", "1/(x*y)", "sign(x*y)", "atan(x^2)", "(x + x^2)^-2"] {
        let (program, _) = compiled(&Expr::parse(text).unwrap());
        assert_eq!(run(&program, &[1e200; 8]), None, "{text}");
    }
}

#[test]
fn a_dual_number_without_derivative_is_defined_exactly_where_the_value_is() {
    check(4000, (small_formulas(), points()), |(e, at)| {
        let expected = value(&e, &at);
        let dual = e.eval(&|s| Dual(Dual64::from(named(&at, s.as_str()))));
        let hyper = e.eval(&|s| Dual(HyperDual64::from(named(&at, s.as_str()))));
        let vector = e.eval(&|s| Dual(DualDVec64::from(named(&at, s.as_str()))));
        prop_assert_eq!(dual.is_some(), expected.is_some(), "{:?}", e);
        prop_assert_eq!(hyper.is_some(), expected.is_some(), "{:?}", e);
        prop_assert_eq!(vector.is_some(), expected.is_some(), "{:?}", e);
        prop_assert!(dual.is_none_or(|d| d.0.eps == 0.0));
        Ok(())
    });
    for text in ["abs(x)", "sign(x)", "sqrt(x)", "asin(x + 1)", "acos(x - 1)", "x^0", "x^1", "sqrt(x^2)"] {
        let e = Expr::parse(text).unwrap();
        let constant = e.eval(&|_| Dual(Dual64::new(0.0, 0.0))).unwrap().0;
        assert_eq!(Some(constant.re), value(&e, &[0.0; 8]), "{text}");
    }
}

#[test]
fn a_defined_name_reads_like_its_definition_written_out() {
    check(1000, (small_formulas(), small_formulas(), functions(), points()), |(inner, outer, f, at)| {
        let mut graph = Graph::default();
        let id = graph.insert(&inner);
        graph.define("x", id);
        let top = graph.insert(&Expr::call(f, &outer));
        let program = Program::compile(&graph, &NAMES.map(Symbol::new), &[top]).unwrap();
        let written = Expr::call(f, &outer).substitute(&|s| (s.as_str() == "x").then(|| inner.clone()));
        let Some(expected) = rounded(&written, &at) else { return Ok(()) };
        agrees("definition", expected, run(&program, &at))
    });
}

#[test]
fn a_symbol_that_is_no_input_is_named() {
    let mut graph = Graph::default();
    let id = graph.insert(&Expr::parse("x + nowhere").unwrap());
    assert_eq!(Program::compile(&graph, &["x".into()], &[id]).unwrap_err().as_str(), "nowhere");
}
