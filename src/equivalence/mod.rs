//! Effects that are the same under another name, proved from the formulas.
//!
//! | relation | what is proved |
//! |---|---|
//! | identical | F_a(y, u; p) = F_b(y, u; q(p)) for every state y, input u and value of p, and the reverse |
//! | contained | the same, but not the reverse: b has more parameters |
//! | first order | ∂F_a/∂p at zero is a combination of ∂F_b/∂q with constant coefficients |
//!
//! F gives the rates of what the sensor shows in terms of what it shows (the sensor's formulas inverted), and the
//! delay of the clock. States that no sensor sees keep their own rates.

pub(crate) mod constant_coefficients;
mod family;
mod first_order;
pub(crate) mod heading_gauge;
mod motion;
pub(crate) mod reparametrisation;
mod tangent;

use crate::effects::Applied;
use crate::formula::{Expr, Normal, Scalar, Symbol};
use crate::model::Model;
use family::{Family, Values, formula, points};
use reparametrisation::Pair;
use std::collections::BTreeMap;
use tangent::Tangent;

/// What is measured beside x and y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measured {
    /// The heading of the body.
    pub heading: bool,
    /// The headings of the trailers.
    pub trailers: bool,
}

impl Measured {
    /// Everything.
    pub const ALL: Measured = Measured { heading: true, trailers: true };
}

/// Parameters of one side as formulas of the other side's; with an unmeasured heading both may be given as formulas
/// of [`TURN`].
pub type Change = BTreeMap<Symbol, Expr>;

/// How far the true heading is turned where no sensor sees it.
pub const TURN: &str = "turn";

/// How two effects, or two sets of them, are related.
#[derive(Clone, Debug, PartialEq)]
pub enum Relation {
    /// Each is the other under a change of parameter: the second's parameters by the first's.
    Identical(Change),
    /// The first is a special case of the second.
    Contained(Change),
    /// The second is a special case of the first: the first's parameters by the second's.
    Contains(Change),
    /// They agree for small values; precise data can tell.
    FirstOrder,
    /// Nothing of the kind is proved.
    Different,
}

impl Relation {
    /// Whether the second explains whatever the first explains, at values of its parameters that leave those it has
    /// beyond the first at zero.
    pub fn replaces(&self) -> bool {
        match self {
            Relation::Identical(_) => true,
            Relation::Contained(change) => change.values().filter(|f| !f.is_zero()).count() == 1,
            _ => false,
        }
    }

    /// The word of the contract, when there is one.
    pub fn word(&self) -> Option<&'static str> {
        match self {
            Relation::Identical(_) | Relation::Contained(_) => Some("identical"),
            Relation::FirstOrder => Some("first order"),
            Relation::Contains(_) | Relation::Different => None,
        }
    }
}

/// How two sets of effects are related in a model that has neither.
///
/// Parameters of the model's free effects may change with them. Symbols stand for every value: what is proved holds
/// for all parameters of the vehicle.
///
/// ```
/// use creepage::equivalence::{Measured, Relation, relation};
/// use creepage::{effects::{self, Applied}, model::Model};
/// let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap();
/// let effect = |id: &str| [Applied::new(effects::named(id).unwrap(), None, vec![0.0])];
/// let Relation::Identical(change) = relation(&car, &effect("rotation-creep"), &effect("wheel-radius"), Measured::ALL)
///     else { panic!() };
/// assert_eq!(change[&"wheel_radius.scale".into()].to_string(), "-rotation_creep.e_rc");
/// ```
pub fn relation(model: &Model, a: &[Applied], b: &[Applied], measured: Measured) -> Relation {
    let families = Family::of(model, a, measured).zip(Family::of(model, b, measured));
    let Some((first, second)) = families.filter(|(a, b)| a.comparable(b) && a.acts() && b.acts()) else {
        return Relation::Different;
    };
    let points = points(model);
    let pair = |given, sought| Pair { given, sought, points: &points };
    let (forth, back) = (pair(&first, &second), pair(&second, &first));
    let (few, many) = (first.own.len(), second.own.len());
    let turning = !measured.heading;
    let slopes = forth.slopes(turning);
    if let Some(change) = sought(&forth, slopes.as_deref(), turning) {
        let returns = || sought(&back, back.slopes(turning).as_deref(), turning).is_some();
        let reached = few == many && (reaches(&change, &first, &second) || (few > 1 && returns()));
        let change = change.iter().map(|(s, value)| (s.clone(), formula(value))).collect();
        return if reached { Relation::Identical(change) } else { Relation::Contained(change) };
    }
    if many <= few {
        let slopes = back.slopes(turning);
        if let Some(change) = sought(&back, slopes.as_deref(), turning) {
            return Relation::Contains(change.iter().map(|(s, value)| (s.clone(), formula(value))).collect());
        }
    }
    let agree = forth.is_regular() && slopes.is_some_and(|s| forth.agree(&s, turning));
    if agree { Relation::FirstOrder } else { Relation::Different }
}

/// The change of parameter, where the first order leaves one possible.
fn sought(pair: &Pair, slopes: Option<&[Vec<Normal>]>, turning: bool) -> Option<Values> {
    if pair.is_regular() && slopes.is_none() {
        return None;
    }
    let first = slopes.and_then(|s| s.first()).map(Vec::as_slice);
    pair.change(first).or_else(|| if turning { pair.turned(&TURN.into()) } else { None })
}

/// Whether a change of one parameter into one reaches every small value: its slope at zero is none.
fn reaches(change: &Values, given: &Family, sought: &Family) -> bool {
    let ([p], [q]) = (&given.own[..], &sought.own[..]) else { return false };
    let by = if change.contains_key(p) { TURN.into() } else { p.clone() };
    let value = |s: &Symbol| match *s == by {
        true => Tangent::parameter(),
        false => Tangent::constant(Normal::symbol(s.clone())),
    };
    let slope = change.get(q).and_then(|q| formula(q).eval(&value));
    slope.is_some_and(|t| t.slope.is_defined() && !t.slope.is_zero())
}
