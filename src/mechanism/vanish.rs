//! Whether a formula is zero everywhere.

use crate::formula::{Expr, Normal, Scalar};

/// Whether a formula is zero for all values of its symbols, proved by its normal form.
///
/// What lies outside the reach of the normal form is not zero as far as anyone knows. This is the one place that
/// decides identities for the search for integrals.
pub(super) fn vanishes(e: &Expr) -> bool {
    let normal = Normal::of(e);
    normal.is_defined() && normal.is_zero()
}
