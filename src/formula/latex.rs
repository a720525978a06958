//! Expressions written as LaTeX.

use super::markup::Markup;
use super::{Expr, Fun, Symbol};

const ROUND: [&str; 2] = [r"\left(", r"\right)"];

const LATEX: Markup = Markup {
    round: ROUND,
    fraction: [r"\frac{", "}{", "}"],
    power: ["{", "}"],
    times: r"\,",
    dot: r"\cdot ",
    call,
    greek: r"\",
    word: [r"\mathrm{", "}"],
    dots: [[r"\dot{", "}"], [r"\ddot{", "}"]],
    // Braces, because the name may be raised to a power.
    order: ["{", "^{(", ")}}"],
    subscript: ["{", "}"],
};

fn call(f: Fun) -> (&'static str, [&'static str; 2]) {
    match f {
        Fun::Sqrt => (f.latex(), ["{", "}"]),
        Fun::Abs => ("", [r"\left|", r"\right|"]),
        f => (f.latex(), ROUND),
    }
}

impl Expr {
    /// The expression in LaTeX's mathematics mode.
    ///
    /// ```
    /// use creepage::formula::Expr;
    /// let e = Expr::parse("-phi'*v_l/(1 - e_rc)^2").unwrap();
    /// assert_eq!(e.latex(), r"-\frac{\dot{\phi}\,v_{l}}{\left(1 - e_{rc}\right)^{2}}");
    /// ```
    pub fn latex(&self) -> String {
        LATEX.expr(self)
    }
}

/// A name in LaTeX: Greek letters, subscripts after `_`, dots for primes.
pub fn latex_symbol(s: &Symbol) -> String {
    LATEX.symbol(s)
}
