//! Systems of linear forms solved symbolically for the rates they determine, by Gauss–Jordan elimination.
//!
//! ```
//! use creepage::mechanism::{Row, solve};
//! use creepage::formula::Expr;
//! let row = |terms: &[(&str, &str)]| {
//!     let mut r = Row::default();
//!     for (rate, c) in terms { r.add(*rate, &Expr::parse(c).unwrap()); }
//!     r
//! };
//! let right = row(&[("v", "1"), ("phi'", "a/2"), ("theta_1'", "-r")]);
//! let left = row(&[("v", "1"), ("phi'", "-a/2"), ("theta_2'", "-r")]);
//! let s = solve::together(&[right, left], &["v".into(), "phi'".into()]).unwrap();
//! assert_eq!(s[0].1.to_string(), "r*theta_1'/2 + r*theta_2'/2");
//! assert_eq!(s[1].1.to_string(), "(r*theta_1' - r*theta_2')/a");
//! ```

use super::Row;
use crate::formula::{Expr, Node, Polynomial, Symbol};

/// Solves row = 0 one unknown at a time, so that a chain is written as a chain: a rate that is solved stays
/// a name in the formulas of the others. `None` when the rows do not determine the unknown rates.
pub fn chained(rows: &[Row], unknown: &[Symbol]) -> Option<Vec<(Symbol, Expr)>> {
    let mut rows: Vec<Row> = rows.to_vec();
    let mut left: Vec<Symbol> = unknown.to_vec();
    let mut solved = Vec::new();
    while let Some((r, name)) = single(&rows, &left) {
        let row = rows.remove(r);
        left.retain(|s| *s != name);
        solved.push((name.clone(), isolate(&row, &name)));
    }
    solved.extend(together(&rows, &left)?);
    let place = |s: &Symbol| unknown.iter().position(|u| u == s);
    solved.sort_by_key(|(s, _)| place(s));
    Some(solved)
}

/// A row with exactly one unknown left in it.
fn single(rows: &[Row], left: &[Symbol]) -> Option<(usize, Symbol)> {
    rows.iter().enumerate().find_map(|(i, row)| {
        let mut unknown = row.rates().filter(|r| left.contains(r));
        let first = unknown.next()?;
        unknown.next().is_none().then(|| (i, first.clone()))
    })
}

/// The rate as minus the rest over its coefficient, with common factors cancelled.
fn isolate(row: &Row, name: &Symbol) -> Expr {
    let c = Polynomial::of(&row.coefficient(name));
    let mut rest = row.clone();
    rest.add(name.clone(), &-&row.coefficient(name));
    let (top, bottom) = Polynomial::of(&(-&rest.expr())).cancelled(&c.squares_joined());
    // A divisor begins without a minus: -a/(-b + c) is written a/(b - c).
    match leads_with_minus(&bottom.expr()) {
        true => &(-&top.expr()).tidy() / &(-&bottom.expr()).tidy(),
        false => &top.expr() / &bottom.expr(),
    }
}

/// Whether the first term of a formula is subtracted.
fn leads_with_minus(e: &Expr) -> bool {
    match e.node() {
        Node::Neg(_) => true,
        Node::Add(a, _) | Node::Sub(a, _) => leads_with_minus(a),
        _ => false,
    }
}

/// Solves row = 0 for the unknown rates at once, no unknown left in any formula; `None` when the rows do not
/// determine them.
///
/// Gauss–Jordan elimination on formulas; pivots that are numbers come first.
pub fn together(rows: &[Row], unknown: &[Symbol]) -> Option<Vec<(Symbol, Expr)>> {
    let mut rows = rows.to_vec();
    let mut left: Vec<Symbol> = unknown.to_vec();
    let mut done: Vec<(Symbol, Row)> = Vec::new();
    while !left.is_empty() {
        let (r, n) = pivot(&rows, &left)?;
        let (row, name) = (rows.remove(r), left.remove(n));
        rows.iter_mut().for_each(|r| *r = cleared(r, &row, &name));
        done.iter_mut().for_each(|(_, r)| *r = cleared(r, &row, &name));
        done.push((name, row));
    }
    let place = |s: &Symbol| unknown.iter().position(|u| u == s);
    done.sort_by_key(|(s, _)| place(s));
    Some(done.into_iter().map(|(name, row)| (name.clone(), isolate(&row, &name))).collect())
}

/// The row and the unknown to eliminate next. A number never vanishes, so it comes first; what may vanish, such
/// as a coefficient of creep, would leave 0/0 behind.
fn pivot(rows: &[Row], left: &[Symbol]) -> Option<(usize, usize)> {
    let weight = |c: &Expr| if c.as_number().is_some() { 0 } else { c.to_string().len() };
    let pairs = (0..left.len()).flat_map(|n| (0..rows.len()).map(move |r| (r, n)));
    let usable = pairs.map(|(r, n)| (rows[r].coefficient(&left[n]), (r, n)));
    let usable = usable.filter(|(c, _)| !Polynomial::of(c).is_zero());
    usable.min_by_key(|(c, _)| weight(c)).map(|(_, place)| place)
}

/// A row freed of a rate by cross-multiplication, so that no division enters.
fn cleared(row: &Row, pivot: &Row, name: &Symbol) -> Row {
    let (a, b) = (row.coefficient(name), pivot.coefficient(name));
    if a.is_zero() {
        return row.clone();
    }
    if let (Some(x), Some(y)) = (a.as_number(), b.as_number()) {
        return row.plus(&Expr::number(&-(x / y)), pivot);
    }
    row.times(&b).plus(&-&a, pivot)
}
