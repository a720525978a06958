//! A mechanism: coordinates with the constraints on their rates.

use super::{Constraint, Row};
use crate::formula::{Expr, Symbol};

/// What the geometry of motion is asked of: coordinates q and constraints A(q, e)·q̇ = 0.
///
/// | symbol | meaning |
/// |---|---|
/// | q | coordinates: pose, steering and castor angles, angles of the wheels, headings of trailers |
/// | A | Pfaffian matrix, a row for each constraint |
/// | e | coefficients of creep; zero is ideal |
#[derive(Clone, Debug)]
pub struct Mechanism {
    /// q.
    pub coordinates: Vec<Symbol>,
    /// The constraints, one row each.
    pub constraints: Vec<Constraint>,
}

impl Mechanism {
    /// The rows of A(q, e).
    pub fn rows(&self) -> Vec<Row> {
        self.constraints.iter().map(Constraint::row).collect()
    }

    /// The rows of A(q, 0).
    pub fn ideal_rows(&self) -> Vec<Row> {
        self.constraints.iter().map(Constraint::ideal_row).collect()
    }

    /// The mechanism with names replaced in the coefficients of its constraints; a name may stand for a formula of
    /// coordinates, such as the angle of an inner wheel.
    pub fn substitute(&self, by: &impl Fn(&Symbol) -> Option<Expr>) -> Self {
        let constraints = self.constraints.iter().map(|c| c.substitute(by)).collect();
        Self { coordinates: self.coordinates.clone(), constraints }
    }
}
