//! Vector fields near a point as Taylor series with whole coefficients, and their Lie brackets.

use super::exact_linear_algebra::common_factor;
use crate::formula::{BigInt, BigRational, Jet, Layout};
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// A vector field near a point up to a constant factor: for each coordinate the Taylor coefficients, whole numbers.
///
/// A component that is zero has no coefficients. No bracket changes the directions reached when a field is multiplied
/// by a constant, so denominators are cleared once and common factors divided out.
#[derive(Clone, PartialEq, Eq, Hash)]
pub(crate) struct Field {
    components: Vec<Vec<BigInt>>,
}

/// What differentiates and multiplies components.
pub(crate) struct Calculus<'a> {
    /// The monomials.
    pub layout: &'a Layout,
    /// The coordinate of each variable of the layout.
    pub coordinates: Vec<usize>,
}

impl Field {
    /// The field with these components; all must have numbers as constant terms.
    pub(crate) fn of(components: &[Jet], layout: &Layout) -> Option<Self> {
        let constants: Option<Vec<_>> = components.iter().map(|j| j.constant().as_rational()).collect();
        let constants = constants?;
        let all = components.iter().flat_map(|j| j.terms().values()).chain(constants.iter().copied());
        let denominator = all.fold(BigInt::one(), |d, v| d.lcm(v.denominator().as_ibig()));
        let component = |(jet, constant): (&Jet, &&BigRational)| {
            let mut whole = vec![BigInt::zero(); layout.count(layout.order())];
            let terms = jet.terms().iter().map(|(m, v)| (*m, v)).chain([(0, *constant)]);
            terms.for_each(|(m, v)| whole[m] = v.numerator() * (&denominator / v.denominator().as_ibig()));
            whole
        };
        let components = components.iter().zip(&constants).map(component).collect();
        Some(Self { components }.normal())
    }

    /// Divided by what all coefficients have in common, the first one positive: fields that differ by a constant
    /// factor become equal.
    fn normal(mut self) -> Self {
        self.components.iter_mut().filter(|c| c.iter().all(Zero::is_zero)).for_each(Vec::clear);
        let mut common = common_factor(self.components.iter().flatten());
        let first = self.components.iter().flatten().find(|v| !v.is_zero());
        if first.is_some_and(Signed::is_negative) {
            common = -common;
        }
        if !common.is_zero() && !common.is_one() {
            self.components.iter_mut().flatten().for_each(|v| *v /= &common);
        }
        self
    }

    /// Whether the field is zero as far as its coefficients go.
    pub(crate) fn is_zero(&self) -> bool {
        self.components.iter().all(Vec::is_empty)
    }

    /// The vector at the point itself.
    pub(crate) fn value(&self) -> Vec<BigInt> {
        self.components.iter().map(|c| c.first().cloned().unwrap_or_default()).collect()
    }

    /// [X, Y] = X·∂Y − Y·∂X up to a degree.
    pub(crate) fn bracket(&self, other: &Field, calculus: &Calculus, degree: usize) -> Field {
        let component = |i: usize| {
            let mut sum = vec![BigInt::zero(); calculus.layout.count(degree)];
            for (v, q) in calculus.coordinates.iter().enumerate() {
                for (along, of, positive) in [(self, other, true), (other, self, false)] {
                    calculus.add_slope(&mut sum, &along.components[*q], &of.components[i], v, positive);
                }
            }
            sum
        };
        Field { components: (0..self.components.len()).map(component).collect() }.normal()
    }
}

impl Calculus<'_> {
    /// sum ± a·∂b/∂v
    fn add_slope(&self, sum: &mut [BigInt], a: &[BigInt], b: &[BigInt], v: usize, positive: bool) {
        if a.is_empty() || b.is_empty() {
            return;
        }
        let slope = self.slope(b, v, sum.len());
        for (i, x) in a.iter().enumerate().take(sum.len()).filter(|(_, x)| !x.is_zero()) {
            // Products come by rising degree: what is cut off stands behind what is kept.
            let places = self.layout.products(i);
            for (place, y) in slope.iter().filter(|(j, _)| *j < places.len()).map(|(j, y)| (places[*j], y)) {
                match sum.get_mut(place) {
                    Some(s) if positive => *s += x * y,
                    Some(s) => *s -= x * y,
                    None => break,
                }
            }
        }
    }

    /// The coefficients of ∂b/∂v that are not zero, by rising monomial, as far as `count`.
    fn slope(&self, b: &[BigInt], v: usize, count: usize) -> Vec<(usize, BigInt)> {
        let filled = b.iter().enumerate().filter(|(_, y)| !y.is_zero());
        let slopes = filled.filter_map(|(m, y)| {
            let (times, place) = self.layout.derivative(v, m)?;
            (place < count).then(|| (place, y * times))
        });
        let mut slopes: Vec<_> = slopes.collect();
        slopes.sort_by_key(|(place, _)| *place);
        slopes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::{Exact, Expr, Symbol};
    use std::sync::Arc;

    #[test]
    fn products_beyond_the_degree_are_left_out() {
        let z = Symbol::from("z");
        let layout = Arc::new(Layout::new(vec![z.clone()], 3));
        let field = |text: &str| {
            let jet = Expr::parse(text).unwrap().eval(&|s| Jet::variable(&layout, s, Exact::ratio(0, 1))).unwrap();
            Field::of(&[jet], &layout).unwrap()
        };
        let calculus = Calculus { layout: &layout, coordinates: vec![0] };
        let bracket = |x: &str, y: &str, degree: usize| field(x).bracket(&field(y), &calculus, degree).components;
        // [z, z³] = 2z³ and [z², z³] = z⁴: the second has nothing up to the second or third degree.
        let cube = vec![vec![BigInt::zero(), BigInt::zero(), BigInt::zero(), BigInt::one()]];
        assert_eq!(bracket("z", "z^3", 3), cube);
        assert_eq!([bracket("z^2", "z^3", 2), bracket("z^2", "z^3", 3)], [[vec![]], [vec![]]]);
    }
}
