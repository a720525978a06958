//! Forward differentiation: a value with its derivative as a carrier (dual numbers over normal forms or numbers).

use super::carrier::Carrier;
use super::values::int;
use crate::formula::{BigRational, Fun, Normal, Scalar};
use num_traits::Zero;

/// f + f′·ε with ε² = 0: exact derivatives of formulas as formulas.
#[derive(Clone, Debug)]
pub struct Tangent<S = Normal> {
    /// f
    pub value: S,
    /// f′
    pub slope: S,
}

impl<S: Carrier> Tangent<S> {
    /// What does not depend on the parameter.
    pub fn constant(value: S) -> Self {
        Self { value, slope: int(0) }
    }

    /// The parameter itself, at zero.
    pub fn parameter() -> Self {
        Self { value: int(0), slope: int(1) }
    }

    fn times(&self, factor: &S) -> S {
        self.slope.mul(factor)
    }
}

impl<S: Carrier> Scalar for Tangent<S> {
    fn number(value: &BigRational) -> Self {
        Self::constant(S::number(value))
    }

    fn add(&self, other: &Self) -> Self {
        Self { value: self.value.add(&other.value), slope: self.slope.add(&other.slope) }
    }

    fn neg(&self) -> Self {
        Self { value: self.value.neg(), slope: self.slope.neg() }
    }

    fn mul(&self, other: &Self) -> Self {
        let slope = self.times(&other.value).add(&other.times(&self.value));
        Self { value: self.value.mul(&other.value), slope }
    }

    fn recip(&self) -> Self {
        self.powi(-1)
    }

    fn powi(&self, n: i32) -> Self {
        let slope = match n {
            0 => int(0),
            n => self.times(&self.value.powi(n - 1)).mul(&int(i64::from(n))),
        };
        Self { value: self.value.powi(n), slope }
    }

    fn call(f: Fun, x: &Self) -> Self {
        let value = S::call(f, &x.value);
        let square = |v: &S| int::<S>(1).add(&v.mul(v));
        let outer = match f {
            // What does not vary needs no derivative.
            _ if x.slope.is_exactly_zero() => int(0),
            Fun::Sin => S::call(Fun::Cos, &x.value),
            Fun::Cos => S::call(Fun::Sin, &x.value).neg(),
            Fun::Tan => square(&value),
            Fun::Cot => square(&value).neg(),
            Fun::Atan => square(&x.value).recip(),
            _ => S::number(&BigRational::zero()).recip(),
        };
        Self { value, slope: x.times(&outer) }
    }

    fn is_defined(&self) -> bool {
        self.value.is_defined() && self.slope.is_defined()
    }

    fn equals(&self, other: &Self) -> bool {
        self.value.equals(&other.value) && self.slope.equals(&other.slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_are_both_value_and_slope() {
        let (p, two) = (Tangent::<Normal>::parameter(), Tangent::constant(int(2)));
        assert!(p.add(&two).equals(&two.add(&p)));
        assert!(!p.add(&two).equals(&two) && !p.equals(&p.add(&p)) && !two.equals(&two.add(&two)));
    }
}
