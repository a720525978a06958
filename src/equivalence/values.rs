//! Values of parameters, and their way from and to formulas.

use crate::formula::{BigRational, Expr, Normal, Scalar, Symbol};
use std::collections::BTreeMap;

/// Values of parameters; what is not given stands for itself.
pub type Values<S = Normal> = BTreeMap<Symbol, S>;

/// A whole number.
pub fn int<S: Scalar>(n: i64) -> S {
    S::number(&BigRational::from(n))
}

/// A normal form as a formula.
pub fn formula(value: &Normal) -> Expr {
    let below = value.denominator();
    if below.is_one() { value.numerator() } else { &value.numerator() / &below }
}
