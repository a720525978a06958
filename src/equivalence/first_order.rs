//! Agreement to first order: derivatives at zero as combinations of one another with constant coefficients.

use super::carrier::Carrier;
use super::equation::{Equation, side_by_side};
use super::family::vanish;
use super::linear_system::LinearSystem;
use super::pair::Pair;
use super::points::Point;
use super::solution::solution;
use crate::formula::{Normal, Scalar, Symbol};

/// The slopes of the given family by one parameter as a combination of those of the sought one.
struct Combination<'a> {
    of: &'a Symbol,
    turning: bool,
}

impl LinearSystem for Combination<'_> {
    fn unknowns(&self, pair: &Pair) -> usize {
        pair.directions(self.turning).len()
    }

    fn equations<S: Carrier>(&self, pair: &Pair, at: &Point<S>) -> Option<Vec<Equation<S>>> {
        Some(side_by_side(&pair.columns(at, self.turning)?, &pair.given.slopes(at, Some(self.of))?))
    }
}

impl Pair<'_> {
    /// The slopes of the given family at zero as combinations of those of the sought one, row by row for each given
    /// parameter, as far as a few points tell; where no heading is measured (`turning`), a turn of it is free.
    pub fn slopes(&self, turning: bool) -> Option<Vec<Vec<Normal>>> {
        self.given.own.iter().map(|of| solution(self, &Combination { of, turning })).collect()
    }

    fn directions(&self, turning: bool) -> Vec<Option<&Symbol>> {
        let symbols = self.sought.own.iter().chain(&self.sought.shared).map(Some);
        symbols.chain(turning.then_some(None)).collect()
    }

    fn columns<S: Carrier>(&self, at: &Point<S>, turning: bool) -> Option<Vec<Vec<S>>> {
        self.directions(turning).into_iter().map(|by| self.sought.slopes(at, by)).collect()
    }

    /// Whether such combinations hold in every state and for every input, and are not of what both sides have in
    /// common alone.
    pub fn agree(&self, slopes: &[Vec<Normal>], turning: bool) -> bool {
        let own = self.sought.own.len();
        let open = Point::<Normal>::default();
        let Some(columns) = self.columns(&open, turning) else { return false };
        let holds = |(p, c): (&Symbol, &Vec<Normal>)| {
            let Some(target) = self.given.slopes(&open, Some(p)) else { return false };
            let rest = |i: usize| columns.iter().zip(c).fold(target[i].clone(), |rest, (g, c)| rest.sub(&c.mul(&g[i])));
            !vanish(&c[..own]) && (0..target.len()).all(|i| rest(i).is_zero())
        };
        self.given.own.iter().zip(slopes).all(holds)
    }
}
