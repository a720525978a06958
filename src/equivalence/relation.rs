//! The equivalence relation between effects: the answers, from a one-to-one reparametrisation to none at all.

use crate::formula::{Expr, Symbol};
use std::collections::BTreeMap;

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
