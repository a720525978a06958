//! The languages that code is written in: how each spells numbers, functions and statements.

use crate::formula::{Expr, Fun, Node, Symbol, nearest_f64};

/// A language of exported code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// C99.
    C,
    /// C++11.
    Cpp,
    /// Python 3.
    Python,
    /// Rust 2021.
    Rust,
}

impl Language {
    /// A formula.
    pub(super) fn expression(self, e: &Expr) -> String {
        let go = |e: &Expr| self.expression(e);
        match e.node() {
            Node::Num(v) => format!("{:?}", nearest_f64(v)),
            Node::Sym(s) => identifier(s),
            Node::Neg(x) => format!("(-{})", go(x)),
            Node::Add(a, b) => format!("({} + {})", go(a), go(b)),
            Node::Sub(a, b) => format!("({} - {})", go(a), go(b)),
            Node::Mul(a, b) => format!("({}*{})", go(a), go(b)),
            Node::Div(a, b) => format!("({}/{})", go(a), go(b)),
            Node::Pow(x, n) => self.power(&go(x), *n),
            Node::Call(f, x) => self.call(*f, &go(x)),
        }
    }

    fn power(self, x: &str, n: i32) -> String {
        match self {
            Self::C => format!("pow({x}, {n})"),
            Self::Cpp => format!("std::pow({x}, {n})"),
            Self::Python => format!("({x})**({n})"),
            Self::Rust => format!("({x}).powi({n})"),
        }
    }

    fn call(self, f: Fun, x: &str) -> String {
        let name = match f {
            Fun::Cot => return format!("(1.0/{})", self.call(Fun::Tan, x)),
            Fun::Sign => return format!("creepage_sign({x})"),
            Fun::Step => return format!("creepage_heaviside({x})"),
            Fun::Ln if self == Self::Rust => "ln",
            Fun::Ln => "log",
            Fun::Abs if self == Self::Rust => "abs",
            Fun::Abs => "fabs",
            other => other.name(),
        };
        match self {
            Self::C => format!("{name}({x})"),
            Self::Cpp => format!("std::{name}({x})"),
            Self::Python => format!("math.{name}({x})"),
            Self::Rust => format!("({x}).{name}()"),
        }
    }

    /// A value with a name.
    pub(super) fn constant(self, name: &Symbol, value: &str) -> String {
        let name = identifier(name);
        match self {
            Self::C | Self::Cpp => format!("    const double {name} = {value};\n"),
            Self::Python => format!("    {name} = {value}\n"),
            Self::Rust => format!("    let {name}: f64 = {value};\n"),
        }
    }

    /// The begin of a comment in a line.
    pub(super) fn comment(self) -> &'static str {
        match self {
            Self::Python => "#",
            _ => "//",
        }
    }

    /// The text around the rates and their derivatives.
    pub(super) fn template(self) -> String {
        let c = include_str!("templates/step.c");
        match self {
            Self::C => c.into(),
            Self::Cpp => c.replace("<math.h>", "<cmath>"),
            Self::Python => include_str!("templates/step.py").into(),
            Self::Rust => include_str!("templates/step.rs.txt").into(),
        }
    }

    /// What follows an assignment.
    pub(super) fn end(self) -> &'static str {
        if self == Self::Python { "" } else { ";" }
    }

    /// A list of numbers.
    pub(super) fn list(self, items: &[String]) -> String {
        match self {
            Self::C | Self::Cpp => format!("{{{}}}", items.join(", ")),
            _ => format!("[{}]", items.join(", ")),
        }
    }
}

/// A name that is no word of any of these languages.
pub(super) fn identifier(s: &Symbol) -> String {
    format!("{}_", s.as_str().replace('\'', "_rate").replace('.', "_"))
}
