//! Gauge of an unmeasured heading: changes of parameter together with a turn of a heading that nothing measures.

use super::carrier::Carrier;
use super::equation::{Equation, less, negative, side_by_side};
use super::family::Family;
use super::linear_system::LinearSystem;
use super::pair::Pair;
use super::points::Point;
use super::proof::Claim;
use super::solution::solution;
use super::values::{Values, int};
use crate::formula::{Normal, Symbol};

/// The given parameter and the sought ones as functions of the turn, where both motions are of the first degree.
struct Turned<'a> {
    given: &'a Symbol,
    turn: &'a Symbol,
}

impl LinearSystem for Turned<'_> {
    fn unknowns(&self, pair: &Pair) -> usize {
        1 + pair.sought.own.len()
    }

    fn equations<S: Carrier>(&self, pair: &Pair, at: &Point<S>) -> Option<Vec<Equation<S>>> {
        let one = |f: &Family, s: &Symbol, turn: Option<&S>| {
            let values = f.own.iter().map(|o| (o.clone(), int(i64::from(o == s)))).collect();
            Some(less(&f.rows(at, &values, turn)?, &f.neutral(at, turn)?))
        };
        let turned = at.open(self.turn);
        let given = one(pair.given, self.given, None)?;
        let sought = pair.sought.own.iter().map(|q| Some(negative(&one(pair.sought, q, Some(&turned))?)));
        let columns: Vec<Vec<S>> = std::iter::once(Some(given)).chain(sought).collect::<Option<_>>()?;
        let target = less(&pair.sought.neutral(at, Some(&turned))?, &pair.given.neutral(at, None)?);
        Some(side_by_side(&columns, &target))
    }
}

/// The same to first order in the turn.
struct FirstOrderTurn<'a>(&'a Symbol);

impl LinearSystem for FirstOrderTurn<'_> {
    fn unknowns(&self, pair: &Pair) -> usize {
        1 + pair.sought.own.len()
    }

    fn equations<S: Carrier>(&self, pair: &Pair, at: &Point<S>) -> Option<Vec<Equation<S>>> {
        let sought = pair.sought.own.iter().map(|q| Some(negative(&pair.sought.slopes(at, Some(q))?)));
        let given = std::iter::once(pair.given.slopes(at, Some(self.0)));
        let columns: Vec<Vec<S>> = given.chain(sought).collect::<Option<_>>()?;
        Some(side_by_side(&columns, &pair.sought.slopes(at, None)?))
    }
}

impl Pair<'_> {
    /// Where no heading is measured: the change with the true heading turned, p and q both as functions of the turn.
    ///
    /// Only where the turn moves the given parameter to first order, so that all values near zero are reached.
    pub fn turned(&self, turn: &Symbol) -> Option<Values> {
        let [p] = &self.given.own[..] else { return None };
        if !self.is_regular() || self.first_order_turn(p)?.is_zero() {
            return None;
        }
        let mut found = solution(self, &Turned { given: p, turn })?.into_iter();
        let given: Values = [(p.clone(), found.next()?)].into();
        let sought: Values = self.sought.own.iter().cloned().zip(found).collect();
        let claim = Claim { given: &given, sought: &sought, turn: Some(turn) };
        if claim.is_proved(self) { Some(given.into_iter().chain(sought).collect()) } else { None }
    }

    /// The slope of the given parameter by the turn, to first order.
    fn first_order_turn(&self, p: &Symbol) -> Option<Normal> {
        solution(self, &FirstOrderTurn(p))?.into_iter().next()
    }
}
