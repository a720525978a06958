//! An effect that stands in a model, with its values.

use super::course::SINCE;
use super::effect::{INPUT, INPUT_RATE};
use super::plain::Subject;
use super::{Effect, Scope, TypicalMotion};
use crate::formula::{Expr, Symbol};
use std::collections::BTreeMap;

/// An effect with its values, and the trailer it belongs to where it belongs to one.
///
/// ```
/// use creepage::effects::{self, Applied};
/// let creep = Applied::new(effects::named("rotation-creep").unwrap(), None, vec![0.05]);
/// assert_eq!((creep.label().as_str(), creep.is_in_range()), ("rotation-creep", true));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Applied {
    /// The effect.
    pub effect: Effect,
    /// The trailer, 1 nearest the tractor.
    pub trailer: Option<usize>,
    /// Values of its parameters, in the order of [`Effect::parameters`].
    pub values: Vec<f64>,
    /// Whether a fit may change the values.
    pub free: bool,
}

impl Applied {
    /// The effect in a sentence for anyone, as it is at a usual motion; `None` where it has no such sentence, or a number of
    /// it is undefined.
    ///
    /// ```
    /// use creepage::effects::{self, Applied, TypicalMotion};
    /// let wide = Applied::new(effects::named("track-width").unwrap(), None, vec![0.03]);
    /// let said = wide.in_plain_words(TypicalMotion::default()).unwrap();
    /// assert_eq!(said, "The wheels stand 3.0 % further apart than the model says.");
    /// ```
    pub fn in_plain_words(&self, motion: TypicalMotion) -> Option<String> {
        let effect = &self.effect;
        effect.plain.as_ref()?.of(&Subject {
            values: effect.parameters.keys().map(String::as_str).zip(self.values.iter().copied()).collect(),
            input: effect.on.as_deref().map(|role| (role, effect.input_unit())),
            trailer: self.trailer,
            motion,
        })
    }

    /// An effect with given, fixed values.
    pub fn new(effect: &Effect, trailer: Option<usize>, values: Vec<f64>) -> Self {
        debug_assert_eq!(values.len(), effect.parameters.len());
        Self { effect: effect.clone(), trailer, values, free: false }
    }

    /// The effect with values that a fit may change.
    pub fn freed(mut self) -> Self {
        self.free = true;
        self
    }

    /// Whether all values lie in the ranges of their parameters.
    pub fn is_in_range(&self) -> bool {
        self.effect.parameters.values().zip(&self.values).all(|(p, v)| p.admits(*v))
    }

    /// Whether two entries are the same effect on the same target.
    pub fn same_as(&self, other: &Applied) -> bool {
        self.stands_for(&other.effect, other.trailer)
    }

    /// Whether it is an effect on a target, whatever its values, its scope and its course.
    pub fn stands_for(&self, effect: &Effect, trailer: Option<usize>) -> bool {
        self.effect.id == effect.id && self.effect.on == effect.on && self.trailer == trailer
    }

    /// `id`, with its target, its scope and its course in brackets where it has them.
    pub fn label(&self) -> String {
        let trailer = self.trailer.map(|i| format!("trailer {i}"));
        let scope = self.effect.scope.as_ref().map(ToString::to_string);
        let course = self.effect.course.as_ref().map(|c| format!("{} moving with time", c.parameter));
        let walk = self.effect.walk.as_ref().map(|w| format!("{} walking at random", w.parameter));
        let all = trailer.into_iter().chain(self.effect.on.clone()).chain(scope).chain(course).chain(walk);
        let all: Vec<String> = all.collect();
        if all.is_empty() { self.effect.id.clone() } else { format!("{} ({})", self.effect.id, all.join(", ")) }
    }

    /// The symbol of a parameter or state in the model's formulas, such as `rotation_creep.e_rc`.
    pub fn symbol(&self, name: &str) -> Symbol {
        let stem = match &self.effect.on {
            Some(role) => format!("{}_{role}", self.effect.id.replace('-', "_")),
            None => self.effect.id.replace('-', "_"),
        };
        Symbol::new(&match self.trailer {
            Some(i) => format!("{stem}_{i}.{name}"),
            None => format!("{stem}.{name}"),
        })
    }

    /// The symbols of its parameters.
    pub fn parameters(&self) -> Vec<Symbol> {
        self.effect.parameters.keys().map(|name| self.symbol(name)).collect()
    }

    /// Its parameters by name.
    pub fn named_values(&self) -> BTreeMap<String, f64> {
        self.effect.parameters.keys().cloned().zip(self.values.iter().copied()).collect()
    }

    /// A formula of the effect with its own names put in place of the plain ones.
    pub fn localised(&self, formula: &Expr) -> Expr {
        let own = |s: &str| self.effect.parameters.contains_key(s) || self.effect.states.contains_key(s);
        formula.substitute(&|s| match s.as_str() {
            INPUT => self.effect.on.as_deref().map(Expr::sym),
            INPUT_RATE => self.effect.on.as_deref().map(|role| Expr::sym(Symbol::new(role).rate())),
            SINCE if self.effect.course.is_some() => Some(Expr::sym(self.symbol(SINCE))),
            name => own(name).then(|| Expr::sym(self.symbol(name))),
        })
    }

    /// The gate of its scope, with its own names; none where it always holds.
    pub fn gate(&self) -> Option<Expr> {
        let scope = self.effect.scope.as_ref()?;
        let numbers = scope.numbers();
        let own = |s: &str| numbers.iter().any(|(name, _)| name == s);
        Some(scope.gate().substitute(&|s| own(s.as_str()).then(|| Expr::sym(self.symbol(s.as_str())))))
    }

    /// The numbers of its scope and its course, which no fit moves, by their symbols.
    pub fn constants(&self) -> Vec<(Symbol, f64)> {
        let of_scope = self.effect.scope.iter().flat_map(Scope::numbers);
        let of_course = self.effect.course.iter().map(|c| (SINCE.to_string(), c.since));
        of_scope.chain(of_course).map(|(name, value)| (self.symbol(&name), value)).collect()
    }

    /// Its states: symbol and rate.
    pub fn states(&self) -> Vec<(Symbol, Expr)> {
        self.effect.states.iter().map(|(name, s)| (self.symbol(name), self.localised(&s.rate))).collect()
    }
}
