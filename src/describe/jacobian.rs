//! The Jacobian of a constraint: its partial derivatives by coordinates, rates and coefficient.

use crate::formula::{Expr, Symbol};
use crate::mechanism::{Constraint, Row};

/// The partial derivatives of g = row·q̇; those that are zero everywhere are left out.
///
/// | derivative | closed form for a single wheel |
/// |---|---|
/// | ∂g/∂φ | type T: (cos φ − e·sin φ)·ẋ + (sin φ + e·cos φ)·ẏ, which is v_l + e·v_t |
/// | ∂g/∂q̇ | the row |
/// | ∂g/∂e | type T: cos φ·ẋ + sin φ·ẏ, which is v_l; type R: r·θ̇ |
#[derive(Clone, Debug)]
pub struct Jacobian {
    /// ∂g/∂q, each a linear form in the rates.
    pub q: Vec<(Symbol, Row)>,
    /// ∂g/∂q̇.
    pub rates: Vec<(Symbol, Expr)>,
    /// ∂g/∂e for the constraint's own coefficient, a linear form in the rates.
    pub e: Row,
}

impl Jacobian {
    /// The derivatives of a constraint with respect to the given coordinates, the rates and its coefficient.
    pub fn of(constraint: &Constraint, coordinates: &[Symbol]) -> Self {
        let row = constraint.row().ordered(&rates(coordinates));
        let q = coordinates.iter().map(|q| (q.clone(), derivative(&row, q)));
        Self {
            q: q.filter(|(_, d)| !d.terms().is_empty()).collect(),
            rates: row.terms().to_vec(),
            e: derivative(&row, &constraint.creep),
        }
    }
}

/// The derivative of the coefficients of a row.
fn derivative(row: &Row, by: &Symbol) -> Row {
    let mut d = Row::default();
    row.terms().iter().for_each(|(rate, c)| d.add(rate.clone(), &c.derivative(by)));
    d
}

/// The rates of coordinates.
pub(super) fn rates(coordinates: &[Symbol]) -> Vec<Symbol> {
    coordinates.iter().map(Symbol::rate).collect()
}
