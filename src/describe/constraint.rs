//! The description of one constraint: its forms, its derivatives and its coefficient.

use super::Jacobian;
use super::jacobian::rates;
use super::regime::Coefficient;
use crate::formula::{Expr, Node, Symbol};
use crate::mechanism::{Constraint, ConstraintType, Printed, Row};

/// A constraint, its generic form, its row as derived, ideal and in the model, and its derivatives.
///
/// ```
/// let wheel = creepage::Model::new("unicycle", &[("wheel_radius", 0.5)])?;
/// let description = creepage::describe(&wheel)?;
/// let rolling: &creepage::describe::ConstraintEntry = &description.constraints[0];
/// assert_eq!(rolling.creep.as_str(), "e_rc");
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct ConstraintEntry {
    /// What it constrains, such as "rear axle, direction".
    pub name: String,
    /// Its type: the generic form, its letter, its source.
    pub kind: ConstraintType,
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
    /// The force that holds it in place of the row, where a law gives its contact one.
    pub held_by: Option<Symbol>,
    /// Its creep coefficient in the model as it stands.
    pub coefficient: Coefficient,
    /// Derivatives of row·q̇.
    pub jacobian: Jacobian,
}

/// A part of a generic form.
#[derive(Clone, Debug)]
pub struct Part {
    /// Its name in text.
    pub label: String,
    /// Its name in LaTeX.
    pub latex: String,
    /// Its formula.
    pub formula: Expr,
}

impl ConstraintEntry {
    /// The entry of a constraint; `in_model` gives what the model puts in the place of a symbol.
    pub fn of(constraint: &Constraint, coordinates: &[Symbol], in_model: &impl Fn(&Symbol) -> Option<Expr>) -> Self {
        let order = rates(coordinates);
        let ordered = |row: Row| row.ordered(&order);
        Self {
            name: constraint.name.clone(),
            kind: constraint.kind().clone(),
            creep: constraint.creep.clone(),
            parts: parts(constraint, &order),
            generic: constraint.generic(),
            singular: constraint.form.singular(),
            row: ordered(constraint.row()),
            ideal: ordered(constraint.ideal_row()),
            coefficient: Coefficient {
                creep: constraint.creep.clone(),
                kind: constraint.kind().clone(),
                value: None,
                given: false,
                row_holds: true,
                limits: None,
            },
            held_by: None,
            model: in_place(&written(constraint, &order), in_model),
            jacobian: Jacobian::of(constraint, coordinates),
        }
    }

    /// Where the type comes from, as the end of a sentence.
    pub(super) fn source(&self) -> String {
        match self.kind.source.as_str() {
            "" => String::new(),
            source => format!("; equations {source}"),
        }
    }

    /// Whether the form speaks of a σ.
    pub(super) fn has_sigma(&self) -> bool {
        self.parts.iter().any(|p| p.label == "sigma")
    }

    /// The rows as derived, ideal and in the model, each with its name.
    pub fn rows(&self) -> [(&'static str, Expr); 3] {
        let model = self.model.clone();
        [("Row", self.row.expr()), ("Ideal row", self.ideal.expr()), ("Row of the model as it stands", model)]
    }

    /// The rows that hold: where a force holds the contact that of the model does not.
    pub(super) fn told_rows(&self) -> impl Iterator<Item = (&'static str, Expr)> {
        self.rows().into_iter().take(if self.held_by.is_some() { 2 } else { 3 })
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
    match constraint.kind().printed {
        Printed::Form => constraint.form.expr(order, &constraint.creep),
        Printed::Row => constraint.row().ordered(order).expr(),
    }
}

/// Names replaced; sums of sums and products of products written as one.
fn in_place(e: &Expr, by: &impl Fn(&Symbol) -> Option<Expr>) -> Expr {
    let go = |e: &Expr| in_place(e, by);
    match e.node() {
        Node::Sym(s) => by(s).unwrap_or_else(|| e.clone()),
        Node::Add(a, b) => sum(&go(a), &go(b)),
        Node::Mul(a, b) => product(&go(a), &go(b)),
        _ => e.with_parts(go),
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

fn parts(constraint: &Constraint, order: &[Symbol]) -> Vec<Part> {
    let filled = constraint.kind().slots.iter().filter_map(|slot| {
        let part = constraint.form.slot(slot.name.as_str())?;
        Some(Part { label: slot.name.to_string(), latex: slot.in_latex(), formula: part.ordered(order) })
    });
    filled.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_sums_and_products_of_products_are_one() {
        let written = |text: &str| {
            let twice = |s: &Symbol| (s.as_str() == "d").then(|| Expr::parse("p - q").unwrap());
            in_place(&Expr::parse(text).unwrap(), &twice).to_string()
        };
        assert_eq!(written("a + (b - c)"), "a + b - c");
        assert_eq!(written("a + (b + c)"), "a + b + c");
        assert_eq!(written("a + d"), "a + p - q");
        assert_eq!(written("a - d"), "a - (p - q)");
        assert_eq!(written("a*(b*c)"), "a*b*c");
        assert_eq!(written("a*d"), "a*(p - q)");
    }
}
