//! Vectors of the plane in exact numbers.

use crate::formula::{Exact, Fun, Scalar};

/// Forward and left.
pub(crate) type Pair = [Exact; 2];

/// The unit vector at an angle; undefined unless its sine and cosine are rational.
pub(crate) fn toward(angle: &Exact) -> Pair {
    [Fun::Cos, Fun::Sin].map(|f| Exact::call(f, angle))
}

/// Turned left by a right angle.
pub(crate) fn left_of([x, y]: &Pair) -> Pair {
    [y.neg(), x.clone()]
}

pub(crate) fn plus(a: &Pair, b: &Pair) -> Pair {
    [a[0].add(&b[0]), a[1].add(&b[1])]
}

pub(crate) fn times(factor: &Exact, a: &Pair) -> Pair {
    [factor.mul(&a[0]), factor.mul(&a[1])]
}

pub(crate) fn dot(a: &Pair, b: &Pair) -> Exact {
    a[0].mul(&b[0]).add(&a[1].mul(&b[1]))
}

/// Whether a value is a number other than zero.
pub(crate) fn is_nonzero(v: &Exact) -> bool {
    v.as_rational().is_some_and(|v| !num_traits::Zero::is_zero(v))
}
