//! Changes of parameter together with a turn of a heading that nothing measures.

use super::constant_coefficients::{Equation, constants};
use super::family::{Family, Point, Values, all_equal, int};
use super::reparametrisation::{Pair, less, negative, side_by_side};
use crate::formula::{Normal, Symbol};

impl Pair<'_> {
    /// Where no heading is measured: the change with the true heading turned, p and q both as functions of the turn.
    ///
    /// Only where the turn moves the given parameter to first order, so that all values near zero are reached.
    pub fn turned(&self, turn: &Symbol) -> Option<Values> {
        let [p] = &self.given.own[..] else { return None };
        if !self.given.regular || !self.sought.regular || self.first_order_turn(p)?.is_zero() {
            return None;
        }
        let unknowns = &self.sought.own;
        let turned = Normal::symbol(turn.clone());
        let equations = |at: &Point| -> Option<Vec<Equation>> {
            let one = |f: &Family, s: &Symbol, turn: Option<&Normal>| {
                let values = f.own.iter().map(|o| (o.clone(), int(i64::from(o == s)))).collect();
                Some(less(&f.rows(at, &values, turn)?, &f.neutral(at, turn)?))
            };
            let given = one(self.given, p, None)?;
            let sought = unknowns.iter().map(|q| Some(negative(&one(self.sought, q, Some(&turned))?)));
            let columns: Vec<Vec<Normal>> = std::iter::once(Some(given)).chain(sought).collect::<Option<_>>()?;
            let target = less(&self.sought.neutral(at, Some(&turned))?, &self.given.neutral(at, None)?);
            Some(side_by_side(&columns, &target))
        };
        let all = self.points.iter().flat_map(|at| equations(at).unwrap_or_default());
        let mut found = constants(1 + unknowns.len(), all)?.into_iter();
        let given: Values = [(p.clone(), found.next()?)].into();
        let change: Values = unknowns.iter().cloned().zip(found).collect();
        let open = Point::default();
        let (a, b) = (self.given.rows(&open, &given, None)?, self.sought.rows(&open, &change, Some(&turned))?);
        all_equal(&a, &b).then(|| given.into_iter().chain(change).collect())
    }

    /// The slope of the given parameter by the turn, to first order.
    fn first_order_turn(&self, p: &Symbol) -> Option<Normal> {
        let equations = |at: &Point| -> Option<Vec<Equation>> {
            let sought = self.sought.own.iter().map(|q| Some(negative(&self.sought.slopes(at, Some(q))?)));
            let columns: Vec<Vec<Normal>> =
                std::iter::once(self.given.slopes(at, Some(p))).chain(sought).collect::<Option<_>>()?;
            Some(side_by_side(&columns, &self.sought.slopes(at, None)?))
        };
        let all = self.points.iter().flat_map(|at| equations(at).unwrap_or_default());
        constants(1 + self.sought.own.len(), all)?.into_iter().next()
    }
}
