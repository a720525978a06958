//! The laws of a carrier.

use super::{Outcome, check};
use creepage::formula::{BigRational, Fun, Scalar};
use proptest::prelude::*;
use std::fmt::Debug;

pub fn number<S: Scalar>(n: i64) -> S {
    S::number(&BigRational::from(n))
}

/// A carrier as the laws see it.
pub struct Carrier<'a, S> {
    /// Two values are the same as far as rounding can tell.
    pub same: &'a dyn Fn(&S, &S) -> bool,
    /// Undefined values, however they came about.
    pub undefined: Vec<S>,
    /// Whether one side of a law may be undefined where the other is not.
    pub partial: bool,
}

impl<S: Scalar + Debug> Carrier<'_, S> {
    /// Both sides are defined and the same, or neither is defined.
    pub fn equal(&self, law: &str, a: &S, b: &S) -> Outcome {
        if self.partial {
            return self.equal_where_defined(law, a, b);
        }
        prop_assert_eq!(a.is_defined(), b.is_defined(), "{}: {:?} and {:?}", law, a, b);
        self.equal_where_defined(law, a, b)
    }

    pub fn equal_where_defined(&self, law: &str, a: &S, b: &S) -> Outcome {
        let both = a.is_defined() && b.is_defined();
        prop_assert!(!both || (self.same)(a, b), "{}: {:?} and {:?}", law, a, b);
        Ok(())
    }

    pub fn sums(&self, a: &S, b: &S, c: &S) -> Outcome {
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

    pub fn products(&self, a: &S, b: &S, c: &S) -> Outcome {
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

    pub fn powers(&self, a: &S) -> Outcome {
        let mut product = number::<S>(1);
        for n in 0..=5 {
            self.equal("aⁿ = a·a…", &a.powi(n), &product)?;
            self.equal("a⁻ⁿ = 1/aⁿ", &a.powi(-n), &product.recip())?;
            product = product.mul(a);
        }
        self.equal("a¹ = a", &a.powi(1), a)
    }

    pub fn functions(&self, a: &S) -> Outcome {
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

    pub fn undefined_is_contagious(&self, a: &S) -> Outcome {
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

    pub fn equality(&self, a: &S, b: &S) -> Outcome {
        prop_assert!(a.is_defined() && a.equals(a), "{:?}", a);
        prop_assert_eq!(a.equals(b), b.equals(a));
        prop_assert!(!a.equals(b) || (self.same)(a, b), "{:?} and {:?}", a, b);
        Ok(())
    }
}

#[track_caller]
pub fn laws<S: Scalar + Debug>(
    values: impl Strategy<Value = S> + Clone,
    same: impl Fn(&S, &S) -> bool,
    undefined: impl IntoIterator<Item = S>,
) {
    let carrier = Carrier { same: &same, undefined: undefined.into_iter().collect(), partial: false };
    check(800, (values.clone(), values.clone(), values), |(a, b, c)| {
        carrier.equality(&a, &b)?;
        carrier.sums(&a, &b, &c)?;
        carrier.products(&a, &b, &c)?;
        carrier.powers(&a)?;
        carrier.functions(&a)?;
        carrier.undefined_is_contagious(&a)
    });
}

/// An overflow is undefined, and nothing brings it back.
pub fn overflow_is_undefined<S: Scalar + Debug>() {
    let big = S::number(&BigRational::from(10).pow(200));
    let huge = S::number(&BigRational::from(10).pow(400));
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
