//! Formulas of passive coefficients of creep: those that follow from the coefficients that make the motion.

use super::{Mechanism, Realisation, Row, solve};
use crate::formula::{Expr, Fun, Node, Polynomial, Symbol};

impl Mechanism {
    /// The coefficient of a passive constraint as a formula of the canonical coefficients and the measured rates.
    ///
    /// `None` when the velocities cannot be solved for, or the coefficient is not passive.
    pub fn passive_coefficient(&self, found: &Realisation, constraint: usize) -> Option<Expr> {
        self.passive(found, constraint, Row::clone)
    }

    /// The same for a vehicle alone, whose coefficients do not depend on its heading `phi`: taken where it is zero.
    pub fn passive_coefficient_ahead(&self, found: &Realisation, constraint: usize) -> Option<Expr> {
        self.passive(found, constraint, ahead)
    }

    fn passive(&self, found: &Realisation, constraint: usize, seen: fn(&Row) -> Row) -> Option<Expr> {
        if !found.passive.contains(&constraint) {
            return None;
        }
        let rows: Vec<Row> = found.canonical().iter().map(|r| seen(&self.constraints[*r].row())).collect();
        let velocities = Velocities::of(solve::together(&rows, &found.unknown)?);
        // The row is linear in its coefficient: e = -row(0)/(row(1) - row(0)).
        let top = Polynomial::of(&-&velocities.along(&seen(&self.constraints[constraint].ideal_row())));
        let bottom = Polynomial::of(&velocities.along(&seen(&self.slopes().swap_remove(constraint))));
        if bottom.is_zero() {
            return None;
        }
        let (top, bottom) = without_common_symbols(top, bottom);
        let (top, bottom) = top.cancelled(&bottom);
        Some(&top.expr() / &bottom.expr())
    }
}

/// Both divided by every symbol that stands in all their terms.
fn without_common_symbols(mut top: Polynomial, mut bottom: Polynomial) -> (Polynomial, Polynomial) {
    for symbol in bottom.expr().symbols() {
        let symbol = Polynomial::of(&Expr::sym(symbol));
        let ((a, rest_a), (b, rest_b)) = (top.cancelled(&symbol), bottom.cancelled(&symbol));
        if rest_a.expr().is_one() && rest_b.expr().is_one() {
            (top, bottom) = (a, b);
        }
    }
    (top, bottom)
}

/// Velocities over one denominator.
struct Velocities {
    tops: Vec<(Symbol, Expr)>,
    denominator: Expr,
}

impl Velocities {
    fn of(solved: Vec<(Symbol, Expr)>) -> Self {
        let parts = |f: &Expr| match f.node() {
            Node::Div(a, b) => (a.clone(), b.clone()),
            _ => (f.clone(), Expr::int(1)),
        };
        let fractions: Vec<_> = solved.into_iter().map(|(s, f)| (s, parts(&f))).collect();
        let mut factors: Vec<Expr> = Vec::new();
        for (_, (_, b)) in &fractions {
            if !factors.contains(b) {
                factors.push(b.clone());
            }
        }
        let product =
            |without: Option<&Expr>| factors.iter().filter(|f| Some(*f) != without).fold(Expr::int(1), |p, f| &p * f);
        let tops = fractions.iter().map(|(s, (a, b))| (s.clone(), a * &product(Some(b)))).collect();
        Self { tops, denominator: product(None) }
    }

    /// The row along these velocities, times the denominator.
    fn along(&self, row: &Row) -> Expr {
        let top = |rate: &Symbol| {
            let known = self.tops.iter().find(|(s, _)| s == rate).map(|(_, a)| a.clone());
            known.unwrap_or_else(|| &self.denominator * &Expr::sym(rate.clone()))
        };
        row.terms().iter().fold(Expr::int(0), |sum, (rate, c)| &sum + &(c * &top(rate)))
    }
}

/// The row at heading zero.
fn ahead(row: &Row) -> Row {
    let mut turned = Row::default();
    row.terms().iter().for_each(|(rate, c)| turned.add(rate.clone(), &straight(c)));
    turned
}

/// The formula at heading zero, sines and cosines of zero written as numbers.
fn straight(e: &Expr) -> Expr {
    match e.node() {
        Node::Sym(s) if s.as_str() == "phi" => Expr::int(0),
        Node::Call(f, x) => match (f, straight(x).tidy()) {
            (Fun::Sin, zero) if zero.is_zero() => zero,
            (Fun::Cos, zero) if zero.is_zero() => Expr::int(1),
            (f, x) => Expr::call(*f, &x),
        },
        _ => e.with_parts(straight),
    }
}
