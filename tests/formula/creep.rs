//! The two forms of σ for a creeping type T and their derivatives, as sec. 2 of THEORY.md states them.

use crate::support::{Outcome, check};
use creepage::formula::{Dual, Expr, Symbol};
use num_dual::HyperDual64;
use proptest::prelude::*;

const SIGMA: &str = "(cot(phi) - e)/(1 + e*cot(phi))";
const ANGLE_FORM: &str = "cot(phi + atan(e))";
const PAIR_FORM: &str = "(cos(phi) - e*sin(phi))/(sin(phi) + e*cos(phi))";

fn value(text: &str, phi: f64, e: f64) -> Option<f64> {
    evaluate(&Expr::parse(text).unwrap(), phi, e)
}

fn evaluate(formula: &Expr, phi: f64, e: f64) -> Option<f64> {
    formula.eval(&|s: &Symbol| if s.as_str() == "phi" { phi } else { e })
}

/// Angles and creeps where no form is singular.
fn regular() -> impl Strategy<Value = (f64, f64)> {
    let away = |(phi, e): &(f64, f64)| phi.sin().abs() > 0.02 && (phi.sin() + e * phi.cos()).abs() > 0.02;
    (-7.0..7.0f64, -2.0..2.0f64).prop_filter("singular", away)
}

fn close(what: &str, found: Option<f64>, expected: Option<f64>) -> Outcome {
    let (a, b) = (found.unwrap_or(f64::NAN), expected.unwrap_or(f64::NAN));
    prop_assert!((a - b).abs() <= 1e-9 * (1.0 + b.abs()), "{}: {} is not {}", what, a, b);
    Ok(())
}

#[test]
fn the_creeping_sigma_is_the_cotangent_of_a_turned_angle() {
    check(3000, regular(), |(phi, e)| {
        let sigma = value(SIGMA, phi, e);
        close("angle form", value(ANGLE_FORM, phi, e), sigma)?;
        close("pair form", value(PAIR_FORM, phi, e), sigma)
    });
}

#[test]
fn its_derivatives_by_rules_are_those_of_the_theory() {
    let slopes = [("phi", "-(1 + e^2)/(sin(phi) + e*cos(phi))^2"), ("e", "-1/(sin(phi) + e*cos(phi))^2")];
    for (name, slope) in slopes {
        let forms = [SIGMA, ANGLE_FORM, PAIR_FORM].map(|f| Expr::parse(f).unwrap().derivative(&name.into()));
        check(2000, regular(), |(phi, e)| {
            let expected = value(slope, phi, e);
            forms.iter().try_for_each(|d| close(name, evaluate(d, phi, e), expected))
        });
    }
}

#[test]
fn its_derivatives_in_the_cotangent_are_those_of_the_theory() {
    let sigma = Expr::parse("(q - e)/(1 + e*q)").unwrap();
    let slopes = [("q", "(1 + e^2)/(1 + e*q)^2"), ("e", "-(1 + q^2)/(1 + e*q)^2")];
    let regular = (-5.0..5.0f64, -2.0..2.0f64).prop_filter("singular", |(q, e)| (1.0 + e * q).abs() > 0.02);
    check(2000, regular, |(q, e)| {
        let at = |s: &Symbol| if s.as_str() == "q" { q } else { e };
        slopes.iter().try_for_each(|(name, slope)| {
            close(name, sigma.derivative(&(*name).into()).eval(&at), Expr::parse(slope).unwrap().eval(&at))
        })
    });
}

#[test]
fn its_mixed_derivative_by_hyper_dual_numbers_is_that_of_the_rules() {
    let sigma = Expr::parse(SIGMA).unwrap();
    let mixed = sigma.derivative(&"phi".into()).derivative(&"e".into());
    check(1000, regular(), |(phi, e)| {
        let hyper = |s: &Symbol| match s.as_str() {
            "phi" => Dual(HyperDual64::new(phi, 1.0, 0.0, 0.0)),
            _ => Dual(HyperDual64::new(e, 0.0, 1.0, 0.0)),
        };
        close("mixed", sigma.eval(&hyper).map(|d| d.0.eps1eps2), evaluate(&mixed, phi, e))
    });
}

#[test]
fn two_creeps_in_a_row_are_one_by_the_group_law() {
    let sigma = Expr::parse("(q - e)/(1 + e*q)").unwrap();
    let twice = sigma.substitute(&|s| match s.as_str() {
        "q" => Some(Expr::parse("(q - e1)/(1 + e1*q)").unwrap()),
        _ => Some(Expr::sym("e2")),
    });
    let once = sigma.substitute(&|s| (s.as_str() == "e").then(|| Expr::parse("(e1 + e2)/(1 - e1*e2)").unwrap()));
    check(2000, prop::array::uniform3(-0.9..0.9f64), |[q, e1, e2]| {
        let at = |s: &Symbol| match s.as_str() {
            "q" => q,
            "e1" => e1,
            _ => e2,
        };
        let regular = (1.0 + e1 * q).abs() > 0.05 && (1.0 - e1 * e2 + (e1 + e2) * q).abs() > 0.05;
        if regular { close("group law", twice.eval(&at), once.eval(&at)) } else { Ok(()) }
    });
}

#[test]
fn the_cotangent_form_is_singular_where_the_pair_is_not() {
    assert_eq!(value(SIGMA, 0.0, 0.1), None);
    assert!((value(PAIR_FORM, 0.0, 0.1).unwrap() - 10.0).abs() < 1e-12);
    assert!(
        (value("(cot(phi) + e)/(1 - e*cot(phi))", 0.6, 0.1).unwrap() - value(ANGLE_FORM, 0.6, 0.1).unwrap()).abs()
            > 0.1
    );
}
