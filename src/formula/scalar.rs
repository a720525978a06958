//! The trait of carriers: number types in which a formula can be evaluated.

use super::{BigRational, Fun};

/// A carrier: a set of values in which a formula can be read.
///
/// Deliberately small: no order, no `Copy`, no `From<f64>`, so that exact numbers, unit exponents and
/// expressions fit. A value may be *undefined* (a division by zero, a logarithm of −1, metres added to
/// seconds, an overflow); every operation on an undefined value is undefined.
///
/// ```
/// use creepage::formula::{Expr, Scalar};
/// // One formula, two readings.
/// let e = Expr::parse("x^2 + 1").unwrap();
/// assert_eq!(e.eval(&|_| 3.0), Some(10.0));
/// let undefined = Expr::parse("1/x").unwrap().eval_undefined_as_value(&|_| 0.0);
/// assert!(!undefined.is_defined());
/// assert!(!undefined.equals(&undefined));
/// ```
pub trait Scalar: Clone {
    /// An exact number of the language.
    fn number(value: &BigRational) -> Self;
    /// Sum.
    fn add(&self, other: &Self) -> Self;
    /// Negative.
    fn neg(&self) -> Self;
    /// Product.
    fn mul(&self, other: &Self) -> Self;
    /// 1/x, undefined at zero.
    fn recip(&self) -> Self;
    /// A function of the language.
    fn call(f: Fun, x: &Self) -> Self;
    /// Whether this is a value at all.
    fn is_defined(&self) -> bool;
    /// Whether both are defined and the same value; undefined equals nothing.
    fn equals(&self, other: &Self) -> bool;

    /// Difference.
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }

    /// Quotient, undefined when the divisor is zero.
    fn div(&self, other: &Self) -> Self {
        self.mul(&other.recip())
    }

    /// Integer power; the zeroth power of a defined value is one.
    fn powi(&self, n: i32) -> Self {
        match n {
            0 => self.mul(&Self::number(&num_traits::Zero::zero())).add(&Self::one()),
            n if n < 0 => self.powi_positive(n.unsigned_abs()).recip(),
            n => self.powi_positive(n.unsigned_abs()),
        }
    }

    /// xⁿ for n ≥ 1 by repeated squaring.
    #[doc(hidden)]
    fn powi_positive(&self, n: u32) -> Self {
        if n == 1 {
            return self.clone();
        }
        let half = self.powi_positive(n / 2);
        let square = half.mul(&half);
        if n % 2 == 1 { square.mul(self) } else { square }
    }

    /// The number one.
    #[doc(hidden)]
    fn one() -> Self {
        Self::number(&num_traits::One::one())
    }
}
