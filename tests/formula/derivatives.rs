//! Derivatives by dual numbers, by rules on the graph and by central differences are the same.

use crate::support::rounding::Rounded;
use crate::support::tree::{NAMES, named, points, small_formulas};
use crate::support::{Outcome, check};
use creepage::formula::{Dual, Expr, Fun, Graph, Program, Symbol};
use nalgebra::{DMatrix, DVector, RowDVector};
use num_dual::{Derivative, Dual2_64, Dual2DVec64, Dual64, DualDVec64, HyperDual64};
use proptest::prelude::*;

type Point = [f64; 8];

fn index(s: &Symbol) -> usize {
    NAMES.iter().position(|n| *n == s.as_str()).unwrap()
}

/// The derivative by rules, its value with a bound, where value and derivative are beyond doubt.
fn by_rules(e: &Expr, names: &[usize], at: &Point) -> Option<Rounded> {
    let point = |s: &Symbol| Rounded::exact(named(at, s.as_str()));
    let d = names.iter().fold(e.clone(), |e, k| e.derivative(&NAMES[*k].into()));
    e.eval(&point)?;
    d.eval(&point)
}

/// A derivative is defined and within a bound; another order of operations rounds differently.
fn agrees(way: &str, e: &Expr, expected: Rounded, found: Option<f64>) -> Outcome {
    let near = |v: f64| expected.allows(v, 100.0) || (v - expected.value).abs() < 1e-9 * (1.0 + v.abs());
    prop_assert!(found.is_some_and(near), "{} of {:?}: {:?} is not {:?}", way, e, found, expected);
    Ok(())
}

fn dual(e: &Expr, k: usize, at: &Point) -> Option<f64> {
    e.eval(&|s| Dual(Dual64::new(at[index(s)], f64::from(index(s) == k)))).map(|d| d.0.eps)
}

fn second(e: &Expr, k: usize, at: &Point) -> Option<f64> {
    e.eval(&|s| Dual(Dual2_64::new(at[index(s)], f64::from(index(s) == k), 0.0))).map(|d| d.0.v2)
}

fn mixed(e: &Expr, [j, k]: [usize; 2], at: &Point) -> Option<f64> {
    let seed = |i: usize, k: usize| f64::from(i == k);
    let hyper = |i: usize| HyperDual64::new(at[i], seed(i, j), seed(i, k), 0.0);
    e.eval(&|s| Dual(hyper(index(s)))).map(|d| d.0.eps1eps2)
}

#[test]
fn dual_numbers_and_rules_give_the_same_first_derivative() {
    check(4000, (small_formulas(), 0..8usize, points()), |(e, k, at)| match by_rules(&e, &[k], &at) {
        Some(expected) => agrees("dual", &e, expected, dual(&e, k, &at)),
        None => Ok(()),
    });
}

#[test]
fn dual_numbers_and_rules_give_the_same_second_derivatives() {
    check(3000, (small_formulas(), 0..8usize, 0..8usize, points()), |(e, j, k, at)| {
        if let Some(expected) = by_rules(&e, &[j], &at).and(by_rules(&e, &[j, k], &at)) {
            agrees("hyper-dual", &e, expected, mixed(&e, [j, k], &at))?;
        }
        if let Some(expected) = by_rules(&e, &[k], &at).and(by_rules(&e, &[k, k], &at)) {
            agrees("second order", &e, expected, second(&e, k, &at))?;
        }
        Ok(())
    });
}

/// Every function, applied to something that moves; the random formulas above reach them too rarely.
fn functions_of_something() -> impl Iterator<Item = [Expr; 6]> {
    let inner = ["x", "x*y/4", "0.3*sin(x + 2*y)", "1.5 + cos(x)*y/9", "-x", "400*x"];
    Fun::all().map(move |f| inner.map(|text| Expr::call(f, &Expr::parse(text).unwrap())))
}

#[test]
fn every_function_has_the_same_derivatives_in_every_way() {
    for compositions in functions_of_something() {
        let decided: usize = compositions.iter().map(agreements).sum();
        assert!(decided >= 80, "{:?}: {decided}", compositions[0]);
    }
}

