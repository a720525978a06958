//! The velocity of a point as a sum of rates along directions.

use super::{Heading, Row};
use crate::formula::{Expr, Symbol};

/// Σ coefficient·rate·u(heading) with unit vectors u.
///
/// ```
/// use creepage::mechanism::{Heading, Velocity};
/// use creepage::formula::Expr;
/// // The front axle of a car, L ahead of the reference point.
/// let front = Velocity::of_reference_point().at_offset(&Heading::along("phi"), &Expr::sym("L"));
/// let sideways = front.along(&Heading::along("phi").turned_by("delta").left());
/// assert_eq!(sideways.to_string(), "-sin(phi + delta)*x' + cos(phi + delta)*y' + cos(delta)*L*phi'");
/// ```
#[derive(Clone, Debug, Default)]
pub struct Velocity {
    terms: Vec<(Expr, Symbol, Heading)>,
}

impl Velocity {
    /// ẋ·u(x) + ẏ·u(y): the reference point in the world's coordinates.
    pub fn of_reference_point() -> Self {
        let one = Expr::int(1);
        Self { terms: vec![(one.clone(), "x'".into(), Heading::x()), (one, "y'".into(), Heading::y())] }
    }

    /// `forward`·u(heading) + `sideways`·u(heading + 90°): a velocity by its components in a body.
    pub fn in_body(forward: impl Into<Symbol>, sideways: impl Into<Symbol>, heading: &Heading) -> Self {
        let one = Expr::int(1);
        Self { terms: vec![(one.clone(), forward.into(), heading.clone()), (one, sideways.into(), heading.left())] }
    }

    /// `speed`·u(heading): motion along a line.
    pub fn along_line(speed: impl Into<Symbol>, heading: &Heading) -> Self {
        Self { terms: vec![(Expr::int(1), speed.into(), heading.clone())] }
    }

    /// The velocity of a point `length` further along a turning direction: adds length·d/dt u(heading).
    pub fn at_offset(&self, heading: &Heading, length: &Expr) -> Self {
        let mut v = self.clone();
        for (angle, n) in heading.angles() {
            let coefficient = &Expr::int(i64::from(*n)) * length;
            v.terms.push((coefficient, angle.rate(), heading.left()));
        }
        v.terms.retain(|(c, _, _)| !c.is_zero());
        v
    }

    /// The component along a direction, as a linear form in the rates.
    pub fn along(&self, direction: &Heading) -> Row {
        let mut row = Row::default();
        for (coefficient, rate, heading) in &self.terms {
            row.add(rate.clone(), &(coefficient * &heading.cos_from(direction)));
        }
        row
    }
}
