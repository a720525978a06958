//! A model with some effects as a family of motions, one for each value of their parameters.

use super::carrier::Carrier;
use super::motion::Motion;
use super::points::Point;
use super::relation::Measured;
use super::tangent::Tangent;
use super::values::{Values, int};
use crate::effects::Applied;
use crate::formula::{Normal, Scalar, Symbol};
use crate::model::Model;

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
    pub fn rows<S: Carrier>(&self, at: &Point<S>, values: &Values<S>, turn: Option<&S>) -> Option<Vec<S>> {
        self.motion.rows(&|s: &Symbol| values.get(s).cloned().unwrap_or_else(|| self.constant(at, s)), turn)
    }

    /// What a symbol is at a point, parameters left open.
    fn constant<S: Carrier>(&self, at: &Point<S>, s: &Symbol) -> S {
        let open = || if self.zeros.contains(s) { int(0) } else { at.open(s) };
        at.get(s).cloned().unwrap_or_else(open)
    }

    /// The rows where all own parameters are zero.
    pub fn neutral<S: Carrier>(&self, at: &Point<S>, turn: Option<&S>) -> Option<Vec<S>> {
        self.rows(at, &self.own.iter().map(|s| (s.clone(), int(0))).collect(), turn)
    }

    /// The derivatives of the rows by a parameter (by the turn of an unmeasured heading where there is none), where
    /// all own parameters are zero.
    pub fn slopes<S: Carrier>(&self, at: &Point<S>, by: Option<&Symbol>) -> Option<Vec<S>> {
        let value = |s: &Symbol| match (by == Some(s), self.own.contains(s)) {
            (true, true) => Tangent::parameter(),
            (true, false) => Tangent { value: at.open(s), slope: int(1) },
            (false, true) => Tangent::constant(int(0)),
            (false, false) => Tangent::constant(self.constant(at, s)),
        };
        let turn = by.is_none().then(Tangent::parameter);
        Some(self.motion.rows(&value, turn.as_ref())?.into_iter().map(|row| row.slope).collect())
    }

    /// Whether the own parameters change what is measured at all.
    pub fn acts(&self) -> bool {
        let open = Point::<Normal>::default();
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

/// Whether every row is zero.
pub fn vanish(rows: &[Normal]) -> bool {
    rows.iter().all(Normal::is_zero)
}
