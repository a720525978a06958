//! A model with some effects as a family of motions, one for each value of their parameters.

use super::Measured;
use super::motion::Motion;
use super::tangent::Tangent;
use crate::effects::Applied;
use crate::formula::{BigRational, Expr, Fun, Normal, Scalar, Symbol};
use crate::model::{Model, trailer_heading};
use std::collections::BTreeMap;

/// Values of parameters; what is not given stands for itself.
pub type Values = BTreeMap<Symbol, Normal>;

/// A state with inputs, as exact numbers; empty where both are left open.
#[derive(Clone, Default)]
pub struct Point(Values);

/// A whole number.
pub fn int(n: i64) -> Normal {
    Normal::number(&BigRational::from_integer(n.into()))
}

/// The motions of a model with effects whose parameters are left open.
pub struct Family {
    motion: Motion,
    /// The parameters of the effects in question.
    pub own: Vec<Symbol>,
    /// The parameters that are open in the model anyway.
    pub shared: Vec<Symbol>,
    angles: Vec<Symbol>,
    /// What the model says is zero: a lever arm that is not there is no lever arm of any length.
    zeros: Vec<Symbol>,
    /// Whether the effects are all regular at zero: no states, no value that must be positive, no direction.
    pub regular: bool,
}

impl Family {
    /// The model with the effects; `None` where its motion cannot be compared.
    pub fn of(model: &Model, effects: &[Applied], measured: Measured) -> Option<Self> {
        let joint = effects.iter().fold(model.clone(), |m, e| m.with_effect(e.clone()));
        let kind = |e: &Applied| e.effect.parameters.values().any(|p| p.positive || p.periodic);
        let angles = effects.iter().flat_map(|e| {
            let angle = |(name, p): (&String, &crate::effects::Parameter)| (p.unit == "rad").then(|| e.symbol(name));
            e.effect.parameters.iter().filter_map(angle).collect::<Vec<_>>()
        });
        Some(Self {
            motion: Motion::of(&joint, measured)?,
            own: effects.iter().flat_map(Applied::parameters).collect(),
            shared: model.free_parameters(),
            angles: angles.collect(),
            zeros: zeros(model),
            regular: effects.iter().all(|e| e.effect.states.is_empty() && !kind(e)),
        })
    }

    /// Whether two families move the same things.
    pub fn comparable(&self, other: &Family) -> bool {
        self.motion.comparable(&other.motion)
    }

    /// Whether a parameter is an angle.
    pub fn is_angle(&self, parameter: &Symbol) -> bool {
        self.angles.contains(parameter)
    }

    /// The rows of the motion at a point.
    pub fn rows(&self, at: &Point, values: &Values, turn: Option<&Normal>) -> Option<Vec<Normal>> {
        self.motion.rows(&|s: &Symbol| values.get(s).cloned().unwrap_or_else(|| self.constant(at, s)), turn)
    }

    /// What a symbol is at a point, parameters left open.
    fn constant(&self, at: &Point, s: &Symbol) -> Normal {
        let open = || if self.zeros.contains(s) { int(0) } else { Normal::symbol(s.clone()) };
        at.0.get(s).cloned().unwrap_or_else(open)
    }

    /// The rows where all own parameters are zero.
    pub fn neutral(&self, at: &Point, turn: Option<&Normal>) -> Option<Vec<Normal>> {
        self.rows(at, &self.own.iter().map(|s| (s.clone(), int(0))).collect(), turn)
    }

    /// The derivatives of the rows by a parameter (by the turn of an unmeasured heading where there is none), where
    /// all own parameters are zero.
    pub fn slopes(&self, at: &Point, by: Option<&Symbol>) -> Option<Vec<Normal>> {
        let value = |s: &Symbol| match (by == Some(s), self.own.contains(s)) {
            (true, true) => Tangent::parameter(),
            (true, false) => Tangent { value: Normal::symbol(s.clone()), slope: int(1) },
            (false, true) => Tangent::constant(int(0)),
            (false, false) => Tangent::constant(self.constant(at, s)),
        };
        let turn = by.is_none().then(Tangent::parameter);
        Some(self.motion.rows(&value, turn.as_ref())?.into_iter().map(|row| row.slope).collect())
    }

    /// Whether the own parameters change what is measured at all.
    pub fn acts(&self) -> bool {
        let open = Point::default();
        let (Some(with), Some(without)) = (self.rows(&open, &Values::new(), None), self.neutral(&open, None)) else {
            return false;
        };
        !all_equal(&with, &without)
    }
}

/// Lengths and angles of the vehicle and its sensor that are exactly zero.
fn zeros(model: &Model) -> Vec<Symbol> {
    let values = Model { effects: vec![], ..model.clone() }.values();
    values.into_iter().filter(|(_, v)| *v == 0.0).map(|(s, _)| s).collect()
}

/// Whether rows are proved equal, one by one.
pub fn all_equal(a: &[Normal], b: &[Normal]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.equals(b))
}

/// Numbers u for which arctan u has a rational sine, and speeds to go with them: simple ones first.
const NUMBERS: [[(i64, i64); 6]; 5] = [
    [(0, 1), (3, 4), (0, 1), (4, 3), (5, 12), (0, 1)],
    [(3, 4), (0, 1), (4, 3), (5, 12), (0, 1), (8, 15)],
    [(4, 3), (5, 12), (3, 4), (8, 15), (-3, 4), (12, 5)],
    [(-5, 12), (-4, 3), (8, 15), (3, 4), (12, 5), (-3, 4)],
    [(8, 15), (12, 5), (-5, 12), (-3, 4), (20, 21), (4, 3)],
];

/// Points at which the motion is compared before it is compared everywhere.
pub fn points(model: &Model) -> Vec<Point> {
    let inputs: Vec<(Symbol, bool)> =
        model.inputs.iter().map(|role| (Symbol::new(role), is_angle(model, role))).collect();
    let point = |(k, numbers): (usize, &[(i64, i64); 6])| {
        let mut next = numbers.iter().cycle().map(|(p, q)| BigRational::new((*p).into(), (*q).into()));
        let mut angle = || next.next().map_or_else(|| int(0), |u| Normal::call(Fun::Atan, &Normal::number(&u)));
        let mut at = Values::from([("x".into(), int(0)), ("y".into(), int(0)), ("phi".into(), angle())]);
        at.extend((1..=model.trailer_count()).map(|i| (trailer_heading(i), angle())));
        for (i, (role, is_angle)) in inputs.iter().enumerate() {
            let speed = BigRational::new((2 + (3 * k + 5 * i * (k + 1)) as i64 % 11).into(), 2.into());
            at.insert(role.clone(), if *is_angle { angle() } else { Normal::number(&speed) });
        }
        Point(at)
    };
    NUMBERS.iter().enumerate().map(point).collect()
}

fn is_angle(model: &Model, role: &str) -> bool {
    model.vehicle.inputs.get(role).is_some_and(|i| i.unit == "rad")
}

/// A normal form as a formula.
pub fn formula(value: &Normal) -> Expr {
    let below = value.denominator();
    if below.is_one() { value.numerator() } else { &value.numerator() / &below }
}

/// Whether every row is zero.
pub fn vanish(rows: &[Normal]) -> bool {
    rows.iter().all(Normal::is_zero)
}
