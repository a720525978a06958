//! The laws of a carrier, written once and run over every carrier.

use crate::support::laws::{Carrier, laws, number, overflow_is_undefined};
use crate::support::{check, modest, nonzero};
use creepage::formula::{BigRational, Dual, Exact, Expr, Normal, Scalar, Unit};
use nalgebra::{DMatrix, DVector, RowDVector};
use num_dual::{Derivative, Dual2_64, Dual2DVec64, Dual64, DualDVec64, HyperDual64};
use proptest::prelude::*;

/// A carrier that lies over floating point: all its numbers in a row.
trait Row {
    fn row(&self) -> Vec<f64>;
}

/// The same to nine digits of the largest number in the row.
fn close<S: Row>(a: &S, b: &S) -> bool {
    let (a, b) = (a.row(), b.row());
    let size = a.iter().chain(&b).fold(1.0, |m: f64, x| m.max(x.abs()));
    a.len() == b.len() && a.iter().zip(&b).all(|(x, y)| (x - y).abs() <= 1e-9 * size)
}

impl Row for f64 {
    fn row(&self) -> Vec<f64> {
        vec![*self]
    }
}

#[test]
fn floating_point_keeps_the_laws() {
    laws(prop_oneof![Just(0.0), nonzero()], close, [f64::NAN, f64::INFINITY, f64::NEG_INFINITY]);
    overflow_is_undefined::<f64>();
    let undefined: [f64; 4] =
        [Scalar::mul(&1e200, &1e200), Scalar::add(&1e308, &1e308), Scalar::powi(&1e200, 2), Scalar::recip(&0.0)];
    assert!(undefined.iter().all(|x| x.is_nan()), "{undefined:?}");
}

impl Row for Dual<Dual64> {
    fn row(&self) -> Vec<f64> {
        vec![self.0.re, self.0.eps]
    }
}

#[test]
fn dual_numbers_keep_the_laws() {
    let values = (nonzero(), modest()).prop_map(|(re, eps)| Dual(Dual64::new(re, eps)));
    let parts = [(f64::INFINITY, 0.0), (1.0, f64::NAN), (1.0, f64::INFINITY), (f64::NAN, 0.0)];
    laws(values, close, parts.map(|(re, eps)| Dual(Dual64::new(re, eps))));
    overflow_is_undefined::<Dual<Dual64>>();
}

impl Row for Dual<Dual2_64> {
    fn row(&self) -> Vec<f64> {
        vec![self.0.re, self.0.v1, self.0.v2]
    }
}

#[test]
fn dual_numbers_of_second_order_keep_the_laws() {
    let values = (nonzero(), modest(), modest()).prop_map(|(re, a, b)| Dual(Dual2_64::new(re, a, b)));
    let parts = [(f64::INFINITY, 0.0, 0.0), (1.0, f64::NAN, 0.0), (1.0, 0.0, f64::INFINITY)];
    laws(values, close, parts.map(|(re, a, b)| Dual(Dual2_64::new(re, a, b))));
    overflow_is_undefined::<Dual<Dual2_64>>();
}

impl Row for Dual<HyperDual64> {
    fn row(&self) -> Vec<f64> {
        vec![self.0.re, self.0.eps1, self.0.eps2, self.0.eps1eps2]
    }
}

#[test]
fn hyper_dual_numbers_keep_the_laws() {
    let values =
        (nonzero(), modest(), modest(), modest()).prop_map(|(re, a, b, ab)| Dual(HyperDual64::new(re, a, b, ab)));
    let parts = [(f64::NAN, 0.0, 0.0, 0.0), (1.0, 0.0, f64::NAN, 0.0), (1.0, 0.0, 0.0, f64::INFINITY)];
    laws(values, close, parts.map(|(re, a, b, ab)| Dual(HyperDual64::new(re, a, b, ab))));
    overflow_is_undefined::<Dual<HyperDual64>>();
}

/// The length of the vectors below; an absent derivative is a zero one.
const N: usize = 3;

impl Row for Dual<DualDVec64> {
    fn row(&self) -> Vec<f64> {
        let eps = self.0.eps.clone().unwrap_generic(nalgebra::Dyn(N), nalgebra::U1);
        [self.0.re].into_iter().chain(eps.iter().copied()).collect()
    }
}

fn dual_vec(re: f64, eps: Option<[f64; N]>) -> Dual<DualDVec64> {
    Dual(DualDVec64::new(re, Derivative::new(eps.map(|v| DVector::from_row_slice(&v)))))
}

