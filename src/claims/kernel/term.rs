//! Formulas as terms of Gallina, the language of Coq, over its axiomatic real numbers.

use crate::formula::{Expr, Fun, Node, Symbol};

/// A formula as a term over the reals; nothing where it has a function that the reals of Coq are not given here.
pub(super) fn term(e: &Expr) -> Option<String> {
    Some(match e.node() {
        Node::Num(v) if v.denominator().is_one() => v.numerator().to_string(),
        Node::Num(v) => format!("({} / {})", v.numerator(), v.denominator()),
        Node::Sym(s) => identifier(s),
        Node::Neg(x) => format!("(- {})", term(x)?),
        Node::Add(a, b) => format!("({} + {})", term(a)?, term(b)?),
        Node::Sub(a, b) => format!("({} - {})", term(a)?, term(b)?),
        Node::Mul(a, b) => format!("({} * {})", term(a)?, term(b)?),
        Node::Div(a, b) => format!("({} / {})", term(a)?, term(b)?),
        Node::Pow(x, n) if *n < 0 => format!("(/ ({} ^ {}))", term(x)?, n.unsigned_abs()),
        Node::Pow(x, n) => format!("({} ^ {n})", term(x)?),
        Node::Call(f, x) => format!("({} {})", function(*f)?, term(x)?),
    })
}

/// The function of that name in Coq's library or in the file that all theorems rest on.
fn function(f: Fun) -> Option<&'static str> {
    match f {
        Fun::Sin => Some("sin"),
        Fun::Cos => Some("cos"),
        Fun::Tan => Some("tan"),
        Fun::Cot => Some("cot"),
        Fun::Atan => Some("atan"),
        Fun::Tanh => Some("tanh"),
        Fun::Exp => Some("exp"),
        Fun::Ln => Some("ln"),
        Fun::Sqrt => Some("sqrt"),
        Fun::Abs => Some("Rabs"),
        Fun::Asin | Fun::Acos | Fun::Sign | Fun::Step => None,
    }
}

/// Words that are no names in Gallina, and names whose meaning theorems need.
const TAKEN: &[&str] = &[
    "as", "at", "cofix", "else", "end", "exists", "fix", "for", "forall", "fun", "if", "in", "let", "match", "mod",
    "R", "return", "then", "where", "with", "PI", "Prop", "Set", "Type", "sin", "cos", "tan", "cot", "atan", "exp",
    "ln", "sqrt",
];

/// A name as an identifier: primes may stand, dots may not.
pub(super) fn identifier(s: &Symbol) -> String {
    let plain = s.as_str().replace('.', "_");
    if TAKEN.contains(&plain.as_str()) { format!("{plain}_") } else { plain }
}
