//! Random rational points for evaluating formulas exactly, the same in every run.

use super::Point;
use crate::formula::{BigRational, Exact, Expr, Symbol};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeSet;

/// Draws values: the same ones in every run.
pub(crate) struct Samples {
    source: ChaCha8Rng,
    angles: BTreeSet<Symbol>,
}

impl Samples {
    /// Values for the symbols of formulas.
    pub(crate) fn of<'a>(formulas: impl Iterator<Item = &'a Expr>) -> Self {
        let angles = formulas.flat_map(Expr::angles).collect();
        Self { source: ChaCha8Rng::seed_from_u64(0x6372_6565_7061_6765), angles }
    }

    /// Whether a symbol stands for an angle: the formulas take its sine, cosine or tangent.
    pub(crate) fn is_angle(&self, symbol: &Symbol) -> bool {
        self.angles.contains(symbol)
    }

    /// A positive rational number.
    pub(crate) fn number(&mut self) -> BigRational {
        let (p, q) = (self.source.random_range(1..60), self.source.random_range(1..12));
        BigRational::from_parts_signed(p.into(), q.into())
    }

    /// An angle that is no multiple of a right angle, where formulas would vanish that do not elsewhere.
    fn angle(&mut self) -> Exact {
        let (p, q) = (self.source.random_range(1..30), self.source.random_range(1..30));
        let p = if p == q { p + 1 } else { p };
        Exact::half_tangent(if self.source.random() { p } else { -p }, q)
    }

    /// A value of the kind the symbol has.
    pub(crate) fn value(&mut self, symbol: &Symbol) -> Exact {
        match self.is_angle(symbol) {
            true => self.angle(),
            false => Exact::rational(self.number()),
        }
    }

    /// A point with new values for these symbols and the values of another for the rest.
    pub(crate) fn point(&mut self, symbols: &[Symbol], others: &Point) -> Point {
        let mut point = others.clone();
        symbols.iter().for_each(|s| point.set(s.clone(), self.value(s)));
        point
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_traits::Signed;

    #[test]
    fn angles_turn_to_both_sides_and_are_no_multiple_of_a_right_angle() {
        let mut samples = Samples::of(std::iter::empty());
        let mut right = 0;
        for _ in 0..4000 {
            let angle = samples.angle();
            let (x, y) = angle.as_direction().unwrap();
            assert!(!x.is_zero() && !y.is_zero(), "{angle}");
            right += usize::from(y.is_negative());
        }
        assert!((1000..3000).contains(&right), "{right}");
    }
}