#[test]
fn dual_vectors_keep_the_laws_with_and_without_a_derivative() {
    let slope = prop::option::of(prop::array::uniform3(modest()));
    let values = (nonzero(), slope).prop_map(|(re, eps)| dual_vec(re, eps));
    laws(values, close, [dual_vec(f64::INFINITY, None), dual_vec(1.0, Some([0.0, f64::NAN, 0.0]))]);
    overflow_is_undefined::<Dual<DualDVec64>>();
    assert!(dual_vec(1.0, None).equals(&dual_vec(1.0, Some([0.0; N]))));
    assert!(!dual_vec(1.0, None).equals(&dual_vec(1.0, Some([0.0, 1.0, 0.0]))));
}

impl Row for Dual<Dual2DVec64> {
    fn row(&self) -> Vec<f64> {
        let v1 = self.0.v1.clone().unwrap_generic(nalgebra::U1, nalgebra::Dyn(N));
        let v2 = self.0.v2.clone().unwrap_generic(nalgebra::Dyn(N), nalgebra::Dyn(N));
        [self.0.re].into_iter().chain(v1.iter().copied()).chain(v2.iter().copied()).collect()
    }
}

fn dual2_vec(re: f64, v1: Option<[f64; N]>, v2: Option<[f64; N * N]>) -> Dual<Dual2DVec64> {
    let v1 = Derivative::new(v1.map(|v| RowDVector::from_row_slice(&v)));
    let v2 = Derivative::new(v2.map(|v| DMatrix::from_row_slice(N, N, &v)));
    Dual(Dual2DVec64::new(re, v1, v2))
}

#[test]
fn dual_vectors_of_second_order_keep_the_laws_with_and_without_derivatives() {
    let v1 = prop::option::of(prop::array::uniform3(modest()));
    let v2 = prop::option::of(prop::array::uniform9(modest()));
    let values = (nonzero(), v1, v2).prop_map(|(re, v1, v2)| dual2_vec(re, v1, v2));
    laws(values, close, [dual2_vec(f64::NAN, None, None), dual2_vec(1.0, None, Some([f64::INFINITY; N * N]))]);
    overflow_is_undefined::<Dual<Dual2DVec64>>();
    assert!(dual2_vec(1.0, None, None).equals(&dual2_vec(1.0, Some([0.0; N]), Some([0.0; N * N]))));
    assert!(!dual2_vec(1.0, None, None).equals(&dual2_vec(1.0, None, Some([1.0; N * N]))));
}

#[test]
fn units_keep_the_laws() {
    let same = |a: &Unit, b: &Unit| a.equals(b) || a.fits(b) || b.fits(a);
    let lengths = prop_oneof![Just("m"), Just("m/s"), Just("1"), Just("kg*m^2/s^2"), Just("1/s")];
    let units = lengths.prop_map(|u| Unit::parse(u).unwrap());
    let values = prop_oneof![4 => units.boxed(), 1 => Just(number::<Unit>(0)).boxed()];
    let metre_and_second = Unit::parse("m").unwrap().add(&Unit::parse("s").unwrap());
    laws(values, same, [metre_and_second]);
}

#[test]
fn expressions_keep_the_laws_as_values() {
    let value = |e: &Expr| e.eval(&|s| if s.as_str() == "x" { 0.7 } else { -1.3 });
    let same = |a: &Expr, b: &Expr| match (value(a), value(b)) {
        (Some(a), Some(b)) => close(&a, &b),
        _ => true, // outside the domain of a function at this point
    };
    let texts = ["x", "y", "0", "1", "-1", "2.5", "1/3", "-x", "x*y", "x - y", "x/y", "y^2"];
    let values = prop::sample::select(texts.map(|t| Expr::parse(t).unwrap()).to_vec());
    let undefined = ["1/0", "x + 1/0", "sin(0^-1)"].map(|t| Expr::parse(t).unwrap());
    laws(values, same, undefined);
}

#[test]
fn expressions_are_compared_by_their_form() {
    let parse = |t: &str| Expr::parse(t).unwrap();
    assert!(parse("a + b").equals(&parse("(a) + b")));
    assert!(!parse("a + b").equals(&parse("b + a")));
}

