//! Whether effects agree for small values of their parameters.

use super::constant_coefficients::constants;
use super::family::{Point, vanish};
use super::reparametrisation::{Pair, side_by_side};
use crate::formula::{Normal, Scalar, Symbol};

impl Pair<'_> {
    /// Whether both families are smooth at zero.
    pub fn is_regular(&self) -> bool {
        self.given.regular && self.sought.regular
    }

    /// The slopes of the given family at zero as combinations of those of the sought one, row by row for each given
    /// parameter, as far as a few points tell; where no heading is measured (`turning`), a turn of it is free.
    pub fn slopes(&self, turning: bool) -> Option<Vec<Vec<Normal>>> {
        self.given.own.iter().map(|p| self.combination(p, turning)).collect()
    }

    fn directions(&self, turning: bool) -> Vec<Option<&Symbol>> {
        let symbols = self.sought.own.iter().chain(&self.sought.shared).map(Some);
        symbols.chain(turning.then_some(None)).collect()
    }

    fn columns(&self, at: &Point, turning: bool) -> Option<Vec<Vec<Normal>>> {
        self.directions(turning).into_iter().map(|by| self.sought.slopes(at, by)).collect()
    }

    fn combination(&self, p: &Symbol, turning: bool) -> Option<Vec<Normal>> {
        let equations = |at: &Point| Some(side_by_side(&self.columns(at, turning)?, &self.given.slopes(at, Some(p))?));
        let all = self.points.iter().flat_map(|at| equations(at).unwrap_or_default());
        constants(self.directions(turning).len(), all)
    }

    /// Whether such combinations hold in every state and for every input, and are not of what both sides have in
    /// common alone.
    pub fn agree(&self, slopes: &[Vec<Normal>], turning: bool) -> bool {
        let own = self.sought.own.len();
        let open = Point::default();
        let Some(columns) = self.columns(&open, turning) else { return false };
        let holds = |(p, c): (&Symbol, &Vec<Normal>)| {
            let Some(target) = self.given.slopes(&open, Some(p)) else { return false };
            let rest = |i: usize| columns.iter().zip(c).fold(target[i].clone(), |rest, (g, c)| rest.sub(&c.mul(&g[i])));
            !vanish(&c[..own]) && (0..target.len()).all(|i| rest(i).is_zero())
        };
        self.given.own.iter().zip(slopes).all(holds)
    }
}
