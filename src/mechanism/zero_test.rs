//! The zero test: whether a formula is zero for all values of its symbols, decided by the normal form.

use crate::formula::{Expr, Normal, Scalar};

/// Whether a formula is zero for all values of its symbols, proved by its normal form.
///
/// What lies outside the reach of the normal form is not zero as far as anyone knows. This is the one place that
/// decides identities for the search for integrals.
pub(crate) fn vanishes(e: &Expr) -> bool {
    let normal = Normal::of(e);
    normal.is_defined() && normal.is_zero()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identities_vanish_and_nothing_else_does() {
        let vanishing = |text: &str| Expr::parse(text).is_ok_and(|e| vanishes(&e));
        assert!(vanishing("sin(a + b) - sin(a)*cos(b) - cos(a)*sin(b)"));
        assert!(vanishing("0") && vanishing("(x + y)^2 - x^2 - 2*x*y - y^2"));
        assert!(!vanishing("x - y") && !vanishing("cos(a) - 1") && !vanishing("sin(a)*cos(a)"));
        // Without exact values nothing is decided.
        assert!(!vanishing("sqrt(x^2 + 1) - sqrt(x^2 + 1)") && !vanishing("1/(x - x)"));
    }
}
