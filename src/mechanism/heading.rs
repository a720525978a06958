//! A direction in the plane, as a sum of angles, with its unit vectors.

use crate::formula::{Expr, Fun, Symbol};

/// A direction: a whole combination of angles plus quarter turns, measured counter-clockwise from x.
///
/// Keeping angles as a sum, and not as sines and cosines, is what lets a derived row come out as
/// cos(δ) where a product of sines and cosines of φ and φ + δ went in.
///
/// ```
/// use creepage::mechanism::Heading;
/// let body = Heading::along("phi");
/// let wheel = body.turned_by("delta");
/// assert_eq!(wheel.cos_from(&body).to_string(), "cos(delta)");
/// assert_eq!(wheel.left().cos_from(&Heading::x()).to_string(), "-sin(phi + delta)");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Heading {
    angles: Vec<(Symbol, i32)>,
    quarters: i32,
}

impl Heading {
    /// The x axis.
    pub fn x() -> Self {
        Self { angles: vec![], quarters: 0 }
    }

    /// The y axis.
    pub fn y() -> Self {
        Self::x().left()
    }

    /// The direction at an angle from x.
    pub fn along(angle: impl Into<Symbol>) -> Self {
        Self::x().turned_by(angle)
    }

    /// Turned counter-clockwise by an angle.
    pub fn turned_by(&self, angle: impl Into<Symbol>) -> Self {
        let mut h = self.clone();
        h.add(angle.into(), 1);
        h
    }

    /// Turned left by a right angle.
    pub fn left(&self) -> Self {
        Self { quarters: self.quarters + 1, ..self.clone() }
    }

    /// The angles of the direction with their multiples.
    pub fn angles(&self) -> &[(Symbol, i32)] {
        &self.angles
    }

    fn add(&mut self, angle: Symbol, times: i32) {
        match self.angles.iter_mut().find(|(a, _)| *a == angle) {
            Some((_, n)) => *n += times,
            None => self.angles.push((angle, times)),
        }
        self.angles.retain(|(_, n)| *n != 0);
    }

    /// The cosine of the angle between two directions: the scalar product of their unit vectors.
    pub fn cos_from(&self, other: &Heading) -> Expr {
        let mut between = self.clone();
        other.angles.iter().for_each(|(a, n)| between.add(a.clone(), -n));
        between.quarters -= other.quarters;
        // cos(−x − kπ/2) = cos(x + kπ/2): the first angle is written positive.
        if between.angles.first().is_some_and(|(_, n)| *n < 0) {
            between.angles.iter_mut().for_each(|(_, n)| *n = -*n);
            between.quarters = -between.quarters;
        }
        between.cos()
    }

    /// The cosine of the direction's angle from x.
    pub fn cos(&self) -> Expr {
        let quarters = self.quarters.rem_euclid(4);
        let value = match (self.angle(), quarters % 2) {
            (None, 0) => Expr::int(1),
            (None, _) => return Expr::int(0),
            (Some(angle), 0) => Expr::call(Fun::Cos, &angle),
            (Some(angle), _) => Expr::call(Fun::Sin, &angle),
        };
        if matches!(quarters, 1 | 2) { -&value } else { value }
    }

    /// The sum of the angles, `None` for no angle.
    fn angle(&self) -> Option<Expr> {
        let term = |(a, n): &(Symbol, i32)| &Expr::int(i64::from(*n)) * &Expr::sym(a.clone());
        self.angles.iter().map(term).reduce(|sum, t| &sum + &t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_sines_with_the_right_sign() {
        let cos_of = |quarters: i32, x: f64| {
            let h = Heading { angles: vec![("a".into(), 1)], quarters };
            h.cos().eval(&|_| x).unwrap()
        };
        for quarters in -5..6 {
            let expected = (0.3 + f64::from(quarters) * std::f64::consts::FRAC_PI_2).cos();
            assert!((cos_of(quarters, 0.3) - expected).abs() < 1e-15, "{quarters}");
        }
    }
}