/// At how many of forty points all ways could be compared; they agree there.
fn agreements(e: &Expr) -> usize {
    let points = (0..40).map(|i| {
        let x = 0.05 * f64::from(i) + 0.013;
        [if i % 2 == 0 { x } else { -x }, 0.7, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    });
    points.filter(|at| agrees_at(e, at).unwrap()).count()
}

fn agrees_at(e: &Expr, at: &Point) -> Result<bool, TestCaseError> {
    let Some(first) = by_rules(e, &[0], at) else { return Ok(false) };
    agrees("dual", e, first, dual(e, 0, at))?;
    central_difference(e, 0, at, first)?;
    for pair in [[0, 0], [0, 1]] {
        let Some(expected) = by_rules(e, &pair, at) else { return Ok(false) };
        agrees("hyper-dual", e, expected, mixed(e, pair, at))?;
        agrees("other way round", e, expected, mixed(e, [pair[1], pair[0]], at))?;
    }
    Ok(true)
}

/// The slope by differences, where halving the step shows that it has converged.
fn central_difference(e: &Expr, k: usize, at: &Point, expected: Rounded) -> Outcome {
    let moved = |h: f64| {
        let mut at = *at;
        at[k] += h;
        e.eval(&|s| Rounded::exact(named(&at, s.as_str())))
    };
    let slope = |h: f64| {
        let (up, down) = (moved(h)?, moved(-h)?);
        Some(((up.value - down.value) / (2.0 * h), (up.error + down.error) / h))
    };
    let (Some((wide, _)), Some((narrow, rounding))) = (slope(1e-4), slope(5e-5)) else { return Ok(()) };
    let truncation = (wide - narrow).abs();
    if truncation > 1e-3 * (1.0 + narrow.abs()) {
        return Ok(()); // near a singularity
    }
    let tolerance = 2.0 * truncation + rounding + 1e-7 * (1.0 + narrow.abs());
    prop_assert!((narrow - expected.value).abs() <= tolerance, "{:?}: {} is not {:?}", e, narrow, expected);
    Ok(())
}

#[test]
fn rules_and_central_differences_give_the_same_derivative() {
    check(4000, (small_formulas(), 0..8usize, points()), |(e, k, at)| match by_rules(&e, &[k], &at) {
        Some(expected) => central_difference(&e, k, &at, expected),
        None => Ok(()),
    });
}

#[test]
fn the_gradient_of_any_length_is_the_row_of_derivatives() {
    check(1500, (small_formulas(), 1..=8usize, points()), |(e, n, at)| {
        let unit = |i: usize| Derivative::some(DVector::from_fn(n, |k, _| f64::from(k == i)));
        let Some(gradient) = e.eval(&|s| Dual(DualDVec64::new(at[index(s)], unit(index(s))))) else { return Ok(()) };
        let gradient = gradient.0.eps.unwrap_generic(nalgebra::Dyn(n), nalgebra::U1);
        for k in 0..n {
            if let Some(expected) = by_rules(&e, &[k], &at) {
                agrees("gradient", &e, expected, Some(gradient[k]))?;
            }
        }
        Ok(())
    });
}

fn hessian(e: &Expr, at: &Point) -> Option<DMatrix<f64>> {
    let unit = |i: usize| Derivative::some(RowDVector::from_fn(8, |_, k| f64::from(k == i)));
    let d = e.eval(&|s| Dual(Dual2DVec64::new(at[index(s)], unit(index(s)), Derivative::none())))?;
    Some(d.0.v2.unwrap_generic(nalgebra::Dyn(8), nalgebra::Dyn(8)))
}

#[test]
fn the_hessian_is_symmetric_and_holds_the_second_derivatives() {
    check(800, (small_formulas(), points()), |(e, at)| {
        let Some(h) = hessian(&e, &at) else { return Ok(()) };
        for (j, k) in (0..8).flat_map(|j| (0..8).map(move |k| (j, k))) {
            let size = 1.0 + h[(j, k)].abs();
            prop_assert!((h[(j, k)] - h[(k, j)]).abs() <= 1e-9 * size, "{:?}: {}", e, h);
            if let Some(expected) = by_rules(&e, &[j], &at).and(by_rules(&e, &[j, k], &at)) {
                agrees("Hessian", &e, expected, Some(h[(j, k)]))?;
            }
        }
        Ok(())
    });
}

#[test]
fn derivatives_taken_on_a_shared_graph_are_those_of_each_formula() {
    check(800, (small_formulas(), small_formulas(), 0..8usize, points()), |(a, b, k, at)| {
        let mut graph = Graph::default();
        let ids = [graph.insert(&a), graph.insert(&b)];
        let ids = graph.derivatives(&ids, &NAMES[k].into());
        let program = Program::compile(&graph, &NAMES.map(Symbol::new), &ids).unwrap();
        let mut found = [0.0; 2];
        program.run(&at, &mut program.registers(), &mut found);
        for (e, v) in [a, b].iter().zip(found) {
            if let Some(expected) = by_rules(e, &[k], &at) {
                agrees("graph", e, expected, v.is_finite().then_some(v))?;
            }
        }
        Ok(())
    });
}

#[test]
fn derivatives_are_those_of_the_table() {
    let table = [
        ("3", "0"),
        ("y", "0"),
        ("x", "1"),
        ("x'", "0"),
        ("-x", "-1"),
        ("x*y", "y"),
        ("x - x*y", "1 - y"),
        ("x^2", "2*x"),
        ("x^1", "1"),
        ("x^0", "0"),
        ("1/x", "-(1/x)/x"),
        ("x/y", "1/y"),
        ("sin(x)", "cos(x)"),
        ("cos(x)", "-sin(x)"),
        ("exp(2*x)", "exp(2*x)*2"),
        ("ln(x)", "1/x"),
        ("sqrt(x)", "1/(2*sqrt(x))"),
        ("abs(x)", "x/abs(x)"),
        ("atan(x)", "1/(1 + x^2)"),
        ("sin(y)", "0"),
        ("y^3", "0"),
    ];
    let at = |s: &Symbol| if s.as_str() == "x" { 0.7 } else { 1.9 };
    for (text, derivative) in table {
        let found = Expr::parse(text).unwrap().derivative(&"x".into());
        let (a, b) = (found.eval(&at).unwrap(), Expr::parse(derivative).unwrap().eval(&at).unwrap());
        assert!((a - b).abs() < 1e-15, "{text}: {found} is not {derivative}");
    }
}

#[test]
fn powers_at_zero_have_their_derivatives_and_corners_have_none() {
    // Text; value, first and second derivative at zero.
    let smooth = [
        ("x^0", [1.0, 0.0, 0.0]),
        ("x^1", [0.0, 1.0, 0.0]),
        ("x^2", [0.0, 0.0, 2.0]),
        ("x^3", [0.0, 0.0, 0.0]),
        ("(x + 1)^-2", [1.0, -2.0, 6.0]),
        ("tanh(x)", [0.0, 1.0, 0.0]),
    ];
    for (text, [value, slope, curvature]) in smooth {
        let e = Expr::parse(text).unwrap();
        let d = e.eval(&|_| Dual(Dual2_64::new(0.0, 1.0, 0.0))).unwrap().0;
        assert_eq!((d.re, d.v1, d.v2), (value, slope, curvature), "{text}");
        assert_eq!(e.derivative(&"x".into()).eval(&|_| 0.0), Some(slope), "{text}");
    }
    for text in ["abs(x)", "sign(x)", "sqrt(x)", "asin(1 + x)", "1/x", "x^-1", "ln(x)", "cot(x)"] {
        let e = Expr::parse(text).unwrap();
        assert!(e.eval(&|_| Dual(Dual64::new(0.0, 1.0))).is_none(), "{text}");
        assert_eq!(e.derivative(&"x".into()).eval(&|_| 0.0), None, "{text}");
    }
}

#[test]
fn a_comparison_of_derivatives_can_say_no() {
    let e = Expr::parse("x^2").unwrap();
    let at = [1.5; 8];
    let wrong = by_rules(&Expr::parse("x^2 + 0.00001*x").unwrap(), &[0], &at).unwrap();
    assert!(agrees("dual", &e, wrong, dual(&e, 0, &at)).is_err());
    assert!(central_difference(&e, 0, &at, wrong).is_err());
}
