//! A configuration of a mechanism: exact values of its symbols.

use super::Row;
use crate::error::{Error, Result};
use crate::formula::{BigRational, Exact, Expr, Symbol};
use std::collections::BTreeMap;

/// Exact values for coordinates and parameters.
///
/// ```
/// use creepage::formula::Exact;
/// use creepage::mechanism::Point;
/// let at = Point::default().with("r", Exact::ratio(1, 4)).with("phi", Exact::half_tangent(1, 3));
/// assert_eq!(at.value(&"phi".into()).to_string(), "angle(4, 3)");
/// ```
#[derive(Clone, Debug, Default)]
pub struct Point {
    values: BTreeMap<Symbol, Exact>,
}

impl Point {
    /// The same point with a value for a name.
    pub fn with(mut self, name: impl Into<Symbol>, value: Exact) -> Self {
        self.set(name, value);
        self
    }

    /// Sets the value of a name.
    pub fn set(&mut self, name: impl Into<Symbol>, value: Exact) {
        self.values.insert(name.into(), value);
    }

    /// The value of a name; undefined without one.
    pub fn value(&self, name: &Symbol) -> Exact {
        self.values.get(name).cloned().unwrap_or_else(|| Exact::ratio(0, 0))
    }

    /// A row of coefficients in the order of the rates, `None` where one of them has no exact value here.
    pub(crate) fn row(&self, row: &Row, rates: &[Symbol]) -> Option<Vec<BigRational>> {
        rates.iter().map(|r| self.number(&row.coefficient(r))).collect()
    }

    /// The rational value of a formula.
    pub(crate) fn number(&self, e: &Expr) -> Option<BigRational> {
        e.eval(&|s| self.value(s))?.as_rational().cloned()
    }

    /// All rows as a matrix.
    ///
    /// # Errors
    /// When a coefficient has no exact value here.
    pub(crate) fn matrix(&self, rows: &[Row], rates: &[Symbol]) -> Result<Vec<Vec<BigRational>>> {
        rows.iter().map(|r| self.row(r, rates).ok_or_else(|| not_exact(r))).collect()
    }
}

/// What to say of a row that cannot be evaluated.
pub(crate) fn not_exact(row: &Row) -> Error {
    let what = format!("the constraint {row} = 0 has no exact value at this point");
    Error::input(what).help("give every symbol a value at which its sines, cosines and roots are rational")
}
