//! Formulas of passive coefficients, as short as they get.

use crate::formula::{Expr, Fun, Node, Polynomial, Symbol};
use crate::mechanism::{Mechanism, Realisation, Row, solve};

/// The coefficient of a constraint from those of the canonical set and the measured rates, for a vehicle alone.
///
/// The velocities are solved for in axes along the body, where heading zero is: no coefficient depends on it. `None`
/// where they cannot be solved for.
pub(super) fn coefficient(mechanism: &Mechanism, found: &Realisation, constraint: usize) -> Option<Expr> {
    let rows: Vec<Row> = found.canonical().iter().map(|r| ahead(&mechanism.constraints[*r].row())).collect();
    let velocities = Velocities::of(solve::together(&rows, &found.unknown)?);
    let own = &mechanism.constraints[constraint];
    let at = |e: i64| ahead(&own.row().substitute(&|s| (*s == own.creep).then(|| Expr::int(e))));
    // The row is linear in its coefficient: e = -row(0)/(row(1) - row(0)).
    let ideal = at(0);
    let slope = at(1).plus(&Expr::int(-1), &ideal);
    let top = Polynomial::of(&-&velocities.along(&ideal));
    let bottom = Polynomial::of(&velocities.along(&slope));
    if bottom.is_zero() {
        return None;
    }
    let (top, bottom) = without_common_symbols(top, bottom);
    let (top, bottom) = top.cancelled(&bottom);
    Some(&top.expr() / &bottom.expr())
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
        Node::Num(_) => e.clone(),
        Node::Sym(s) => {
            if s.as_str() == "phi" {
                Expr::int(0)
            } else {
                e.clone()
            }
        }
        Node::Neg(x) => -&straight(x),
        Node::Add(a, b) => &straight(a) + &straight(b),
        Node::Sub(a, b) => &straight(a) - &straight(b),
        Node::Mul(a, b) => &straight(a) * &straight(b),
        Node::Div(a, b) => &straight(a) / &straight(b),
        Node::Pow(x, n) => straight(x).pow(*n),
        Node::Call(f, x) => match (f, straight(x).tidy()) {
            (Fun::Sin, zero) if zero.is_zero() => zero,
            (Fun::Cos, zero) if zero.is_zero() => Expr::int(1),
            (f, x) => Expr::call(*f, &x),
        },
    }
}
