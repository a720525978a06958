//! A growth vector as a theorem: the distribution as data, of which the kernel computes the brackets by itself.

use super::distribution::{Distribution, Place};
use crate::formula::{BigInt, BigRational, Expr, Fun, Node, Symbol};
use std::fmt::Write;

/// The definition of a distribution and the theorem of its growth vector, under a name; nothing where a coefficient is
/// no polynomial.
pub(super) fn growth_theorem(name: &str, of: &Distribution) -> Option<String> {
    let terms = Terms { coordinates: &of.coordinates };
    let coordinates: Vec<String> = of.coordinates.iter().enumerate().map(|(i, q)| format!("{i} {q}")).collect();
    let places: Vec<String> = of.at.iter().map(place).collect();
    let growth: Vec<String> = of.growth.iter().map(usize::to_string).collect();
    let integrals: Vec<String> = of.integrals.iter().map(|h| terms.polynomial(h)).collect::<Option<_>>()?;
    let mut out = format!("(* {name}: coordinates {} *)\n", coordinates.join(", "));
    let _ = writeln!(out, "Open Scope polynomial_scope.\nDefinition {name} := {{|");
    let _ = writeln!(out, "  coordinates := {};", of.coordinates.len());
    let _ = writeln!(out, "  rows := {};", terms.matrix(&of.rows)?);
    let _ = writeln!(out, "  fields := {};", terms.matrix(&of.motions)?);
    let _ = writeln!(out, "  integrals := [{}];", integrals.join("; "));
    let _ = writeln!(out, "  configuration := [{}]\n|}}.\nClose Scope polynomial_scope.", places.join("; "));
    let _ = writeln!(out, "Theorem {name}_growth :\n  has_growth {name} {} [{}]%nat.", of.rank, growth.join("; "));
    out.push_str("Proof. growth. Qed.\n");
    Some(out)
}

fn place(at: &Place) -> String {
    match at {
        Place::Angle(c, s) => format!("Angle {} {}", rational(c), rational(s)),
        Place::Length(x) => format!("Length {}", rational(x)),
    }
}

/// A rational number as a term.
fn rational(v: &BigRational) -> String {
    match v.denominator().is_one() {
        true if *v.numerator() >= BigInt::from(0) => v.numerator().to_string(),
        true => format!("({})", v.numerator()),
        false => format!("({} # {})", v.numerator(), v.denominator()),
    }
}

/// Formulas as polynomials over the places of the coordinates.
struct Terms<'a> {
    coordinates: &'a [Symbol],
}

impl Terms<'_> {
    fn matrix(&self, rows: &[Vec<Expr>]) -> Option<String> {
        let row = |row: &Vec<Expr>| {
            let entries: Option<Vec<String>> = row.iter().map(|e| self.polynomial(e)).collect();
            entries.map(|e| format!("    [{}]", e.join("; ")))
        };
        let rows: Option<Vec<String>> = rows.iter().map(row).collect();
        rows.map(|rows| format!("[\n{}]", rows.join(";\n")))
    }

    fn place(&self, e: &Expr) -> Option<usize> {
        let Node::Sym(s) = e.node() else { return None };
        self.coordinates.iter().position(|q| q == s)
    }

    fn polynomial(&self, e: &Expr) -> Option<String> {
        if let Some(v) = e.as_number() {
            return Some(format!("number {}", rational(&v)));
        }
        let go = |x: &Expr| self.polynomial(x);
        Some(match e.node() {
            Node::Sym(_) => format!("coordinate {}", self.place(e)?),
            Node::Call(Fun::Sin, x) => format!("sine {}", self.place(x)?),
            Node::Call(Fun::Cos, x) => format!("cosine {}", self.place(x)?),
            Node::Neg(x) => format!("(- ({}))", go(x)?),
            Node::Add(a, b) => format!("({} + {})", go(a)?, go(b)?),
            Node::Sub(a, b) => format!("({} - ({}))", go(a)?, go(b)?),
            Node::Mul(a, b) => format!("({} * {})", go(a)?, go(b)?),
            Node::Div(a, b) => {
                let divisor = (&Expr::int(1) / b).as_number()?;
                format!("(number {} * {})", rational(&divisor), go(a)?)
            }
            Node::Pow(x, n) if *n >= 0 => format!("({} ^ {n})", go(x)?),
            Node::Num(_) | Node::Pow(..) | Node::Call(..) => return None,
        })
    }
}
