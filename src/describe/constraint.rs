//! One constraint with everything that follows from it.

use super::Jacobian;
use super::jacobian::rates;
use super::regime::Coefficient;
use crate::formula::{Expr, Node, Symbol};
use crate::mechanism::{Constraint, Form, Row};

/// A constraint, its generic form, its row as derived, ideal and in the model, and its derivatives.
#[derive(Clone, Debug)]
pub struct ConstraintEntry {
    /// What it constrains, such as "rear axle, direction".
    pub name: String,
    /// `R` or `T`.
    pub form: char,
    /// Equations it comes from.
    pub source: &'static str,
    /// Its creep coefficient.
    pub creep: Symbol,
    /// The parts of the generic form: π̇, σ, q̇ or s, q̇₁, p, q̇₃, σ.
    pub parts: Vec<Part>,
    /// The generic form with its parts put in: π̇ − σ·q̇ or s·q̇₁ − p·q̇₃.
    pub generic: Expr,
    /// σ is undefined where this is zero; `None` where σ is defined everywhere.
    pub singular: Option<Expr>,
    /// The row of the Pfaffian matrix with its creep coefficient: row·q̇ = 0.
    pub row: Row,
    /// The row without creep.
    pub ideal: Row,
    /// The row of the model as it stands: what effects changed put in, a coefficient that none changed zero.
    pub model: Expr,
    /// Its creep coefficient in the model as it stands.
    pub coefficient: Coefficient,
    /// Derivatives of row·q̇.
    pub jacobian: Jacobian,
}

/// A part of a generic form.
#[derive(Clone, Debug)]
pub struct Part {
    /// Its name in text.
    pub label: &'static str,
    /// Its name in LaTeX.
    pub latex: &'static str,
    /// Its formula.
    pub formula: Expr,
}

/// The generic form of a letter in text and in LaTeX, and the source of the form.
pub(super) fn form(letter: char) -> [&'static str; 3] {
    match letter {
        'R' => ["pi' - sigma*q' = 0", r"\dot{\pi} - \sigma\,\dot{q} = 0", "(8), (13), (24)"],
        _ => ["s*q1' - p*q3' = 0", r"s\,\dot{q}_{1} - p\,\dot{q}_{3} = 0", "(17), (20), (21), (25)"],
    }
}

impl ConstraintEntry {
    /// The entry of a constraint; `in_model` gives what the model puts in the place of a symbol.
    pub fn of(constraint: &Constraint, coordinates: &[Symbol], in_model: &impl Fn(&Symbol) -> Option<Expr>) -> Self {
        let order = rates(coordinates);
        let ordered = |row: Row| row.ordered(&order);
        let letter = constraint.letter();
        Self {
            name: constraint.name.clone(),
            form: letter,
            source: form(letter)[2],
            creep: constraint.creep.clone(),
            parts: parts(&constraint.form, &ordered),
            generic: constraint.generic(),
            singular: match &constraint.form {
                Form::R(_) => None,
                Form::T(t) => Some(t.s.clone()),
            },
            row: ordered(constraint.row()),
            ideal: ordered(constraint.ideal_row()),
            coefficient: Coefficient {
                creep: constraint.creep.clone(),
                form: letter,
                value: None,
                given: false,
                row_holds: true,
                limits: None,
            },
            model: in_place(&written(constraint, &order), in_model),
            jacobian: Jacobian::of(constraint, coordinates),
        }
    }

    /// The rows as derived, ideal and in the model, each with its name.
    pub fn rows(&self) -> [(&'static str, Expr); 3] {
        let model = self.model.clone();
        [("Row", self.row.expr()), ("Ideal row", self.ideal.expr()), ("Row of the model as it stands", model)]
    }

    /// Every formula of the entry.
    pub fn formulas(&self) -> Vec<Expr> {
        let parts = self.parts.iter().map(|p| p.formula.clone());
        let rows = self.rows().map(|(_, row)| row).into_iter().chain([self.jacobian.e.expr()]);
        let by_q = self.jacobian.q.iter().map(|(_, d)| d.expr());
        let by_rate = self.jacobian.rates.iter().map(|(_, c)| c.clone());
        let single = std::iter::once(self.generic.clone()).chain(self.singular.clone());
        parts.chain(single).chain(rows).chain(by_q).chain(by_rate).collect()
    }
}

/// A constraint as it is best read: type R by its σ, type T by its row.
fn written(constraint: &Constraint, order: &[Symbol]) -> Expr {
    match &constraint.form {
        Form::R(r) => &r.pi.ordered(order).expr() - &(&r.sigma * &Expr::sym(r.rate.clone())),
        Form::T(_) => constraint.row().ordered(order).expr(),
    }
}

/// Names replaced; sums of sums and products of products written as one.
fn in_place(e: &Expr, by: &impl Fn(&Symbol) -> Option<Expr>) -> Expr {
    let go = |e: &Expr| in_place(e, by);
    match e.node() {
        Node::Num(_) => e.clone(),
        Node::Sym(s) => by(s).unwrap_or_else(|| e.clone()),
        Node::Neg(x) => -&go(x),
        Node::Add(a, b) => sum(&go(a), &go(b)),
        Node::Sub(a, b) => &go(a) - &go(b),
        Node::Mul(a, b) => product(&go(a), &go(b)),
        Node::Div(a, b) => &go(a) / &go(b),
        Node::Pow(x, n) => go(x).pow(*n),
        Node::Call(f, x) => Expr::call(*f, &go(x)),
    }
}

/// a + (b + c) as a + b + c.
fn sum(a: &Expr, b: &Expr) -> Expr {
    match b.node() {
        Node::Add(c, d) => sum(&sum(a, c), d),
        Node::Sub(c, d) => &sum(a, c) - d,
        _ => a + b,
    }
}

/// a·(b·c) as a·b·c.
fn product(a: &Expr, b: &Expr) -> Expr {
    match b.node() {
        Node::Mul(c, d) => product(&product(a, c), d),
        _ => a * b,
    }
}

fn parts(form: &Form, ordered: &impl Fn(Row) -> Row) -> Vec<Part> {
    let part = |label, latex, formula| Part { label, latex, formula };
    match form {
        Form::R(r) => vec![
            part("pi'", r"\dot{\pi}", ordered(r.pi.clone()).expr()),
            part("sigma", r"\sigma", r.sigma.clone()),
            part("q'", r"\dot{q}", Expr::sym(r.rate.clone())),
        ],
        Form::T(t) => vec![
            part("s", "s", t.s.clone()),
            part("q1'", r"\dot{q}_{1}", ordered(t.q1.clone()).expr()),
            part("p", "p", t.p.clone()),
            part("q3'", r"\dot{q}_{3}", ordered(t.q3.clone()).expr()),
            part("sigma", r"\sigma", t.sigma()),
        ],
    }
}
