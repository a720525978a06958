//! Expressions written in a notation for the page; the differences between notations are data.

use super::print::{Bind, bind, decimal};
use super::{Expr, Fun, Node, Symbol};

/// A notation: what it writes before, between and behind the parts of a formula.
pub(super) struct Markup {
    pub round: [&'static str; 2],
    pub fraction: [&'static str; 3],
    pub power: [&'static str; 2],
    /// Between factors.
    pub times: &'static str,
    /// Between factors where the second begins with a digit: 2·3 is not 23.
    pub dot: &'static str,
    /// A function's name and what stands around its argument.
    pub call: fn(Fun) -> (&'static str, [&'static str; 2]),
    /// Before the name of a Greek letter.
    pub greek: &'static str,
    /// Around a name of several letters.
    pub word: [&'static str; 2],
    /// Around a name with one prime, and with two.
    pub dots: [[&'static str; 2]; 2],
    /// Around a name and its number of primes, when they are more.
    pub order: [&'static str; 3],
    pub subscript: [&'static str; 2],
}

/// Greek names that LaTeX and Typst know under the same name.
const GREEK: &[&str] = &[
    "alpha", "beta", "gamma", "delta", "epsilon", "eta", "theta", "kappa", "lambda", "mu", "nu", "xi", "pi", "rho",
    "sigma", "tau", "phi", "chi", "psi", "omega", "Delta", "Omega", "Phi", "Psi",
];

impl Markup {
    /// An expression.
    pub fn expr(&self, e: &Expr) -> String {
        match e.node() {
            Node::Num(v) => decimal(v),
            Node::Sym(s) => self.symbol(s),
            Node::Neg(x) => format!("-{}", self.later(x, Bind::Product)),
            Node::Add(a, b) => format!("{} + {}", self.part(a, Bind::Sum), self.later(b, Bind::Product)),
            Node::Sub(a, b) => format!("{} - {}", self.part(a, Bind::Sum), self.later(b, Bind::Product)),
            Node::Mul(a, b) => self.product(a, b),
            Node::Div(a, b) => parted(self.fraction, &self.expr(a), &self.expr(b)),
            Node::Pow(x, n) => format!("{}^{}", self.part(x, Bind::Atom), around(self.power, &n.to_string())),
            Node::Call(f, x) => {
                let (name, brackets) = (self.call)(*f);
                format!("{name}{}", around(brackets, &self.expr(x)))
            }
        }
    }

    /// A part in a place that asks for a binding; a fraction is drawn as one thing.
    fn part(&self, e: &Expr, wanted: Bind) -> String {
        let fraction = matches!(e.node(), Node::Div(..)) && wanted != Bind::Atom;
        let text = self.expr(e);
        if bind(e) < wanted && !fraction { around(self.round, &text) } else { text }
    }

    /// A part after an operator: the sign of a factor would be read as a minus.
    fn later(&self, e: &Expr, wanted: Bind) -> String {
        let text = self.part(e, wanted);
        if text.starts_with('-') { around(self.round, &text) } else { text }
    }

    fn product(&self, a: &Expr, b: &Expr) -> String {
        let (left, right) = (self.part(a, Bind::Product), self.later(b, Bind::Factor));
        let digit = right.starts_with(|c: char| c.is_ascii_digit());
        parted(["", if digit { self.dot } else { self.times }, ""], &left, &right)
    }

    /// A name: Greek letters, subscripts after `_`, dots for primes.
    pub fn symbol(&self, s: &Symbol) -> String {
        let text = s.as_str();
        let stem = text.trim_end_matches('\'');
        let primes = text.len() - stem.len();
        let stem = stem.rsplit('.').next().unwrap_or(stem);
        let (letter, subscript) = stem.split_once('_').unwrap_or((stem, ""));
        let letter = match letter {
            l if GREEK.contains(&l) => format!("{}{l}", self.greek),
            l if l.chars().count() > 1 => around(self.word, l),
            l => l.to_string(),
        };
        let dotted = match primes {
            0 => letter,
            1 | 2 => around(self.dots[primes - 1], &letter),
            n => parted(self.order, &letter, &n.to_string()),
        };
        match subscript {
            "" => dotted,
            s => format!("{dotted}_{}", around(self.subscript, &s.replace('_', ","))),
        }
    }
}

fn around([before, behind]: [&str; 2], text: &str) -> String {
    format!("{before}{text}{behind}")
}

fn parted([before, between, behind]: [&str; 3], a: &str, b: &str) -> String {
    format!("{before}{a}{between}{b}{behind}")
}
