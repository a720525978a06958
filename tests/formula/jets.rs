//! The carrier of truncated power series: a ring, with functions that obey the chain rule.

use crate::support::{Outcome, check};
use creepage::formula::{BigRational, Exact, Expr, Fun, Jet, Layout, Scalar, Symbol};
use proptest::prelude::*;
use std::sync::Arc;

const ORDER: usize = 4;
const VARIABLES: [&str; 3] = ["x", "y", "phi"];

fn layout_of(order: usize) -> Arc<Layout> {
    Arc::new(Layout::new(VARIABLES.map(Symbol::from).to_vec(), order))
}

fn ratio(p: i64, q: i64) -> BigRational {
    BigRational::from_parts_signed(p.into(), q.into())
}

/// x, y and phi near a point, series cut above an order.
fn near(order: usize, point: &[Exact; 3]) -> impl Fn(&Symbol) -> Jet {
    let layout = layout_of(order);
    let point = point.clone();
    move |s: &Symbol| match VARIABLES.iter().position(|v| *v == s.as_str()) {
        Some(k) => Jet::variable(&layout, s, point[k].clone()),
        None => Jet::fixed(Exact::ratio(0, 0)),
    }
}

fn numbers() -> impl Strategy<Value = Exact> + Clone {
    prop_oneof![1 => Just(Exact::ratio(0, 1)), 5 => (-9i64..10, 1i64..7).prop_map(|(p, q)| Exact::ratio(p, q))]
}

fn angles() -> impl Strategy<Value = Exact> + Clone {
    prop_oneof![
        6 => (-7i64..8, 1i64..6).prop_map(|(p, q)| Exact::half_tangent(p, q)),
        1 => (1i64..5, -5i64..5).prop_map(|(x, y)| Exact::direction(x.into(), y.into())),
    ]
}

fn points() -> impl Strategy<Value = [Exact; 3]> + Clone {
    (numbers(), numbers(), angles()).prop_map(|(x, y, phi)| [x, y, phi])
}

/// Formulas of numbers, `n`, and of angles, `a`, nested up to `depth`.
fn formulas(depth: u32) -> (BoxedStrategy<String>, BoxedStrategy<String>) {
    let constants = (1u32..6).prop_map(|k| k.to_string());
    let leaf = prop_oneof![2 => Just("x".to_string()), 2 => Just("y".to_string()), 1 => constants].boxed();
    let angle = Just("phi".to_string()).boxed();
    (0..depth).fold((leaf, angle), |(n, a), _| {
        let two = (n.clone(), prop::sample::select(vec!['+', '-', '*', '/']), n.clone());
        let circular = prop::sample::select(vec!["sin", "cos", "tan", "cot"]);
        let number = prop_oneof![
            2 => n.clone(),
            5 => two.prop_map(|(l, op, r)| format!("({l}{op}{r})")),
            1 => (n.clone(), -2i32..4).prop_map(|(x, k)| format!("({x})^{k}")),
            1 => n.clone().prop_map(|x| format!("sqrt(({x})^2)")),
            1 => n.clone().prop_map(|x| format!("sqrt({x})")),
            3 => (circular, a.clone()).prop_map(|(f, x)| format!("{f}({x})")),
        ];
        let angle = prop_oneof![
            2 => a.clone(),
            2 => (a.clone(), a.clone()).prop_map(|(l, r)| format!("({l}+{r})")),
            1 => (a.clone(), a.clone()).prop_map(|(l, r)| format!("({l}-{r})")),
            1 => (a.clone(), -2i32..4).prop_map(|(x, k)| format!("({k}*({x}))")),
            2 => n.prop_map(|x| format!("atan({x})")),
            1 => a.prop_map(|x| format!("-({x})")),
        ];
        (number.boxed(), angle.boxed())
    })
}

fn parsed(texts: BoxedStrategy<String>) -> impl Strategy<Value = Expr> {
    texts.prop_map(|t| Expr::parse(&t).unwrap_or_else(|e| panic!("{t}: {e}")))
}

