//! Vectors of exact numbers.

use crate::formula::{Exact, Fun, Scalar};

/// Forward and left.
pub(super) type Pair = [Exact; 2];

/// The unit vector at an angle; undefined unless its sine and cosine are rational.
pub(super) fn toward(angle: &Exact) -> Pair {
    [Fun::Cos, Fun::Sin].map(|f| Exact::call(f, angle))
}

/// Turned left by a right angle.
pub(super) fn left_of([x, y]: &Pair) -> Pair {
    [y.neg(), x.clone()]
}

pub(super) fn plus(a: &Pair, b: &Pair) -> Pair {
    [a[0].add(&b[0]), a[1].add(&b[1])]
}

pub(super) fn times(factor: &Exact, a: &Pair) -> Pair {
    [factor.mul(&a[0]), factor.mul(&a[1])]
}

pub(super) fn dot(a: &Pair, b: &Pair) -> Exact {
    a[0].mul(&b[0]).add(&a[1].mul(&b[1]))
}

/// Whether a value is a number other than zero.
pub(super) fn is_nonzero(v: &Exact) -> bool {
    v.as_rational().is_some_and(|v| !num_traits::Zero::is_zero(v))
}
