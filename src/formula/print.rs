//! Expressions to text that reads back as the same expression.

use super::{BigRational, Expr, Node};
use std::fmt;

/// How tightly a form binds; a part that binds less tightly than its place asks for gets parentheses.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub(super) enum Bind {
    Sum,
    Sign,
    Product,
    Factor,
    Power,
    Atom,
}

/// How tightly an expression binds.
pub(super) fn bind(e: &Expr) -> Bind {
    match e.node() {
        Node::Add(..) | Node::Sub(..) => Bind::Sum,
        Node::Mul(..) | Node::Div(..) => Bind::Product,
        Node::Neg(..) => Bind::Sign,
        Node::Pow(..) => Bind::Power,
        Node::Num(..) | Node::Sym(..) | Node::Call(..) => Bind::Atom,
    }
}

impl fmt::Display for Expr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.node() {
            Node::Num(v) => f.write_str(&decimal(v)),
            Node::Sym(s) => write!(f, "{s}"),
            Node::Neg(x) => write!(f, "-{}", Part(x, Bind::Product)),
            Node::Add(a, b) => write!(f, "{} + {}", Part(a, Bind::Sum), Part(b, Bind::Product)),
            Node::Sub(a, b) => write!(f, "{} - {}", Part(a, Bind::Sum), Part(b, Bind::Product)),
            Node::Mul(a, b) => write!(f, "{}*{}", Part(a, Bind::Product), Part(b, Bind::Factor)),
            Node::Div(a, b) => write!(f, "{}/{}", Part(a, Bind::Product), Part(b, Bind::Factor)),
            Node::Pow(x, n) => write!(f, "{}^{n}", Part(x, Bind::Atom)),
            Node::Call(g, x) => write!(f, "{}({x})", g.name()),
        }
    }
}

/// A part of an expression in a place that asks for a binding.
struct Part<'a>(&'a Expr, Bind);

impl fmt::Display for Part<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if bind(self.0) < self.1 { write!(f, "({})", self.0) } else { write!(f, "{}", self.0) }
    }
}

/// A terminating decimal in full: `0.25`, `1500`.
pub(super) fn decimal(v: &BigRational) -> String {
    let mut scale = 0usize;
    let mut rest = v.clone();
    let ten = BigRational::from(10);
    while !rest.denominator().as_ibig().is_one() {
        rest *= &ten;
        scale += 1;
    }
    let digits = rest.numerator().to_string();
    if scale == 0 || v.is_zero() {
        return digits;
    }
    let padded = format!("{digits:0>width$}", width = scale + 1);
    let (whole, part) = padded.split_at(padded.len() - scale);
    format!("{whole}.{part}")
}

impl fmt::Debug for Expr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{self}`")
    }
}