/// Series as formulas make them.
fn jets() -> impl Strategy<Value = Jet> {
    let value = |(e, at): (Expr, [Exact; 3])| e.eval(&near(ORDER, &at));
    (parsed(formulas(3).0), points()).prop_filter_map("undefined", value)
}

fn angle_jets() -> impl Strategy<Value = Jet> {
    let value = |(e, at): (Expr, [Exact; 3])| e.eval(&near(ORDER, &at));
    (parsed(formulas(2).1), points()).prop_filter_map("undefined", value)
}

fn same(law: &str, a: &Jet, b: &Jet) -> Outcome {
    prop_assert!(a.equals(b), "{}: {:?} and {:?}", law, a, b);
    Ok(())
}

/// As `same`, or the left side is undefined.
fn same_where_defined(law: &str, a: &Jet, b: &Jet) -> Outcome {
    if a.is_defined() { same(law, a, b) } else { Ok(()) }
}

#[test]
fn series_are_a_ring() {
    check(300, (jets(), jets(), jets()), |(a, b, c)| {
        let (zero, one) = (Jet::number(&ratio(0, 1)), Jet::number(&ratio(1, 1)));
        same("a + b = b + a", &a.add(&b), &b.add(&a))?;
        same("(a + b) + c = a + (b + c)", &a.add(&b).add(&c), &a.add(&b.add(&c)))?;
        same("a + 0 = a", &a.add(&zero), &a)?;
        same("a - a = 0", &a.sub(&a), &zero)?;
        same("ab = ba", &a.mul(&b), &b.mul(&a))?;
        same("(ab)c = a(bc)", &a.mul(&b).mul(&c), &a.mul(&b.mul(&c)))?;
        same("a(b + c) = ab + ac", &a.mul(&b.add(&c)), &a.mul(&b).add(&a.mul(&c)))?;
        same("1·a = a", &one.mul(&a), &a)?;
        same("a·0 = 0", &a.mul(&zero), &zero)?;
        same("a³ = a·a·a", &a.powi(3), &a.mul(&a).mul(&a))?;
        let inverse = a.recip();
        prop_assert_eq!(inverse.is_defined(), !a.constant().equals(&Exact::ratio(0, 1)));
        same_where_defined("a·(1/a) = 1", &a.mul(&inverse), &one)
    });
}

#[test]
fn functions_of_numbers_keep_their_identities() {
    check(300, jets(), |a| {
        let root = Jet::call(Fun::Sqrt, &a);
        same_where_defined("√a·√a = a", &root.mul(&root), &a)?;
        same_where_defined("√(a²)² = a²", &Jet::call(Fun::Sqrt, &a.mul(&a)).powi(2), &a.mul(&a))?;
        let arc = Jet::call(Fun::Atan, &a);
        same("tan atan a = a", &Jet::call(Fun::Tan, &arc), &a)?;
        same("atan(-a) = -atan a", &Jet::call(Fun::Atan, &a.neg()), &arc.neg())
    });
}

#[test]
fn functions_of_angles_keep_their_identities() {
    check(300, (angle_jets(), angle_jets()), |(a, b)| {
        let one = Jet::number(&ratio(1, 1));
        let [sin, cos, tan, cot] = [Fun::Sin, Fun::Cos, Fun::Tan, Fun::Cot].map(|f| Jet::call(f, &a));
        same_where_defined("sin² + cos² = 1", &sin.powi(2).add(&cos.powi(2)), &one)?;
        same_where_defined("tan = sin/cos", &sin.div(&cos), &tan)?;
        same_where_defined("cot = cos/sin", &cos.div(&sin), &cot)?;
        same_where_defined("tan·cot = 1", &tan.mul(&cot), &one)?;
        let [sin_b, cos_b] = [Fun::Sin, Fun::Cos].map(|f| Jet::call(f, &b));
        let sum = a.add(&b);
        let expanded = sin.mul(&cos_b).add(&cos.mul(&sin_b));
        same_where_defined("sin(a + b)", &expanded, &Jet::call(Fun::Sin, &sum))?;
        let expanded = cos.mul(&cos_b).sub(&sin.mul(&sin_b));
        same_where_defined("cos(a + b)", &expanded, &Jet::call(Fun::Cos, &sum))?;
        same("a + a = 2a", &a.add(&a), &Jet::number(&ratio(2, 1)).mul(&a))?;
        same("2a = a·2", &a.mul(&Jet::number(&ratio(2, 1))), &a.add(&a))
    });
}