/// Powers of ten far beyond floating point come and go without a trace.
fn nothing_overflows<S: Scalar>() {
    let power = |n: usize| S::number(&num_traits::pow(BigRational::from(10), n));
    assert!(power(400).powi(2).equals(&power(800)) && power(200).powi(2).equals(&power(400)));
    assert!(power(400).add(&number(1)).sub(&power(400)).equals(&number(1)));
    assert!(power(400).powi(-1).mul(&power(401)).equals(&number(10)));
}

/// p/q
fn ratios() -> impl Strategy<Value = Exact> + Clone {
    (-5i64..6, 1i64..5).prop_map(|(p, q)| Exact::ratio(p, q))
}

/// Angles within and beyond a turn, with rational sine and without.
fn angles() -> impl Strategy<Value = Exact> + Clone {
    let once = prop_oneof![
        4 => (-4i64..5, 1i64..4).prop_map(|(p, q)| Exact::half_tangent(p, q)),
        2 => (-3i64..4, 1i64..4).prop_map(|(x, y)| Exact::direction(x.into(), y.into())),
        1 => Just(Exact::half_tangent(1, 0)),
    ];
    (once, -3i64..4).prop_map(|(angle, n)| angle.mul(&number(n)))
}

fn not_exact() -> Vec<Exact> {
    vec![Exact::ratio(1, 0), Exact::direction(0.into(), 0.into()), Exact::ratio(1, 1).add(&Exact::half_tangent(1, 2))]
}

#[test]
fn exact_numbers_keep_the_laws() {
    laws(ratios(), Exact::equals, not_exact());
    nothing_overflows::<Exact>();
}

#[test]
fn exact_angles_keep_the_laws_of_sums_and_functions_and_where_products_exist_those_of_products() {
    let carrier = |partial| Carrier { same: &Exact::equals, undefined: not_exact(), partial };
    let (whole, partial) = (carrier(false), carrier(true));
    check(800, (angles(), angles(), angles()), |(a, b, c)| {
        whole.equality(&a, &b)?;
        whole.sums(&a, &b, &c)?;
        partial.products(&a, &b, &c)?;
        whole.powers(&a)?;
        whole.functions(&a)?;
        whole.undefined_is_contagious(&a)
    });
    check(800, (ratios(), angles(), ratios()), |(a, b, c)| {
        partial.sums(&a, &b, &c)?;
        partial.products(&a, &b, &c)
    });
}

#[test]
fn exact_angles_are_multiplied_by_whole_numbers() {
    let carrier = Carrier { same: &Exact::equals, undefined: vec![], partial: false };
    check(800, (-9i64..10, -9i64..10, angles(), angles()), |(n, m, a, b)| {
        let (k, l) = (number::<Exact>(n), number::<Exact>(m));
        carrier.equal("(n + m)a = na + ma", &number::<Exact>(n + m).mul(&a), &k.mul(&a).add(&l.mul(&a)))?;
        carrier.equal("n(a + b) = na + nb", &k.mul(&a.add(&b)), &k.mul(&a).add(&k.mul(&b)))?;
        carrier.equal("(nm)a = n(ma)", &number::<Exact>(n * m).mul(&a), &k.mul(&l.mul(&a)))?;
        let (found, expected) = (k.mul(&a).to_f64(), n as f64 * a.to_f64());
        prop_assert!((found - expected).abs() < 1e-12 * (1.0 + expected.abs()), "{} and {}", found, expected);
        Ok(())
    });
}

#[test]
fn normal_forms_keep_the_laws() {
    let texts = [
        "0",
        "1",
        "-2",
        "1/3",
        "0.75",
        "x",
        "y",
        "x - y",
        "x/y",
        "1/(x + y)",
        "(x^2 - y^2)/(2*x)",
        "sin(x)",
        "cos(x)",
        "-cos(x)^2",
        "1 - cos(x)",
        "tan(x)",
        "cot(x - 2*y)",
        "sin(x)/(1 + y)",
        "cos(x + y)",
        "tan(x + atan(y))",
        "atan(y)",
        "atan(3/4)",
        "-atan(y/x)",
        "x + atan(3/4)",
        "2*atan(1)",
        "4",
        "9/4",
    ];
    let values = prop::sample::select(texts.map(|t| Normal::of(&Expr::parse(t).unwrap())).to_vec());
    let undefined = ["1/(x - x)", "sin(x/2)", "sqrt(x)", "sin(1)", "tan(2*atan(1) + atan(0))", "cot(y - y)"];
    laws(values, Normal::equals, undefined.map(|t| Normal::of(&Expr::parse(t).unwrap())));
    nothing_overflows::<Normal>();
}
