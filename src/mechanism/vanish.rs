//! Whether a formula is zero everywhere.

use super::{Point, samples::Samples};
use crate::formula::{Expr, Symbol};
use num_traits::Zero;

/// How many points are tried, and at how many of them the formula must have an exact value.
const TRIED: usize = 48;
const NEEDED: usize = 24;

/// Whether a formula is zero for all values of its symbols.
///
/// Decided by exact values at random rational points: a formula that is not zero is zero there only by accident. This
/// is the one place that decides identities for the search for integrals.
pub(super) fn vanishes(e: &Expr) -> bool {
    let symbols: Vec<Symbol> = e.symbols().into_iter().collect();
    let mut samples = Samples::of(std::iter::once(e));
    let nothing = Point::default();
    let values = (0..TRIED).filter_map(|_| samples.point(&symbols, &nothing).number(e));
    let mut values = values.take(NEEDED);
    let mut met = 0;
    values.all(|v| {
        met += 1;
        v.is_zero()
    }) && met == NEEDED
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
