//! The numbers of holonomic and nonholonomic constraints of a mechanism, by brackets and by integrals (Frobenius'
//! theorem).

use super::{Growth, Integral, Mechanism, Point};
use crate::error::Result;

/// Holonomic and nonholonomic constraints, counted twice.
///
/// | number | from brackets | from integrals |
/// |---|---|---|
/// | holonomic | n − final dimension of the growth vector, at most | integrals found, at least |
/// | nonholonomic | rank − holonomic | |
///
/// Each count bounds the true one from its side, so where they agree both are proved. A motion of one dimension is
/// integrable whatever the search for integrals finds (Frobenius): a body that can only roll straight, with a trailer,
/// has an integral tan(β/2)·exp(s/d) that is none of the functions tried.
#[derive(Clone, Debug)]
pub struct Nonholonomy {
    /// The growth vector.
    pub growth: Growth,
    /// Independent integrals.
    pub integrals: Vec<Integral>,
    /// n − final dimension.
    pub holonomic: usize,
    /// rank − holonomic.
    pub nonholonomic: usize,
}

impl Nonholonomy {
    /// Whether brackets and integrals give the same count.
    pub fn counts_agree(&self) -> bool {
        self.holonomic == self.integrals.len()
    }
}

impl Mechanism {
    /// Growth vector, integrals and the two counts at a point, with brackets up to a length.
    ///
    /// ```
    /// use creepage::formula::Exact;
    /// use creepage::mechanism::Point;
    /// use creepage::{model::mechanism, vehicles};
    /// let robot = mechanism(vehicles::named("differential-drive").unwrap(), 0);
    /// let lengths = [("a", 3, 4), ("r_1", 1, 3), ("r_2", 1, 3)];
    /// let at = lengths.iter().fold(Point::default(), |p, (s, a, b)| p.with(*s, Exact::ratio(*a, *b)));
    /// let found = robot.nonholonomy(&at.with("phi", Exact::half_tangent(1, 2)), 6).unwrap();
    /// assert_eq!((found.holonomic, found.nonholonomic), (1, 2));
    /// assert!(found.counts_agree());
    /// ```
    ///
    /// # Errors
    /// As [`Mechanism::growth`].
    pub fn nonholonomy(&self, at: &Point, depth: usize) -> Result<Nonholonomy> {
        let n = self.coordinates.len();
        let integrals = self.integrals(at);
        let growth = self.growth(at, n - integrals.len(), depth)?;
        let holonomic = n - growth.dimensions.last().copied().unwrap_or(0);
        Ok(Nonholonomy { nonholonomic: growth.rank.saturating_sub(holonomic), holonomic, growth, integrals })
    }
}
