//! Identity testing by evaluation: a formula that vanishes at several fixed points is taken to vanish everywhere.

use super::{Definitions, Row};
use crate::formula::{Expr, Symbol};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// Values for all names of definitions: those that nothing defines get numbers that depend on the name and the
/// number of the point only, within 0.2 … 1.2, and the formulas give the others.
///
/// A formula of sines, products and quotients that is zero at such a point is zero everywhere, unless the point is a
/// root by bad luck; several points leave no room for that.
///
/// ```
/// use creepage::formula::Expr;
/// use creepage::mechanism::{Definitions, Row, Sample};
/// let mut d = Definitions::default();
/// d.define("x'", Expr::parse("v*cos(phi)").unwrap());
/// d.define("y'", Expr::parse("v*sin(phi)").unwrap());
/// let mut row = Row::default();
/// row.add("x'", &Expr::parse("sin(phi)").unwrap());
/// row.add("y'", &Expr::parse("-cos(phi)").unwrap());
/// assert!((0..3).all(|k| Sample::of(&d, k).unwrap().annihilates(&row)));
/// d.define("y'", Expr::parse("v*sin(phi) + w").unwrap());
/// assert!(!Sample::of(&d, 0).unwrap().annihilates(&row));
/// ```
#[derive(Clone, Debug)]
pub struct Sample {
    values: BTreeMap<Symbol, f64>,
    point: u32,
}

/// Largest sum over the sum of sizes that counts as rounding.
const RELATIVE_ROUNDING: f64 = 1e-10;

impl Sample {
    /// The values at a point; `None` when definitions use each other in a circle.
    pub fn of(definitions: &Definitions, point: u32) -> Option<Self> {
        let mut sample = Self { values: BTreeMap::new(), point };
        for (name, formula) in definitions.sorted().ok()? {
            let value = sample.value(formula).unwrap_or(f64::NAN);
            sample.values.insert(name.clone(), value);
        }
        Some(sample)
    }

    /// The value of a formula; `None` where it is undefined.
    pub fn value(&self, e: &Expr) -> Option<f64> {
        e.eval(&|s| self.values.get(s).copied().unwrap_or_else(|| scattered(s, self.point)))
    }

    /// Whether row·q̇ is zero to rounding; what is undefined is not.
    pub fn annihilates(&self, row: &Row) -> bool {
        let term = |(rate, c): &(Symbol, Expr)| self.value(&(c * &Expr::sym(rate.clone()))).unwrap_or(f64::NAN);
        let terms: Vec<f64> = row.terms().iter().map(term).collect();
        let size: f64 = terms.iter().copied().map(f64::abs).sum();
        terms.iter().sum::<f64>().abs() <= RELATIVE_ROUNDING * size
    }
}

/// A number within 0.2 … 1.2 for a name.
fn scattered(name: &Symbol, point: u32) -> f64 {
    // A digest: names that differ in one letter lie apart, on every machine alike.
    let digest = Sha256::new().chain_update(name.as_str()).chain_update(point.to_le_bytes()).finalize();
    let bits = u32::from_le_bytes([digest[0], digest[1], digest[2], digest[3]]);
    0.2 + f64::from(bits) / f64::from(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_scattered_over_their_range() {
        let mut values: Vec<f64> = (0..400).map(|k| scattered(&Symbol::new(["a", "b"][k % 2]), k as u32 / 2)).collect();
        values.sort_by(f64::total_cmp);
        assert!(values[0] >= 0.2 && values[399] <= 1.2, "{values:?}");
        // No gap of a twentieth: four hundred draws leave one with a chance of 10⁻⁷.
        let ends = [[0.2], [1.2]].concat();
        let all = [&ends[..1], &values, &ends[1..]].concat();
        assert!(all.windows(2).all(|w| w[1] - w[0] < 0.05), "{all:?}");
    }

    #[test]
    fn what_is_small_and_not_zero_annihilates_nothing() {
        let small = |factor: &str| {
            let mut row = Row::default();
            row.add("x'", &Expr::parse(factor).unwrap());
            Sample::of(&Definitions::default(), 0).unwrap().annihilates(&row)
        };
        assert!(!small("0.0000001") && !small("1") && !small("10000000"));
        assert!(small("sqrt(u)^2 - u"));
    }
}
