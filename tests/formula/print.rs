//! Reading and printing are inverse, and both mean what arithmetic means.

use crate::support::tree::{Tree, formulas, number_text, points, small_trees, trees};
use crate::support::{self, check};
use creepage::formula::{BigRational, Expr, Symbol, latex_symbol};
use proptest::prelude::*;

/// Printed text reads back as the very same expression.
fn returns(e: &Expr) -> Result<(), TestCaseError> {
    let text = e.to_string();
    let back = Expr::parse(&text).map_err(|e| TestCaseError::fail(e.to_string()))?;
    prop_assert_eq!(&back, e);
    prop_assert_eq!(back.to_string(), text);
    Ok(())
}

#[test]
fn every_form_is_read_as_it_is_written() {
    check(1500, trees(), |t| {
        prop_assert!(t.is_form_of(&t.expr()), "{} became {:?}", t.text(), t.expr());
        Ok(())
    });
}

#[test]
fn printed_text_reads_back_as_the_same_expression() {
    check(3000, formulas(), |e| returns(&e));
}

#[test]
fn white_space_needless_parentheses_and_typographic_signs_change_nothing() {
    check(1500, (trees(), prop::collection::vec(any::<u8>(), 1..40)), |(t, taste)| {
        let loose = t.loose_text(&taste);
        let read = Expr::parse(&loose).map_err(|e| TestCaseError::fail(e.to_string()))?;
        prop_assert_eq!(read, t.expr(), "{:?}", loose);
        Ok(())
    });
}

#[test]
fn a_printed_formula_has_the_value_of_the_tree_it_came_from() {
    check(3000, (small_trees(), points()), |(t, at)| {
        let printed = Expr::parse(&t.expr().to_string()).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let value = printed.eval(&|s| support::tree::named(&at, s.as_str()));
        let expected = t.value(&at);
        prop_assert_eq!(value.is_some(), expected.is_finite(), "{:?}: {:?} or {}", printed, value, expected);
        prop_assert!(value.is_none_or(|v| v == expected), "{:?}: {:?} or {}", printed, value, expected);
        Ok(())
    });
}

#[test]
fn precedence_is_that_of_mathematics() {
    // Value at x = 3, y = 2, and how the formula is printed.
    let table = [
        ("-x^2", -9.0, "-x^2"),
        ("(-x)^2", 9.0, "(-x)^2"),
        ("-(x^2)", -9.0, "-x^2"),
        ("2^-1", 0.5, "2^-1"),
        ("2^(-1)", 0.5, "2^-1"),
        ("-2^2", -4.0, "-2^2"),
        ("-(-x)", 3.0, "-(-x)"),
        ("--x", 3.0, "-(-x)"),
        ("x - (y - 1)", 2.0, "x - (y - 1)"),
        ("x - y - 1", 0.0, "x - y - 1"),
        ("x - (y + 1)", 0.0, "x - (y + 1)"),
        ("x + (y - 1)", 4.0, "x + (y - 1)"),
        ("12/(x*y)", 2.0, "12/(x*y)"),
        ("12/x*y", 8.0, "12/x*y"),
        ("12/(x/y)", 8.0, "12/(x/y)"),
        ("12/x/y", 2.0, "12/x/y"),
        ("-x*y", -6.0, "-x*y"),
        ("-(x*y)", -6.0, "-x*y"),
        ("x*-y", -6.0, "x*(-y)"),
        ("x/-y", -1.5, "x/(-y)"),
        ("x - -y", 5.0, "x - (-y)"),
        ("(x + y)^2", 25.0, "(x + y)^2"),
        ("(x*y)^2", 36.0, "(x*y)^2"),
        ("(x^2)^3", 729.0, "(x^2)^3"),
        ("x*y^2", 12.0, "x*y^2"),
        ("sqrt(x + 1)^3", 8.0, "sqrt(x + 1)^3"),
        ("abs(-x)^2", 9.0, "abs(-x)^2"),
        ("0.50*x", 1.5, "0.5*x"),
        ("1e-3*x", 0.003, "0.001*x"),
        ("2.5E+2", 250.0, "250"),
        (".5 + 1.", 1.5, "0.5 + 1"),
    ];
    for (text, value, printed) in table {
        let e = Expr::parse(text).unwrap();
        assert_eq!(e.eval(&|s| if s.as_str() == "x" { 3.0 } else { 2.0 }), Some(value), "{text}");
        assert_eq!(e.to_string(), printed);
    }
}

#[test]
fn a_number_is_the_double_that_rust_reads() {
    check(2000, prop_oneof![number_text(), "[0-9]{1,25}(\\.[0-9]{1,25})?([eE]-?[0-9]{1,2})?"], |text| {
        let e = Expr::parse(&text).map_err(|e| TestCaseError::fail(e.to_string()))?;
        prop_assert_eq!(e.eval(&|_| f64::NAN), text.parse().ok());
        returns(&e)
    });
}

