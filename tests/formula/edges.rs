//! Carriers where a shortcut, a size or a layout could be mistaken for another.

use creepage::formula::{
    BigInt, BigRational, Dual, Exact, Expr, Graph, Jet, Layout, Polynomial, Program, Scalar, Unit,
};
use num_dual::{Dual2, Dual2Vec, Dual64, DualVec};
use std::sync::Arc;

fn layout(name: &str, order: usize) -> Arc<Layout> {
    Arc::new(Layout::new(vec![name.into()], order))
}

/// A constant that belongs to a layout.
fn constant_of(layout: &Arc<Layout>, value: Exact) -> Jet {
    Jet::variable(layout, &"elsewhere".into(), value)
}

fn whole(n: i64) -> Jet {
    Jet::number(&BigRational::from(n))
}

#[test]
fn equal_layouts_go_together_and_others_do_not() {
    let one = |l: &Arc<Layout>| Jet::variable(l, &"x".into(), Exact::ratio(1, 2));
    let (a, same, other) = (layout("x", 2), layout("x", 2), layout("y", 2));
    assert!(one(&a).add(&one(&same)).is_defined());
    assert!(one(&a).equals(&one(&same)));
    assert!(!one(&a).add(&Jet::variable(&other, &"y".into(), Exact::ratio(1, 2))).is_defined());
}

/// Also a constant that came from a series keeps to its layout.
#[test]
fn what_is_made_from_a_layout_belongs_to_it() {
    for order in [0, 2] {
        let (a, other) = (layout("x", order), layout("y", order));
        let three = constant_of(&a, Exact::ratio(3, 1));
        let angle = Jet::fixed(Exact::direction(3.into(), 4.into()));
        let made = [
            ("c·2", three.mul(&whole(2))),
            ("2·c", whole(2).mul(&three)),
            ("angle·c", angle.mul(&three)),
            ("c·angle", three.mul(&angle)),
            ("1/c", three.recip()),
            ("atan c", Jet::call(creepage::formula::Fun::Atan, &three)),
            ("c + c", three.add(&three)),
            ("-c", three.neg()),
        ];
        let foreign = constant_of(&other, Exact::ratio(0, 1));
        for (what, jet) in made {
            assert!(jet.is_defined() && jet.add(&whole(0)).is_defined(), "{what}");
            assert!(!jet.add(&foreign).is_defined(), "{what} of order {order} is at home in another layout");
        }
    }
}

/// A constant has the value of the function also where the function has no slope.
#[test]
fn a_constant_has_derivative_zero_where_a_function_has_none() {
    for text in ["sqrt(x)", "abs(x)", "sign(x)"] {
        let e = Expr::parse(text).unwrap();
        assert_eq!(e.eval(&|_| Dual(Dual64::new(0.0, 0.0))).map(|d| (d.0.re, d.0.eps)), Some((0.0, 0.0)), "{text}");
        assert_eq!(e.eval(&|_| Dual(Dual2::new(0.0, 0.0, 0.0))).map(|d| d.0.re), Some(0.0), "{text}");
        assert_eq!(e.eval(&|_| Dual(DualVec::from_re(0.0))).map(|d: Dual<DualVec<f64, f64, _>>| d.0.re), Some(0.0));
        assert_eq!(e.eval(&|_| Dual(Dual2Vec::from_re(0.0))).map(|d: Dual<Dual2Vec<f64, f64, _>>| d.0.re), Some(0.0));
        // Only the first derivative is zero: not a constant.
        assert!(e.eval(&|_| Dual(Dual2::new(0.0, 0.0, 1.0))).is_none(), "{text}");
    }
}

#[test]
fn the_hyperbolic_tangent_keeps_its_digits_near_zero() {
    let e = Expr::parse("tanh(x)").unwrap();
    for x in [1e-12, -1e-9, 1e-6] {
        let d = e.eval(&|_| Dual(Dual64::new(x, 1.0))).unwrap().0;
        assert!((d.re / x - 1.0).abs() < 1e-11, "{x}: {}", d.re);
    }
}

#[test]
fn an_angle_of_long_numbers_has_a_value() {
    let ten = |k: usize| BigInt::from(10).pow(k);
    let angle = Exact::direction(ten(400) + 1, ten(399) * 3);
    assert!((angle.to_f64() - 0.3f64.atan()).abs() < 1e-12, "{}", angle.to_f64());
}

#[test]
fn a_program_says_how_large_it_is() {
    let mut g = Graph::default();
    let node = g.insert(&Expr::parse("x*y").unwrap());
    let program = Program::compile(&g, &["x".into(), "y".into(), "unused".into()], &[node]).unwrap();
    assert_eq!((program.inputs(), program.outputs(), program.len(), program.registers().len()), (3, 1, 3, 3));
    assert_eq!(program.run_in(&[2.0, 3.0, 5.0]), [6.0]);
    let nothing = Program::compile(&g, &[], &[]).unwrap();
    assert!(nothing.is_empty() && !program.is_empty());
}

#[test]
fn polynomials_are_equal_when_their_terms_are() {
    let of = |text: &str| Polynomial::of(&Expr::parse(text).unwrap());
    assert!(of("a + b") == of("b + a"));
    assert!(of("a*b + a*cos(c)") == of("a*(cos(c) + b)"));
    assert!(of("a + b") != of("a + c") && of("a + b") != of("a + 2*b"));
}

#[test]
fn a_logarithm_of_a_number_is_a_number_and_of_zero_of_any_unit_is_nothing() {
    let unit = |text: &str, of: Unit| Expr::parse(text).unwrap().eval(&|_| of).map(|u| u.to_string());
    let number = Unit::number_unit();
    for text in ["ln(x)", "cot(x)", "exp(x)", "cos(x)"] {
        assert_eq!(unit(text, number), Some("1".into()), "{text}");
        assert_eq!(unit(text, Unit::parse("m").unwrap()), None, "{text}");
    }
    assert_eq!((unit("ln(0)", number), unit("cot(0)", number), unit("cos(0)", number)), (None, None, Some("1".into())));
}

/// A function that is zero at zero keeps the zero that may stand for a length.
#[test]
fn functions_of_the_number_zero_are_zero_of_any_unit_or_a_number() {
    let unit = |text: &str| Expr::parse(text).unwrap().eval(&|_| Unit::parse("m").unwrap()).map(|u| u.to_string());
    for f in ["sin", "tan", "asin", "atan", "tanh", "abs", "sqrt"] {
        assert_eq!(unit(&format!("{f}(0) + x")), Some("m".into()), "{f}");
    }
    for f in ["cos", "exp", "acos", "sign"] {
        assert_eq!(unit(&format!("{f}(0) + x")), None, "{f}");
    }
}
