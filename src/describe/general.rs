//! General configurations of a model, at which ranks and Lie brackets are taken exactly.

use crate::error::Result;
use crate::formula::{Exact, Expr, Scalar, Symbol};
use crate::mechanism::{Mechanism, Point};
use crate::model::Model;
use std::collections::BTreeSet;

/// Directions whose sines and cosines are rational, no two of a list at right angles: an axle across the one ahead of
/// it would be a special configuration.
const DIRECTIONS: [&[(i64, i64)]; 2] = [
    &[(4, 3), (12, 5), (15, 8), (24, 7), (12, -5)],
    &[(8, 15), (20, 21), (7, -24), (21, 20), (5, 12), (35, 12), (9, -40)],
];

/// Two general configurations of a model.
pub(super) struct General {
    /// Angles on the circle, lengths of the model.
    pub points: [Point; 2],
    /// Parameters that the model leaves open; they got some value.
    pub open: Vec<Symbol>,
}

impl General {
    /// Every angle a direction of the list, every length as the model has it, effects included.
    ///
    /// # Errors
    /// When an effect does not apply, or formulas use each other in a circle.
    pub(super) fn of(model: &Model, mechanism: &Mechanism) -> Result<Self> {
        let definitions = model.row_definitions()?;
        let values = model.values();
        let symbols = coefficient_symbols(mechanism);
        let is_angle = |q: &Symbol| model.vehicle.coordinate(q.as_str()).is_none_or(|c| c.unit == "rad");
        let (angles, lengths): (Vec<&Symbol>, Vec<&Symbol>) =
            mechanism.coordinates.iter().filter(|q| symbols.contains(q)).partition(|q| is_angle(q));
        let left_out: Vec<Symbol> =
            model.vehicle.parameters.keys().map(|p| Symbol::new(p)).filter(|p| !values.contains_key(p)).collect();
        let point = |which: usize| -> Result<Point> {
            let given = |s: &Symbol| {
                let angle = angles.iter().position(|q| *q == s).map(|k| direction(DIRECTIONS[which], k));
                let coordinate = || lengths.iter().position(|q| *q == s).map(|k| stand_in(2 * k + which));
                let length = || values.get(s).map(|v| decimal(*v));
                let stand_in = || left_out.iter().position(|p| p == s).map(stand_in);
                angle.or_else(coordinate).or_else(length).or_else(stand_in)
            };
            let defined = definitions.evaluate(&given)?;
            let mut point = Point::default();
            for s in &symbols {
                if let Some(value) = given(s).or_else(|| defined.get(s).cloned()) {
                    point.set(s.clone(), value);
                }
            }
            Ok(point)
        };
        let points = [point(0)?, point(1)?];
        let matters = |p: &Symbol| {
            symbols.contains(p) || symbols.iter().filter_map(|s| definitions.get(s)).any(|f| f.mentions(p))
        };
        let open = left_out.iter().filter(|p| matters(p)).cloned().collect();
        Ok(Self { points, open })
    }
}

/// The symbols in the coefficients of the ideal rows.
fn coefficient_symbols(mechanism: &Mechanism) -> BTreeSet<Symbol> {
    let rows = mechanism.ideal_rows();
    rows.iter().flat_map(|r| r.terms()).flat_map(|(_, c)| c.symbols()).collect()
}

fn direction(directions: &[(i64, i64)], k: usize) -> Exact {
    let (x, y) = directions[k % directions.len()];
    Exact::direction(x.into(), y.into())
}

/// A length for what the model leaves open.
fn stand_in(k: usize) -> Exact {
    Exact::ratio(i64::try_from(k).unwrap_or(0) * 3 + 7, 5)
}

/// The number that the digits of a value say: 3/10 for 0.3; undefined for what is no number.
fn decimal(v: f64) -> Exact {
    let undefined = || Exact::ratio(0, 0);
    let written = v.is_finite().then(|| Expr::parse(&v.to_string()).ok()).flatten();
    written.and_then(|e| e.eval(&|_| undefined())).filter(Scalar::is_defined).unwrap_or_else(undefined)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_directions_of_a_list_are_at_right_angles() {
        for list in DIRECTIONS {
            for ((a, b), (c, d)) in list.iter().flat_map(|p| list.iter().map(move |q| (p, q))) {
                assert_ne!(a * c + b * d, 0);
                let root = f64::sqrt((a * a + b * b) as f64) as i64;
                assert_eq!(root * root, a * a + b * b);
            }
        }
    }

    #[test]
    fn a_decimal_is_what_its_digits_say() {
        assert!(decimal(0.3).equals(&Exact::ratio(3, 10)) && decimal(-2.5).equals(&Exact::ratio(-5, 2)));
        assert!(
            decimal(1e20)
                .equals(&Exact::ratio(10, 1).mul(&Exact::ratio(10_000_000_000_000_000, 1)).mul(&Exact::ratio(1000, 1)))
        );
        for v in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!decimal(v).is_defined());
        }
    }
}
