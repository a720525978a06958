//! The change of parameter that turns one family of motions into another.

use super::carrier::Carrier;
use super::equation::{Equation, less, side_by_side};
use super::linear_system::LinearSystem;
use super::pair::Pair;
use super::points::Point;
use super::proof::Claim;
use super::solution::solution;
use super::values::{Values, int};
use crate::formula::{Fun, Normal, Scalar, Symbol};

/// A way to write a parameter q in terms of an unknown in which the motion may be of the first degree.
#[derive(Clone, Copy)]
enum Chart {
    /// q itself.
    Plain,
    /// q = arctan u.
    Slope,
}

impl Chart {
    fn parameter<S: Carrier>(self, u: &S) -> S {
        match self {
            Chart::Plain => u.clone(),
            Chart::Slope => S::call(Fun::Atan, u),
        }
    }
}

/// Where the motion is of the first degree in its parameters: F = F₀ + Σ qⱼ·Gⱼ.
struct Affine<'a>(&'a [Symbol]);

impl LinearSystem for Affine<'_> {
    fn unknowns(&self, _: &Pair) -> usize {
        self.0.len()
    }

    fn equations<S: Carrier>(&self, pair: &Pair, at: &Point<S>) -> Option<Vec<Equation<S>>> {
        let (target, neutral) = (pair.given_at(at)?, pair.sought_at(at, self.0, None)?);
        let unit = |j: usize| Some(less(&pair.sought_at(at, self.0, Some((j, int(1))))?, &neutral));
        let columns = (0..self.0.len()).map(unit).collect::<Option<Vec<_>>>()?;
        Some(side_by_side(&columns, &less(&target, &neutral)))
    }
}

/// Where the motion is a quotient of the first degree in one parameter: F = (n₀ + n₁·u)/(1 + d·u).
struct Fractional<'a> {
    unknown: &'a Symbol,
    chart: Chart,
}

impl LinearSystem for Fractional<'_> {
    fn unknowns(&self, _: &Pair) -> usize {
        1
    }

    fn equations<S: Carrier>(&self, pair: &Pair, at: &Point<S>) -> Option<Vec<Equation<S>>> {
        let single = std::slice::from_ref(self.unknown);
        let f = |u: i64| pair.sought_at(at, single, Some((0, self.chart.parameter(&int(u)))));
        let (target, f) = (pair.given_at(at)?, [f(0)?, f(1)?, f(2)?]);
        let rows = (0..target.len()).map(|i| quotient([&f[0][i], &f[1][i], &f[2][i]], &target[i]));
        Some(rows.collect())
    }
}

/// The equation u·(n₁ − t·d) = t − n₀ from values at u = 0, 1, 2.
fn quotient<S: Carrier>(f: [&S; 3], target: &S) -> Equation<S> {
    let two: S = int(2);
    let rise = f[2].sub(f[1]);
    let d = match rise.vanishes_beside(&[f[1], f[2]]) {
        // Constant beyond zero: of the first degree only where it is constant throughout.
        Some(true) => int(0),
        Some(false) => two.mul(f[1]).sub(f[0]).sub(f[2]).div(&two.mul(&rise)),
        None => int::<S>(0).recip(),
    };
    let n = d.add(&int(1)).mul(f[1]).sub(f[0]);
    Equation { factors: vec![n.sub(&target.mul(&d))], target: target.sub(f[0]) }
}

impl Pair<'_> {
    /// The sought parameters as formulas of the given ones, such that both motions are equal: proved in normal form.
    ///
    /// First with the parameters that both have in common left as they are, then with these changed too.
    /// `slopes` are the coefficients of the first order, where they are known.
    pub fn change(&self, slopes: Option<&[Normal]>) -> Option<Values> {
        let own = &self.sought.own;
        let all = [&own[..], &self.sought.shared].concat();
        let mut found = self.affine(own);
        if let [single] = &own[..] {
            found = found.or_else(|| self.fractional(single, Chart::Plain));
            if self.sought.is_angle(single) {
                found = found.or_else(|| self.fractional(single, Chart::Slope));
            }
            found = found.or_else(|| self.proportional(single, slopes));
        }
        found.or_else(|| if all.len() > own.len() { self.affine(&all) } else { None })
    }

    fn affine(&self, unknowns: &[Symbol]) -> Option<Values> {
        let found = solution(self, &Affine(unknowns))?;
        self.proved(unknowns.iter().cloned().zip(found).collect())
    }

    fn fractional(&self, unknown: &Symbol, chart: Chart) -> Option<Values> {
        let found = solution(self, &Fractional { unknown, chart })?;
        self.proved([(unknown.clone(), chart.parameter(found.first()?))].into())
    }

    /// Where the first order may be the whole: an angle for an angle.
    fn proportional(&self, unknown: &Symbol, slopes: Option<&[Normal]>) -> Option<Values> {
        let [given] = &self.given.own[..] else { return None };
        let scaled = slopes?.first()?.mul(&Normal::symbol(given.clone()));
        self.proved([(unknown.clone(), scaled)].into())
    }

    /// The change, if both motions are equal with it in every state and for every input.
    fn proved(&self, change: Values) -> Option<Values> {
        let claim = Claim { given: &Values::new(), sought: &change, turn: None };
        claim.is_proved(self).then_some(change)
    }
}
