//! Sample points of a comparison: states with inputs, as exact numbers or as floating-point ones.

use super::carrier::{Carrier, between, fraction};
use super::values::{Values, int};
use crate::formula::{BigRational, Fun, Normal, Scalar, Symbol};
use crate::model::{Model, trailer_heading};

/// A state with inputs as numbers; empty where both are left open.
#[derive(Clone)]
pub struct Point<S = Normal> {
    given: Values<S>,
    /// Of several sets of numbers for what is open, the one that is meant.
    set: u32,
}

impl<S> Default for Point<S> {
    fn default() -> Self {
        Self { given: Values::new(), set: 0 }
    }
}

impl<S: Carrier> Point<S> {
    /// What a symbol is here, if it is given.
    pub fn get(&self, s: &Symbol) -> Option<&S> {
        self.given.get(s)
    }

    /// A symbol that is left open.
    pub fn open(&self, s: &Symbol) -> S {
        S::open(s, self.set)
    }
}

/// Points that share the numbers for all that is left open.
pub type Sample = Vec<Point<f64>>;

/// Numbers u for which arctan u has a rational sine, and speeds to go with them: simple ones first.
const NUMBERS: [[(i64, i64); 6]; 5] = [
    [(0, 1), (3, 4), (0, 1), (4, 3), (5, 12), (0, 1)],
    [(3, 4), (0, 1), (4, 3), (5, 12), (0, 1), (8, 15)],
    [(4, 3), (5, 12), (3, 4), (8, 15), (-3, 4), (12, 5)],
    [(-5, 12), (-4, 3), (8, 15), (3, 4), (12, 5), (-3, 4)],
    [(8, 15), (12, 5), (-5, 12), (-3, 4), (20, 21), (4, 3)],
];

/// Points at which the motion is compared exactly before it is compared everywhere.
pub fn exact_points(model: &Model) -> Vec<Point> {
    let inputs: Vec<(Symbol, bool)> =
        model.inputs.iter().map(|role| (Symbol::new(role), is_angle(model, role))).collect();
    let point = |(k, numbers): (usize, &[(i64, i64); 6])| {
        let mut next = numbers.iter().cycle().map(|(p, q)| BigRational::from_parts_signed((*p).into(), (*q).into()));
        let mut angle = || next.next().map_or_else(|| int(0), |u| Normal::call(Fun::Atan, &Normal::number(&u)));
        let mut given = Values::from([("x".into(), int(0)), ("y".into(), int(0)), ("phi".into(), angle())]);
        given.extend((1..=model.trailer_count()).map(|i| (trailer_heading(i), angle())));
        for (i, (role, is_angle)) in inputs.iter().enumerate() {
            let speed = BigRational::from_parts_signed((2 + (3 * k + 5 * i * (k + 1)) as i64 % 11).into(), 2.into());
            given.insert(role.clone(), if *is_angle { angle() } else { Normal::number(&speed) });
        }
        Point { given, set: 0 }
    };
    NUMBERS.iter().enumerate().map(point).collect()
}

fn is_angle(model: &Model, role: &str) -> bool {
    model.vehicle.inputs.get(role).is_some_and(|i| i.unit == "rad")
}

/// Sets of numbers for what is open: what has a solution for one and none for another has a pole at the other.
const SETS: u32 = 2;
/// Points of a sample.
const POINTS: u32 = 14;

/// Samples at which every symbol is a floating-point number, the same for the same model.
pub fn samples(model: &Model) -> Vec<Sample> {
    (0..SETS).map(|set| (0..POINTS).map(|k| number_point(model, set, k)).collect()).collect()
}

/// A point in general position: no angle near a quarter of a turn, no input near zero.
fn number_point(model: &Model, set: u32, k: u32) -> Point<f64> {
    let share = |name: &str| fraction(name, SETS + set * POINTS + k);
    let mut given: Values<f64> = ["x", "y"].map(|s| (Symbol::new(s), 0.0)).into();
    let headings = std::iter::once("phi".into()).chain((1..=model.trailer_count()).map(trailer_heading));
    given.extend(headings.map(|s| (s.clone(), between(-1.2, 1.2, share(s.as_str())))));
    for role in &model.inputs {
        let range = if is_angle(model, role) { [-0.7, 0.7] } else { [0.5, 6.0] };
        given.insert(Symbol::new(role), between(range[0], range[1], share(role)));
    }
    Point { given, set }
}
