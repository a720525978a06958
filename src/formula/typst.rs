//! Expressions written as Typst.

use super::markup::Markup;
use super::{Expr, Fun};

const ROUND: [&str; 2] = ["(", ")"];

const TYPST: Markup = Markup {
    round: ROUND,
    fraction: ["frac(", ", ", ")"],
    power: ["(", ")"],
    times: " thin ",
    dot: " dot.op ",
    call,
    greek: "",
    word: ["\"", "\""],
    dots: [["dot(", ")"], ["dot.double(", ")"]],
    order: ["", "^((", "))"],
    subscript: ["\"", "\""],
};

fn call(f: Fun) -> (&'static str, [&'static str; 2]) {
    let name = match f {
        Fun::Asin => "arcsin",
        Fun::Acos => "arccos",
        Fun::Atan => "arctan",
        Fun::Sign => "op(\"sgn\")",
        Fun::Step => "op(\"H\")",
        f => f.name(),
    };
    (name, ROUND)
}

impl Expr {
    /// The expression in Typst's mathematics mode.
    ///
    /// ```
    /// use creepage::formula::Expr;
    /// let e = Expr::parse("-phi'*v_l/(1 - e_rc)^2").unwrap();
    /// assert_eq!(e.typst(), r#"-frac(dot(phi) thin v_"l", (1 - e_"rc")^(2))"#);
    /// ```
    pub fn typst(&self) -> String {
        TYPST.expr(self)
    }
}
