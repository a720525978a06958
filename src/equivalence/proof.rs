//! The proof of a reparametrisation: both motions equal in every state and for every input, in normal form.

use super::carrier::Carrier;
use super::family::all_equal;
use super::numeric_rejection::differ;
use super::pair::Pair;
use super::points::Point;
use super::values::{Values, formula};
use crate::formula::{Expr, Symbol};

/// That two motions are equal with parameters of both sides changed, and the true heading turned on the sought side.
pub struct Claim<'a> {
    /// Parameters of the given family.
    pub given: &'a Values,
    /// Parameters of the sought family.
    pub sought: &'a Values,
    /// The name of the turn, where there is one.
    pub turn: Option<&'a Symbol>,
}

impl Claim<'_> {
    /// Whether it is proved; what numbers refute is not tried.
    pub fn is_proved(&self, pair: &Pair) -> bool {
        let equal = |[a, b]: [Vec<_>; 2]| all_equal(&a, &b);
        !self.is_refuted(pair) && self.motions(pair, &Point::default(), self.given, self.sought).is_some_and(equal)
    }

    fn is_refuted(&self, pair: &Pair) -> bool {
        let formulas = |values: &Values| values.iter().map(|(s, v)| (s.clone(), formula(v))).collect::<Vec<_>>();
        let (given, sought) = (formulas(self.given), formulas(self.sought));
        let numbers = |at: &Point<f64>, formulas: &[(Symbol, Expr)]| -> Option<Values<f64>> {
            let known = |s: &Symbol| at.get(s).copied().unwrap_or_else(|| at.open(s));
            formulas.iter().map(|(s, f)| Some((s.clone(), f.eval(&known)?))).collect()
        };
        differ(pair, &|at| self.motions(pair, at, &numbers(at, &given)?, &numbers(at, &sought)?))
    }

    fn motions<S: Carrier>(
        &self,
        pair: &Pair,
        at: &Point<S>,
        given: &Values<S>,
        sought: &Values<S>,
    ) -> Option<[Vec<S>; 2]> {
        let turn = self.turn.map(|turn| at.open(turn));
        Some([pair.given.rows(at, given, None)?, pair.sought.rows(at, sought, turn.as_ref())?])
    }
}
