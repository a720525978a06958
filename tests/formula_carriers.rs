//! The laws of a carrier, written once and run over every carrier.

mod support;

use creepage::formula::{Dual, Expr, Fun, Scalar, Unit};
use nalgebra::{DMatrix, DVector, RowDVector};
use num_bigint::BigInt;
use num_dual::{Derivative, Dual2_64, Dual2DVec64, Dual64, DualDVec64, HyperDual64};
use num_rational::BigRational;
use proptest::prelude::*;
use std::fmt::Debug;
use support::{Outcome, check, modest, nonzero};

fn number<S: Scalar>(n: i64) -> S {
    S::number(&BigRational::from_integer(BigInt::from(n)))
}

/// A carrier as the laws see it.
struct Carrier<'a, S> {
    /// Two values are the same as far as rounding can tell.
    same: &'a dyn Fn(&S, &S) -> bool,
    /// Undefined values, however they came about.
    undefined: Vec<S>,
}

impl<S: Scalar + Debug> Carrier<'_, S> {
    /// Both sides are defined and the same, or neither is defined.
    fn equal(&self, law: &str, a: &S, b: &S) -> Outcome {
        prop_assert_eq!(a.is_defined(), b.is_defined(), "{}: {:?} and {:?}", law, a, b);
        self.equal_where_defined(law, a, b)
    }

    fn equal_where_defined(&self, law: &str, a: &S, b: &S) -> Outcome {
        let both = a.is_defined() && b.is_defined();
        prop_assert!(!both || (self.same)(a, b), "{}: {:?} and {:?}", law, a, b);
        Ok(())
    }

    fn sums(&self, a: &S, b: &S, c: &S) -> Outcome {
        let zero = number::<S>(0);
        self.equal("a + b = b + a", &a.add(b), &b.add(a))?;
        self.equal("(a + b) + c = a + (b + c)", &a.add(b).add(c), &a.add(&b.add(c)))?;
        self.equal("a + 0 = a", &a.add(&zero), a)?;
        self.equal("0 + a = a", &zero.add(a), a)?;
        self.equal("a - b = a + (-b)", &a.sub(b), &a.add(&b.neg()))?;
        self.equal("-(-a) = a", &a.neg().neg(), a)?;
        self.equal("a - a = 0", &a.sub(a), &zero)?;
        self.equal("-(a + b) = -a - b", &a.add(b).neg(), &a.neg().sub(b))
    }

    fn products(&self, a: &S, b: &S, c: &S) -> Outcome {
        let (zero, one) = (number::<S>(0), number::<S>(1));
        self.equal("ab = ba", &a.mul(b), &b.mul(a))?;
        self.equal("(ab)c = a(bc)", &a.mul(b).mul(c), &a.mul(&b.mul(c)))?;
        self.equal("a·1 = a", &a.mul(&one), a)?;
        self.equal("a·0 = 0", &a.mul(&zero), &zero)?;
        self.equal("(-a)b = -(ab)", &a.neg().mul(b), &a.mul(b).neg())?;
        self.equal("a/b = a·(1/b)", &a.div(b), &a.mul(&b.recip()))?;
        self.equal("a/1 = a", &a.div(&one), a)?;
        let inverse = a.recip();
        if inverse.is_defined() {
            self.equal("a·(1/a) = 1", &a.mul(&inverse), &one)?;
            self.equal("1/(1/a) = a", &inverse.recip(), a)?;
        }
        if a.add(b).is_defined() {
            self.equal("(a + b)c = ac + bc", &a.add(b).mul(c), &a.mul(c).add(&b.mul(c)))?;
        }
        Ok(())
    }

    fn powers(&self, a: &S) -> Outcome {
        let mut product = number::<S>(1);
        for n in 0..=5 {
            self.equal("aⁿ = a·a…", &a.powi(n), &product)?;
            self.equal("a⁻ⁿ = 1/aⁿ", &a.powi(-n), &product.recip())?;
            product = product.mul(a);
        }
        self.equal("a¹ = a", &a.powi(1), a)
    }

    fn functions(&self, a: &S) -> Outcome {
        let one = number::<S>(1);
        let call = |f: Fun| S::call(f, a);
        let inner = |f: Fun, g: Fun| S::call(f, &call(g));
        let square = |x: S| x.mul(&x);
        let odd = [Fun::Sin, Fun::Tan, Fun::Cot, Fun::Asin, Fun::Atan, Fun::Tanh, Fun::Sign];
        for f in odd {
            self.equal("f(-a) = -f(a)", &S::call(f, &a.neg()), &call(f).neg())?;
        }
        for f in [Fun::Cos, Fun::Abs] {
            self.equal("f(-a) = f(a)", &S::call(f, &a.neg()), &call(f))?;
        }
        self.equal_where_defined("sin² + cos² = 1", &square(call(Fun::Sin)).add(&square(call(Fun::Cos))), &one)?;
        self.equal_where_defined("tan = sin/cos", &call(Fun::Tan), &call(Fun::Sin).div(&call(Fun::Cos)))?;
        self.equal_where_defined("cot = cos/sin", &call(Fun::Cot), &call(Fun::Cos).div(&call(Fun::Sin)))?;
        for (f, g) in [
            (Fun::Sin, Fun::Asin),
            (Fun::Cos, Fun::Acos),
            (Fun::Tan, Fun::Atan),
            (Fun::Exp, Fun::Ln),
            (Fun::Ln, Fun::Exp),
        ] {
            self.equal_where_defined("f(f⁻¹(a)) = a", &inner(f, g), a)?;
        }
        self.equal_where_defined("√a·√a = a", &square(call(Fun::Sqrt)), a)?;
        self.equal_where_defined("√(a²) = |a|", &S::call(Fun::Sqrt, &a.mul(a)), &call(Fun::Abs))?;
        self.equal_where_defined("|a| = a·sgn a", &call(Fun::Abs), &a.mul(&call(Fun::Sign)))?;
        let (up, down) = (call(Fun::Exp), S::call(Fun::Exp, &a.neg()));
        self.equal_where_defined("e⁻ᵃ = 1/eᵃ", &down, &up.recip())?;
        self.equal_where_defined("tanh", &call(Fun::Tanh), &up.sub(&down).div(&up.add(&down)))
    }

    fn undefined_is_contagious(&self, a: &S) -> Outcome {
        let by_zero = number::<S>(0).recip();
        for u in self.undefined.iter().chain([&by_zero]) {
            let zero = number::<S>(0);
            let mut results = vec![u.clone(), u.neg(), u.recip()];
            for x in [a, &zero, u] {
                results.extend([u.add(x), x.add(u), u.sub(x), x.sub(u), u.mul(x), x.mul(u), u.div(x), x.div(u)]);
            }
            results.extend((-3..=3).map(|n| u.powi(n)));
            results.extend(Fun::all().map(|f| S::call(f, u)));
            for (i, r) in results.iter().enumerate() {
                prop_assert!(!r.is_defined(), "operation {} on {:?} gives {:?}", i, u, r);
                prop_assert!(!r.equals(r) && !r.equals(a) && !a.equals(r), "{:?}", r);
            }
        }
        Ok(())
    }

    fn equality(&self, a: &S, b: &S) -> Outcome {
        prop_assert!(a.is_defined() && a.equals(a), "{:?}", a);
        prop_assert_eq!(a.equals(b), b.equals(a));
        prop_assert!(!a.equals(b) || (self.same)(a, b), "{:?} and {:?}", a, b);
        Ok(())
    }
}

