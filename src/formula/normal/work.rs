//! A bound on the work of a proof: products of two terms that one thread may take before all else is undefined.

use std::cell::Cell;

thread_local! {
    static LEFT: Cell<u64> = const { Cell::new(u64::MAX) };
}

/// What a calculation in normal forms gives when it may take so many products of two terms; beyond them every normal
/// form is undefined.
///
/// The same for every number of threads, as long as the calculation itself stays on one.
pub(crate) fn with_work_bounded<R>(most: u64, calculation: impl FnOnce() -> R) -> R {
    let outer = LEFT.replace(most);
    let result = calculation();
    LEFT.set(outer);
    result
}

/// Takes so many products; `None` where they are more than are left.
pub(super) fn spend(products: usize) -> Option<()> {
    let left = LEFT.get();
    if left == u64::MAX {
        return Some(());
    }
    let rest = left.checked_sub(products as u64);
    LEFT.set(rest.unwrap_or(0));
    rest.map(|_| ())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::{Expr, Normal, Scalar};

    #[test]
    fn beyond_the_bound_a_normal_form_is_undefined_and_after_it_is_not() {
        let power = || Normal::of(&Expr::parse("(x + y + 1)^8 - (x + y)^8").unwrap()).is_defined();
        assert!(!with_work_bounded(100, power));
        assert!(with_work_bounded(100_000, power) && power());
        assert!(!with_work_bounded(100, || with_work_bounded(100_000, power) && power()), "the outer bound is back");
    }
}
