//! Definitions at a point, to see whether a formula vanishes everywhere.

use super::{Definitions, Row};
use crate::formula::{Expr, Symbol};
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
const ROUNDING: f64 = 1e-10;

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
        let (mut sum, mut size) = (0.0, 0.0);
        for (rate, c) in row.terms() {
            let term = self.value(&(c * &Expr::sym(rate.clone()))).unwrap_or(f64::NAN);
            sum += term;
            size += f64::abs(term);
        }
        f64::abs(sum) <= ROUNDING * size
    }
}

/// A number within 0.2 … 1.2 for a name.
fn scattered(name: &Symbol, point: u32) -> f64 {
    // FNV-1a and a last mixing step: names that differ in one letter lie apart, on every machine alike.
    let bytes = name.as_str().bytes().chain(point.to_le_bytes());
    let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3));
    let mixed = (hash ^ (hash >> 32)).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
    #[allow(clippy::cast_precision_loss)] // 32 bits fit
    let fraction = mixed as f64 / f64::from(u32::MAX);
    0.2 + fraction
}