fn laws<S: Scalar + Debug>(
    values: impl Strategy<Value = S> + Clone,
    same: impl Fn(&S, &S) -> bool,
    undefined: impl IntoIterator<Item = S>,
) {
    let carrier = Carrier { same: &same, undefined: undefined.into_iter().collect() };
    check(800, (values.clone(), values.clone(), values), |(a, b, c)| {
        carrier.equality(&a, &b)?;
        carrier.sums(&a, &b, &c)?;
        carrier.products(&a, &b, &c)?;
        carrier.powers(&a)?;
        carrier.functions(&a)?;
        carrier.undefined_is_contagious(&a)
    });
}

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

/// An overflow is undefined, and nothing brings it back.
fn overflow_is_undefined<S: Scalar + Debug>() {
    let big = S::number(&num_traits::pow(BigRational::from_integer(10.into()), 200));
    let huge = S::number(&num_traits::pow(BigRational::from_integer(10.into()), 400));
    let fine = |x: &S| x.is_defined() && x.equals(x);
    assert!(fine(&big) && fine(&big.neg()) && fine(&big.recip()));
    let lost = [
        huge,
        big.mul(&big),
        big.neg().mul(&big),
        big.powi(2),
        big.powi(-2),
        S::call(Fun::Exp, &number(1000)),
        big.mul(&big).recip(),
        big.mul(&big).powi(0),
        big.mul(&big).sub(&big.mul(&big)),
        S::call(Fun::Sign, &big.mul(&big)),
        S::call(Fun::Atan, &big.mul(&big)),
        S::call(Fun::Tanh, &S::call(Fun::Exp, &number(1000))),
    ];
    for (i, x) in lost.iter().enumerate() {
        assert!(!x.is_defined() && !x.equals(x), "{i}: {x:?}");
    }
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
