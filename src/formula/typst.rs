//! Expressions to Typst.

use super::latex::GREEK;
use super::print::{Bind, bind, decimal};
use super::{Expr, Fun, Node, Symbol};

impl Expr {
    /// The expression in Typst's mathematics mode.
    ///
    /// ```
    /// use creepage::formula::Expr;
    /// let e = Expr::parse("-phi'*v_l/(1 - e_rc)^2").unwrap();
    /// assert_eq!(e.typst(), r#"-frac(dot(phi) thin v_"l", (1 - e_"rc")^(2))"#);
    /// ```
    pub fn typst(&self) -> String {
        match self.node() {
            Node::Num(v) => decimal(v),
            Node::Sym(s) => typst_symbol(s),
            Node::Neg(x) => format!("-{}", later(x, Bind::Product)),
            Node::Add(a, b) => format!("{} + {}", part(a, Bind::Sum), later(b, Bind::Product)),
            Node::Sub(a, b) => format!("{} - {}", part(a, Bind::Sum), later(b, Bind::Product)),
            Node::Mul(a, b) => product(a, b),
            Node::Div(a, b) => format!("frac({}, {})", a.typst(), b.typst()),
            Node::Pow(x, n) => format!("{}^({n})", part(x, Bind::Atom)),
            Node::Call(f, x) => format!("{}({})", function(*f), x.typst()),
        }
    }
}

/// A part in a place that asks for a binding; a fraction is drawn as one thing.
fn part(e: &Expr, wanted: Bind) -> String {
    let fraction = matches!(e.node(), Node::Div(..)) && wanted != Bind::Atom;
    if bind(e) < wanted && !fraction { format!("({})", e.typst()) } else { e.typst() }
}

/// A product; only a dot keeps 2·3 from being read as 23.
fn product(a: &Expr, b: &Expr) -> String {
    let (left, right) = (part(a, Bind::Product), later(b, Bind::Factor));
    let dot = if right.starts_with(|c: char| c.is_ascii_digit()) { "dot.op" } else { "thin" };
    format!("{left} {dot} {right}")
}

/// A part after an operator: the sign of a factor would be read as a minus.
fn later(e: &Expr, wanted: Bind) -> String {
    let text = part(e, wanted);
    if text.starts_with('-') { format!("({text})") } else { text }
}

fn function(f: Fun) -> &'static str {
    match f {
        Fun::Asin => "arcsin",
        Fun::Acos => "arccos",
        Fun::Atan => "arctan",
        Fun::Sign => "op(\"sgn\")",
        f => f.name(),
    }
}

/// A name in Typst's mathematics mode: Greek letters, subscripts after `_`, dots for primes.
pub fn typst_symbol(s: &Symbol) -> String {
    let text = s.as_str();
    let stem = text.trim_end_matches('\'');
    let primes = text.len() - stem.len();
    let stem = stem.rsplit('.').next().unwrap_or(stem);
    let (letter, subscript) = stem.split_once('_').unwrap_or((stem, ""));
    let letter = match letter {
        l if GREEK.contains(&l) || l.chars().count() == 1 => l.to_string(),
        l => format!("\"{l}\""),
    };
    let dotted = match primes {
        0 => letter,
        1 => format!("dot({letter})"),
        2 => format!("dot.double({letter})"),
        n => format!("{letter}^(({n}))"),
    };
    match subscript {
        "" => dotted,
        s => format!("{dotted}_\"{}\"", s.replace('_', ",")),
    }
}
