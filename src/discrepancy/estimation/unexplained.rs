//! Motion that a fit leaves unexplained: process noise that it needs beyond chance.

use crate::discrepancy::estimation::autocorrelation::NOTICEABLE;
use crate::discrepancy::estimation::fit::Fit;

/// Named effects from which on one simpler term is tried whatever remains.
const MANY: usize = 2;

/// Whether motion remains that a fit does not explain.
pub fn remains(fit: &Fit) -> bool {
    remaining(fit).next().is_some()
}

/// The kinds of jumps that a fit needs beyond chance.
pub(crate) fn remaining(fit: &Fit) -> impl Iterator<Item = usize> {
    (0..fit.unexplained.len()).filter(|c| fit.unexplained[*c] / fit.variance_inflation() > NOTICEABLE)
}

/// Whether a term may be asked for: something remains, or suspiciously much was needed.
pub(crate) fn is_wanted(named: &Fit) -> bool {
    remains(named) || named.model.free_effects().count() >= MANY
}
