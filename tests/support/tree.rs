//! Random formulas, as trees of the tests' own: what they mean is known without the library.

use super::rounding::finite;
use creepage::formula::{Expr, Fun, Node};
use proptest::prelude::*;
use std::fmt::Write;

/// The names random formulas are made of.
pub const NAMES: [&str; 8] = ["x", "y", "e_rc", "phi", "theta'", "v_l''", "rear.left_2", "φ"];

/// A random formula.
#[derive(Clone, Debug)]
pub enum Tree {
    Num(String),
    Sym(usize),
    Neg(Box<Tree>),
    Two(char, Box<Tree>, Box<Tree>),
    Pow(Box<Tree>, i32),
    Call(Fun, Box<Tree>),
}

/// Numbers as a person may write them, exactly representable or not.
pub fn number_text() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => (0u32..13).prop_map(|n| n.to_string()),
        2 => "[0-9]{1,3}\\.[0-9]{1,4}",
        1 => "\\.[0-9]{1,4}",
        1 => "[0-9]{1,2}\\.",
        1 => "[1-9](\\.[0-9]{1,3})?[eE][+-]?[0-2]",
    ]
}

/// Any form the parser can build, nested up to seven deep.
pub fn trees() -> impl Strategy<Value = Tree> {
    trees_of(number_text().boxed(), 64)
}

/// Formulas whose constants are small whole numbers and whose powers are small.
pub fn small_trees() -> impl Strategy<Value = Tree> {
    trees_of((0u32..4).prop_map(|n| n.to_string()).boxed(), 4)
}

fn trees_of(numbers: BoxedStrategy<String>, power: i32) -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![numbers.prop_map(Tree::Num), (0..NAMES.len()).prop_map(Tree::Sym)];
    let powers = prop_oneof![4 => -3i32..5, 1 => -power..=power].prop_map(move |n| n.clamp(-power, power));
    leaf.prop_recursive(6, 40, 2, move |inner| {
        let two = (prop::sample::select(vec!['+', '-', '*', '/']), inner.clone(), inner.clone());
        prop_oneof![
            1 => inner.clone().prop_map(|x| Tree::Neg(x.into())),
            4 => two.prop_map(|(op, a, b)| Tree::Two(op, a.into(), b.into())),
            1 => (inner.clone(), powers.clone()).prop_map(|(x, n)| Tree::Pow(x.into(), n)),
            1 => (functions(), inner).prop_map(|(f, x)| Tree::Call(f, x.into())),
        ]
    })
}

pub fn functions() -> impl Strategy<Value = Fun> {
    prop::sample::select(Fun::all().collect::<Vec<_>>())
}

/// Random formulas read by the library.
pub fn formulas() -> impl Strategy<Value = Expr> {
    trees().prop_map(|t| t.expr())
}

/// Random formulas with small numbers, read by the library.
pub fn small_formulas() -> impl Strategy<Value = Expr> {
    small_trees().prop_map(|t| t.expr())
}

impl Tree {
    /// Every part in parentheses, so that no precedence is needed to read it.
    pub fn text(&self) -> String {
        match self {
            Tree::Num(n) => n.clone(),
            Tree::Sym(k) => NAMES[*k].to_string(),
            Tree::Neg(x) => format!("(-{})", x.text()),
            Tree::Two(op, a, b) => format!("({}{op}{})", a.text(), b.text()),
            Tree::Pow(x, n) => format!("(({})^{n})", x.text()),
            Tree::Call(f, x) => format!("{}({})", f.name(), x.text()),
        }
    }

    /// The same with white space, typographic operators and needless parentheses, driven by `taste`.
    pub fn loose_text(&self, taste: &[u8]) -> String {
        let mut text = String::new();
        for (i, c) in self.text().chars().enumerate() {
            let inside_number = c == '+' && text.ends_with(['e', 'E']);
            let taste = if inside_number { 0 } else { taste[i % taste.len()] };
            match (c, taste % 4) {
                ('-', 1) => text.push('−'),
                ('*', 1) => text.push('·'),
                ('\'', 1) => text.push('′'),
                ('(', 2) => text.push_str("( "),
                (')', 2) => text.push_str("\t)"),
                ('+' | '*' | '/', 3) => drop(write!(text, "\n{c} ")),
                _ => text.push(c),
            }
        }
        if taste[0].is_multiple_of(2) { text } else { format!(" (({text}) )") }
    }

    pub fn expr(&self) -> Expr {
        Expr::parse(&self.text()).unwrap_or_else(|e| panic!("{e}"))
    }

    /// Whether the library read exactly this form.
    pub fn is_form_of(&self, e: &Expr) -> bool {
        match (self, e.node()) {
            (Tree::Num(n), Node::Num(_)) => e.eval(&|_| 0.0) == n.parse().ok(),
            (Tree::Sym(k), Node::Sym(s)) => s.as_str() == NAMES[*k],
            (Tree::Neg(x), Node::Neg(e)) => x.is_form_of(e),
            (Tree::Two('+', a, b), Node::Add(c, d))
            | (Tree::Two('-', a, b), Node::Sub(c, d))
            | (Tree::Two('*', a, b), Node::Mul(c, d))
            | (Tree::Two('/', a, b), Node::Div(c, d)) => a.is_form_of(c) && b.is_form_of(d),
            (Tree::Pow(x, n), Node::Pow(e, m)) => n == m && x.is_form_of(e),
            (Tree::Call(f, x), Node::Call(g, e)) => f == g && x.is_form_of(e),
            _ => false,
        }
    }

    /// Its value by plain arithmetic; NaN where it has none.
    pub fn value(&self, at: &[f64; 8]) -> f64 {
        finite(match self {
            Tree::Num(n) => n.parse().unwrap_or(f64::NAN),
            Tree::Sym(k) => at[*k],
            Tree::Neg(x) => -x.value(at),
            Tree::Two('+', a, b) => a.value(at) + b.value(at),
            Tree::Two('-', a, b) => a.value(at) - b.value(at),
            Tree::Two('*', a, b) => a.value(at) * b.value(at),
            Tree::Two(_, a, b) => a.value(at) / b.value(at),
            Tree::Pow(x, n) if *n < 0 => 1.0 / finite(x.value(at).powi(-n)),
            Tree::Pow(x, n) => finite(x.value(at)).powi(*n) + 0.0 * x.value(at),
            Tree::Call(f, x) => function(*f, x.value(at)),
        })
    }
}

/// The functions of the language by the standard library.
pub fn function(f: Fun, x: f64) -> f64 {
    match f {
        Fun::Sin => x.sin(),
        Fun::Cos => x.cos(),
        Fun::Tan => x.tan(),
        Fun::Cot => x.tan().recip(),
        Fun::Asin => x.asin(),
        Fun::Acos => x.acos(),
        Fun::Atan => x.atan(),
        Fun::Tanh => x.tanh(),
        Fun::Exp => x.exp(),
        Fun::Ln => x.ln(),
        Fun::Sqrt => x.sqrt(),
        Fun::Abs => x.abs(),
        Fun::Sign if x == 0.0 => 0.0,
        Fun::Sign => x.signum(),
        Fun::Step if !x.is_finite() => f64::NAN,
        Fun::Step => f64::from(u8::from(x > 0.0)),
    }
}

/// The value of a name at a point.
pub fn named(at: &[f64; 8], name: &str) -> f64 {
    NAMES.iter().position(|n| *n == name).map_or(f64::NAN, |k| at[k])
}

/// Values for all names.
pub fn points() -> impl Strategy<Value = [f64; 8]> {
    prop::array::uniform8(super::modest())
}
