//! A row of the Pfaffian matrix: a linear form in rates with formulas as coefficients.

use crate::formula::{Expr, Polynomial, Symbol};
use std::fmt;

/// Σ coefficient·rate: one row of a Pfaffian matrix, its rates in the order they were met.
///
/// ```
/// use creepage::mechanism::Row;
/// use creepage::formula::Expr;
/// let mut row = Row::default();
/// row.add("x'", &Expr::parse("cos(phi)").unwrap());
/// row.add("theta'", &Expr::parse("-r").unwrap());
/// assert_eq!(row.to_string(), "cos(phi)*x' - r*theta'");
/// ```
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Row {
    terms: Vec<(Symbol, Expr)>,
}

impl Row {
    /// Adds a multiple of a rate; what cancels is dropped.
    pub fn add(&mut self, rate: impl Into<Symbol>, coefficient: &Expr) {
        let rate = rate.into();
        match self.terms.iter_mut().find(|(r, _)| *r == rate) {
            Some((_, c)) => *c = (&*c + coefficient).tidy(),
            None => self.terms.push((rate, coefficient.tidy())),
        }
        self.terms.retain(|(_, c)| !Polynomial::of(c).is_zero());
    }

    /// A row whose coefficients stay as they are written, for print; sums of it are multiplied out again.
    pub(crate) fn as_written(terms: Vec<(Symbol, Expr)>) -> Row {
        Row { terms }
    }

    /// This row plus a multiple of another.
    pub fn plus(&self, factor: &Expr, other: &Row) -> Row {
        let mut sum = self.clone();
        other.terms.iter().for_each(|(r, c)| sum.add(r.clone(), &(factor * c)));
        sum
    }

    /// The row times a factor.
    pub fn times(&self, factor: &Expr) -> Row {
        Row::default().plus(factor, self)
    }

    /// The row without the terms of rates that are known to be zero.
    pub fn without(&self, zero: &impl Fn(&Symbol) -> bool) -> Row {
        Row { terms: self.terms.iter().filter(|(r, _)| !zero(r)).cloned().collect() }
    }

    /// The coefficient of a rate; zero when the rate does not occur.
    pub fn coefficient(&self, rate: &Symbol) -> Expr {
        self.terms.iter().find(|(r, _)| r == rate).map_or_else(|| Expr::int(0), |(_, c)| c.clone())
    }

    /// The rates that occur.
    pub fn rates(&self) -> impl Iterator<Item = &Symbol> {
        self.terms.iter().map(|(r, _)| r)
    }

    /// Rates and coefficients.
    pub fn terms(&self) -> &[(Symbol, Expr)] {
        &self.terms
    }

    /// The row with its rates in a given order; others keep theirs, behind.
    pub fn ordered(&self, order: &[Symbol]) -> Row {
        let place = |s: &Symbol| order.iter().position(|o| o == s).unwrap_or(order.len());
        let mut terms = self.terms.clone();
        terms.sort_by_key(|(r, _)| place(r));
        Row { terms }
    }

    /// The row with names replaced in its coefficients.
    pub fn substitute(&self, by: &impl Fn(&Symbol) -> Option<Expr>) -> Row {
        let mut row = Row::default();
        self.terms.iter().for_each(|(r, c)| row.add(r.clone(), &c.substitute(by)));
        row
    }

    /// The row with rates replaced by linear forms in other rates.
    pub(crate) fn with_rates(&self, by: &impl Fn(&Symbol) -> Option<Row>) -> Row {
        let mut row = Row::default();
        for (rate, c) in &self.terms {
            match by(rate) {
                Some(other) => row = row.plus(c, &other),
                None => row.add(rate.clone(), c),
            }
        }
        row
    }

    /// The row as a formula.
    pub fn expr(&self) -> Expr {
        self.terms.iter().fold(Expr::int(0), |sum, (rate, c)| &sum + &(c * &Expr::sym(rate.clone())))
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.expr())
    }
}
