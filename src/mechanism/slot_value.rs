//! The value of a slot: a factor, or a linear form in rates.

use super::Row;
use crate::error::{Error, Result};
use crate::formula::{Expr, Node, Symbol};

/// A factor of rates, or a linear form in them.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// A formula without rates.
    Factor(Expr),
    /// A linear form in rates.
    Rates(Row),
}

impl Part {
    /// A formula read as one or the other: names that end in `'` are rates.
    ///
    /// # Errors
    /// When it is neither.
    ///
    /// ```
    /// use creepage::formula::Expr;
    /// use creepage::mechanism::Part;
    /// let read = |text: &str| Part::of(&Expr::parse(text).unwrap());
    /// assert!(matches!(read("m*l^2").unwrap(), Part::Factor(_)));
    /// assert_eq!(read("m*(psi' + theta')").unwrap().expr().to_string(), "m*psi' + m*theta'");
    /// assert!(read("psi'^2").is_err() && read("1 + psi'").is_err());
    /// ```
    pub fn of(formula: &Expr) -> Result<Self> {
        Self::assembled(formula, &|s| match s.as_str().ends_with('\'') {
            true => Self::rate(s),
            false => Self::Factor(Expr::sym(s.clone())),
        })
    }

    /// A single rate.
    pub fn rate(name: &Symbol) -> Self {
        let mut row = Row::default();
        row.add(name.clone(), &Expr::int(1));
        Self::Rates(row)
    }

    /// A formula with what stands for its names put in.
    ///
    /// # Errors
    /// When the result is not linear in rates.
    pub(crate) fn assembled(formula: &Expr, put: &impl Fn(&Symbol) -> Part) -> Result<Self> {
        use Part::{Factor, Rates};
        let go = |e: &Expr| Self::assembled(e, put);
        let crooked = || Err(Error::input(format!("{formula} is not linear in rates, without a constant term")));
        Ok(match formula.node() {
            Node::Sym(s) => put(s),
            Node::Neg(x) => match go(x)? {
                Factor(f) => Factor(-&f),
                Rates(r) => Rates(r.times(&Expr::int(-1))),
            },
            Node::Add(a, b) | Node::Sub(a, b) => {
                let sign = Expr::int(if matches!(formula.node(), Node::Sub(..)) { -1 } else { 1 });
                match (go(a)?, go(b)?) {
                    (Factor(a), Factor(b)) if sign.is_one() => Factor(&a + &b),
                    (Factor(a), Factor(b)) => Factor(&a - &b),
                    (Rates(a), Rates(b)) => Rates(a.plus(&sign, &b)),
                    (Rates(a), Factor(b)) if b.is_zero() => Rates(a),
                    (Factor(a), Rates(b)) if a.is_zero() => Rates(b.times(&sign)),
                    _ => return crooked(),
                }
            }
            Node::Mul(a, b) => match (go(a)?, go(b)?) {
                (Factor(a), Factor(b)) => Factor(&a * &b),
                (Factor(f), Rates(r)) | (Rates(r), Factor(f)) => Rates(r.times(&f)),
                _ => return crooked(),
            },
            Node::Div(a, b) => match (go(a)?, go(b)?) {
                (Factor(a), Factor(b)) => Factor(&a / &b),
                (Rates(r), Factor(f)) => Rates(r.times(&(&Expr::int(1) / &f))),
                _ => return crooked(),
            },
            Node::Num(_) | Node::Pow(..) | Node::Call(..) => {
                let mut parts = Vec::new();
                for name in formula.symbols() {
                    match put(&name) {
                        Factor(f) => parts.push((name, f)),
                        Rates(_) => return crooked(),
                    }
                }
                let factor = |s: &Symbol| parts.iter().find(|(n, _)| n == s).map(|(_, f)| f.clone());
                Factor(formula.substitute(&factor))
            }
        })
    }

    /// As a formula.
    pub fn expr(&self) -> Expr {
        match self {
            Self::Factor(f) => f.clone(),
            Self::Rates(row) => row.expr(),
        }
    }

    /// As a formula with its rates in a given order.
    pub fn ordered(&self, order: &[Symbol]) -> Expr {
        match self {
            Self::Factor(f) => f.clone(),
            Self::Rates(row) => row.ordered(order).expr(),
        }
    }

    /// With names replaced; rates keep theirs.
    pub fn substitute(&self, by: &impl Fn(&Symbol) -> Option<Expr>) -> Self {
        match self {
            Self::Factor(f) => Self::Factor(f.substitute(by)),
            Self::Rates(row) => Self::Rates(row.substitute(by)),
        }
    }
}
