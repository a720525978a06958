//! Exact numbers and angles: a table of values, and agreement with floating point.

use crate::support::check;
use crate::support::fragment::{exactly, fragments, points, rounded};
use creepage::formula::{Exact, Expr, Fun, Scalar};
use proptest::prelude::*;
use std::cell::Cell;

/// A formula at the angle with the half-tangent 1/2 (cos 3/5, sin 4/5), the angle of (2, 1) and u = 2/3.
fn shown(text: &str) -> String {
    let value = |s: &str| match s {
        "phi" => Exact::half_tangent(1, 2),
        "psi" => Exact::direction(2.into(), 1.into()),
        "half" => Exact::half_tangent(1, 0),
        "quarter" => Exact::half_tangent(1, 1),
        "back" => Exact::half_tangent(-1, 1),
        _ => Exact::ratio(2, 3),
    };
    Expr::parse(text).unwrap().eval_undefined_as_value(&|s| value(s.as_str())).to_string()
}

fn all_show(table: &[(&str, &str)]) {
    for (text, expected) in table {
        assert_eq!(shown(text), *expected, "{text}");
    }
}

#[test]
fn a_half_tangent_gives_rational_sine_and_cosine() {
    all_show(&[
        ("cos(phi)", "3/5"),
        ("sin(phi)", "4/5"),
        ("tan(phi)", "4/3"),
        ("cot(phi)", "3/4"),
        ("phi", "angle(3, 4)"),
        ("-phi", "angle(3, -4)"),
        ("half", "angle(-1, 0)"),
        ("cos(half)", "-1"),
        ("sin(half)", "0"),
        ("tan(half)", "0"),
        ("cos(quarter)", "0"),
        ("sin(quarter)", "1"),
        ("cot(quarter)", "0"),
        ("sin(back)", "-1"),
    ]);
    assert_eq!(Exact::half_tangent(0, 1).to_string(), "0");
    assert_eq!(Exact::half_tangent(-2, -4).to_string(), "angle(3, 4)");
}

#[test]
fn angles_are_added_subtracted_and_taken_whole_times() {
    all_show(&[
        ("phi + phi", "angle(-7, 24)"),
        ("2*phi", "angle(-7, 24)"),
        ("cos(2*phi)", "-7/25"),
        ("sin(phi*2)", "24/25"),
        ("cos(-3*phi)", "-117/125"),
        ("phi - phi", "0"),
        ("phi - psi", "angle(2, 1)"),
        ("phi + 0", "angle(3, 4)"),
        ("0 - psi", "angle(2, -1)"),
        ("0*phi", "0"),
        ("sin(quarter - phi)", "3/5"),
        ("1000*half - 999*half", "angle(-1, 0)"),
    ]);
}

#[test]
fn tangents_of_sums_are_rational_even_where_sines_are_not() {
    all_show(&[
        ("tan(psi)", "1/2"),
        ("cot(psi)", "2"),
        ("sin(psi)", "undefined"),
        ("cos(psi)", "undefined"),
        ("sin(2*psi)", "4/5"),
        ("tan(phi + psi)", "11/2"),
        ("tan(phi - psi)", "1/2"),
        ("cot(phi + atan(u))", "1/18"),
        ("tan(psi + atan(u))", "7/4"),
        ("tan(quarter + psi)", "-2"),
        ("cot(half + psi)", "2"),
        ("tan(atan(u))", "2/3"),
    ]);
}

#[test]
fn inverse_functions_give_angles_in_their_ranges() {
    all_show(&[
        ("atan(-3/4)", "angle(4, -3)"),
        ("asin(3/5)", "angle(4, 3)"),
        ("asin(-3/5)", "angle(4, -3)"),
        ("acos(-3/5)", "angle(-3, 4)"),
        ("acos(3/5)", "angle(3, 4)"),
        ("asin(1)", "angle(0, 1)"),
        ("acos(-1)", "angle(-1, 0)"),
        ("acos(1)", "0"),
        ("atan(0)", "0"),
        ("asin(2)", "undefined"),
        ("acos(2)", "undefined"),
        ("asin(u)", "undefined"),
    ]);
}

#[test]
fn a_whole_turn_is_not_zero() {
    all_show(&[
        ("half + half", "angle(1, 0) + 1 turns"),
        ("4*quarter", "angle(1, 0) + 1 turns"),
        ("-4*quarter", "angle(1, 0) + -1 turns"),
        ("quarter + half", "angle(0, -1) + 1 turns"),
        ("-half", "angle(-1, 0) + -1 turns"),
        ("-(3*half)", "angle(-1, 0) + -2 turns"),
        ("half - half", "0"),
        ("4*quarter - 2*half", "0"),
        ("back + half", "angle(0, 1)"),
        ("2*back", "angle(-1, 0) + -1 turns"),
        ("quarter + quarter", "angle(-1, 0)"),
        ("cos(4*quarter)", "1"),
        ("sin(4*quarter)", "0"),
        ("cot(4*quarter)", "undefined"),
        ("1 + 4*quarter", "undefined"),
        ("1/(4*quarter)", "undefined"),
    ]);
    assert!(!Exact::half_tangent(1, 1).mul(&Exact::ratio(4, 1)).equals(&Exact::ratio(0, 1)));
    assert!(Exact::half_tangent(1, 1).mul(&Exact::ratio(6, 1)).to_f64() > 9.4);
}