/// All derivatives up to the order: exponents of x, y, phi with the factorials that turn coefficients into them.
fn derivatives(order: u32) -> Vec<([u32; 3], i64)> {
    let factorial = |n: u32| (1..=i64::from(n)).product::<i64>();
    let all = (0..=order).flat_map(move |i| (0..=order - i).map(move |j| (i, j)));
    let all = all.flat_map(move |(i, j)| (0..=order - i - j).map(move |k| [i, j, k]));
    all.map(|p| (p, p.iter().map(|n| factorial(*n)).product())).collect()
}

fn derivative(e: &Expr, powers: [u32; 3]) -> Expr {
    let steps = VARIABLES.iter().zip(powers).flat_map(|(v, n)| (0..n).map(move |_| Symbol::from(*v)));
    steps.fold(e.clone(), |d, v| d.derivative(&v))
}

#[test]
fn coefficients_are_the_derivatives_of_the_formula() {
    let compared = std::cell::Cell::new(0);
    check(400, (parsed(formulas(3).0), points()), |(e, at)| {
        let exact =
            |s: &Symbol| VARIABLES.iter().position(|v| *v == s.as_str()).map_or(Exact::ratio(0, 0), |k| at[k].clone());
        let (value, jet) = (e.eval(&exact), e.eval(&near(3, &at)));
        let Some(jet) = jet else { return Ok(()) };
        prop_assert!(value.is_some_and(|v| v.equals(jet.constant())), "{}", e);
        for (powers, factor) in derivatives(3).into_iter().skip(1) {
            let Some(expected) = derivative(&e, powers).eval(&exact) else { continue };
            let found = jet.coefficient(&powers) * ratio(factor, 1);
            prop_assert!(
                expected.equals(&Exact::rational(found.clone())),
                "{} {:?}: {} {}",
                e,
                powers,
                expected,
                found
            );
            compared.set(compared.get() + usize::from(!found.is_zero()));
        }
        Ok(())
    });
    assert!(compared.get() > 500, "{}", compared.get());
}

#[test]
fn a_formula_is_defined_as_a_series_where_its_derivatives_are() {
    check(400, (parsed(formulas(3).0), points()), |(e, at)| {
        let exact =
            |s: &Symbol| VARIABLES.iter().position(|v| *v == s.as_str()).map_or(Exact::ratio(0, 0), |k| at[k].clone());
        let all = || VARIABLES.iter().map(|v| e.derivative(&Symbol::from(*v)));
        let smooth = e.eval(&exact).is_some() && all().all(|d| d.eval(&exact).is_some());
        prop_assert!(!smooth || e.eval(&near(2, &at)).is_some(), "{}", e);
        Ok(())
    });
}

#[test]
fn a_lower_order_is_the_front_part() {
    check(200, (parsed(formulas(3).0), points()), |(e, at)| {
        let (Some(long), Some(short)) = (e.eval(&near(4, &at)), e.eval(&near(2, &at))) else { return Ok(()) };
        let cut: Vec<_> = long.terms().iter().filter(|(m, _)| **m < layout_of(4).count(2)).collect();
        prop_assert_eq!(cut, short.terms().iter().collect::<Vec<_>>(), "{}", e);
        Ok(())
    });
}

