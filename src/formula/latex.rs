//! Expressions to LaTeX.

use super::print::{Bind, bind, decimal};
use super::{Expr, Fun, Node, Symbol};

/// Greek names that LaTeX and Typst know under the same name.
pub(super) const GREEK: &[&str] = &[
    "alpha", "beta", "gamma", "delta", "epsilon", "eta", "theta", "kappa", "lambda", "mu", "nu", "xi", "pi", "rho",
    "sigma", "tau", "phi", "chi", "psi", "omega", "Delta", "Omega", "Phi", "Psi",
];

impl Expr {
    /// The expression in LaTeX's mathematics mode.
    ///
    /// ```
    /// use creepage::formula::Expr;
    /// let e = Expr::parse("-phi'*v_l/(1 - e_rc)^2").unwrap();
    /// assert_eq!(e.latex(), r"-\frac{\dot{\phi}\,v_{l}}{\left(1 - e_{rc}\right)^{2}}");
    /// ```
    pub fn latex(&self) -> String {
        match self.node() {
            Node::Num(v) => decimal(v),
            Node::Sym(s) => latex_symbol(s),
            Node::Neg(x) => format!("-{}", later(x, Bind::Product)),
            Node::Add(a, b) => format!("{} + {}", part(a, Bind::Sum), later(b, Bind::Product)),
            Node::Sub(a, b) => format!("{} - {}", part(a, Bind::Sum), later(b, Bind::Product)),
            Node::Mul(a, b) => product(a, b),
            Node::Div(a, b) => format!("\\frac{{{}}}{{{}}}", a.latex(), b.latex()),
            Node::Pow(x, n) => format!("{}^{{{n}}}", part(x, Bind::Atom)),
            Node::Call(Fun::Sqrt, x) => format!("\\sqrt{{{}}}", x.latex()),
            Node::Call(Fun::Abs, x) => format!("\\left|{}\\right|", x.latex()),
            Node::Call(f, x) => format!("{}\\left({}\\right)", f.latex(), x.latex()),
        }
    }
}

/// A part in a place that asks for a binding; a fraction is drawn as one thing.
fn part(e: &Expr, wanted: Bind) -> String {
    let fraction = matches!(e.node(), Node::Div(..)) && wanted != Bind::Atom;
    if bind(e) < wanted && !fraction { format!("\\left({}\\right)", e.latex()) } else { e.latex() }
}

/// A product; only a dot keeps 2·3 from being read as 23.
fn product(a: &Expr, b: &Expr) -> String {
    let (left, right) = (part(a, Bind::Product), later(b, Bind::Factor));
    let dot = if right.starts_with(|c: char| c.is_ascii_digit()) { r"\cdot " } else { r"\," };
    format!("{left}{dot}{right}")
}

/// A part after an operator: in a\,-b the sign of a factor would be read as a minus.
fn later(e: &Expr, wanted: Bind) -> String {
    let text = part(e, wanted);
    if text.starts_with('-') { format!("\\left({text}\\right)") } else { text }
}

/// A name in LaTeX: Greek letters, subscripts after `_`, dots for primes.
pub fn latex_symbol(s: &Symbol) -> String {
    let text = s.as_str();
    let stem = text.trim_end_matches('\'');
    let primes = text.len() - stem.len();
    let stem = stem.rsplit('.').next().unwrap_or(stem);
    let (letter, subscript) = stem.split_once('_').unwrap_or((stem, ""));
    let letter = match letter {
        l if GREEK.contains(&l) => format!("\\{l}"),
        l if l.chars().count() > 1 => format!("\\mathrm{{{l}}}"),
        l => l.to_string(),
    };
    let dotted = match primes {
        0 => letter,
        1 => format!("\\dot{{{letter}}}"),
        2 => format!("\\ddot{{{letter}}}"),
        // Braces, because the name may be raised to a power.
        n => format!("{{{letter}^{{({n})}}}}"),
    };
    match subscript {
        "" => dotted,
        s => format!("{dotted}_{{{}}}", s.replace('_', ",")),
    }
}