#[test]
fn functions_of_numbers_are_exact_or_undefined() {
    all_show(&[
        ("sqrt(4/9)", "2/3"),
        ("sqrt(0)", "0"),
        ("sqrt(2)", "undefined"),
        ("sqrt(4/3)", "undefined"),
        ("sqrt(-4)", "undefined"),
        ("abs(-u)", "2/3"),
        ("sign(-u)", "-1"),
        ("sign(0)", "0"),
        ("exp(0)", "1"),
        ("exp(1)", "undefined"),
        ("ln(1)", "0"),
        ("ln(u)", "undefined"),
        ("tanh(0)", "0"),
        ("sin(0)", "0"),
        ("cos(0)", "1"),
        ("u^-2", "9/4"),
        ("0.1 + 0.2", "3/10"),
    ]);
}

#[test]
fn what_is_neither_number_nor_angle_is_undefined() {
    let texts = [
        "sin(1)",
        "cos(u)",
        "tan(1)",
        "cot(0)",
        "cot(u)",
        "phi/2",
        "u*phi",
        "phi*psi",
        "phi^2",
        "1/phi",
        "1 + phi",
        "phi - u",
        "tan(quarter)",
        "cot(half)",
        "abs(phi)",
        "sign(phi)",
        "exp(phi)",
        "atan(phi)",
        "1/(u - 2/3)",
        "1001*phi",
        "0/0",
    ];
    for text in texts {
        assert_eq!(shown(text), "undefined", "{text}");
    }
    assert!(!Exact::direction(0.into(), 0.into()).is_defined());
    assert!(!Exact::ratio(1, 0).is_defined() && Exact::ratio(1, 0).to_f64().is_nan());
}

#[test]
fn values_are_read_out() {
    let phi = Exact::half_tangent(1, 2);
    assert_eq!(phi.as_direction(), Some((3.into(), 4.into())));
    assert_eq!(Exact::ratio(0, 5).as_direction(), Some((1.into(), 0.into())));
    assert!(phi.as_rational().is_none() && Exact::ratio(1, 2).as_direction().is_none());
    assert_eq!(Exact::ratio(-6, 8).as_rational().map(ToString::to_string), Some("-3/4".into()));
    assert_eq!(Exact::ratio(-3, 4).to_f64(), -0.75);
    assert!((Exact::direction(1.into(), 1.into()).to_f64() - std::f64::consts::FRAC_PI_4).abs() < 1e-15);
    let huge = Exact::direction(num_traits::pow(10.into(), 400), num_traits::pow(10.into(), 400));
    assert_eq!(huge.to_string(), "angle(1, 1)");
    let wide = Exact::half_tangent(1, i64::MAX).to_f64();
    assert!((wide * i64::MAX as f64 - 2.0).abs() < 1e-12, "{wide}");
}

#[test]
fn an_exact_value_is_the_value_to_rounding_and_exists_where_there_is_one() {
    let compared = Cell::new(0);
    check(3000, (fragments(), points()), |(e, at)| {
        let found = exactly(&e, &at);
        let Some(expected) = e.eval(&|s| rounded(&at, s.as_str())) else { return Ok(()) };
        prop_assert!(found.as_rational().is_some(), "{:?} is not {:?}", found, expected);
        prop_assert!(expected.allows(found.to_f64(), 4.0), "{:?} is not {:?}", found, expected);
        compared.set(compared.get() + 1);
        Ok(())
    });
    assert!(compared.get() > 1200, "{compared:?}");
}

#[test]
fn functions_of_rational_numbers_agree_with_floating_point() {
    let functions = prop::sample::select(Fun::all().collect::<Vec<_>>());
    let compared = Cell::new(0);
    check(3000, (functions, -25i64..26, 1i64..17), |(f, p, q)| {
        let found = Exact::call(f, &Exact::ratio(p, q));
        if found.is_defined() {
            let expected = f64::call(f, &(p as f64 / q as f64));
            prop_assert!((found.to_f64() - expected).abs() < 1e-14 * (1.0 + expected.abs()), "{:?}", found);
            compared.set(compared.get() + 1);
        }
        Ok(())
    });
    assert!(compared.get() > 600, "{compared:?}");
}