#[test]
fn monomials_are_counted_and_multiplied() {
    let layout = layout_of(4);
    // Binomial coefficients (degree + 3 over 3).
    assert_eq!([0, 1, 2, 3, 4].map(|d| layout.count(d)), [1, 4, 10, 20, 35]);
    assert_eq!((layout.count(9), layout.order(), layout.variables().len()), (35, 4, 3));
    for i in 0..35 {
        assert_eq!(layout.monomial(layout.powers(i)), Some(i));
        assert_eq!(layout.products(i).len(), layout.count(4 - layout.degree(i)));
        for (j, place) in layout.products(i).iter().enumerate() {
            let sum: Vec<u32> = layout.powers(i).iter().zip(layout.powers(j)).map(|(a, b)| a + b).collect();
            assert_eq!(layout.powers(*place), sum);
        }
        for v in 0..3 {
            let slope = layout.derivative(v, i);
            assert_eq!(slope.map(|s| s.0), Some(layout.powers(i)[v]).filter(|k| *k > 0));
            assert!(
                slope.is_none_or(|(k, m)| layout.powers(m)[v] + 1 == k && layout.degree(m) + 1 == layout.degree(i))
            );
        }
    }
}

#[test]
fn undefined_is_contagious() {
    let bad = Jet::fixed(Exact::ratio(1, 0));
    let other = Jet::variable(&Arc::new(Layout::new(vec!["z".into()], 2)), &"z".into(), Exact::ratio(1, 2));
    check(100, (jets(), angle_jets()), |(a, angle)| {
        for u in [&bad, &a.add(&bad), &bad.mul(&a), &Jet::number(&ratio(0, 1)).recip()] {
            let results = [a.add(u), u.add(&a), a.mul(u), u.mul(&a), u.neg(), u.recip(), u.powi(0), u.sub(u)];
            prop_assert!(results.iter().all(|r| !r.is_defined() && !r.equals(r) && r.terms().is_empty()));
            prop_assert!(Fun::all().all(|f| !Jet::call(f, u).is_defined()));
        }
        // A third of an angle is not known, an angle times a variable neither.
        let variable = Jet::variable(&layout_of(ORDER), &"x".into(), Exact::ratio(1, 2));
        prop_assert!(angle.constant().as_rational().is_some() || !angle.mul(&variable).is_defined());
        prop_assert!(angle.constant().as_rational().is_some() || !angle.mul(&Jet::number(&ratio(1, 3))).is_defined());
        // Series of different layouts do not mix.
        let mixed = [a.add(&other), a.mul(&other), other.mul(&a)];
        prop_assert!(a.terms().is_empty() || mixed.iter().all(|m| !m.is_defined()));
        prop_assert!(!a.equals(&other) && other.equals(&other));
        Ok(())
    });
}

#[test]
fn equal_means_every_coefficient() {
    let layout = layout_of(2);
    let [x, y] = ["x", "y"].map(|v| Jet::variable(&layout, &v.into(), Exact::ratio(1, 2)));
    assert!(x.equals(&x) && !x.equals(&y) && !x.equals(&x.add(&x.mul(&x)).sub(&Jet::number(&ratio(1, 4)))));
}

#[test]
fn functions_without_a_series_take_constants_only() {
    let x = Jet::variable(&layout_of(2), &"x".into(), Exact::ratio(1, 1));
    let one = Jet::number(&ratio(1, 1));
    for f in [Fun::Abs, Fun::Sign, Fun::Ln, Fun::Asin, Fun::Acos] {
        assert!(!Jet::call(f, &x).is_defined(), "{f:?}");
        assert!(Jet::call(f, &one).constant().equals(&Exact::call(f, &Exact::ratio(1, 1))), "{f:?}");
        assert!(Jet::call(f, &one).is_defined(), "{f:?}");
    }
    assert!(Jet::variable(&layout_of(2), &"z".into(), Exact::ratio(1, 1)).equals(&one));
}
