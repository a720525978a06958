//! The change of parameter that turns one family of motions into another.

use super::constant_coefficients::{Equation, constants};
use super::family::{Family, Point, Values, all_equal, int};
use crate::formula::{Fun, Normal, Scalar, Symbol};

/// What the two sides of a comparison have in common.
pub struct Pair<'a> {
    /// The family whose parameters are given.
    pub given: &'a Family,
    /// The family whose parameters are sought.
    pub sought: &'a Family,
    /// Points at which they are compared first.
    pub points: &'a [Point],
}

/// A way to write a parameter q in terms of an unknown in which the motion may be of the first degree.
#[derive(Clone, Copy)]
enum Chart {
    /// q itself.
    Plain,
    /// q = arctan u.
    Slope,
}

impl Chart {
    fn parameter(self, u: &Normal) -> Normal {
        match self {
            Chart::Plain => u.clone(),
            Chart::Slope => Normal::call(Fun::Atan, u),
        }
    }
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
            found = found.or_else(|| self.fractional(single, Chart::Slope).filter(|_| self.sought.is_angle(single)));
            found = found.or_else(|| self.proportional(single, slopes));
        }
        found.or_else(|| if all.len() > own.len() { self.affine(&all) } else { None })
    }

    fn given_at(&self, at: &Point) -> Option<Vec<Normal>> {
        self.given.rows(at, &Values::new(), None)
    }

    /// The motion sought where the unknowns are all zero, or one of them is something else.
    fn sought_at(&self, at: &Point, unknowns: &[Symbol], other: Option<(usize, Normal)>) -> Option<Vec<Normal>> {
        let mut values: Values = self.sought.own.iter().chain(unknowns).map(|s| (s.clone(), int(0))).collect();
        values.extend(other.map(|(j, v)| (unknowns[j].clone(), v)));
        self.sought.rows(at, &values, None)
    }

    /// Where the motion is of the first degree in its parameters: F = F₀ + Σ qⱼ·Gⱼ.
    fn affine(&self, unknowns: &[Symbol]) -> Option<Values> {
        let equations = |at: &Point| -> Option<Vec<Equation>> {
            let (target, neutral) = (self.given_at(at)?, self.sought_at(at, unknowns, None)?);
            let unit = |j: usize| Some(less(&self.sought_at(at, unknowns, Some((j, int(1))))?, &neutral));
            let columns = (0..unknowns.len()).map(unit).collect::<Option<Vec<_>>>()?;
            Some(side_by_side(&columns, &less(&target, &neutral)))
        };
        let all = self.points.iter().flat_map(|at| equations(at).unwrap_or_default());
        self.proved(unknowns.iter().cloned().zip(constants(unknowns.len(), all)?).collect())
    }

    /// Where the motion is a quotient of the first degree in one parameter: F = (n₀ + n₁·u)/(1 + d·u).
    fn fractional(&self, unknown: &Symbol, chart: Chart) -> Option<Values> {
        let single = std::slice::from_ref(unknown);
        let equations = |at: &Point| -> Option<Vec<Equation>> {
            let f = |u: i64| self.sought_at(at, single, Some((0, chart.parameter(&int(u)))));
            let (target, f) = (self.given_at(at)?, [f(0)?, f(1)?, f(2)?]);
            let rows = (0..target.len()).map(|i| quotient([&f[0][i], &f[1][i], &f[2][i]], &target[i]));
            Some(rows.collect())
        };
        let all = self.points.iter().flat_map(|at| equations(at).unwrap_or_default());
        let u = constants(1, all)?;
        self.proved([(unknown.clone(), chart.parameter(&u[0]))].into())
    }

    /// Where the first order may be the whole: an angle for an angle.
    fn proportional(&self, unknown: &Symbol, slopes: Option<&[Normal]>) -> Option<Values> {
        let [given] = &self.given.own[..] else { return None };
        let scaled = slopes?.first()?.mul(&Normal::symbol(given.clone()));
        self.proved([(unknown.clone(), scaled)].into())
    }

    /// The change, if both motions are equal with it in every state and for every input.
    fn proved(&self, change: Values) -> Option<Values> {
        let open = Point::default();
        let (a, b) = (self.given_at(&open)?, self.sought.rows(&open, &change, None)?);
        all_equal(&a, &b).then_some(change)
    }
}

/// The equation u·(n₁ − t·d) = t − n₀ from values at u = 0, 1, 2.
fn quotient(f: [&Normal; 3], target: &Normal) -> Equation {
    let two = int(2);
    let rise = f[2].sub(f[1]);
    let d = if rise.is_zero() {
        // Constant beyond zero: of the first degree only where it is constant throughout.
        int(0)
    } else {
        two.mul(f[1]).sub(f[0]).sub(f[2]).div(&two.mul(&rise))
    };
    let n = d.add(&int(1)).mul(f[1]).sub(f[0]);
    Equation { factors: vec![n.sub(&target.mul(&d))], target: target.sub(f[0]) }
}

/// a − b, row by row.
pub fn less(a: &[Normal], b: &[Normal]) -> Vec<Normal> {
    a.iter().zip(b).map(|(a, b)| a.sub(b)).collect()
}

/// −a, row by row.
pub fn negative(rows: &[Normal]) -> Vec<Normal> {
    rows.iter().map(Scalar::neg).collect()
}

/// The equations Σ cⱼ·columnⱼ = target, row by row.
pub fn side_by_side(columns: &[Vec<Normal>], target: &[Normal]) -> Vec<Equation> {
    let row = |i: usize| columns.iter().map(|c| c[i].clone()).collect();
    target.iter().enumerate().map(|(i, t)| Equation { factors: row(i), target: t.clone() }).collect()
}
