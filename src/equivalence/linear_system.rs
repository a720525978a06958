//! Linear systems of a comparison: Σ cⱼ·gⱼ = t with the same c at every point.

use super::carrier::Carrier;
use super::equation::Equation;
use super::pair::Pair;
use super::points::Point;

/// Equations that a comparison of two families leads to.
pub trait LinearSystem {
    /// How many cⱼ are sought.
    fn unknowns(&self, pair: &Pair) -> usize;

    /// The equations at a point; `None` where the motion is undefined.
    fn equations<S: Carrier>(&self, pair: &Pair, at: &Point<S>) -> Option<Vec<Equation<S>>>;
}