#[test]
fn the_longest_and_smallest_numbers_read_back_too() {
    for text in ["1e399", "1e-399", "9e-324", "1.7976931348623157e308", &"7".repeat(400), "12345678e-390"] {
        returns(&Expr::parse(text).unwrap()).unwrap();
    }
    for text in ["1e400", "1e-400", "1.5e-399", &format!("{}e1", "7".repeat(400))] {
        assert!(Expr::parse(text).is_err_and(|e| e.place() == Some((1, 1))), "{text}");
    }
}

#[test]
fn an_exact_number_is_written_as_a_decimal_or_a_quotient() {
    let written = |p: i64, q: i64| Expr::number(&BigRational::from_parts_signed(p.into(), q.into()));
    let table = [(1, 4, "0.25"), (-1, 4, "-0.25"), (1, 3, "1/3"), (-22, 7, "-22/7"), (0, 5, "0"), (6, 3, "2")];
    for (p, q, text) in table {
        assert_eq!(written(p, q).to_string(), text);
    }
    check(1000, (any::<i64>(), 1..i64::MAX), |(p, q)| {
        let e = written(p, q);
        prop_assert_eq!(e.as_number(), Some(BigRational::from_parts_signed(p.into(), q.into())));
        returns(&e)
    });
}

#[test]
fn latex_has_balanced_braces_and_parentheses() {
    check(2000, formulas(), |e| {
        let latex = e.latex();
        let count = |s: &str| latex.matches(s).count();
        prop_assert!(braces_balance(&latex), "{}", latex);
        prop_assert_eq!(count("\\left"), count("\\right"), "{}", latex);
        Ok(())
    });
}

fn braces_balance(latex: &str) -> bool {
    let depths = latex.chars().scan(0i32, |depth, c| {
        *depth += i32::from(c == '{') - i32::from(c == '}');
        Some(*depth)
    });
    let depths: Vec<_> = depths.collect();
    depths.iter().all(|d| *d >= 0) && depths.last().is_none_or(|d| *d == 0)
}

#[test]
fn latex_cannot_be_misread() {
    let table = [
        ("a*-b", r"a\,\left(-b\right)"),
        ("a - -b", r"a - \left(-b\right)"),
        ("-(-a)", r"-\left(-a\right)"),
        ("a*(-b*c/d)", r"a\,\left(-\frac{b\,c}{d}\right)"),
        ("2*3", r"2\cdot 3"),
        ("2*3^2", r"2\cdot 3^{2}"),
        ("2*x", r"2\,x"),
        ("(a/b)^2", r"\left(\frac{a}{b}\right)^{2}"),
        ("(-a)^2", r"\left(-a\right)^{2}"),
        ("-a^2", r"-a^{2}"),
        ("x'''^2", r"{x^{(3)}}^{2}"),
        ("a - (b - c)", r"a - \left(b - c\right)"),
        ("a/(b*c)", r"\frac{a}{b\,c}"),
        ("sqrt(abs(x))", r"\sqrt{\left|x\right|}"),
        ("omega_rear_left''", r"\ddot{\omega}_{rear,left}"),
    ];
    for (text, latex) in table {
        assert_eq!(Expr::parse(text).unwrap().latex(), latex, "{text}");
    }
    assert_eq!(latex_symbol(&"theta_rc'".into()), r"\dot{\theta}_{rc}");
}

#[test]
fn typst_cannot_be_misread() {
    let table = [
        ("a*-b", "a thin (-b)"),
        ("a - -b", "a - (-b)"),
        ("a*(-b*c/d)", "a thin (-frac(b thin c, d))"),
        ("2*3^2", "2 dot.op 3^(2)"),
        ("(a/b)^2", "(frac(a, b))^(2)"),
        ("-a^2", "-a^(2)"),
        ("a - (b - c)", "a - (b - c)"),
        ("atan(abs(x))", "arctan(abs(x))"),
        ("omega_rear_left''", "dot.double(omega)_\"rear,left\""),
        ("slip_1 + sign(x)", "\"slip\"_\"1\" + op(\"sgn\")(x)"),
    ];
    for (text, typst) in table {
        assert_eq!(Expr::parse(text).unwrap().typst(), typst, "{text}");
    }
}

#[test]
fn a_name_is_well_formed_exactly_if_it_reads_back_as_itself() {
    let text = prop_oneof!["[a-z_φ][a-z0-9_.]{0,4}'{0,3}", "[ -~]{0,5}", Just("sin".into()), Just("sin'".into())];
    check(2000, text, |text| {
        let name = Symbol::new(&text);
        let read = Expr::parse(&text).is_ok_and(|e| e == Expr::sym(name.clone()));
        prop_assert_eq!(name.is_well_formed(), read, "{:?}", text);
        Ok(())
    });
}

#[test]
fn a_tree_of_the_tests_is_not_blind() {
    // The comparison itself can say no.
    let t = Tree::Two('-', Tree::Sym(0).into(), Tree::Sym(1).into());
    assert!(t.is_form_of(&Expr::parse("x - y").unwrap()));
    assert!(!t.is_form_of(&Expr::parse("y - x").unwrap()));
    assert!(!t.is_form_of(&Expr::parse("x + y").unwrap()));
}
