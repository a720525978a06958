//! Floating-point numbers as a carrier: the value of a formula.

use super::rational::{BigRational, nearest_f64};
use super::{Fun, Scalar};

/// NaN for anything that is not a finite number: overflow is undefined, not infinite.
#[inline]
pub(super) fn finite(x: f64) -> f64 {
    if x.is_finite() { x } else { f64::NAN }
}

/// Quotient with division by zero undefined; an infinite divisor has lost its value and is undefined too.
#[inline]
pub(super) fn quotient(a: f64, b: f64) -> f64 {
    if b.is_finite() { finite(a / b) } else { f64::NAN }
}

/// A function of the language on floating-point numbers.
#[inline]
pub(super) fn call(f: Fun, x: f64) -> f64 {
    if !x.is_finite() {
        return f64::NAN;
    }
    finite(match f {
        Fun::Sin => x.sin(),
        Fun::Cos => x.cos(),
        Fun::Tan => x.tan(),
        Fun::Cot => 1.0 / x.tan(),
        Fun::Asin => x.asin(),
        Fun::Acos => x.acos(),
        Fun::Atan => x.atan(),
        Fun::Tanh => x.tanh(),
        Fun::Exp => x.exp(),
        Fun::Ln => x.ln(),
        Fun::Sqrt => x.sqrt(),
        Fun::Abs => x.abs(),
        Fun::Sign if x == 0.0 => 0.0,
        Fun::Sign => x.signum(),
        Fun::Step if x.is_nan() => f64::NAN,
        Fun::Step => f64::from(u8::from(x > 0.0)),
    })
}

impl Scalar for f64 {
    fn number(value: &BigRational) -> Self {
        finite(nearest_f64(value))
    }
    fn add(&self, other: &Self) -> Self {
        finite(self + other)
    }
    fn neg(&self) -> Self {
        -self
    }
    fn mul(&self, other: &Self) -> Self {
        finite(self * other)
    }
    fn recip(&self) -> Self {
        quotient(1.0, *self)
    }
    fn sub(&self, other: &Self) -> Self {
        finite(self - other)
    }
    fn div(&self, other: &Self) -> Self {
        quotient(*self, *other)
    }
    fn powi(&self, n: i32) -> Self {
        // Not the negative power of the standard library, which is 0 where the positive one overflows.
        let power = if self.is_finite() { finite(f64::powi(*self, n.saturating_abs())) } else { f64::NAN };
        if n < 0 { quotient(1.0, power) } else { power }
    }
    fn call(f: Fun, x: &Self) -> Self {
        call(f, *x)
    }
    fn is_defined(&self) -> bool {
        self.is_finite()
    }
    fn equals(&self, other: &Self) -> bool {
        self.is_finite() && self == other
    }
}
